#!/usr/bin/env python3
"""spinning.py: a disc of neo-Hookean rubber that has the stress and the velocity of the one that spins steadily by the linear theory, by rings: radius and angle of each,
midpoint elements, symplectic steps. Independent of floe; prints the energies with which inputs/extreme/spinning.yaml is checked, on two meshes.
"""
import math

import numpy as np

BULK, SHEAR, DENSITY = 0.6666666667, 0.25, 1.0
LAME = BULK - 2.0 / 3.0 * SHEAR


def stretches(stress):
    """The principal stretches with which the law has three principal stresses."""
    found = np.ones(3)
    for _ in range(200):
        volume = np.prod(found)
        left = stress - (SHEAR * (found**2 - 1.0) + LAME * np.log(volume)) / volume
        mean = np.mean(left)
        found = found * (1.0 + (left - mean) / (2.0 * SHEAR) + mean / (3.0 * BULK))
    return found


def start(spin, radius, nu):
    """Stretches along, about and across each ring, by the stress of the steady disc (Timoshenko and Goodier, art. 32, plane strain)."""
    scale = DENSITY * spin**2 / (8.0 * (1.0 - nu))
    along = scale * (3.0 - 2.0 * nu) * (1.0 - radius**2)
    about = scale * ((3.0 - 2.0 * nu) - (1.0 + 2.0 * nu) * radius**2)
    return np.array([stretches(np.array([a, b, nu * (a + b)])) for a, b in zip(along, about)]).T


def spin_up(spin, end, rings):
    edge = np.linspace(0.0, 1.0, rings + 1)
    width = np.diff(edge)
    middle = 0.5 * (edge[1:] + edge[:-1])
    mass = np.zeros(rings + 1)
    area = middle * width  # over 2 pi
    mass[:-1] += 0.5 * DENSITY * area
    mass[1:] += 0.5 * DENSITY * area
    r, angle, speed = edge.copy(), np.zeros(rings + 1), np.zeros(rings + 1)
    # As it would turn at rest in its frame (Timoshenko and Goodier, art. 32, plane strain), at the places before it has stretched.
    nu, modulus = (3 * BULK - 2 * SHEAR) / (2 * (3 * BULK + SHEAR)), 9 * BULK * SHEAR / (3 * BULK + SHEAR)
    grown = (1 - 2 * nu) * (1 + nu) / (8 * modulus * (1 - nu)) * DENSITY * spin**2 * r * (3 - 2 * nu - r**2)
    moment = mass * r * spin * (r + grown)
    first = start(spin, middle, nu)
    steps = math.ceil(end / (0.1 / rings))
    dt = end / max(steps, 1)
    for _ in range(steps):
        stretch, radius = first[0] * np.diff(r) / width, 0.5 * (r[1:] + r[:-1])
        hoop, shear = first[1] * radius / middle, first[0] * radius * np.diff(angle) / width
        volume = LAME * np.log(stretch * hoop * first[2]) - SHEAR
        along = area * first[0] * (SHEAR * stretch + volume / stretch) / width
        across = 0.5 * area * (SHEAR * shear**2 / radius + first[1] * (SHEAR * hoop + volume / hoop) / middle)
        turn = area * SHEAR * shear * radius * first[0] / width
        force, couple = np.zeros(rings + 1), np.zeros(rings + 1)
        force[:-1] += along - across
        force[1:] -= along + across
        couple[:-1] += turn
        couple[1:] -= turn
        speed[1:] += dt * (force[1:] / mass[1:] + (moment[1:] / mass[1:]) ** 2 / r[1:] ** 3)
        moment[1:] += dt * couple[1:]
        r[1:] += dt * speed[1:]
        angle[1:] += dt * moment[1:] / (mass[1:] * r[1:] ** 2)
        angle[0] = angle[1]
    kinetic = 0.5 * np.sum(mass[1:] * speed[1:] ** 2 + moment[1:] ** 2 / (mass[1:] * r[1:] ** 2))
    stretch, radius = first[0] * np.diff(r) / width, 0.5 * (r[1:] + r[:-1])
    hoop, shear = first[1] * radius / middle, first[0] * radius * np.diff(angle) / width
    log_j = np.log(stretch * hoop * first[2])
    square = stretch**2 + shear**2 + hoop**2 + first[2] ** 2
    strain = np.sum(area * (0.5 * SHEAR * (square - 3.0) - SHEAR * log_j + 0.5 * LAME * log_j**2))
    return 2 * math.pi * kinetic, 2 * math.pi * strain, 2 * math.pi * np.sum(moment)


if __name__ == "__main__":
    for spin, end in ((0.1, 0.0), (0.1, 1.5), (0.3, 0.0), (0.3, 1.5), (0.6, 0.0), (0.6, 1.5)):
        for rings in (40, 80):
            kinetic, strain, moment = spin_up(spin, end, rings)
            print(f"spin {spin} at {end}: {rings} rings: kinetic {kinetic:.6g}, strain {strain:.6g}, angular momentum {moment:.6g}")
