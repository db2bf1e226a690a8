#!/usr/bin/env python3
"""crumpled.py: a bag of slack membrane that the gas about it crushes, by rings of gas that go along (von Neumann and Richtmyer 1950)
and one ring that has the membrane's mass and no stiffness. Independent of floe; prints the areas with which inputs/extreme/crumpled.yaml
is checked, for times before sound has come back from the walls, on two meshes.
"""
import math

import numpy as np

GAMMA, OUTSIDE, OUTER, RADIUS, WALL, THICKNESS = 1.4, 1000.0, 1.0, 0.5, 1.2, 0.1


def crush(pressure, density, skin, times, rings):
    inner = np.linspace(0.0, RADIUS, rings + 1)
    outer = np.linspace(RADIUS, WALL, round(1.4 * rings) + 1)
    r = np.concatenate((inner, outer[1:]))
    area = 0.5 * (r[1:] ** 2 - r[:-1] ** 2)  # over an angle of one
    inside = np.arange(len(area)) < rings
    mass = np.where(inside, density, OUTER) * area
    energy = np.where(inside, pressure / density, OUTSIDE / OUTER) / (GAMMA - 1.0)
    node = np.zeros(len(r))
    node[:-1] += 0.5 * mass
    node[1:] += 0.5 * mass
    node[rings] += skin * THICKNESS * RADIUS
    v, t, out = np.zeros(len(r)), 0.0, []
    for end in times:
        while t < end:
            rho = mass / area
            p = (GAMMA - 1.0) * rho * energy
            c = np.sqrt(GAMMA * p / rho)
            jump = np.diff(v)
            q = np.where(jump < 0.0, rho * (2.0 * jump**2 - 0.5 * c * jump), 0.0)
            dt = min(end - t, 0.2 * np.min(np.diff(r) / (c + np.abs(jump))))
            force = np.zeros(len(r))
            force[1:-1] = r[1:-1] * np.diff(-(p + q))
            v[1:-1] += dt * force[1:-1] / node[1:-1]
            r += dt * v
            new = 0.5 * (r[1:] ** 2 - r[:-1] ** 2)
            energy -= (p + q) * (new - area) / mass
            area = new
            t += dt
        out.append(0.25 * math.pi * r[rings] ** 2)
    return out


if __name__ == "__main__":
    for pressure in (100.0, 10.0, 1.0):
        for skin in (0.05, 0.5, 5.0):
            for rings in (100, 200):
                early, late = crush(pressure, pressure * 1e-3, skin, (0.004, 0.008), rings)
                print(f"pressure {pressure:g}, skin {skin:g}: {rings} rings: area {early:.5f} at 0.004, {late:.5f} at 0.008")
