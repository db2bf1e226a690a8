"""E3: sides that let go. A block thrown off a slip side, gliding along it, arriving at it, resting on it; the mirror beside it."""
from rows import run

ROUND = "domain={dim: 2, geometry: axisymmetric, lower: [0, 0], upper: [0.5, 1], cell: 0.025}"
SPACE = "domain={dim: 3, lower: [0, 0, 0], upper: [0.8, 0.8, 0.8], cell: 0.05}"
THROWN = {
    "plane": (),
    "about the axis": (ROUND, "bodies.block.shape={box: {lower: [0, 0], upper: [0.3, 0.4]}}",
                       "boundaries={r: {upper: slip}, z: {lower: slip, upper: free}}"),
    "in space": (SPACE, "bodies.block.shape={box: {lower: [0.2, 0.2, 0], upper: [0.6, 0.6, 0.4]}}",
                 "bodies.block.velocity=[0, 0, 1]", "boundaries={x: slip, y: slip, z: {lower: slip, upper: free}}"),
}
AWAY = "bodies.block.shape={box: {lower: [0.3, 0.0125], upper: [0.7, 0.4125]}}"
DOWN = "bodies.block.velocity=[0, -1]"


def energy(history, k):
    return history["kinetic"][k] + history["strain"][k]


def kept(history):
    return energy(history, -1) / energy(history, 0)


def up(history):
    """Place and velocity along the last axis."""
    axis = "z" if "centre_block_z" in history else "y"
    return history["centre_block_" + axis], history["velocity_block_" + axis]


def thrown(page):
    rows = []
    for name, settings in THROWN.items():
        history = run("e3_block", "e3/thrown-" + name.replace(" ", "-"), settings=settings + ("time.end=0.3",)).history()
        place, velocity = up(history)
        way = place[-1] - place[0]
        rows.append((name, f"{way:.6f}", f"{velocity[-1]:.6f}", f"{kept(history):.6f}"))
        page.bar(f"E3: thrown off a slip side, {name}: way over v t", way / 0.3, 0.99, 1.01, "{:.6f}")
        page.bar(f"E3: thrown off a slip side, {name}: energy over its start", kept(history), 0.99, 1.01, "{:.6f}")
    page.table(("thrown off", "way (0.3 m)", "velocity (1 m/s)", "energy over its start"), rows)


def mirror(page):
    history = run("e3_block", "e3/mirror", settings=("boundaries.y.lower=symmetry",)).history()
    page.bar("E3: thrown off a mirror: greatest way of the centre, m (0.3 where it lets go)", max(up(history)[0]) - 0.2, None, 0.05)


def glides(page):
    history = run("e3_block", "e3/glides", settings=("bodies.block.velocity=[0.5, 0]",)).history()
    page.bar("E3: gliding along a slip side: energy over its start", kept(history), 0.99, 1.01, "{:.9f}")


def arrives(page):
    """With the contact of 2 L/c = 0.0196 s, all is over at 0.06 s."""
    rows = []
    for cell in (0.05, 0.025, 0.0125):
        away = AWAY.replace("0.4125", str(0.4 + cell / 2)).replace("0.0125", str(cell / 2))
        history = run("e3_block", f"e3/arrives-{cell}", settings=(DOWN, away, f"domain.cell={cell}", "time.end=0.06",
                                                                   "output.history_interval=0.0005")).history()
        before = [e for t, e in zip(history["time"], history["kinetic"]) if t < 0.9 * cell / 2]
        rows.append((cell, f"{min(before) / before[0]:.6f}", f"{kept(history):.4f}", f"{up(history)[1][-1]:.4f}"))
    page.table(("cell (m)", "energy until it arrives", "energy after", "velocity after (m/s)"), rows)
    page.bar("E3: half a cell from a slip side, moving to it: energy over its start, cell 0.0125 m", float(rows[-1][2]), 0.99, 1.01)


def rests(page):
    """At rest under its weight, once damping has taken the swing with which it began."""
    history = run("e3_block", "e3/rests", settings=(
        "bodies.block.velocity=[0, 0]", "loads={weight: {gravity: {acceleration: [0, -10]}}}",
        "damping={rate: 20, end: 0.5}", "time.end=0.8")).history()
    late = [k for k, t in enumerate(history["time"]) if t > 0.6]
    ledger = history["ledger_momentum_y_boundary"]
    borne = (ledger[-1] - ledger[late[0]]) / (history["time"][-1] - history["time"][late[0]])
    page.bar("E3: resting on a slip side: force of the side over the weight", borne / (1000 * 0.4 * 0.4 * 10), 0.99, 1.01)


def measure(page):
    page.write("## E3: sides that let go", "",
               "A block of rubber on a slip side (`inputs/defaults/e3_block.yaml`), with defaults only. Exact: it flies on as it was thrown.")
    thrown(page)
    mirror(page)
    glides(page)
    arrives(page)
    rests(page)
