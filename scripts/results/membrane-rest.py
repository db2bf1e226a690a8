"""Membranes that gas blows up to a circle, against their exact rest. The dog-bone with cells of 0.05 takes most of its time: 280,000 steps."""
from floe import plots
from membranes import EXPLAINED, HEADER, Rest

TITLE = "Membranes that gas blows up: the exact rest"
BONE, CIRCLE = "inputs/membrane_dogbone.yaml", "inputs/membrane_circle.yaml"
# Cells, points on the membrane, published: r at 0 and 90 degrees, p, stress (York 1997, table 5).
BONES = ((0.4, 56, "1.08, 1.13; 33.4; 394"), (0.2, 100, "1.335, 1.334; 24.9; 372"), (0.1, 200, "1.388, 1.387; 27.0; 417"), (0.05, 600, "1.394, 1.396; 29.0; 447"))
GAS = 0.4746  # mass of the dog-bone's gas


def bones(page):
    page.write("## Dog-bone (York 1997, section 6.2, box 9; York 2000, section 4.3)", "",
               f"`{BONE}`, which says what is printed and what chosen; 64 gas points a cell; 56, 100, 200 and 600 points on the membrane.")
    runs, rests, rows = {}, [], []
    for h, number, published in BONES:
        runs[h] = page.run(BONE, f"dogbone-{h}", "mpm", [f"domain.cell={h}", f"bodies.skin.membrane.number={number}"], once=True)
        rests.append(Rest(runs[h]))
        rows.append((*rests[-1].row(h), published))
    page.table((*HEADER, "published: r, p, stress"), rows)
    finest = rests[-1]
    for what, value, limit in (("r at 0 degrees", finest.radius_errors[0], 0.3), ("r at 90 degrees", finest.radius_errors[1], 0.3), ("pressure", finest.pressure_error, 1),
                               ("hoop stress", finest.stress_error, 1.5), ("roundness", finest.roundness, 0.2), ("drift of energy", finest.drift, 0.1)):
        page.bar(f"dog-bone at {BONES[-1][0]}: {what}", value, "<=", limit, "{:.2g}", " %")
    page.bar(f"dog-bone at {BONES[-1][0]}: gas outside, share of its mass", finest.outside / GAS, "<=", 0, "{:.2g}")
    falls = sum(fine.worst < coarse.worst for coarse, fine in zip(rests, rests[1:]))
    page.bar("dog-bone: halvings of h at which the largest of these errors of r, p and stress falls", falls, ">=", len(BONES) - 1, "{:d}")
    return runs


def circles(page):
    page.write("## Slack circle (Sulsky and York 2000, section 8)", "", f"`{CIRCLE}`, radius 0.5, p0 = 1000; the paper has figures only. What damping takes the gas gets as heat.")
    rows = []
    for h in (0.1, 0.05):
        rest = Rest(page.run(CIRCLE, f"circle-{h}", "mpm", [f"domain.cell={h}"], once=True))
        rows.append(rest.row(h))
        page.bar(f"circle at {h}: largest error of r, p and hoop stress", rest.worst, "<=", 0.5, "{:.2g}", " %")
    page.table(HEADER, rows)


def make(page):
    page.write("Total energy is conserved, so that the rest is exact: p r = E' eps t and p A/(gamma - 1) + strain energy = p0 A0/(gamma - 1) (`membrane_rest`, for the length and the gas that are", "there).",
               *EXPLAINED, "")
    runs = bones(page)
    circles(page)
    page.write("## Bars")
    page.show_bars()
    page.write("## Against time")
    for name, said, label in (("pressure_in_skin", "pressure of the dog-bone", "pressure"), ("first_skin_x", "radius of the dog-bone", "r at 0 degrees")):
        plots.lines(page.picture(name, said), {f"h = {h}": (run.result.history["time"].values, run.result.history[name].values, {}) for h, run in runs.items()}, "t", label)
