"""The largest stable steps of a line of points, and other limits."""
import math
import re

import numpy
from floe import plots
from floe.results import number, read_csv, split_title
from histories import column

TITLE = "Up to which step, exchange, ... a scene is stable"
LINE, BAR, IN_GAS, PULSE, CYLINDER = "inputs/stability_line.yaml", "inputs/bar_vibration.yaml", "inputs/extreme/tension.yaml", "inputs/acoustic_pulse.yaml", "inputs/pressurized_cylinder.yaml"
BASES, SCHEMES = ("linear", "gimp", "quadratic", "cubic", "cpdi"), ("usl", "usf", "musl")
TRANSFERS = ("flip", "pic", "xpic", "apic", "tpic")
H_OVER_C = 0.00197642354  # s, of the clamped bar
YORK = {"centres": "2.0", "sides": "1.1"}                                           # first unstable steps that York saw, with MUSL and USF
BY_HAND = {("centres", "usl"): 0.76, ("centres", "usf"): 2.10, ("centres", "musl"): 2.10}  # from the sides: 1.05


class Limits:
    """Limits of one search, by the values that it was made for."""

    def __init__(self, rows, *keys):
        self.rows = {tuple(row[key] for key in keys): row for row in rows}

    def stable(self, *values, column="stable_over_reference"):
        return number(self.rows[values][column])


def off(value, reference):
    return 100 * (value / reference - 1)


def worst(values):
    """The largest of the absolute values; NaN if one is none."""
    return float(numpy.abs(numpy.array(list(values))).max())


def search(page, folder, deck, settings, *more):
    return page.limits(folder, deck, *(word for one in settings for word in ("--set", one)), *more)


def each(**axes):
    return [word for key, values in axes.items() for word in ("--each", f"method.{key}={','.join(values)}")]


def york_line(page):
    """Rows of York's line of points, beside eigenvalues of the step that a test computes apart from the solver."""
    found = Limits(search(page, "line", LINE, []), "boundaries.x", "domain.lattice_offset", "method.stress")
    said = page.test("verification_mpm_stability", "tests/verification/test_mpm_stability.c")
    rows, from_eigen, from_hand = [], [], []
    for ends, text in (("symmetry", "held"), ("periodic", "ring")):
        for lattice, place in (("0", "centres"), ("-0.4999", "sides")):
            for scheme in SCHEMES:
                eigen = float(re.search(rf"^{text} {place} +{scheme} *: limit (\S+) ", said, re.MULTILINE).group(1))
                by_hand = BY_HAND.get((place, scheme), 1.05)
                stable, unstable = (found.stable(ends, lattice, scheme, column=f"{which}_over_reference") for which in ("stable", "unstable"))
                from_eigen.append(off(stable, eigen))
                from_hand.append(off(stable, by_hand))
                rows.append((text, place, scheme, "-" if scheme == "usl" else YORK[place], f"{by_hand:.2f}", f"{eigen:.4f}", f"**{stable:.4f}** to {unstable:.4f}",
                             f"{from_eigen[-1]:+.2f} %", f"{from_hand[-1]:+.1f} %"))
    page.bar("line of points: largest stable step off the eigenvalue of the step by at most", worst(from_eigen), "<=", 2, "{:.2f}", " %")
    page.bar("line of points: largest stable step off the limits by hand by at most", worst(from_hand), "<=", 2, "{:.2f}", " %")
    return rows


def line_figure(page):
    """The largest energy of each run of the line over what there can be, over its step."""
    titles, rows = read_csv(page.runs / "line/stability.csv")
    at = {split_title(title)[0]: k for k, title in enumerate(titles)}
    ends = ("symmetry", "periodic")

    def draw(axes, k):
        for lattice, place, style in (("0", "centres", "-"), ("-0.4999", "sides", "--")):
            for scheme, colour in zip(SCHEMES, ("#c03020", "#1060b0", "#208040")):
                own = sorted((float(row[at["time.fixed_step"]]) * 1e3, number(row[at["energy_ratio"]])) for row in rows
                             if (row[at["boundaries.x"]], row[at["domain.lattice_offset"]], row[at["method.stress"]]) == (ends[k], lattice, scheme))
                axes.plot(*zip(*own), linestyle=style, color=colour, marker=".", label=f"{place}, {scheme}")
        axes.set_yscale("log")
        axes.set_xlabel("step over h/c")
        axes.set_ylabel("largest energy over what there can be")
        axes.legend(fontsize="small")

    plots.panels(page.picture("line", "energy over the step"), draw, ["held ends", "ring"])


def centring(page):
    """Both time centrings of the pressure of cells against linear acoustics."""
    found = Limits(search(page, "centring", PULSE, ["output.interval=null", "output.history_interval=0.05", "time.end=1e9", "time.max_steps=4000", "stability.growth=1"],
                          "--over", "time.fixed_step=0.008:0.03", *each(centring=("half", "full")), "--relative-to", 0.02, "--tolerance", 0.002), "method.centring")
    rows, apart = [], []
    for which, theory in (("half", 1), ("full", 0.5 ** 0.5)):
        stable, unstable = found.stable(which), found.stable(which, column="unstable_over_reference")
        apart.append(off(stable, theory))
        rows.append((which, f"{theory:.4f}", f"**{stable:.4f}** to {unstable:.4f}", f"{apart[-1]:+.2f} %"))
    page.bar("ICE, both centrings: largest stable step off linear acoustics by at most", worst(apart), "<=", 2, "{:.2f}", " %")
    return rows


def bases(page):
    found = Limits(search(page, "bar", BAR, ["output.interval=null", "output.history_interval=0.01", "time.end=100", "time.max_steps=4000"], "--over", "time.fixed_step=0.0005:0.008",
                          *each(basis=BASES, stress=SCHEMES), "--relative-to", H_OVER_C, "--tolerance", 0.005), "method.basis", "method.stress")
    page.write("## Bases", "", "The clamped bar of 16 cells with two points a cell, 4000 steps. Largest stable step over h/c:")
    page.table(("basis", *SCHEMES), [(basis, *(f"{found.stable(basis, scheme):.2f}" for scheme in SCHEMES)) for basis in BASES])
    page.write("For two points a cell of an infinite line von Neumann analysis gives 0.77 for USL and 1.66 to 1.73 for MUSL and USF with the linear basis.", "")
    return found


def usl_and_musl(found, basis, transfers):
    return [f"{found.stable(transfer, basis, 'usl'):.2f} ({found.stable(transfer, basis, 'musl'):.2f})" for transfer in transfers]


def transfers(page):
    found = Limits(search(page, "transfers", BAR, ["output.interval=null", "output.history_interval=0.01", "time.end=100", "time.max_steps=2000", "method.flip=null"],
                          "--over", "time.fixed_step=0.0005:0.012", *each(transfer=TRANSFERS[1:], basis=BASES, stress=SCHEMES), "--relative-to", H_OVER_C, "--tolerance", 0.01),
                   "method.transfer", "method.basis", "method.stress")
    page.data("transfers", page.runs / "transfers/limits.csv")
    apart = worst(off(found.stable(transfer, basis, "usf"), found.stable(transfer, basis, "musl")) for transfer in TRANSFERS[1:] for basis in BASES)
    page.write("## Transfers", "", f"The same bar, 2000 steps. Largest stable step over h/c for USL; in brackets for MUSL, from which USF differs by at most {apart:.1f} %:")
    page.table(("basis", "pic", "xpic (2)", "apic", "tpic"), [(basis, *usl_and_musl(found, basis, TRANSFERS[1:])) for basis in BASES])


def in_gas(page):
    """The same of a bar in gas on cells, by every basis, transfer and time of the stress update."""
    page.write("## A bar in gas", "",
               f"A bar that vibrates in gas on cells (`{IN_GAS}`), four points a cell, 1000 steps, one step of the points in a step of the cells. Largest stable step over h/c of the bar for USL;",
               "in brackets for MUSL. The gas, whose sound is 1.18 times as fast, would be stable up to 0.85.", "")
    for interface in ("smeared", "sharp"):
        found = Limits(search(page, f"coupled-{interface}", IN_GAS, [f"method.interface={interface}", "time.substeps=1", "verify.exact.standing_bar.amplitude=1e-6", "output.interval=null",
                                                                    "output.history_interval=0.1", "time.end=1000", "time.max_steps=1000", "method.flip=null"],
                              "--over", "time.fixed_step=0.01:0.2", *each(transfer=TRANSFERS, basis=BASES, stress=SCHEMES), "--relative-to", 0.0625, "--tolerance", 0.02),
                       "method.transfer", "method.basis", "method.stress")
        page.data(f"coupled-{interface}", page.runs / f"coupled-{interface}/limits.csv")
        apart = worst(off(found.stable(transfer, basis, "usf"), found.stable(transfer, basis, "musl")) for transfer in TRANSFERS for basis in BASES)
        page.write(f"Interface {interface}; USF differs from MUSL by at most {apart:.1f} % (values of the search are 1.2 % apart):")
        page.table(("basis", "flip (0.99)", "pic", "xpic (2)", "apic", "tpic"), [(basis, *usl_and_musl(found, basis, TRANSFERS)) for basis in BASES])


def densities(page):
    """The coupled step over the ratio of densities: limits by interface of steel as heavy as the deck has it."""
    gas = 0.1 / math.sqrt(1.4 * 19.5e6 / 1.1768)  # h/c of the gas at the end: 19.5 MPa at the density it began with
    rows, of_steel = [], {}
    for density in (8.9, 89, 890, 8900, 89000):
        step = 0.1 / math.sqrt(175.4e9 / density)
        found = Limits(search(page, f"density-{density:g}", CYLINDER, ["domain.cell=0.1", "time.end=0.0015", "time.max_steps=1500", "time.substeps=1", f"materials.steel.density={density:g}"],
                              "--coupling", "ice-mpm", "--over", f"time.fixed_step={0.3 * min(step, gas):.6g}:{4 * step:.6g}", *each(interface=("smeared", "sharp")), "--tolerance", 0.03), "method.interface")
        cells = []
        for interface in ("smeared", "sharp"):
            stable, unstable = (found.stable(interface, column=column) for column in ("stable", "unstable"))
            cells += [f"{stable:.3g} to {unstable:.3g}", f"{stable / min(step, gas):.2f}"]
            if density == 8900:
                of_steel[interface] = stable
        rows.append((f"{density:g}", f"{density / 1.1768:.3g}", f"{step:.3g}", *cells))
    page.write("## Solid in gas: ratio of densities", "",
               "The pressurised cylinder at h = 0.1 m up to 1.5 ms or 1500 steps, gas on cells, the steel as stiff as ever and as heavy as shown, one step of the points in a step of the cells. Largest stable fixed step,",
               f"over the smaller of h/c of the solid and of the gas, which is {gas:.4g} s when it has been heated. Steps below all limits are bound by whichever is smaller, at any",
               "ratio.")
    page.table(("density (kg/m3)", "over that of the air outside", "h/c (s)", "smeared: stable up to (s)", "over the smaller h/c", "sharp: stable up to (s)", "over the smaller h/c"), rows)
    return of_steel


def exchange(page):
    found = search(page, "exchange", CYLINDER, ["method.interface=smeared", "domain.cell=0.1", "time.end=0.0015"], "--coupling", "ice-mpm", "--over", "method.exchange=1:1e10", "--tolerance", 0.2)[0]
    page.write("## Exchange between gas and solid", "",
               "The same cylinder, smeared. The solid and the gas that is in its cells are tied by K: it is stable from",
               f"K = {number(found['stable']):.2g} kg/(m3 s) on, and not at {number(found['unstable']):.2g}; by default they have one velocity (`method.exchange: locked`).", "")


def least_step(run):
    """The smallest step of a run; its first row is of no step, and its last steps end where the run does."""
    steps = column(run, "dt")[1:]
    return float(steps[steps > 0.5 * float(numpy.median(steps))].min())


def defaults(page, bar, cylinder):
    """How far the steps of the default CFL number stay below these limits. `bar`: limits by basis; `cylinder`: by interface, of the steel as heavy as the deck has it."""
    page.write("## The default CFL number", "",
               "`time.cfl` is a share of what floe takes for the stable step of a scene, basis and transfer. With the default, 0.5, the smallest step of a run is this part of the limit found above:")
    rows = []
    for basis in BASES:
        run = page.run(BAR, f"default-{basis}", None, [f"method.basis={basis}", "method.stress=usl", "time.cfl=0.5", "output.interval=null", "output.history_interval=0.001"], once=True)
        rows.append((f"clamped bar, {basis}, usl", f"{least_step(run):.3g}", f"{least_step(run) / (bar.stable(basis, 'usl') * H_OVER_C):.2f}"))
    for interface, stable in cylinder.items():
        run = page.run(CYLINDER, f"default-{interface}", "ice-mpm", ["domain.cell=0.1", "time.end=0.0015", "time.substeps=1", "time.cfl=0.5", f"method.interface={interface}",
                                                                    "output.interval=null", "output.history_interval=1e-5"], once=True)
        rows.append((f"cylinder in gas, {interface}, h = 0.1 m", f"{least_step(run):.3g}", f"{least_step(run) / stable:.2f}"))
    page.table(("scene", "smallest step (s)", "of the limit"), rows)
    page.write("More is not taken: points that a lattice does not put at centres have smaller limits (at the sides of their cells half of those, above), and points move.")


def make(page):
    line, pressure = york_line(page), centring(page)
    page.write("Found by bisection with `floe stability`: each value is a run of its own, unstable if it diverges, has rejected steps, an energy that",
               "is no number, or more energy of motion and strain than there can be. A limit lies between the two values shown.", "", "## Bars")
    page.show_bars()
    page.write("## York's line of points", "",
               "Five points in cells of 1, the middle one kicked (York 1997, chapter 8). All steps over h/c. *Published*: the first unstable step that York saw, straining with velocities that",
               "points bring to the nodes, as MUSL and USF do. *By hand*: 2/sin(2 pi/5) from centres, half of that from sides, and 0.76 for USL from centres, the largest step of five cells. *Eigenvalue*: that of",
               "floe's own step, computed apart from it by `tests/verification/test_mpm_stability.c`.")
    page.table(("ends", "points at", "stress", "published", "by hand", "eigenvalue", "found", "off the eigenvalue", "off the figure by hand"), line)
    page.write("The line with held ends and the ring have the same limits, for the shortest wave that five cells hold is the same. York saw the first unstable step at 2.0 and 1.1, in steps of a tenth.",
               "York puts points 0.0001 beside the sides. Round the ring the eigenvalue moves by less than 0.1 % for any distance up to that, on either side.", "")
    line_figure(page)
    bar = bases(page)
    transfers(page)
    in_gas(page)
    page.write("## Time centring of the pressure of cells", "",
               "A pulse of sound of 1e-6 round a ring of 50 cells, unlimited, 4000 steps; unstable as soon as there is more energy than there can be. Largest",
               "stable step over h/c. Theory: 1 - 4 l^2 s^2 (full, phi = 1) and 1 - 2 l^2 s^4 (half, phi = 1/2) as determinants of the step, l = c dt/h, s the sine of half",
               "the phase of a cell.")
    page.table(("centring", "theory", "found", "off"), pressure)
    cylinder = densities(page)
    exchange(page)
    defaults(page, bar, cylinder)
