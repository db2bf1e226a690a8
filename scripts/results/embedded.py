"""Membranes thinner than a cell that hold gas of the cells. The dog-bone with cells of 0.1 takes minutes."""
import math

import floe
from membranes import HEADER, Rest, largest

TITLE = "Membranes thinner than a cell that hold gas of the cells"
CIRCLE, BONE, PISTON = (f"inputs/{name}.yaml" for name in ("membrane_circle", "membrane_dogbone", "piston_membrane"))
# York's strain and transfer, without what the deck of the rest adds to them.
PLAIN = ["bodies.skin.membrane.strain=null", "bodies.skin.membrane.smoothing=null", "method={basis: quadratic, flip: 1}", "materials.air={eos: {ideal: {gamma: 1.4, specific_heat: 1}}}",
         "damping=null"]
STREAM = ["domain={dim: 2, stress_state: plane_strain, lower: [0, 0], upper: [1, 0.3], cell: 0.05}", "materials.gas.viscosity=null",
          "boundaries={x: {lower: {inlet: {velocity: [10, 0], material: gas, pressure: 1000, temperature: 2500}}, upper: free}, y: slip}",
          "bodies.gas={material: gas, shape: {box: {lower: [0, 0], upper: [0.313, 0.3]}}, pressure: 1000, density: 1, velocity: [10, 0]}",
          "bodies.air={material: air, shape: {box: {lower: [0, 0], upper: [1, 0.3]}}, pressure: 1000, temperature: 700, velocity: [10, 0]}",
          "bodies.skin.velocity=[10, 0]", "bodies.skin.membrane.curve={segment: {from: [0.313, 0], to: [0.313, 0.3]}}", "time.end=0.05"]
REST = ["ambient={material: air, pressure: 1000, temperature: 700}", "boundaries={x: symmetry, y: symmetry}", "time.end=0.02"]


def rest(page):
    page.write("## At rest, and in a stream")
    still = page.run(CIRCLE, "rest", "ice-mpm", [*PLAIN, *REST], once=True)
    stream = page.run(CIRCLE, "stream", "ice-mpm", [*PLAIN, *STREAM], once=True)

    def pressures(run):
        return ", ".join(f"{largest(run, 'pressure_' + gas, 1000):.2g}" for gas in ("gas", "air"))

    page.table(("what", "measured"), [
        (f"two gases of one pressure (1000) at rest, {still.result.summary['steps']} steps: largest change of either pressure", pressures(still)),
        ("the same: gas beyond the membrane", f"{largest(still, 'outside_skin'):.2g}"),
        ("a plane membrane carried through ten sides of cells: largest change of either pressure", pressures(stream)),
        ("the same: velocity of the membrane off by", f"{largest(stream, 'velocity_skin_x', 10):.2g}")])
    page.bar("two gases at rest: largest change of pressure, share", largest(still, "pressure_gas", 1000) / 1000, "<=", 1e-12, "{:.1e}")
    page.bar("two gases at rest: gas beyond the membrane", largest(still, "outside_skin"), "<=", 0, "{:.2g}")
    page.bar("membrane in a stream: largest change of pressure, share", largest(stream, "pressure_air", 1000) / 1000, "<=", 1e-12, "{:.1e}")


def piston(page):
    page.write("## Piston (York 1997, section 6.1; York 2000, section 4.2)", "",
               f"`{PISTON}`: a sheet of four points on springs, which starts on a side of cells and crosses it twice a period; exact 0.0070882 and 0.0223479.")
    runs = [(0.1, h, page.run(PISTON, f"piston-{h}", None, [f"domain.cell=[{h}, 1]"], once=True)) for h in (4, 2, 1, 0.5)]
    heavy = ["materials.sheet.density=100", "verify.reference.piston.mass=1", "time.end=0.067"]
    page.table(("m", "h", "period, error", "turning points, error", "drift of energy"), [
        (mass, h, floe.percent(run.error("hperiod_position"), 2), floe.percent(run.error("hturns_position"), 2), f"{largest(run, 'drift_energy'):.2g}")
        for mass, h, run in [*runs, (1, 1, page.run(PISTON, "piston-heavy", None, heavy, once=True))]])
    errors = [run.error("hperiod_position") for _, _, run in runs]
    page.write(f"Order of the period in h: {', '.join(f'{math.log2(a / b):.2f}' for a, b in zip(errors, errors[1:]))}.", "")
    page.bar("piston, h = 1: period", 100 * errors[2], "<=", 1, "{:.2g}", " %")


def circle(page):
    page.write("## Slack circle (A4)", "", f"`{CIRCLE} --coupling ice-mpm --set time.end=0.2`, the other side a vacuum.")
    rows = []
    for h in (0.1, 0.05):
        found = Rest(page.run(CIRCLE, f"circle-{h}", "ice-mpm", [f"domain.cell={h}", "time.end=0.2"], once=True))
        rows.append(found.row(h))
        page.bar(f"circle at {h}: r", max(found.radius_errors), "<=", 0.01, "{:.2g}", " %")
        page.bar(f"circle at {h}: pressure", found.pressure_error, "<=", 0.2, "{:.2g}", " %")
        page.bar(f"circle at {h}: hoop stress", found.stress_error, "<=", 0.2, "{:.2g}", " %")
    page.table(HEADER, rows)


def bone_bars(page, what, found):
    page.bar(f"{what}: largest error of r and p", max(*found.radius_errors, found.pressure_error), "<=", 1, "{:.2g}", " %")
    page.bar(f"{what}: gas beyond the membrane", found.outside, "<=", 0, "{:.2g}")


def bones(page):
    page.write("## Dog-bone (A3)", "", f"`{BONE} --coupling ice-mpm`: 56, 100 and 200 points on the membrane, cells of h.")
    rows = []
    for h, number in ((0.4, 56), (0.2, 100), (0.1, 200)):
        found = Rest(page.run(BONE, f"dogbone-{h}", "ice-mpm", [f"domain.cell={h}", f"bodies.skin.membrane.number={number}"], once=True))
        rows.append(found.row(h))
        bone_bars(page, f"dog-bone at {h}", found)
    page.table(HEADER, rows)
    page.write("## Dog-bone with normals to unconnected points (A5)", "",
               "The same on a mesh of 10 by 10 with `normals: isosurface`, 100 points: tangents of the stress come from the points as they lie; the line that cuts the cells goes through them in their",
               "order. With gas as points: [normals](normals.md).")
    found = Rest(page.run(BONE, "unconnected", "ice-mpm", ["bodies.skin.membrane.normals=isosurface", "domain.upper=[2, 2]", "domain.cell=0.2", "bodies.skin.membrane.number=100"], once=True))
    page.table(HEADER, [found.row(0.2)])
    bone_bars(page, "dog-bone, unconnected normals", found)


def tried(page):
    page.write("## Other ways that were tried", "", "The circle at h = 0.1 with a thin outer gas (pressure 1), to t = 0.06, by programs that are not kept:")
    page.table(("way", "pressure (exact 989)", "gas of the inside in cells wholly outside", "more than a cell outside"), [
        ("one mixture pressure a cell, the membrane a solid of the mixture", 619, "1.3 %", "0.015 %"),
        ("the same, and faces pass each gas only through what is open to it", 838, 0, 0), ("each gas by itself in cut cells (kept)", 988, 0, 0)])
    page.write("A mixture has one pressure in a cut cell, so that the jump across the membrane is spread over cells that the inner gas shares with the outer: the inner gas expands into them, and",
               "against a membrane that takes a part of the cell by its thickness (15 % of the gas is displaced at the start). Limiting the fluxes stops the leak, not the loss of pressure.", "")


def make(page):
    page.write("Gas on cells inside a membrane of points ([theory](../theory/README.md)). Errors of the rest are those of means over the last tenth of the time, as in [membrane-rest](membrane-rest.md).",
               "About an axis, a balloon and a tube: [axis](axis.md); bags that are hit: [airbag](airbag.md).", "")
    for part in (rest, piston, circle, bones, tried):
        part(page)
    page.write("## Bars")
    page.show_bars()
