"""Two elastic bars that collide, with and without a contact; normals of pairs of bodies."""
import re

import numpy
from curves import curves

TITLE = "Two bars that collide: release, restitution, energy; normals"
DECK = "inputs/two_bars.yaml"
WITHOUT_NU = ["materials.bar.law.linear_elastic.bulk_modulus=33333.333333333336", "materials.bar.law.linear_elastic.shear_modulus=5e4"]
WAYS = {
    "stick": ["contact.kind=stick", "contact.criterion=null", "contact.touch=nodes"],
    **{f"release, {criterion}, nodes": [f"contact.criterion={criterion}", "contact.touch=nodes"] for criterion in ("pair", "mean", "both")},
    "release, pair": [],
    "friction, 0": ["contact.kind=friction"],
    "release, pair, quadratic basis": ["method.basis=quadratic"],
}


def after_impact(run):
    """Time of contact, both velocities, restitution, share of the energy lost, largest drift of momentum: means from 0.03 to 0.2 after the right bar
    has begun to move."""
    column = {name: one.values for name, one in run.result.history.items()}
    time, energy = column["time"], column["kinetic"] + column["strain"]
    left, right = column["velocity_left_x"], column["velocity_right_x"]
    start = time[right > 0.02][0]
    then = (time >= start + 0.03) & (time <= start + 0.2)
    return start, left[then].mean(), right[then].mean(), (right - left)[then].mean() / 2, 1 - energy[then].mean() / energy[0], column["drift_momentum_x"].max()


def bars(page):
    page.write("Two elastic bars in plane stress, 1.25 by 4.5, the left one at velocity 2 (York 1997, appendices A.1 and A.4.12; `inputs/two_bars.yaml`). Published: without release they",
               "stick; with it the left bar keeps 0.3 and the right one leaves with 1.7 (restitution 0.7, nu = 0.3, 11 % of the energy lost); with nu = 0, 2 % is lost at two",
               "meshes. In theory the restitution is 1 for nu = 0, by waves along the bars, and about 0.95 for nu = 0.3, where lateral vibration keeps the rest. The bars meet",
               "at t = 0.25; where contact is at shared nodes they do so up to a cell before.")
    runs, rows, drifts, restitutions = {}, [], [], []
    for nu in (0.3, 0):
        for h in (0.25, 0.125):
            for way, settings in WAYS.items():
                folder = f"{nu}-{h}-" + re.sub("[^a-z0-9]+", "-", way)
                run = runs[(nu, h, way)] = page.run(DECK, folder, None, [f"domain.cell={h}", *(WITHOUT_NU if nu == 0 else []), *settings], once=True)
                start, left, right, restitution, lost, drift = after_impact(run)
                rows.append((nu, h, way, f"{start:.3f}", f"{left:.3f}", f"{right:.3f}", f"**{restitution:.3f}**", f"{100 * lost:.2f} %", f"{drift:.1e}"))
                if way.endswith("nodes"):
                    drifts.append(drift)
                    restitutions.append(restitution)
    page.table(("nu", "h", "contact", "bars meet at t", "left after", "right after", "restitution", "energy lost", "momentum drift"), rows)
    page.bar("momentum: largest drift over its size, release at nodes, all criteria, meshes, nu", float(max(drifts)), "<=", 1e-12, "{:.1e}")
    page.bar("least restitution with release at nodes: the bars part", float(min(restitutions)), ">=", 0.7, "{:.3f}")
    return runs


def words(page):
    page.write("The energy that `friction` loses is that of the impulses at the nodes that stop the approach, and falls with h; `release` hands on the acceleration of the",
               "common field and loses none with the deck's linear basis; with quadratic splines 5 to 8 % are lost. In one dimension, against the waves in the bars (`test_impact` of `verification_mpm_contact`; the reference is `bar_impact`), the restitution",
               "comes to 1 as the bars have more cells. York's own step of 0.0007 is 0.93 of h/c; with it and the linear basis energy grows here, and 0.4 h/c is used.", "",
               "`release` and `friction` without `nodes`: contact where points have met, the default. The three criteria of the thesis agree where a pair has one normal, as York found for the",
               "first two.")


def curve(run, *names):
    history = run.result.history
    return history["time"].values, sum(history[name].values for name in names)


def apart(run):
    """The longest time after the first contact in which no force is between the bars: the velocities of both stay what they are."""
    time, right = curve(run, "velocity_right_x")
    changes = numpy.flatnonzero((abs(numpy.diff(right)) > 1e-6) | (time[1:] < time[right > 0.02][0]))
    longest = numpy.diff(changes).argmax()
    return time[changes[longest] + 1], time[changes[longest + 1]]


def figures(page, runs):
    blue, red, grey = "#1060b0", "#c03020", "#606060"
    series = {}
    for said, way, colour in (("no release", "stick", grey), ("release at nodes", "release, pair, nodes", blue), ("release where points have met", "release, pair", red)):
        for side, style in (("left", "-"), ("right", "--")):
            series[f"{said}, {side}"] = (*curve(runs[(0.3, 0.25, way)], f"velocity_{side}_x"), {"color": colour, "linestyle": style})
    page.write("## Velocities (York 1997, figures 93 and 95), nu = 0.3, h = 0.25")
    curves(page.picture("velocities", "velocities of the centres of mass"), series, "t", "velocity of the centre of mass")
    begin, end = apart(runs[(0.3, 0.25, "stick")])
    page.write(f"Without release the bars are free of each other from t = {begin:.3f} to {end:.3f}, with a cell between them, and then meet again: the thesis names 0.35 and 0.425.",
               "", "## Energy (York 1997, figure 96)")
    energy = ("kinetic", "strain")
    series = {
        "release, nu = 0, h = 0.25": (*curve(runs[(0, 0.25, "release, pair, nodes")], *energy), {"color": blue}),
        "release, nu = 0, h = 0.125": (*curve(runs[(0, 0.125, "release, pair, nodes")], *energy), {"color": blue, "linestyle": "--"}),
        "release, nu = 0.3, h = 0.25": (*curve(runs[(0.3, 0.25, "release, pair, nodes")], *energy), {"color": red}),
        "without friction, nu = 0.3, h = 0.25": (*curve(runs[(0.3, 0.25, "friction, 0")], *energy), {"color": grey}),
        "strain energy, release, nu = 0.3, h = 0.25": (*curve(runs[(0.3, 0.25, "release, pair, nodes")], "strain"), {"color": red, "linestyle": ":"}),
    }
    curves(page.picture("energies", "energies"), series, "t", "energy of both bars")
    page.write("## Points at the end (York 1997, figures 93a and 95a), nu = 0.3, h = 0.25", "")
    for way, said in (("stick", "without release"), ("release, pair, nodes", "with release at shared nodes")):
        page.drawn(runs[(0.3, 0.25, way)], "contact-points-" + way.split(",")[0], said, "--points", "velocity_x", "--range", "-1:3", "--width", 600)


def normals(page):
    said = page.test("verification_mpm_normals", "tests/verification/test_mpm_normals.c")
    page.write("## Normals", "", "Angle between the normal of a pair of bodies and the exact one, at all nodes that both reach, in degrees: root mean square / worst at h = 0.05, 0.025 and 0.0125",
               "(spheres: 0.05), two points along each axis of a cell. By `verification_mpm_normals`. The error is that of the few points about a node, and does not fall with h. Largest are those",
               "of nodes that a body hardly reaches.")
    rows = [(body, normals, basis, seeding, *(errors.split("  ") + ["", ""])[:3])
            for body, normals, basis, seeding, errors in re.findall(r"^(plane|circle|sphere), (\w+), (\w+), (\w+): +(.*)$", said, re.MULTILINE)]
    page.table(("surface", "normals", "basis", "seeding", "h = 0.05", "0.025", "0.0125"), rows)
    page.write("A ball that touches a net of one layer of points (York 1997, figure 101): nodes that both reach, those of them beyond the net, and the worst angle.")
    page.table(("normals", "basis", "nodes", "beyond the net", "worst"),
               re.findall(r"^net, (\w+), (\w+): (\d+) nodes, (\d+) beyond it, worst (\S+)$", said, re.MULTILINE))


def make(page):
    runs = bars(page)
    words(page)
    page.write("", "## Bars")
    page.show_bars()
    figures(page, runs)
    normals(page)
