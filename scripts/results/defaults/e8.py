"""E8: bodies that overlap, leave the domain, lie between points or are thinner than a cell: one answer, or a word about it."""
import math

import rows

GAS = 1e5 / (0.4 * 717.5 * 300)
EXACT = {"mass_steel": 7800 * 0.09 * math.pi, "mass_gas": GAS * (0.64 - 0.09 * math.pi), "mass_air": GAS * 0.36}
SECOND = "bodies.second={material: steel, shape: {box: {lower: [0.5, 0.5], upper: [0.93, 0.97]}}}"
# What is changed, and what must be said of it: in a refusal (status 2).
REFUSED = [
    ("two solids overlap", [SECOND], "solid 'second' overlaps solid 'ball'"),
    ("a solid between the points of its lattice",
     ["bodies.dot={material: steel, seeding: lattice, shape: {ball: {centre: [0.026, 0.026], radius: 0.002}}}"],
     "no point lies in it"),
    ("a body outside the domain", ["bodies.ball.shape.ball.centre=[3, 3]"], "lies outside the domain"),
]


def measure(page):
    page.write("Bodies that overlap (`inputs/defaults/e8_bodies.yaml`): masses over the exact ones.")
    table = []
    for coupling, most in (("mpm", 1e-4), ("ice-mpm", 1e-2)):
        run = rows.run("e8_bodies", "e8-" + coupling, coupling)
        history = run.history() if run.status == 0 else {}
        errors = {name: abs(history[name][0] / exact - 1) if name in history else math.nan for name, exact in EXACT.items()}
        table.append([coupling, run.status] + [f"{errors[name]:.1e}" for name in EXACT])
        page.bar(f"E8 {coupling}: largest error of a mass", max(errors.values(), key=lambda x: math.inf if math.isnan(x) else x),
                 None, most)
    page.table(["coupling", "exit status", *EXACT], table)
    table = []
    for what, settings, words in REFUSED:
        for coupling in ("mpm", "ice-mpm"):
            run = rows.run("e8_bodies", "e8-refused", coupling, settings)
            said = run.status == 2 and words in run.text
            table.append([what, coupling, run.status, run.text.strip().replace("|", "/")[:160]])
            page.bar(f"E8 {coupling}: {what} is refused", 1 if said else 0, 1, 1)
    page.table(["what", "coupling", "exit status", "said"], table)
