"""Material points as York has them: gas, plasticity, axisymmetry, cell crossing."""
import math
import re

import floe
import numpy

TITLE = "Material points as York has them: gas, plasticity, axisymmetry, cell crossing"


def taylor_bar(page):
    page.write("## A copper bar against a rigid wall (Taylor's test)", "",
               "`inputs/taylor_bar.yaml`, J2 plasticity, axisymmetric, quadratic basis, 2 x 2 points a cell, to 80 us. Published: codes with",
               "Lagrangian meshes, as the literature quotes them (Kamoulakos 1990; Zhu and Cescotto 1995; Camacho and Ortiz 1997).")
    rows = []
    for h in (0.8, 0.4, 0.2):
        run = page.run("inputs/taylor_bar.yaml", f"bar-{h}", None, [f"domain.cell={h} mm"], once=True)
        last, history = run.result.at(math.inf), run.result.history
        place, half = 1e3 * last.points("bar", "position").values, h / 4  # half of what a point stood for at first, 2 x 2 a cell
        motion = history["kinetic"].values[0]
        left = motion - history["kinetic"].values[-1] - history["strain"].values[-1]
        work = (history["internal_copper"].values[-1] - history["internal_copper"].values[0]) / motion
        rows.append((h, f"{place[:, 1].max() + half:.2f}", f"{place[:, 0].max() + half:.2f}", f"{last.points('bar', 'plastic_strain').values.max():.2f}", f"{left / motion:.3f}", f"{work:.3f}"))
    for what, value, low, high in (("length, mm", rows[-1][1], 21.3, 21.7), ("radius, mm", rows[-1][2], 7.0, 7.2), ("largest plastic strain", rows[-1][3], 2.5, 3.2)):
        page.bar(f"copper bar, h = 0.2 mm: {what}, least published", float(value), ">=", low, "{:.2f}")
        page.bar(f"copper bar, h = 0.2 mm: {what}, most published", float(value), "<=", high, "{:.2f}")
    rows.append(("published", "21.3 to 21.7", "7.0 to 7.2", "2.5 to 3.2", "", ""))
    page.table(("h (mm)", "length (mm)", "radius of the mushroom (mm)", "largest plastic strain", "energy that is neither motion nor strain at the end, over that at first",
                "of it heat by plastic work"), rows)
    page.write("What is neither plastic work nor left as strain or motion is the method's own loss. Length and radius",
               "are those of the outermost points plus half of what a point stood for at first.", "")


def forces(page):
    """Figures of tests/verification/test_mpm_force.c."""
    said = page.test("verification_mpm_force", "tests/verification/test_mpm_force.c")
    before, after = (re.search(rf"^{word}: (\S+) (\S+) (\S+)$", said, re.MULTILINE).groups() for word in ("before", "after"))
    page.write("## A point that crosses a cell boundary", "",
               "York 1997, appendix A.2: a line of points under tension, and the forces on three nodes as point 6 crosses the cell boundary at the middle one.",
               "The forces are those of floe's own kernel; V_p = 0.1^2/6 reproduces the printed ones. The stresses of points 1 to 3 and 9, 10 are not",
               "printed; they are taken from the printed forces of the outer nodes before the crossing, so that 66 and 3114 are no test, the others are.")
    page.table(("", "upper node", "node at the boundary", "lower node"),
               [("before, printed", 66, 111, 3114), ("before, floe, linear", *before), ("after, printed", 2183, -3940, 5123), ("after, floe, linear", *after)])
    page.write("(The printed 111 is 112.7 by the printed stresses; the stress of the cell above has changed by 2183 - 2109 in the step.) With one set of",
               "stresses, the point a nanometre above and below the boundary:")
    rows = []
    for name, *numbers in re.findall(r"^(\w+): (\S+) (\S+) (\S+) becomes (\S+) (\S+) (\S+), largest jump (\S+)$", said, re.MULTILINE):
        above, below = ", ".join(numbers[:3]), ", ".join(numbers[3:6])
        rows.append((name, above, "the same" if above == below else below, floe.figure(float(numbers[6]), 2)))
    page.table(("basis", "forces above", "forces below", "largest jump"), rows)


def gained(run):
    """Energy that has come in or gone, in the mean of the last two of fifteen swings, over the largest of motion and strain in the first: what is there less
    what the ledger has let in."""
    history = run.result.history
    time = history["time"].values
    there = history["kinetic"].values + history["strain"].values
    own = there - there[0] - history["ledger_energy_source"].values
    late, first = time >= time[-1] * 13 / 15, time <= time[-1] / 15
    return float(own[late].mean() / there[first].max())


def crossing(page):
    page.write("`inputs/cell_crossing.yaml` is a mass on such a spring, 10 points, for 15 swings. Energy that has come in or gone (strain and kinetic energy",
               "less the work of gravity, mean of the last two swings) over the largest of the first swing; the thesis: \"a slowly developing instability\":")
    rows = []
    for basis in ("linear", "gimp", "quadratic"):
        row = [basis]
        for stress in ("usl", "musl", "usf"):
            for cfl in (0.2, 0.05):
                run = page.run("inputs/cell_crossing.yaml", f"crossing-{basis}-{stress}-{cfl}", None, [f"method.basis={basis}", f"method.stress={stress}", f"time.cfl={cfl}"], once=True)
                ended = re.search(r"by t = (\S+ s)", run.text)
                row.append(f"{100 * gained(run):+.1f} %" if run.status == 0 else f"**ended at {ended.group(1)}: energy from nothing**" if ended else f"**status {run.status}**")
        rows.append(row)
    page.table(("basis", "`usl`, cfl 0.2", "0.05", "`musl`, cfl 0.2", "0.05", "`usf`, cfl 0.2", "0.05"), rows)
    page.write("The growth that the thesis reports is that of the linear basis with stress first in steps of 0.2: floe ends a run that makes energy from nothing. The smooth bases, or a quarter of the step,",
               "do not grow so.", "")


def piston(page):
    page.write("## A piston on a container of fluid", "",
               "`inputs/piston_container.yaml` (York 1997, section 6.1; York, Sulsky and Schreyer 2000, section 4.2): acoustic fluid of one point a cell, a",
               "piston, a spring of negligible mass, linear basis. Mean period of three swings against that of the exact sum of modes (first mode",
               "0.0070882 and 0.0223479 s). The spring has 20/h points, the piston is its last, at 20 + h/2.")
    heavy = ["bodies.spring.membrane.heavy_mass=1", "verify.reference.piston.mass=1", "time.end=0.067"]

    def period(name, h, *settings):
        points = round(20 / h)
        run = page.run("inputs/piston_container.yaml", f"piston-{name}-{h}", None, [
            f"domain.cell={h}", f"bodies.spring.membrane.number={points}", f"bodies.spring.membrane.heavy_point={points}", f"verify.reference.piston.origin={20 + h / 2}", *settings], once=True)
        return floe.percent(run.error("hperiod_position"), 2)

    rows = [(f"{h}{' (the paper' + chr(39) + 's)' if h == 1 else ''}", round(40 / h), period("light", h), period("heavy", h, *heavy), period("two", h, *heavy, "bodies.fluid.points=2"),
             period("smooth", h, *heavy, "method.basis=quadratic")) for h in (4, 2, 1, 0.5, 0.25)]
    rows.append(("published, h = 1", "", "0.0071 s: 0.17 %", "0.022 s: 1.6 %", "", ""))
    page.table(("h", "cells", "m = 0.1: period off by", "m = 1: period off by", "m = 1, two fluid points a cell", "m = 1, quadratic basis"), rows)
    page.write("The heavy piston's error halves with h. The light one's is that of the history from which crossings are read (1e-5 of the period) from h = 2",
               "on. With the quadratic basis the interface is smeared over three nodes.", "")


def expansion(page):
    page.write("## A cylinder of gas that expands into a vacuum", "",
               "`inputs/gas_expansion.yaml` (York 1997, section 4.2; no figures are printed), at t = 0.005, before the front reaches the wall; against the flow",
               "by characteristics. L1 over L1 of the exact, weighted by volume:")
    rows = []
    both = page.cases("compare", "expansion", "inputs/gas_expansion.yaml", "--repeat", 0)
    linear = page.cases("compare", "expansion-linear", "inputs/gas_expansion.yaml", "--set", "runs_as=[mpm]", "--set", "method.basis=linear", "--repeat", 0)
    for said, cases, coupling in (("mpm, quadratic", both, "mpm"), ("mpm, linear (the thesis's)", linear, "mpm"), ("ice, near-vacuum around", both, "ice")):
        for row in (row for row in cases.rows if row["coupling"] == coupling):
            rows.append((said, row["domain.cell"], *(floe.percent(float(row["l1rel_" + name])) for name in ("density", "pressure", "velocity_x", "internal_energy")),
                         floe.figure(float(row["drift_energy"]), 1)))
    page.table(("coupling", "h", "density", "pressure", "velocity (x)", "internal energy", "energy drift"), rows)
    page.write("The deck's cell is 0.05, the text's 0.025. Mass and momentum are kept to round-off by both. Of points, those at the edge stand for most of the volume, and their velocity is what",
               "the cells about the edge make of it. On cells velocity and energy are compared only where the exact gas is.", "")


def viscosity(page):
    """Figures of tests/verification/test_mpm_viscous.c."""
    said = page.test("verification_mpm_viscous", "tests/verification/test_mpm_viscous.c")
    found = re.findall(r"^(\w+), (\d+) cells, force (\S+): velocity (\S+), energy (\S+) of the motion's$", said, re.MULTILINE)
    page.write("## Viscosity of points", "", "A sine of velocity between walls that dies away, and a flow that a body force drives, 8 and 16 cells across: error of the velocity, and what heat and motion",
               "together are off by, over the motion's energy.")
    rows = []
    for basis in sorted({name for name, *_ in found}):
        at = {(int(n), force == "0"): (float(velocity), float(energy)) for name, n, force, velocity, energy in found if name == basis}
        rows.append((basis, *(floe.percent(at[(n, decay)][0], 2) for decay in (True, False) for n in (8, 16)),
                     *(f"{math.log2(at[(8, decay)][0] / at[(16, decay)][0]):.1f}" for decay in (True, False)), floe.percent(at[(16, True)][1], 1)))
    page.table(("basis", "dies away, 8", "16", "driven, 8", "16", "order, dies away", "driven", "energy, dies away, 16"), rows)


def axis(page):
    page.write("## About an axis", "", "The thick cylinder under a traction as a slab in (r, z), quadratic basis, against Lamé (L1 over L1 of the exact):")
    settings = ["domain.geometry=axisymmetric", "domain.stress_state=null", "domain.upper=[1.2, 0.4]", "boundaries={z: slip}",
                "bodies.cylinder.shape={box: {lower: [0.5, 0], upper: [1, 0.4]}}", "loads.bore.traction.surface={box: {lower: [0, -1], upper: [0.5, 2]}}",
                "verify.metrics=[eq13, l1rel_sigma_r, l1rel_sigma_theta]"]
    names, spacings = ("eq13", "l1rel_sigma_r", "l1rel_sigma_theta"), (0.1, 0.05, 0.025)
    runs = [page.run("inputs/annulus_traction.yaml", f"axis-{h}", None, [f"domain.cell={h}", *settings], once=True) for h in spacings]
    errors = numpy.array([[run.error(name) for name in names] for run in runs])
    page.table(("h", "eq. 13", "sigma_r", "sigma_theta"),
               [(f"{h:g}", *map(floe.percent, row)) for h, row in zip(spacings, errors)] + [("**order**", *(f"**{floe.order(spacings, errors[:, k])[0]:.2f}**" for k in range(3)))])
    page.write("`verification_mpm_states` has the same with the linear basis (order 1.0) and the hollow sphere in (r, z) (0.65 and 0.36 % of the pressure at h = 0.1",
               "and 0.05). Gas at uniform pressure stays at rest to 3e-15 of the speed of sound with every basis, at the axis too, but for the quadratic",
               "basis with two points a cell, where the two cells next to the axis settle 4 % off their pressure at any spacing. Momentum along the axis is kept",
               "to 1e-15 in flight (`verification_mpm_axisymmetric`).")


def make(page):
    page.write("From runs and tests that anyone can repeat. References are exact solutions or published figures, never", "floe's own.", "")
    for part in (taylor_bar, forces, crossing, piston, expansion, viscosity, axis):
        part(page)
    page.write("", "## Bars")
    page.show_bars()
