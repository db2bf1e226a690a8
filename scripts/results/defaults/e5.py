"""E5: two discs bounce (Sulsky, Chen, Schreyer 1994). What is left of their energy, when they touch, what becomes of the momentum."""
import math

from rows import run

TOUCH = (0.6 * math.sqrt(2) - 0.4) / (0.2 * math.sqrt(2))
CONTACT = ("contact={between: [left, right]}",)
LEAST = {20: 0.94, 40: 0.96}


def moved(cells, share):
    """Both discs off the lattice of points by a share of a cell, and 0.6 of it."""
    x, y = share / cells, 0.6 * share / cells
    return ("domain={dim: 2, stress_state: plane_strain, lower: [-0.1, -0.1], upper: [1.1, 1.1], cell: " + str(1 / cells) + "}",
            f"bodies.left.shape={{ball: {{centre: [{0.2 + x}, {0.2 + y}], radius: 0.2}}}}",
            f"bodies.right.shape={{ball: {{centre: [{0.8 + x}, {0.8 + y}], radius: 0.2}}}}")


def touch_time(history):
    """When the first thousandth of the energy has become strain: a little after they touch."""
    start = history["kinetic"][0]
    return next((t for t, s in zip(history["time"], history["strain"]) if s > 1e-3 * start), math.nan)


def measure(page):
    page.write("", "## E5: two discs that bounce", "")
    rows = []
    for cells in (20, 40):
        for share in (0, 0.15, 0.3, 0.5):
            for contact in ((), CONTACT) if share in (0, 0.3) else ((),):
                name = f"{cells} x {cells}, off the lattice by {share:g} cells" + (", contact" if contact else "")
                result = run("e5_discs", f"e5/{cells}-{share}-{len(contact)}", settings=moved(cells, share) + contact)
                history = result.history()
                energy = [k + s for k, s in zip(history["kinetic"], history["strain"])]
                drift = max(abs(d) for axis in "xy" for d in history["drift_momentum_" + axis])
                touch = touch_time(history)
                rows.append((name, f"{energy[-1] / energy[0]:.4f}", f"{max(energy) / energy[0]:.4f}", f"{touch:.3f}", f"{drift:.1e}", f"{result.cpu:.2f}"))
                page.bar(f"E5: {name}: energy over its start", energy[-1] / energy[0], LEAST[cells], 1.005)
                page.bar(f"E5: {name}: largest drift of momentum", drift, None, 1e-13, "{:.1e}")
                if contact:
                    page.bar(f"E5: {name}: touch at {TOUCH:.4f}, measured", touch, 0.98 * TOUCH, 1.02 * TOUCH)
    page.table(("scene", "energy", "largest", f"a thousandth is strain at (touch at {TOUCH:.4f})", "drift of momentum", "CPU (s)"), rows)
