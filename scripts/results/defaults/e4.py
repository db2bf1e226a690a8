"""E4: a disc of twelve cells across spins freely, 20 turns fast and 2 turns slowly; a ball in space. What is left is 1, exactly."""
import math

from rows import run

SPACE = ("domain={dim: 3, lower: [-0.5, -0.5, -0.5], upper: [0.5, 0.5, 0.5], cell: 0.0625}", "boundaries={x: free, y: free, z: free}",
         "bodies.disc.shape={ball: {centre: [0, 0, 0], radius: 0.37}}", f"time.end={2 * math.pi / 0.5}")
SCENES = {
    "20 turns": (),
    "20 turns, points of the lattice": ("bodies.disc.seeding=lattice",),
    "2 slow turns": ("verify.exact.spinning_disc.spin=0.05", f"time.end={4 * math.pi / 0.05}"),
    "a ball in space, 1 turn": SPACE,
}


def measure(page):
    page.write("", "## E4: a disc that spins", "")
    rows = []
    for name, settings in SCENES.items():
        result = run("e4_spin", "e4/" + name.replace(" ", "-").replace(",", ""), settings=settings)
        history = result.history()
        moment = next(values for column, values in history.items() if column in ("angular_momentum_disc", "angular_momentum_disc_z"))
        energy = [k + s for k, s in zip(history["kinetic"], history["strain"])]
        spin = [value / moment[0] for value in moment]
        kept = [value / energy[0] for value in energy]
        rows.append((name, f"{spin[-1]:.6f}", f"{max(spin):.6f}", f"{kept[-1]:.4f}", f"{max(kept):.4f}", f"{result.cpu:.1f}"))
        page.bar(f"E4: {name}: moment of momentum at the end over its start", spin[-1], 0.97, 1.01, "{:.6f}")
        page.bar(f"E4: {name}: its largest", max(spin), None, 1.01, "{:.6f}")
        page.bar(f"E4: {name}: mechanical energy at the end over its start", kept[-1], 0.95, 1.007)
        page.bar(f"E4: {name}: its largest", max(kept), None, 1.007)
    page.table(("scene", "moment of momentum", "largest", "energy", "largest", "CPU (s)"), rows)
