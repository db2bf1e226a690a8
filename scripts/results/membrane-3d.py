"""Membranes as surfaces in space."""
import math

import floe
import numpy
from membranes import late

TITLE = "Membranes in space: points on a surface, in no order"
SPHERE, TUBE, REVOLVED, PATCH = (f"inputs/membrane_{name}.yaml" for name in ("sphere", "tube", "revolved", "patch"))
# The decks without `encloses`: points of the gas push by themselves. The exact rest of the balloon as its start. The dog-bone in (r, z).
FREE = ["bodies.skin.membrane={surface: {sphere: {centre: [0, 0, 0], radius: 0.5}}, thickness: 0.1, section: volume}",
        "verify.history={pressure: pressure_gas, gas_energy: internal_gas, strain_energy: strain_skin}", "verify.metrics=[hlate_pressure, hlate_gas_energy, hlate_strain_energy]"]
TUBE_FREE = ["bodies.skin.membrane={surface: {cylinder: {centre: [0, 0, 0], radius: 0.5, from: 0, to: 0.4}}, thickness: 0.1, section: volume}"]
AT_REST = ["bodies.gas.shape.ball.radius=0.517445", "bodies.gas.pressure=884.042", "bodies.gas.density=0.902263", "time.end=0.02"]
REST_SKIN = "surface: {sphere: {centre: [0, 0, 0], radius: 0.517445}}, thickness: 0.0933714, section: volume, slack: -0.0342933"
IN_RZ = ["boundaries={r: {lower: symmetry, upper: slip}, z: {lower: symmetry, upper: slip}}", "bodies.gas.points=3", "bodies.knob.points=3",
         "bodies.gas.shape={box: {lower: [0, 0], upper: [0.3, 0.45]}}", "bodies.knob.shape={box: {lower: [0, 0.45], upper: [0.5, 0.75]}}",
         "bodies.skin.membrane={curve: {polyline: {vertices: [[0.32, 0], [0.32, 0.42], [0.52, 0.45], [0.52, 0.7], [0.42, 0.78], [0, 0.8]]}}, thickness: 0.1, section: volume}"]
METRICS = ("hlate_pressure", "hlate_area", "hlate_gas_energy", "hlate_strain_energy")
ACROSS = ("pressure", "volume inside", "energy of the gas", "strain energy")


def drift(run):
    return run.result.summary["conservation"]["energy"]


def percent(value):
    return "-" if math.isnan(value) else f"{100 * value:.4f}"


def order(coarse, fine, ratio, metric):
    return math.log(coarse.error(metric) / fine.error(metric)) / math.log(ratio)


def balloon(page):
    page.write("## Balloon", "", f"`{SPHERE}`, an eighth of a sphere between three mirrors: p = 2 sigma t/r and the total energy give the rest. Errors in per cent of the exact value; that of the radius is a",
               "third of the volume's.")
    header = ("cell", "cells across", *ACROSS, "drift of energy")
    held = {h: page.run(SPHERE, f"sphere-{h}", None, [f"domain.cell={h}"], once=True) for h in (0.1, 0.075, 0.05)}
    page.table(header, [(h, f"{1 / h:.0f}", *(percent(run.error(metric)) for metric in METRICS), percent(drift(run))) for h, run in held.items()])
    page.write("The same without `encloses`: the points of the gas push by themselves.")
    free = {h: page.run(SPHERE, f"free-{h}", None, [f"domain.cell={h}", *FREE], once=True) for h in (0.1, 0.05)}
    page.table(header, [(h, f"{1 / h:.0f}", *(percent(run.error(metric)) for metric in METRICS), percent(drift(run))) for h, run in free.items()])
    page.bar("balloon, 20 cells across: pressure off the exact rest, per cent", 100 * held[0.05].error("hlate_pressure"), "<=", 1, "{:.4f}")
    for what, metric in (("pressure", "hlate_pressure"), ("radius", "hlate_area"), ("strain energy", "hlate_strain_energy")):
        page.bar(f"balloon, 10 to 20 cells across: order of the {what}", order(held[0.1], held[0.05], 2, metric), ">=", 1, "{:.2f}")
    return held[0.1]


def off_start(run, name):
    """By how many per cent the mean of the last tenth is off the start."""
    return f"{100 * (late(run, name) / run.result.history[name].values[0] - 1):+.4f}"


def from_rest(page):
    page.write("## Where the error comes from", "",
               "The balloon from its exact rest (radius 0.517445, pressure 884.042, stress 2449.6): nothing should happen. Means of the last tenth of 0.02, per cent off the start; *noise*: kinetic energy",
               "over the gas's energy.")
    rows = []
    for h in (0.1, 0.05):
        for encloses in ("", ", encloses: gas"):
            run = page.run(SPHERE, f"rest{'-held' if encloses else ''}-{h}", None, [f"domain.cell={h}", *FREE, *AT_REST, f"bodies.skin.membrane={{{REST_SKIN}{encloses}}}"], once=True)
            rows.append((h, "encloses" if encloses else "", *(off_start(run, name) for name in ("pressure_gas", "strain_skin", "internal_gas")),
                         f"{late(run, 'kinetic') / late(run, 'internal_gas'):.1e}"))
    page.table(("cell", "", "pressure", "strain energy", "energy of the gas", "noise"), rows)
    page.write("Without `encloses` the pressure of the points is off because their volumes are: p V is right, as is the energy. Two sums over points are no exact integrals: gas of even pressure pushes the",
               "nodes inside it by p sum V grad S, which should be nothing, and swells by sum V div v, which should be what the space grows by. Points move so as to swell, for that lowers their energy;",
               "the finer the cells, the sooner, so that the error grows as cells shrink. The same forces push the membrane unevenly, and its strain energy comes out too large. With `encloses` the",
               "membrane bears the mean pressure by its own normals and areas, the points push by what they differ from it, and their volumes fill the space that normals and areas tell. What is left:",
               "the strain energy still creeps, by noise in the plane of the membrane, whose points keep a strain each; smaller steps make it less. Tried and not kept: stretching by the part of",
               "the step in the plane alone (no change); `flip: 0.9` (half the strain energy's error, three times the pressure's); `stress: usl` (worse); no shear viscosity, and 27 points of gas a",
               "cell (no change).")


def listed(page, own):
    """The same balloon from a list of its points."""
    points = own.result.snapshots[0].points("skin", "position").values
    path = page.runs / "points.csv"
    path.write_text("x (m),y (m),z (m)\n" + "".join(",".join(f"{x:.17g}" for x in place) + "\n" for place in points), encoding="ascii")
    place = "../" + str(path.relative_to(page.runs.parents[2]))
    run = page.run(SPHERE, "listed", None, [f"bodies.skin.membrane.surface={{points: {{at: {place}, area: 0.39269908169872414}}}}"], once=True)
    page.write("### From a list of points", "", "The points that `surface: {sphere: ...}` makes, read from a file (`surface: {points: {at: points.csv, area: ...}}`), at cells of 0.1: errors in per cent, normals in",
               "degrees at the end.")
    page.table(("", "pressure", "energy of the gas", "strain energy", "normals: worst", "root mean square"), [
        (said, *(f"{100 * one.error(metric):.6f}" for metric in ("hlate_pressure", "hlate_gas_energy", "hlate_strain_energy")), floe.figure(one.error("linf_normal")), floe.figure(one.error("l2_normal")))
        for said, one in (("made by the shape", own), ("from a list", run))])
    page.bar("balloon from a list of its points: error of the pressure off that of the sphere's own, of the exact pressure",
             abs(own.error("hlate_pressure") - run.error("hlate_pressure")), "<=", 1e-3, "{:.1e}")


def sheet(page):
    page.write("## Sheet between supports", "", f"`{PATCH}`: a taut sheet, drawn out by 2 % between two supports, against exact plane stress (`stretched_sheet`); the speed is that of the deck, and a tenth and a",
               "hundredth of it: what is left goes with inertia and the half step between places and velocities. Relative errors; normals in degrees.")
    metrics, rows = ("linfrel_stress_xx", "l2rel_stress_yy", "l2rel_displacement_x", "linf_stress_xy", "linf_normal"), []
    for rate in (0.02, 0.002, 0.0002):
        run = page.run(PATCH, f"patch-{rate:g}", None, [f"verify.exact.stretched_sheet.rate={rate:g}", f"supports.right.velocity=[{0.5 * rate:g}, 0, 0]", f"time.end={0.02 / rate:g}"], once=True)
        rows.append((f"{rate:g}", *(f"{run.error(metric):.1e}" for metric in metrics)))
    page.table(("rate", "stress along, worst", "stress across, root mean square", "displacement, root mean square", "shear stress, worst, over E", "normals, worst"), rows)
    page.bar("sheet between supports: worst stress off plane stress, at the slowest", run.error(metrics[0]), "<=", 1e-5, "{:.1e}")


def tube(page):
    page.write("## Tube", "", f"`{TUBE}`, the shell of a cylinder between mirrors, its length held.")
    coarse, fine = 0.1, 0.066666666666666667
    runs = {(h, free): page.run(TUBE, f"tube-{'free-' if free else ''}{h:.4g}", None, [f"domain.cell={h}", *(TUBE_FREE if free else [])], once=True) for h in (coarse, fine) for free in (False, True)}
    page.table(("cell", "cells across", "pressure", "drift of energy", "pressure without `encloses`", "drift"), [
        (f"{h:.4g}", f"{1 / h:.0f}", *(percent(value) for free in (False, True) for value in (runs[(h, free)].error("hlate_pressure"), drift(runs[(h, free)])))) for h in (coarse, fine)])
    page.bar("tube, 15 cells across: pressure off the exact rest, per cent", 100 * runs[(fine, False)].error("hlate_pressure"), "<=", 1, "{:.4f}")
    page.bar("tube, 10 to 15 cells across: order of the pressure", order(runs[(coarse, False)], runs[(fine, False)], 1.5, "hlate_pressure"), ">=", 1, "{:.2f}")


class Bone:
    """What is left of the dog-bone's run at its end; `whole`: of which share of the whole its energies are, over an eighth."""

    def __init__(self, run, whole):
        at = run.result.snapshots[-1].points("skin", "position").values
        self.r, self.z = numpy.hypot(at[:, 0], at[:, 2]), at[:, 1]
        self.run, self.whole = run, whole

    def volume(self):
        """Inside the contour, r over z by height, a quarter of the circle."""
        order = numpy.argsort(self.z, kind="stable")
        z, r = numpy.concatenate(([0], self.z[order])), numpy.concatenate(([self.r[order[0]]], self.r[order]))
        return math.pi / 4 * float(((z[1:] - z[:-1]) * (r[1:] ** 2 + r[1:] * r[:-1] + r[:-1] ** 2) / 3).sum())

    def pressure(self):
        return 0.4 / self.whole * late(self.run, "internal_gas") / self.volume()

    def contour(self):
        """Radius at the equator and half length, by lines through r over z^2 and z over r^2 of the points nearer than a fifth."""
        waist, end = self.z < 0.2, self.r < 0.2
        return ", ".join(f"{numpy.polyfit(square, value, 1)[1]:.4f}" for square, value in ((self.z[waist] ** 2, self.r[waist]), (self.r[end] ** 2, self.z[end])))

    def row(self, h, said):
        gas = late(self.run, "internal_gas")
        return (f"{h:.4g}", said, f"{self.pressure():.2f}", f"{self.volume():.5f}", self.contour(), f"{late(self.run, 'strain_skin') / self.whole:.4f}", f"{gas / self.whole:.2f}",
                f"{100 * late(self.run, 'kinetic') / gas:.4f}", f"{100 * drift(self.run):.3f}")


def dogbone(page):
    page.write("## Dog-bone of revolution", "",
               f"`{REVOLVED}`: a slack contour with corners. A surface bent in two directions cannot become a sphere without stretching and shearing in its plane, so that no rest in closed form is known.",
               "Beside it the same contour in (r, z), a line of points in their order, by overrides of the same deck (nine points of gas a cell). Pressure: energy of the gas times (gamma - 1) over the",
               "volume inside the contour; lengths: radius at the waist, half length; energies of an eighth of the whole. No `encloses`: at corners fitted normals misjudge the volume, and it drifts by 1 %",
               "of the energy here.")
    fine = 0.066666666666666667
    space = {h: Bone(page.run(REVOLVED, f"revolved-{h:.4g}", None, [f"domain.cell={h}"], once=True), 1) for h in (0.1, fine)}
    plane = {h: Bone(page.run(REVOLVED, f"rz-{h:.4g}", None, [f"domain={{dim: 2, geometry: axisymmetric, lower: [0, 0], upper: [0.8, 1], cell: {h}}}", *IN_RZ], once=True), 4)
             for h in (0.1, fine, 0.05)}
    page.table(("cell", "", "pressure", "volume inside", "waist, half length", "strain energy", "energy of the gas", "kinetic, % of it", "drift of energy, %"),
               [*(one.row(h, "in space") for h, one in space.items()), *(one.row(h, "(r, z)") for h, one in plane.items())])
    for h in (0.1, fine):
        page.bar(f"dog-bone of revolution, cells of {h:.4g}: pressure in space off that in (r, z), per cent", 100 * abs(space[h].pressure() / plane[h].pressure() - 1), "<=", 1, "{:.2f}")


def make(page):
    page.write("Plane stress in the tangent plane of each point, with wrinkles; normals by the `quadric` fit to the points as they lie; all of pure MPM. The membrane `encloses` the gas of balloon and",
               "tube ([theory](../theory/README.md)). Errors are means over the last tenth of the time, against exact rest states (reference `membrane_rest`).")
    own = balloon(page)
    from_rest(page)
    listed(page, own)
    for part in (sheet, tube, dogbone):
        part(page)
    page.write("## Bars")
    page.show_bars()
