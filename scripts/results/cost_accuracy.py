"""Error against processor time of every variant beside the linear-basis baseline: A1 in one figure, and rows A2, A3, A4, B5, B10."""
import dataclasses
import math

import floe
from floe import plots
from floe.results import number
from verdict import Point, secured

TITLE = "Error per second: every variant beside the linear basis"
CYLINDER, CONTAINER, PISTON, DOGBONE, CIRCLE, PENDULUM, BAR = (f"inputs/{name}.yaml" for name in (
    "pressurized_cylinder", "piston_container", "piston_membrane", "membrane_dogbone", "membrane_circle", "pendulum", "bar_vibration"))
RESTS = ("hlate_radius", "hlate_radius_last", "hlate_pressure", "hlate_hoop_stress")


@dataclasses.dataclass
class Case:
    """One case of a variant that has come to its end."""
    variant: str
    h: float
    error: float      # the largest of its metrics
    reached: float    # the largest of its own and of all finer meshes of the variant: an error that passes through zero on its way is no accuracy
    cpu: float        # s
    wall: float       # s
    disturbed: bool


def axis(**columns):
    """An axis of variants: keys with __ for dots, each with its value for every variant."""
    return ";".join(key.replace("__", ".") + "=" + ",".join(map(str, values)) for key, values in columns.items())


def ended(cases, metrics):
    """The cases with all these errors, variants in their order, coarse to fine."""
    variants = {}
    for row in cases.rows:
        errors = [number(row[metric]) for metric in metrics]
        if row["status"] in ("done", "at_rest") and all(error >= 0 for error in errors) and max(errors) > 0:
            variants.setdefault(row["title"], []).append(Case(row["title"], float(row["h"]), max(errors), math.nan, float(row["cpu_seconds"]), float(row["run_seconds"]),
                                                              row["disturbed"] == "yes"))
    return variants


def joined(*parts):
    """Variants of several studies, each with its errors as no finer mesh exceeds them."""
    out = {}
    for part in parts:
        for name, found in part.items():
            out.setdefault(name, []).extend(found)
    for found in out.values():
        found.sort(key=lambda one: -one.h)
        for one, (_, error) in zip(found, secured([Point(one.h, one.error, max(one.cpu, 1e-9)) for one in found], 0.0)):
            one.reached = error
    return out


def show(page, variants, scale, unit):
    page.table(("variant", "h", "error" + unit, "CPU, s", "wall, s"), [(name, f"{one.h:g}", floe.figure(scale * one.error), floe.figure(one.cpu, 2) + (" *" if one.disturbed else ""), floe.figure(one.wall, 2))
                                                                  for name, found in variants.items() for one in found])


def gains(variants):
    """(case of the baseline, the best case of another variant in no more time) where there is one; the first variant is the baseline."""
    baseline, *others = variants
    for one in variants[baseline]:
        in_time = [other for name in others for other in variants[name] if other.cpu <= one.cpu]
        if in_time:
            yield one, min(in_time, key=lambda other: other.reached)


def row(page, what, variants, scale, unit):
    """Table, factors and bar. The bar is for the baseline's dearest case that another variant can be compared with."""
    show(page, variants, scale, unit)
    found = list(gains(variants))
    page.write("The smallest error that another variant reaches in no more processor time than a case of the baseline takes, and that no finer mesh of it exceeds:")
    page.table(("baseline at h", "in, s", "error" + unit, "variant", "its h", "in, s", "error" + unit, "factor"),
               [(f"{one.h:g}", floe.figure(one.cpu, 2), floe.figure(scale * one.error), best.variant, f"{best.h:g}", floe.figure(best.cpu, 2), floe.figure(scale * best.reached),
                 f"**{one.error / best.reached:.3g}**") for one, best in found])
    page.bar(f"{what}: error at equal time, baseline over best", found[-1][0].error / found[-1][1].reached if found else math.nan, ">=", 5)


def study(page, folder, repeat, deck, settings, *axes, more=()):
    words = [word for one in settings for word in ("--set", one)] + [word for one in axes for word in ("--axis", one)]
    return page.cases("study", folder, deck, *words, *more, "--repeat", repeat)


# ---- A1 ----

CYLINDERS = (  # title, coupling, basis, seeding, edge_penalty, interface, solver
    ("mpm linear lattice", "mpm", "linear", "lattice", 0, "smeared", "dynamic"), ("mpm linear", "mpm", "linear", "fitted", 0, "smeared", "dynamic"),
    ("mpm gimp", "mpm", "gimp", "fitted", 0, "smeared", "dynamic"), ("mpm cpdi", "mpm", "cpdi", "fitted", 0, "smeared", "dynamic"),
    ("mpm quadratic", "mpm", "quadratic", "fitted", 0, "smeared", "dynamic"), ("mpm cubic", "mpm", "cubic", "fitted", 0, "smeared", "dynamic"),
    ("mpm quadratic edge", "mpm", "quadratic", "fitted", 0.05, "smeared", "dynamic"), ("mpm quadratic edge static", "mpm", "quadratic", "fitted", 0.05, "smeared", "static"),
    ("ice-mpm linear lattice", "ice-mpm", "linear", "lattice", 0, "smeared", "dynamic"), ("ice-mpm linear", "ice-mpm", "linear", "fitted", 0, "smeared", "dynamic"),
    ("ice-mpm gimp", "ice-mpm", "gimp", "fitted", 0, "smeared", "dynamic"), ("ice-mpm cpdi", "ice-mpm", "cpdi", "fitted", 0, "smeared", "dynamic"),
    ("ice-mpm quadratic", "ice-mpm", "quadratic", "fitted", 0, "smeared", "dynamic"), ("ice-mpm cubic", "ice-mpm", "cubic", "fitted", 0, "smeared", "dynamic"),
    ("ice-mpm quadratic edge", "ice-mpm", "quadratic", "fitted", 0.05, "smeared", "dynamic"), ("ice-mpm quadratic edge sharp", "ice-mpm", "quadratic", "fitted", 0.05, "sharp", "dynamic"),
    ("ice-mpm quadratic edge static", "ice-mpm", "quadratic", "fitted", 0.05, "smeared", "static"),
    ("ice-mpm quadratic edge sharp static", "ice-mpm", "quadratic", "fitted", 0.05, "sharp", "static"))
SPACINGS, FINE = "domain.cell=0.1,0.05,0.025", "domain.cell=0.0125,0.00625"


def cylinders(page, folder, chosen, spacings):
    title, coupling, basis, seeding, edge, interface, solver = zip(*chosen)
    return study(page, folder, 1, CYLINDER, ["study=null", "output.interval=0.01"],
                 axis(title=title, coupling=coupling, method__basis=basis, bodies__cylinder__seeding=seeding, bodies__bore__seeding=seeding, method__edge_penalty=edge,
                      method__interface=interface, time__solver=solver), spacings, more=("--max-wall", 300))


def cylinder_figure(page, variants):
    shades = {name: k for coupling in ("mpm", "ice-mpm") for k, name in enumerate(one for one in variants if one.startswith(coupling + " "))}

    def draw(axes, k):
        coupling = ("mpm", "ice-mpm")[k]
        for name, found in variants.items():
            if name.startswith(coupling + " "):
                style = "--" if name.endswith("lattice") else ":" if name.endswith("static") else "-"
                axes.plot([one.cpu for one in found], [100 * one.error for one in found], linestyle=style, marker="osD^v<>pXd"[shades[name] % 10], markersize=4,
                          color=f"C{shades[name] % 10}", label=name[len(coupling) + 1:])
        axes.set_xscale("log")
        axes.set_yscale("log")
        axes.set_xlabel("processor time (s)")
        axes.set_ylabel("error of eq. 13 (%)")
        axes.legend(fontsize="small")

    plots.panels(page.picture("a1", "error of eq. 13 against processor time"), draw, ["mpm", "ice-mpm"])


def first_within(variants, coupling, level):
    """The least wall time in which a variant of a coupling has come to an error."""
    return min((one.wall for name, found in variants.items() if name.startswith(coupling + " ") for one in found if one.reached <= level), default=math.nan)


def cylinder(page):
    coarse = cylinders(page, "a1", CYLINDERS, SPACINGS)
    page.data("a1", page.runs / "a1/study.csv")
    fine = cylinders(page, "a1-fine", [one for one in CYLINDERS if one[-1] == "static"], FINE)
    variants = joined(ended(coarse, ["eq13"]), ended(fine, ["eq13"]))
    page.write("## The pressurised cylinder (A1)", "",
               "`inputs/pressurized_cylinder.yaml`, both couplings, all variants in one study: eq. 13 against processor time. *Lattice* is the baseline, the settings of the paper: linear",
               "functions, whole sub-cells, a smeared load. Lamé is a solution for small strains: 0.03 to 0.05 % is no error of a run. *Edge*: `edge_penalty: 0.05`; *sharp*: `interface: sharp`; *static*: `solver: static`, here to finer meshes, too.")
    cylinder_figure(page, variants)
    show(page, variants, 100, ", %")
    for coupling in ("mpm", "ice-mpm"):
        page.bar(f"A1, {coupling}: eq. 13 within 1 % after", first_within(variants, coupling, 0.01), "<=", 1, "{:.2g}", " s")
        page.bar(f"A1, {coupling}: eq. 13 within 0.1 % after", first_within(variants, coupling, 0.001), "<=", 20, "{:.2g}", " s")
        own = {name: found for name, found in variants.items() if name.startswith(coupling + " ")}
        one, best = list(gains(own))[-1]
        page.write(f"By `{coupling}`, in the time of the baseline at h = {one.h:g} ({one.cpu:.2g} s, {100 * one.error:.3g} %): {best.variant}, h = {best.h:g}, {100 * best.reached:.3g} %: "
                   f"**{one.error / best.reached:.3g}** times less.", "")


# ---- the rows ----

def piston(page):
    page.write("## Piston on a container of fluid (A2)", "",
               "`inputs/piston_container.yaml`, error of the period; two masses. Baseline: linear functions, one fluid point a cell, as printed. *Gimp* and *quadratic* have the same points;",
               "*sharp* is `inputs/piston_membrane.yaml`, fluid on cells up to a sheet that cuts them, in steps of `cfl: 0.5`. The light piston's errors are near those of reading crossings of zero off the history",
               "(1e-5 of the period); with the smooth bases they change their sign near h = 1, while those of *sharp* fall with the square of h.", "")
    numbers = (5, 10, 20, 40, 80)
    for mass, end in ((0.1, 0.0213), (1, 0.067)):
        times = [f"verify.reference.piston.mass={mass}", f"time.end={end}", f"output.interval={end}"]
        points = study(page, f"a2-{mass}", 1, CONTAINER, [f"bodies.spring.membrane.heavy_mass={mass}", *times],
                       axis(title=("linear", "gimp", "quadratic"), method__basis=("linear", "gimp", "quadratic")),
                       axis(domain__cell=(4, 2, 1, 0.5, 0.25), bodies__spring__membrane__number=numbers, bodies__spring__membrane__heavy_point=numbers,
                            verify__reference__piston__origin=(22, 21, 20.5, 20.25, 20.125)))
        sharp = study(page, f"a2-sharp-{mass}", 1, PISTON, [f"materials.sheet.density={100 * mass:g}", *times, "time.cfl=0.5"], "title=sharp", "domain.cell=[4.0,1],[2,1],[1,1],[0.5,1]")
        page.write(f"m = {mass}:")
        row(page, f"A2, m = {mass}: period", joined(ended(points, ["hperiod_position"]), ended(sharp, ["hperiod_position"])), 100, ", %")


MEMBRANES = ("linear as printed", "quadratic places", "quadratic places cells", "static", "static cells")
MEMBRANE_AXIS = {"title": MEMBRANES, "coupling": ("mpm", "mpm", "ice-mpm", "mpm", "ice-mpm"), "method__basis": ("linear",) + 4 * ("quadratic",),
                 "bodies__skin__membrane__strain": ("rate",) + 4 * ("positions",), "bodies__skin__membrane__smoothing": (0,) + 4 * (0.05,),
                 "method__flip": (1,) + 4 * (0.999,), "method__losses": ("drift",) + 4 * ("heat",), "time__solver": 3 * ("dynamic",) + 2 * ("static",)}


def dogbone(page):
    page.write("## Dog-bone that becomes a cylinder (A3)", "",
               "`inputs/membrane_dogbone.yaml` against its exact rest: the largest error of radii, pressure and hoop stress. Baseline: as printed (linear, stress updated last from velocities mapped",
               "again, strain by its rate, no heat). *Places*: strain by places, smoothed, losses as heat: the deck. *Cells*: gas on cells, held by the membrane. *Static*: the state of rest solved for (`solver: static`) without steps.", "")
    cases = study(page, "a3", 1, DOGBONE, ["output.interval=4"], axis(**MEMBRANE_AXIS, method__stress=("musl",) + 4 * ("usl",)),
                  axis(domain__cell=(0.4, 0.2), bodies__skin__membrane__number=(56, 100)), more=("--max-wall", 200))
    row(page, "A3: radii, pressure and hoop stress", joined(ended(cases, RESTS)), 100, ", %")


def circle(page):
    page.write("## Slack circle (A4)", "", "`inputs/membrane_circle.yaml`, as above. Baseline: linear, strain by its rate, no heat.", "")
    cases = study(page, "a4", 2, CIRCLE, ["output.interval=0.06"], axis(**MEMBRANE_AXIS), axis(domain__cell=(0.2, 0.1, 0.05), bodies__skin__membrane__number=(46, 91, 181)))
    row(page, "A4: radii, pressure and hoop stress", joined(ended(cases, RESTS)), 100, ", %")


def pendulum(page):
    page.write("## Pendulum on a string (B5)", "",
               "`inputs/pendulum.yaml` against a chain of bars: the largest error of the place over the amplitude, and the error of the period. Baseline: linear, stress updated last, strain by its rate, as printed. *Places*:",
               "`strain: positions`, `smoothing: 0.05`. Points of a string that swings cross cells, and the gradient of velocity at a point jumps; what it has integrated is then not what its neighbours' places say, and the",
               "difference flutters. Places have no such memory.", "")
    cases = study(page, "b5", 1, PENDULUM, ["output.interval=1.75", "method.flip=1"], "domain.cell=0.2,0.1,0.05",
                  axis(title=("linear as printed", "linear musl", "gimp musl", "linear musl places"), method__basis=("linear", "linear", "gimp", "linear"), method__stress=("usl", "musl", "musl", "musl"),
                       bodies__string__membrane__strain=("rate", "rate", "rate", "positions"), bodies__string__membrane__smoothing=(0, 0, 0, 0.05)), more=("--max-wall", 200))
    row(page, "B5: place", joined(ended(cases, ["hmax_x"])), 100, ", %")
    page.write("Period:")
    row(page, "B5: period", joined(ended(cases, ["hperiod_x"])), 100, ", %")


def bar(page):
    page.write("## Vibrating bar (B10)", "",
               "`inputs/bar_vibration.yaml`: L1 of stress (of a largest stress of 3.1 Pa), then of velocity (of 1e-4 m/s). Baseline: linear, FLIP, `cfl: 0.4` as in the deck (with 0.8 it is unstable); the others take",
               "`cfl: 0.95`. No one of them is the best in both: splines have stress of second order, where it is read off at the points; hat functions (those of GIMP are the same here), whose stress is of first order, have the smaller dispersion with APIC or TPIC.", "")
    cases = study(page, "b10", 2, BAR, ["output.interval=0.07"],
                  axis(title=("linear", "linear cfl 0.6", "quadratic", "quadratic apic", "cubic tpic", "linear apic", "gimp tpic"), method__basis=("linear", "linear", "quadratic", "quadratic", "cubic", "linear", "gimp"),
                       method__transfer=("flip", "flip", "flip", "apic", "tpic", "apic", "tpic"), method__flip=(1, 1, 1) + 4 * ("null",), time__cfl=(0.4, 0.6, 0.6) + 4 * (0.95,)),
                  "domain.cell=0.015625,0.0078125,0.00390625,0.001953125")
    row(page, "B10: stress", joined(ended(cases, ["l1_stress_xx"])), 1, ", Pa")
    page.write("Velocity:")
    row(page, "B10: velocity", joined(ended(cases, ["l1_velocity_x"])), 1, ", m/s")


def make(page):
    page.write("Times are those of the steps, of the processor and of the wall, on one thread; *: others used the machine meanwhile. What is compared is what was run: no curve is interpolated or continued. A factor is the baseline's error over",
               "the smallest that another variant has reached in no more processor time; the bar is for the dearest case of the baseline. The bars are at the end.", "")
    for part in (cylinder, piston, dogbone, circle, pendulum, bar):
        part(page)
    page.write("## Bars")
    page.show_bars()
