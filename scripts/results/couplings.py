"""One scene, each coupling: error over processor time on three meshes, and which to choose for 5, 1 and 0.2 %."""
import dataclasses
import math
from typing import TYPE_CHECKING, Callable

import e1
import e10
import e2
import e6
import floe
import numpy
from floe import plots
from verdict import Point, verdict

if TYPE_CHECKING:  # so the page's stamp knows where they are
    from defaults import e1 as _1, e10 as _10, e2 as _2, e6 as _6  # noqa: F401

TITLE = "One scene, each coupling: error over processor time"
LEVELS = (0.05, 0.01, 0.002)


@dataclasses.dataclass
class Scene:
    """A row of validation in each coupling that can run it."""
    row: str
    title: str
    error: str                   # what is measured, in words
    about: str                   # decks and what is particular
    reference: float             # the relative error that the reference itself may have
    variants: dict               # name: [(h, deck, coupling, settings)] from the coarsest mesh to the finest
    measure: Callable            # of a Run: (relative error, what the run leaves open of it)


def metrics(*names):
    """The largest of some of the deck's errors; nothing is left open."""
    def measure(run):
        return max(run.error(name) for name in names), 0.0
    return measure


def deck_meshes(deck, couplings, meshes, settings=(), key="domain.cell="):
    """{coupling: cases} of a deck; a mesh is a spacing, or (spacing, settings that go with it)."""
    pairs = [mesh if isinstance(mesh, tuple) else (mesh, ()) for mesh in meshes]
    return {coupling: [(h, deck, coupling, [f"{key}{h:.12g}", *own, *settings]) for h, own in pairs] for coupling in couplings}


# ---- gases alone ----

def riemann(title, exact, end, walls=True):
    settings = ["verify.exact={riemann: {" + exact + ", position: 0.5}}", f"time.end={end}", "verify.metrics=[l1rel_density]", "runs_as=[ice, mpm]",
                "bodies.tube.points=9", "materials.gas.artificial_viscosity={linear: 0.2, quadratic: 2}"] + (["boundaries={x: slip}"] if walls else [])
    return Scene("D1", title, "l1rel_density", "`inputs/riemann.yaml`.", 0.0,
                 deck_meshes("inputs/riemann.yaml", ("ice", "mpm"), (0.01, 0.005, 0.0025), settings), metrics("l1rel_density"))


def gases():
    yield Scene("B1, D1", "Sod's shock tube", "l1rel_density", "`inputs/sod.yaml`.", 0.0,
                deck_meshes("inputs/sod.yaml", ("ice", "mpm"), (0.01, 0.005, 0.0025), ["verify.metrics=[l1rel_density]"]), metrics("l1rel_density"))
    yield riemann("Two fans, nearly a vacuum between them", "left_density: 1, left_velocity: -2, left_pressure: 0.4, right_density: 1, right_velocity: 2, "
                  "right_pressure: 0.4", 0.15, walls=False)
    yield riemann("The left blast, pressures 1e5 apart", "left_density: 1, left_pressure: 1000, right_density: 1, right_pressure: 0.01", 0.012)
    yield riemann("The right blast, pressures 1e4 apart", "left_density: 1, left_pressure: 0.01, right_density: 1, right_pressure: 100", 0.035)
    yield Scene("B2", "Cylinder of gas expanding into a vacuum", "l1rel_density", "`inputs/gas_expansion.yaml`; the reference is a radial solution on a fine mesh.",
                1e-3, deck_meshes("inputs/gas_expansion.yaml", ("ice", "mpm"), (0.05, 0.025, 0.0125), ["verify.metrics=[l1rel_density]"]),
                metrics("l1rel_density"))


# ---- a fluid and a solid ----

def cylinder(metric):
    return Scene("A1", "Pressurised thick cylinder", metric, "`inputs/pressurized_cylinder.yaml`. Lamé's solution is that of small strains; "
                 "these are 3.2e-4 at the bore, and the reference is good for 0.05 %.", 5e-4,
                 deck_meshes("inputs/pressurized_cylinder.yaml", ("mpm", "ice-mpm"), (0.1, 0.05, 0.025), ["verify.metrics=[eq13, l1rel_sigma_theta]"]), metrics(metric))


def other_cylinder():
    return Scene("E11", "Thick cylinder of other numbers, defaults only", "the larger of l1rel_sigma_r and l1rel_sigma_theta",
                 "`inputs/defaults/e11_cylinder.yaml`, 6, 12 and 24 cells of wall. Strains of 2.3e-4 at the bore.", 4e-4,
                 deck_meshes("inputs/defaults/e11_cylinder.yaml", ("mpm", "ice-mpm"), (0.08, 0.04, 0.02)), metrics("l1rel_sigma_r", "l1rel_sigma_theta"))


def piston(mass, metric):
    heavy = ["verify.reference.piston.mass=1", "time.end=0.067"] if mass == 1 else []
    points = deck_meshes("inputs/piston_container.yaml", ("mpm",), (4, 2, 1), (["bodies.spring.membrane.heavy_mass=1"] if heavy else []) + heavy)
    cells = [(h, "inputs/piston_membrane.yaml", None, [f"domain.cell=[{h}, 1]"] + (["materials.sheet.density=100"] if heavy else []) + heavy) for h in (4, 2, 1)]
    amplitude = 0.5 / {0.1: 886.43, 1: 281.15}[mass] / 20
    return Scene("A2", f"Piston on a container of fluid, mass {mass}", metric, "`inputs/piston_container.yaml` (mpm) and `inputs/piston_membrane.yaml` (ice-mpm: a membrane "
                 "holds the fluid). The exact period is that of small motions; the piston's is "
                 f"{amplitude:.1g} of the tube.", amplitude, {**points, "ice-mpm": cells}, metrics(metric))


def rest(run):
    """The largest error of radius, pressure and hoop stress at rest, and the largest half range of them over the last tenth of the time."""
    history, left = run.result.history, 0.0
    time = history["time"].values
    for name in ("first_skin_x", "pressure_in_skin", "stress_skin"):
        late = history[name].values[time >= time[0] + 0.9 * (time[-1] - time[0])]
        left = max(left, 0.5 * float(numpy.ptp(late)) / abs(float(late.mean())))
    return metrics("hlate_radius", "hlate_pressure", "hlate_hoop_stress")(run)[0], left


def membrane(row, title, deck, meshes, settings=(), about=""):
    return Scene(row, title, "the largest of hlate_radius, hlate_pressure and hlate_hoop_stress", f"`{deck}`. {about}The rest state is exact; what still swings "
                 "in the last tenth of the time is the error's own uncertainty.", 1e-5, deck_meshes(deck, ("mpm", "ice-mpm"), meshes, settings), rest)


def membranes():
    bone = [(h, [f"bodies.skin.membrane.number={number}"]) for h, number in ((0.4, 56), (0.3, 75), (0.2, 100))]
    yield membrane("A3", "Dog-bone membrane filled with gas", "inputs/membrane_dogbone.yaml", bone)
    yield membrane("A4", "Slack circular membrane filled with gas", "inputs/membrane_circle.yaml", (0.1, 0.05, 0.025))
    narrow = [(0.4, 56), (2 / 7, 75), (0.2, 100)]
    yield membrane("A5", "Dog-bone with normals to unconnected points", "inputs/membrane_dogbone.yaml",
                   [(h, [f"bodies.skin.membrane.number={number}"]) for h, number in narrow], ["bodies.skin.membrane.normals=isosurface", "domain.upper=[2, 2]"],
                   "`normals: isosurface`, 10 x 10 cells as published at the finest. ")


def late_mean(run, columns, window):
    """The mean of some columns of a run's history over a time."""
    history = run.result.history
    time = history["time"].values
    inside = (time >= window[0]) & (time <= window[1])
    return float(numpy.mean([history[name].values[inside].mean() for name in columns]))


def shock_tube():
    behind = e1.exact()[1]

    def measure(run):
        return abs(late_mean(run, [name + "_pressure" for name in ("first", "second", "third", "fourth")], e1.WINDOW) / behind - 1), 0.0

    def side(h):
        return [s for s in e1.tube(2, 0, h) if not s.startswith(("bodies.wall", "domain"))] + [
            f"domain={{dim: 2, lower: [0, 0], upper: [1.5, {4 * h:g}], cell: {h:g}}}", "bodies.wall=null", "runs_as=[ice]"]

    deck, meshes = "inputs/defaults/e1_shock_tube.yaml", (0.02, 0.01, 0.005)
    variants = {name: [(h, deck, name, e1.tube(2, 0, h)) for h in meshes] for name in ("mpm", "ice-mpm")}
    variants["ice"] = [(h, deck, "ice", side(h)) for h in meshes]
    return Scene("E1", "Shock tube against a steel wall", "the mean pressure of the four cells beside the wall, off the reflected shock's",
                 f"`{deck}`, a strip of four cells; `ice`: a side in the wall's place. Exact for a rigid wall: {behind / 1e3:.2f} kPa; steel yields by 0.005 %.",
                 5e-5, variants, measure)


def charge():
    def measure(run):
        history = {name: column.values for name, column in run.result.history.items()}
        wanted = e2.wanted(history, 0.64, math.pi * e2.RADIUS ** 2, e2.WINDOW)
        return abs(late_mean(run, ["pressure_air"], e2.WINDOW) / wanted - 1), 0.0

    deck = "inputs/defaults/e2_charge_in_box.yaml"
    return Scene("E2", "Charge in a closed steel box", "the gas's mean pressure from 5 ms on, off what the balance of energy asks for", f"`{deck}`.", 1e-6,
                 {name: [(h, deck, name, e2.settings(2, h)) for h in (0.1, 0.05, 0.025)] for name in ("mpm", "ice-mpm")}, measure)


def plateau_of_points(run, speed, pressure):
    """The mean of (p - p0)/(rho c u) over the water's points from 1/4 to 2/3 of the way to the front, by their volumes."""
    last = run.result.at(math.inf)
    place, p = last.points("water", "position").values, last.points("water", "pressure").values
    volume = last.points("water", "initial_volume").values
    inside = (place[:, 1] > speed * last.time / 4) & (place[:, 1] < 2 * speed * last.time / 3)
    return float(numpy.average(p[inside] - pressure, weights=volume[inside])) / (e10.DENSITY * speed * e10.SPEED)


def hammer(title, young, end, reference, about):
    speed, pressure, deck = e10.wave_speed(young, 0.07, 1e5), 1e5, "inputs/defaults/e10_hammer.yaml"

    def measure(run):
        cells = run.result.summary["coupling"] == "ice-mpm"
        return abs((e10.plateau if cells else plateau_of_points)(run, speed, pressure) - 1), 0.0

    settings = [f"materials.wall.law.linear_elastic.bulk_modulus={young / 3:.12g}", f"materials.wall.law.linear_elastic.shear_modulus={young / 2:.12g}",
                f"time.end={end:g}", "runs_as=[mpm, ice-mpm]", "ambient.points=0"]
    return Scene("E10", title, "the section's mean pressure behind the front, off rho c u", f"`{deck}`, 2, 4 and 6 cells of wall; as `mpm` the air outside is left out. {about}",
                 reference, deck_meshes(deck, ("mpm", "ice-mpm"), (0.01, 0.005, 1 / 300), settings), measure)


# ---- no fluid ----

def cantilever():
    exact = e6.elastica()

    def measure(run):
        x, y = e6.tip(run.folder)
        return math.hypot(x - exact[0], y - exact[1]) / math.hypot(exact[0] - 1, exact[1]), 0.0

    return Scene("E6", "Cantilever under its weight, in balance", "the tip's place, off the elastica's, over its way",
                 "`inputs/defaults/e6_cantilever.yaml`, 2, 4 and 8 cells thick. The elastica has no shear: with it the tip would be lower by (t/L)^2 of its way, some 0.2 %.", 2e-3,
                 deck_meshes("inputs/defaults/e6_cantilever.yaml", ("mpm",), (0.05, 0.025, 0.0125), ["time.solver=static", "time.increments=10"]), measure)


def swing():
    exact = e6.timoshenko()[0]

    def measure(run):
        return abs(e6.frequency({name: column.values for name, column in run.result.history.items()}) / exact - 1), 0.0

    return Scene("E6", "First frequency of a cantilever", "the frequency, off Timoshenko's", "`inputs/defaults/e6_frequency.yaml`, 2, 4 and 8 cells thick. "
                 "Shear and rotation take 0.65 % off, which is known to a twentieth.", 3e-4,
                 deck_meshes("inputs/defaults/e6_frequency.yaml", ("mpm",), (0.05, 0.025, 0.0125)), measure)


def pressed():
    return Scene("E11", "Thick cylinder pressed from outside, in balance", "the larger of l1rel_sigma_r and l1rel_sigma_theta", "`inputs/defaults/e11_outside.yaml`, "
                 "6, 12 and 24 cells of wall. Strains of 4e-4.", 6e-4,
                 deck_meshes("inputs/defaults/e11_outside.yaml", ("mpm",), (0.46 / 6, 0.46 / 12, 0.46 / 24)), metrics("l1rel_sigma_r", "l1rel_sigma_theta"))


PARTS = {
    "Solids and membranes in fluids": lambda: [cylinder("eq13"), cylinder("l1rel_sigma_theta"), piston(0.1, "hperiod_position"), piston(0.1, "hturns_position"),
                                               piston(1, "hperiod_position"), piston(1, "hturns_position"), *membranes(), shock_tube(), charge(),
                                               hammer("Water hammer in a stiff tube", 2e13, 1e-4, 2e-4, "Joukowsky's pressure, with what a modulus of 2e13 Pa takes off by Korteweg."),
                                               hammer("Water hammer in a steel tube", 2e11, 2e-4, 1e-2, "Korteweg's plateau is that of a tube in balance, about which it breathes: good for 1 %."),
                                               other_cylinder()],
    "Gases alone": lambda: list(gases()),
    "Solids alone": lambda: [cantilever(), swing(), pressed()],
}


def run_scene(page, scene, done):
    """{variant: points}; a run that another scene has made is not made again."""
    found = {}
    for name, cases in scene.variants.items():
        points = []
        for h, deck, coupling, settings in cases:
            key = (deck, coupling, tuple(settings))
            if key not in done:
                done[key] = page.run(deck, f"{len(done):03d}", coupling, settings)
            run = done[key]
            error, left = scene.measure(run) if run.status == 0 else (math.nan, 0.0)
            points.append(Point(h, error, run.cpu, run.scatter, scene.reference + left, run.disturbed))
        found[name] = points
    return found


def show_scene(page, scene, found, done):
    page.write(f"### {scene.title}: {scene.error}", "", f"Row {scene.row}; {scene.about}")
    rows = []
    for name, cases in scene.variants.items():
        for point, (h, deck, coupling, settings) in zip(found[name], cases):
            run = done[(deck, coupling, tuple(settings))]
            if run.status != 0:
                rows.append((name, floe.figure(h), f"exit status {run.status}", "-", "-", "-", "-"))
                continue
            mark = " *" if run.disturbed else ""
            rows.append((name, floe.figure(h), floe.percent(point.error), floe.percent(point.floor, 1), floe.figure(run.cpu) + mark,
                         f"{100 * run.scatter:.0f} % of {run.repeats}" if run.repeats > 1 else "once", floe.figure(run.wall) + mark))
    page.table(("coupling", "h", "error", "known to", "CPU, s", "scatter", "wall, s"), rows)
    answers = [(level, verdict(found, level, scene.reference)) for level in LEVELS]
    page.write(*[f"* {100 * level:g} %: {text}." for level, text in answers], "")
    return answers


def plot_scenes(page, name, scenes):
    """A panel a scene."""
    def draw(axes, k):
        scene, found = scenes[k]
        for variant, points in found.items():
            good = [one for one in points if one.error == one.error]
            axes.errorbar([one.cpu for one in good], [max(one.error, 1e-6) for one in good], yerr=[min(one.floor, 0.9 * max(one.error, 1e-6)) for one in good],
                          color=plots.colours([variant])[variant], marker="o", label=variant, elinewidth=0.8)
        for level in LEVELS:
            axes.axhline(level, **{**plots.EXACT, "linestyle": ":"})
        axes.set_xscale("log")
        axes.set_yscale("log")
        axes.set_xlabel("CPU (s)")
        axes.set_ylabel("relative error")
        axes.legend()

    plots.panels(page.picture(name, "error over processor time"), draw, [f"{scene.row}: {scene.title}\n{scene.error.split(',')[0]}"[:110] for scene, _ in scenes], columns=3)


def make(page):
    page.write("Fluids as material points (`mpm`), on the cells (`ice`), or on the cells beside solids and membranes of points (`ice-mpm`): each row of validation",
               "with an exact answer that more than one of them can run, and some of points alone. *CPU* is the processor time of the steps, without outputs, the least of some",
               "runs (a case of less than 50 ms is run until 0.5 s are spent); *scatter* is how far the median of them lies above it; *known to* is what the reference is good for, and",
               "what the run itself leaves open. A time to a level is interpolated between meshes and never beyond; an error counts for a mesh only if no finer one has a larger. In brackets",
               "the least and the most that the time may be, by scatter and by what the errors are known to: where these overlap, nothing is chosen. A level below twice what the reference",
               "is good for is not offered. Dotted lines: 5, 1 and 0.2 %.", "", "## Which to choose")
    place, done, summary = len(page.lines), {}, []
    for part, scenes in PARTS.items():
        page.write("", f"## {part}")
        shown = []
        for scene in scenes():
            found = run_scene(page, scene, done)
            answers = show_scene(page, scene, found, done)
            summary.append((scene.row, scene.title, scene.error, *[text for _, text in answers]))
            shown.append((scene, found))
        plot_scenes(page, part.lower().replace(" ", "-"), shown)
    page.lines[place:place] = ["", *floe.markdown(("row", "scene", "error", *[f"{100 * level:g} %" for level in LEVELS]), summary), "",
                               "Not here: A6 has no exact answer ([airbag](airbag.md)); E3, E4 and E6 are solids in a vacuum, which are points and nothing else; E5 and E12 have published ranges;",
                               "E7 has no deck; E8 and E9 are refusals ([defaults](defaults.md))."]
