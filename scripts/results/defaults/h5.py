"""H5: a cylinder that sinks in water, by its added mass."""
import numpy as np
from rows import run

RADIUS, TANK, START, END = 0.2, 2.0, 1.2, 0.25  # m, m (its width and height), m, s
HEAVY, WATER, GRAVITY = 2000.0, 1000.0, 9.81


def added_mass(y):
    """Added mass of the cylinder at height y over the mass of the water that it displaces: potential flow in the square tank, by sources
    inside the cylinder and outside the tank that fit the normal velocity on both."""
    angle = np.linspace(0.0, 2.0 * np.pi, 240, endpoint=False)
    normal = np.column_stack((np.cos(angle), np.sin(angle)))
    half, along = TANK / 2.0, (np.arange(120) + 0.5) / 120.0
    places, normals, speeds = [RADIUS * normal + [0.0, y]], [normal], [normal[:, 1]]
    corners = np.array([(-half, 0.0), (half, 0.0), (half, TANK), (-half, TANK), (-half, 0.0)])
    for a, b, out in zip(corners[:-1], corners[1:], ((0, -1), (1, 0), (0, 1), (-1, 0))):
        places.append(a + (b - a) * along[:, None])
        normals.append(np.tile(np.array(out, float), (len(along), 1)))
        speeds.append(np.zeros(len(along)))
    ring = [np.linspace(0.0, 2.0 * np.pi, n, endpoint=False) for n in (80, 160)]
    sources = np.vstack([0.6 * RADIUS * np.column_stack((np.cos(ring[0]), np.sin(ring[0]))) + [0.0, y],
                         TANK * np.column_stack((np.cos(ring[1]), np.sin(ring[1]))) + [0.0, half]])
    place = np.vstack(places)
    arm = place[:, None] - sources[None]
    square = (arm ** 2).sum(2)
    strength = np.linalg.lstsq(np.einsum("ijk,ik->ij", arm, np.vstack(normals)) / square, np.concatenate(speeds), rcond=1e-13)[0]
    potential = 0.5 * np.log(square[:240]) @ strength
    return -(potential * normal[:, 1]).mean() * 2.0 / RADIUS


def way(steps=50):
    """How far the cylinder has sunk by the end (m): (m + m_added) v is its momentum, whose change with height acts back on it (Lamb, article 137)."""
    y, v, dt = START, 0.0, END / steps
    for _ in range(steps):
        share, slope = added_mass(y), (added_mass(y + 1e-3) - added_mass(y - 1e-3)) / 2e-3
        fall = (-(HEAVY - WATER) * GRAVITY - 0.5 * WATER * slope * v * v) / (HEAVY + WATER * share)
        y, v = y + dt * (v + 0.5 * dt * fall), v + dt * fall
    return START - y


def measure(page):
    exact = way()
    page.write("## H5: a cylinder let go in water", "", f"By the added mass of potential flow it sinks by {exact:.5f} m in 0.25 s.", "")
    rows = []
    for coupling, most in (("ice-mpm", 0.01), ("mpm", 0.05)):
        for h in (0.05, 0.025):
            done = run("h5_cylinder", f"h5/{coupling}-{h}", coupling=coupling, settings=(f"domain.cell={h}",))
            sunk = START - done.history()["centre_cylinder_y"][-1]
            rows.append((coupling, h, f"{sunk:.5f}", f"{100 * (sunk / exact - 1):+.2f} %", f"{done.history()['drift_energy'][-1]:.1e}", f"{done.cpu:.1f}"))
            page.bar(f"H5 cylinder in water, {coupling}, h = {h}: way, error", abs(sunk / exact - 1.0), None, most)
    page.table(("coupling", "h, m", "way, m", "error", "drift of energy", "CPU, s"), rows)
