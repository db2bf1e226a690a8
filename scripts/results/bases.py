"""Every basis with every transfer on manufactured solutions."""
import math
import re

import floe
from curves import curves
from floe import plots
from pages import RESULTS, write_csv

TITLE = "Bases and transfers on manufactured solutions"
BAR, RING = "inputs/bar_mms.yaml", "inputs/ring_mms.yaml"
BASES = ("linear", "gimp", "cpdi", "quadratic", "cubic")
METRICS = ("l1_displacement_x", "l1_velocity_x", "l1_stress_xx")
CELLS = ["--axis", "domain.cell=0.0625,0.03125,0.015625"]
# flip1: no PIC at all; tpic-usf: tpic with that scheme of stresses.
TRANSFERS = {"flip1": ["method.transfer=flip", "method.flip=1"], **{name: [f"method.transfer={name}", "method.flip=null"] for name in ("pic", "xpic", "apic", "tpic", "afmpm")}}
TRANSFERS["flip"] = ["method.transfer=flip", "method.flip=null"]
MARKS = dict(zip(TRANSFERS, "osv^Dx+"))
KEPT = ("status", "h", *METRICS, "drift_energy", "cpu_seconds", "disturbed")


class Pair:
    """One basis with one transfer: its rows, coarse first."""

    def __init__(self, basis, transfer, rows):
        self.basis, self.transfer, self.rows = basis, transfer, rows

    def errors(self, metric):
        return [float(row[metric] or "nan") if row["status"] == "done" else math.nan for row in self.rows]

    def order(self, metric):
        """Fitted to all spacings; "-" where a run did not end or is exact, or where there is one spacing alone."""
        errors, spacings = self.errors(metric), [float(row["h"]) for row in self.rows]
        return f"{floe.order(spacings, errors)[0]:.2f}" if all(error > 0 for error in errors) and len(set(spacings)) > 1 else "-"

    def row(self):
        cells = [cell for metric in METRICS for cell in (" ".join("failed" if math.isnan(error) else f"{error:.1e}" for error in self.errors(metric)), self.order(metric))]
        last = self.rows[-1]
        time = f"{float(last['cpu_seconds']):.2g}" + (" *" if last["disturbed"] == "yes" else "") if last["status"] == "done" else last["status"]
        return (self.basis, self.transfer, *cells, f"{float(last['drift_energy'] or 'nan'):.1e}", time)


def study(page, short, deck, words, transfers=None):
    """A study of all bases with each transfer: {(basis, transfer): Pair}, and its rows beside the page."""
    pairs = {}
    for transfer, settings in (transfers or TRANSFERS).items():
        cases = page.cases("study", f"{short}-{transfer}", deck, f"--bases={','.join(BASES)}", *words, *(word for one in settings for word in ("--set", one)), "--set", "output.interval=null")
        for basis in BASES:
            pairs[(basis, transfer)] = Pair(basis, transfer, [row for row in cases.rows if row["method.basis"].strip('"') == basis])
    write_csv(RESULTS / f"bases-{short}.csv", ("basis", "transfer", *KEPT),
              [(basis, transfer, *(row[name] for name in KEPT)) for (basis, transfer), pair in pairs.items() for row in pair.rows])
    return pairs


def table(page, pairs):
    page.table(("basis", "transfer", *(cell for metric in METRICS for cell in (metric, "order")), "energy", "CPU, s"), [pairs[(basis, transfer)].row()
               for basis in BASES for transfer in dict.fromkeys(name for _, name in pairs)])


def plot(page, short, pairs, unit):
    colour = plots.colours(BASES)
    series = {f"{basis} {transfer}": ([float(row["cpu_seconds"] or "nan") for row in pair.rows], pair.errors(METRICS[0]), {"color": colour[basis], "marker": MARKS[transfer]})
              for (basis, transfer), pair in pairs.items() if transfer in MARKS}
    curves(page.picture(short, "error against processor time"), series, "processor time (s)", f"L1 of displacement{unit}", log=True)


def best(pairs, metric):
    """The pair with the least error of the finest mesh, in words."""
    pair = min(pairs.values(), key=lambda one: one.errors(metric)[-1] if one.errors(metric)[-1] > 0 else math.inf)
    return f"{pair.basis} with {pair.transfer} ({pair.errors(metric)[-1]:.1e})"


def leaders(page, studies):
    page.write("## Least errors", "", "On the finest mesh of each problem:")
    page.table(("problem", "displacement", "velocity", "stress"), [(said, *(best(pairs, metric) for metric in METRICS)) for said, pairs in studies])


def spin(page):
    said = page.test("verification_mpm_transfer", "tests/verification/test_mpm_transfer.c")
    page.write("## Moment of momentum", "", "The share that a free, stiff disc loses over a tenth of a turn, by `verification_mpm_transfer` (flip: 1, C_p counted).")
    page.table(("transfer", "basis", "lost"), re.findall(r"^(\S+) +(\S+) +loses +(\S+)", said, re.MULTILINE))


def words(page):
    page.write("## What is known of why", "",
               "* **At small strain, points in their cells**: the gradient of linear functions, GIMP and CPDI is even in a cell, right to second order in its middle only, and is read at the points: first",
               "  order in stress. That is space, not time; GIMP with points at quarters of a cell is the linear basis.",
               "* **At large strain with 2 points a cell** the error of GIMP and of splines is quadrature, in space: points that have spread over the mesh sum a node's force with an error that goes with",
               "  points a cell, not with h. 4 points a cell and smoother splines cure it. GIMP gains little: its domains keep their width while the points part, and leave gaps; CPDI's follow.",
               "* **pic** diffuses by about h^2 in each step, so that its error is first order in h, and larger with smaller steps. **apic and tpic** keep what turns; APIC with splines to round-off. `xpic` of",
               "  order 2 does not: take `filter_order: 4` or more, or `afmpm`, where things turn.",
               "* **usl and musl** agree; **usf** has as stress that of the step's start: first order when read at its end.",
               "* **The drift of energy** is first order in the step: velocities live half a step behind places, and the work of the force is counted between.", "",
               "The default is quadratic splines with `afmpm` for solids in dynamic steps, and `flip` beside gas as points, with damping to rest, and in contact, which were measured with it",
               "([defaults](../defaults.md)); which of these tables a scene is like decides whether another pair does better.", "")


def make(page):
    page.write("Each basis with each transfer, under a force that holds points to a motion that is known exactly: L1, by volume, of displacement, velocity and stress at three spacings, coarse first, and",
               "the order fitted to the three. *energy* is its drift in the ledger on the finest mesh, *CPU* the processor time of its steps (*: others used the machine meanwhile). `flip1` is FLIP alone, `flip`",
               "has one per cent of PIC. A dash: a run of the three did not come to its end, or is exact.")
    small = study(page, "small", BAR, [*CELLS, "--set", "verify.exact.bar_mms.amplitude=0.001"])
    large = study(page, "large", BAR, CELLS)
    schemes = {f"tpic-{scheme}": [*TRANSFERS["tpic"], f"method.stress={scheme}"] for scheme in ("usf", "musl")}
    many = study(page, "many", BAR, [*CELLS, "--set", "bodies.bar.points=4"], {**TRANSFERS, **schemes})
    steps = study(page, "steps", BAR, ["--axis", "time.cfl=0.4,0.2,0.1", "--set", "domain.cell=0.015625"], {"tpic": TRANSFERS["tpic"]})
    ring = study(page, "ring", RING, ["--axis", "domain.cell=0.1,0.05,0.025"])
    turns = study(page, "turns", RING, ["--axis", "domain.cell=0.1,0.06", *(word for one in ("spin=4", "amplitude=0.4", "frequency=0.5") for word in ("--set", f"verify.exact.ring_mms.{one}")),
                                        "--set", "time.end=1.4"])
    for what, pairs, pair, metric, limit in (
            ("bar, strain 0.3 %, 2 points a cell, h = 1/64: quadratic tpic, L1 of stress (Pa, of 2000)", small, ("quadratic", "tpic"), METRICS[2], 1),
            ("bar, strain 31 %, 2 points a cell, h = 1/64: cpdi tpic, L1 of displacement (m)", large, ("cpdi", "tpic"), METRICS[0], 1e-5),
            ("bar, strain 31 %, 4 points a cell, h = 1/64: cubic tpic, L1 of displacement (m)", many, ("cubic", "tpic"), METRICS[0], 2e-5),
            ("ring, h = 1/40: cubic tpic, L1 of displacement", ring, ("cubic", "tpic"), METRICS[0], 1e-3)):
        page.bar(what, pairs[pair].errors(metric)[-1], "<=", limit, "{:.2g}")
    page.write("## Bars")
    page.show_bars()
    leaders(page, (("bar, strain 0.3 %", small), ("bar, strain 31 %, 2 points a cell", large), ("bar, strain 31 %, 4 points a cell", many), ("ring", ring), ("ring that turns", turns)))
    words(page)
    page.write("## A bar at a strain of 0.3 %, 2 points a cell", "", "h = 1/16, 1/32, 1/64. No point leaves its cell, so that the order is that of the basis.")
    table(page, small)
    page.write("## The bar at a strain of 31 %, 2 points a cell", "", "Points cross 1.6 cells of the coarsest mesh and 6.4 of the finest.")
    table(page, large)
    plot(page, "large", large, " (m)")
    page.write("## The same with 4 points a cell")
    table(page, many)
    page.write("## Steps, 2 points a cell, h = 1/64", "", "A CFL number of 0.4, 0.2 and 0.1.")
    page.table(("basis", "transfer", *METRICS, "energy", "CPU, s"), [(row[0], row[1], row[2], row[4], row[6], row[8], row[9]) for row in (pair.row() for pair in steps.values())])
    page.write("## The ring, a shear of 1.4, 3 by 3 points a cell", "", "h = 1/10, 1/20, 1/40.")
    table(page, ring)
    plot(page, "ring", ring, "")
    page.write("## The ring turned by 5.6 radians, a shear of 2.8", "",
               "All of it spins at 4 radians a second while its layers turn by up to 0.4 radians more: principal stretches of 3.1 and 0.32 at t = 1, errors at t = 1.4. h = 0.1 and 0.06, with 3 by 3 points",
               "a cell.")
    table(page, turns)
    spin(page)
