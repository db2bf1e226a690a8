#!/usr/bin/env python3
"""light_plate.py: a rigid plate between two gases: behind it a simple wave (p of its velocity, exact), before it a shock as strong as its velocity of the moment would drive
for ever. Independent of floe; prints velocity and way at the end of the cases of inputs/extreme/light_plate.yaml, and the contact's velocity without a plate.
"""
import math

GAMMA = 1.4


def behind(speed, pressure, density):
    ratio = 1 - 0.5 * (GAMMA - 1) * speed / math.sqrt(GAMMA * pressure / density)
    return pressure * max(ratio, 0.0) ** (2 * GAMMA / (GAMMA - 1))


def before(speed, pressure, density):
    half = 0.25 * (GAMMA + 1) * speed
    return pressure + density * (half + math.sqrt(half**2 + GAMMA * pressure / density)) * speed


def fly(driver, mass, end, steps=200000):
    speed = way = 0.0
    for _ in range(steps):
        speed += end / steps * (behind(speed, driver, 10.0) - before(speed, 1.0, 1.0)) / mass
        way += end / steps * speed
    return speed, way


def contact(driver):
    low, high = 0.0, 10 * math.sqrt(driver)
    for _ in range(200):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if behind(middle, driver, 10.0) > before(middle, 1.0, 1.0) else (low, middle)
    return low


if __name__ == "__main__":
    for driver, end in ((1e4, 6e-3), (1e8, 6e-5)):
        print(f"driver {driver:g}: contact {contact(driver):.6g}")
        for density in (1.0, 0.2):
            speed, way = fly(driver, 0.02 * density, end)
            print(f"  plate of {density:g}: velocity {speed:.6g}, way {way:.6g}")
