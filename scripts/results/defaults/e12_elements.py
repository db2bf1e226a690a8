"""Taylor's bar by finite elements about the axis: a reference for row E12 that shares nothing with floe but the law.

Bilinear elements, two by two points, their volume strain the element's mean (no hourglass, no locking), lumped masses, central differences, Jaumann's rate
and radial return. The wall is a plane z = 0 without friction: it lets go of the foot, or holds it as most published programs do."""
import math

import numpy as np

RADIUS, LENGTH, SPEED, END = 3.2e-3, 32.4e-3, 227.0, 80e-6
BULK, SHEAR, YIELD, HARDENING, DENSITY = 130e9, 43.333e9, 400e6, 100e6, 8930.0
CORNER = np.array([[-1, -1], [1, -1], [1, 1], [-1, 1]], float)


def shapes():
    """Values and slopes of the four functions at the four points."""
    at = CORNER / math.sqrt(3.0)
    value = 0.25 * (1 + CORNER[None, :, 0] * at[:, None, 0]) * (1 + CORNER[None, :, 1] * at[:, None, 1])
    slope = 0.25 * np.stack((CORNER[None, :, 0] * (1 + CORNER[None, :, 1] * at[:, None, 1]),
                             CORNER[None, :, 1] * (1 + CORNER[None, :, 0] * at[:, None, 0])), axis=-1)
    return value, slope


def geometry(corner, value, slope):
    """Gradients of the functions, volumes per radian and radii at the points of each element."""
    jacobian = np.einsum("qas,eai->eqsi", slope, corner)
    det = jacobian[..., 0, 0] * jacobian[..., 1, 1] - jacobian[..., 0, 1] * jacobian[..., 1, 0]
    s, t = slope[None, ..., 0], slope[None, ..., 1]
    gradient = np.stack((s * jacobian[..., 1, 1, None] - t * jacobian[..., 0, 1, None],
                         t * jacobian[..., 0, 0, None] - s * jacobian[..., 1, 0, None]), axis=-1) / det[..., None, None]
    radius = corner[..., 0] @ value.T
    return gradient, radius * det, radius


def new_stress(stress, plastic, rates, dt):
    """Stress (rr, zz, tt, rz) and plastic strain after a step with rates (rr, zz, tt, rz, spin)."""
    rr, zz, tt, rz = stress
    c, s = np.cos(rates[4] * dt), np.sin(rates[4] * dt)
    turned = [c * c * rr + 2 * c * s * rz + s * s * zz, s * s * rr - 2 * c * s * rz + c * c * zz, tt, (c * c - s * s) * rz + c * s * (zz - rr)]
    volume = (BULK - 2.0 / 3.0 * SHEAR) * (rates[0] + rates[1] + rates[2])
    trial = [turned[k] + dt * (2 * SHEAR * rates[k] + (volume if k < 3 else 0.0)) for k in range(4)]
    mean = (trial[0] + trial[1] + trial[2]) / 3.0
    deviator = [trial[0] - mean, trial[1] - mean, trial[2] - mean, trial[3]]
    mises = np.sqrt(1.5 * (deviator[0] ** 2 + deviator[1] ** 2 + deviator[2] ** 2 + 2 * deviator[3] ** 2))
    flow = np.maximum(mises - YIELD - HARDENING * plastic, 0.0) / (3 * SHEAR + HARDENING)
    left = 1.0 - 3 * SHEAR * flow / np.maximum(mises, 1.0)
    return [left * deviator[k] + (mean if k < 3 else 0.0) for k in range(4)], plastic + flow


def bar(across, holds):
    """Length, largest radius (mm) and largest plastic strain of a bar with so many elements in its radius."""
    along = round(across * LENGTH / RADIUS)
    value, slope = shapes()
    r, z = np.meshgrid(np.linspace(0, RADIUS, across + 1), np.linspace(0, LENGTH, along + 1))
    x = np.stack((r.ravel(), z.ravel()), axis=1)
    node = (np.arange(along)[:, None] * (across + 1) + np.arange(across)[None, :]).ravel()
    corners = np.stack((node, node + 1, node + across + 2, node + across + 1), axis=1)
    v = np.zeros_like(x)
    v[:, 1] = -SPEED
    def to_nodes(what):
        return np.bincount(corners.ravel(), what.ravel(), len(x))
    mass = to_nodes(DENSITY * geometry(x[corners], value, slope)[1] @ value)
    stress, plastic = [np.zeros((len(node), 4)) for _ in range(4)], np.zeros((len(node), 4))
    speed, time = math.sqrt((BULK + 4.0 / 3.0 * SHEAR) / DENSITY), 0.0
    while time < END:
        corner = x[corners]
        edge = np.sqrt(((corner - np.roll(corner, 1, axis=1)) ** 2).sum(axis=2)).min()
        dt = min(0.5 * edge / speed, END - time)
        gradient, volume, radius = geometry(corner, value, slope)
        mean = np.einsum("eq,eqai->eai", volume, gradient)
        mean[..., 0] += (volume / radius) @ value
        mean /= volume.sum(axis=1)[:, None, None]
        velocity = v[corners]
        L = np.einsum("eqaj,eai->eqij", gradient, velocity)
        hoop = velocity[..., 0] @ value.T / radius
        more = (np.einsum("eai,eai->e", mean, velocity)[:, None] - L[..., 0, 0] - L[..., 1, 1] - hoop) / 3.0
        rates = (L[..., 0, 0] + more, L[..., 1, 1] + more, hoop + more, 0.5 * (L[..., 0, 1] + L[..., 1, 0]), 0.5 * (L[..., 0, 1] - L[..., 1, 0]))
        stress, plastic = new_stress(stress, plastic, rates, dt)
        pressure = (stress[0] + stress[1] + stress[2]) / 3.0
        rr, zz, tt, rz = (volume * (stress[0] - pressure), volume * (stress[1] - pressure), volume * (stress[2] - pressure), volume * stress[3])
        whole = (volume * pressure).sum(axis=1)[:, None]
        force_r = np.einsum("eq,eqa->ea", rr, gradient[..., 0]) + np.einsum("eq,eqa->ea", rz, gradient[..., 1]) + (tt / radius) @ value + whole * mean[..., 0]
        force_z = np.einsum("eq,eqa->ea", zz, gradient[..., 1]) + np.einsum("eq,eqa->ea", rz, gradient[..., 0]) + whole * mean[..., 1]
        v[:, 0] -= dt * to_nodes(force_r) / mass
        v[:, 1] -= dt * to_nodes(force_z) / mass
        v[:: across + 1, 0] = 0.0
        if holds:
            v[: across + 1, 1] = 0.0
        else:
            v[:, 1] = np.maximum(v[:, 1], -x[:, 1] / dt)
        x += dt * v
        time += dt
    return 1e3 * x[:, 1].max(), 1e3 * x[:, 0].max(), plastic.max()


if __name__ == "__main__":
    import sys
    for number in sys.argv[1:]:
        for holds in (False, True):
            print(number, "holds" if holds else "lets go", "length %.3f mm, radius %.3f mm, plastic strain %.2f" % bar(int(number), holds))
