"""Riemann problems, interfaces and blasts against their exact solutions."""
import floe
from floe import plots
from order_table import order_of, order_table
from profiles import profile

TITLE = "Shocks, interfaces and blasts on cells, against exact solutions"
FINE = "0.01,0.005,0.0025,0.00125"


def riemann(exact, end):
    return ["verify.exact={riemann: {" + exact + "}}", f"time.end={end}"]


# Folder, title, settings: those of the head of inputs/riemann.yaml.
TUBES = (
    ("toro-1", "Toro 1: Sod's tube with a stream", []),
    ("toro-2", "Toro 2: two fans, nearly a vacuum", riemann("left_density: 1, left_velocity: -2, left_pressure: 0.4, right_density: 1, right_velocity: 2, right_pressure: 0.4, "
                                                           "position: 0.5", 0.15)),
    ("toro-3", "Toro 3: the left blast, pressures 1e5 apart", riemann("left_density: 1, left_pressure: 1000, right_density: 1, right_pressure: 0.01, position: 0.5", 0.012)),
    ("toro-4", "Toro 4: two shocks", riemann("left_density: 5.99924, left_velocity: 19.5975, left_pressure: 460.894, right_density: 5.99242, right_velocity: -6.19633, "
                                             "right_pressure: 46.0950, position: 0.4", 0.035)),
    ("toro-5", "Toro 5: the left blast, its contact all but at rest", riemann("left_density: 1, left_velocity: -19.59745, left_pressure: 1000, right_density: 1, "
                                                                             "right_velocity: -19.59745, right_pressure: 0.01, position: 0.8", 0.012)),
    ("right-blast", "The right blast, pressures 1e4 apart", riemann("left_density: 1, left_pressure: 0.01, right_density: 1, right_pressure: 100, position: 0.5", 0.035)),
    ("lax", "Lax's problem", riemann("left_density: 0.445, left_velocity: 0.698, left_pressure: 3.528, right_density: 0.5, right_pressure: 0.571, position: 0.5", 0.13)),
)
TWO_GASES = ["materials.left.eos={ideal: {gamma: 1.4, specific_heat: 717.5}}", "materials.right.eos={ideal: {gamma: 1.6, specific_heat: 717.5}}",
             *riemann("left_density: 1, left_pressure: 1, right_density: 0.125, right_pressure: 0.1, right_gamma: 1.6, position: 0.7", 0.1)]
NOH_LINE = ["domain.dim=2", "domain.lower=[0, 0]", "domain.upper=[1, 1]", "boundaries.y.lower=symmetry", "bodies.gas.shape={box: {lower: [0, 0], upper: [1, 1]}}",
            "verify.exact.noh.geometry=1", "verify.region={ball: {centre: [0, 0], radius: 0.35}}"]
SEDOV_LINE = ["domain.dim=2", "domain.geometry=axisymmetric", "domain.lower=[0, 0]", "domain.upper=[1.2, 0.12]", "boundaries={z: symmetry}",
              "ambient={material: gas, pressure: 1e-6, temperature: 2.5e-6}",
              "bodies.gas={material: gas, shape: {box: {lower: [0, 0], upper: [0.03, 0.12]}}, density: 1, pressure: 44.0496}",
              "verify.exact={sedov: {energy: 0.31136717, pressure: 1e-6, geometry: 1, axes: 1}}", "time.end=1"]
SEDOV_POINT = ["domain.dim=2", "domain.geometry=axisymmetric", "domain.lower=[0, 0]", "domain.upper=[1.2, 1.2]", "boundaries={z: {lower: symmetry}}",
               "ambient={material: gas, pressure: 1e-6, temperature: 2.5e-6}",
               "bodies.gas={material: gas, shape: {ball: {centre: [0, 0], radius: 0.04}}, density: 1, pressure: 1269.87}",
               "verify.exact={sedov: {energy: 0.85107185, pressure: 1e-6, geometry: 2}}", "time.end=1"]
STATE = ("l1_density", "l1_velocity_x", "l1_pressure")


def compared(page, folder, deck, settings, spacings):
    words = [word for setting in settings for word in ("--set", setting)]
    return page.cases("compare", folder, f"inputs/{deck}.yaml", *words, "--axis", "domain.cell=" + spacings, "--repeat", 0)


def problem(page, folder, deck, settings, spacings, metrics):
    """Errors and orders of one problem."""
    cases = compared(page, folder, deck, settings, spacings)
    drift = cases.numbers("drift_energy", coupling="ice")
    order_table(page, cases, "ice", metrics, rejected=True, last=[("energy drift", lambda k: f"{drift[k]:.1e}")])
    return cases


def order_of_at_least(page, what, cases, metric, least):
    page.bar(f"{what}, order of {metric.split('_', 1)[1]}", order_of(cases, "ice", metric)[0], ">=", least, "{:.2f}")


def picture(page, folder, case="ice-0.005"):
    run = profile(page.runs / folder / case)
    plots.lines(page.picture(folder, folder), {"ice": (run["x"], run["density"], {"linestyle": "", "marker": ".", "markersize": 3}),
                                               "exact (averages over cells)": (run["x"], run["exact_density"], plots.EXACT)}, "x", "density")


def tubes(page):
    page.write("## Riemann problems of one gas", "", "`inputs/riemann.yaml`, at the default CFL number. The exact solver gives the star states of Toro 2009, table 4.2,",
               "to half their last figure (`tests/unit/test_verify_riemann.c`).", "")
    for folder, said, settings in TUBES:
        page.write(f"### {said}")
        cases = problem(page, folder, "riemann", settings, FINE, (*STATE, "l1_internal_energy"))
        order_of_at_least(page, said, cases, "l1_density", 0.6)
        page.bar(f"{said}: steps rejected", float(cases.numbers("rejected_steps", coupling="ice").max()), "<=", 0, "{:.0f}")
        picture(page, folder)


def beside_interface(run, low, high, pressure):
    """The largest departure of the pressure from what it should be between two places, as a share of that."""
    inside = (run["x"] > low) & (run["x"] < high)
    return abs(run["pressure"][inside] - pressure).max() / pressure


def foot(run):
    """How far the pressure falls below the exact one left of x = 0.69, in per cent of 1 GPa."""
    left = run["x"] < 0.69
    return max(0, (run["exact_pressure"] - run["pressure"])[left].max()) / 1e7


def two_fluids(page):
    page.write("## Shock tubes of two fluids", "", "`inputs/fluid_tube.yaml`: density, velocity and energy of the mixture by mass; its pressure.", "",
               "### Water of 1 GPa and air")
    metrics = ("l1rel_density", "l1rel_velocity_x", "l1rel_pressure", "l1rel_internal_energy", "l1_volume_fraction")
    cases = problem(page, "water-air", "fluid_tube", [], FINE, metrics)
    order_of_at_least(page, "water and air", cases, "l1rel_density", 0.7)
    order_of_at_least(page, "water and air", cases, "l1rel_pressure", 0.7)
    picture(page, "water-air")
    fine, coarse = (profile(page.runs / "water-air" / f"ice-{h}") for h in (0.00125, 0.01))
    page.write("Behind the fan the pressure should be 14.19 MPa up to the shock at 0.834. About the interface, from 0.69 to 0.828, it is off by at most "
               f"{100 * beside_interface(fine, 0.69, 0.828, 14190477.2):.2f} % of that at 800 cells. At the foot of the fan it falls too low, by {foot(coarse):.1f} % of the "
               f"water's 1 GPa at 100 cells and {foot(fine):.1f} % at 800: centred in time, the foot of a strong fan rings.", "", "### Two gases, gamma 1.4 and 1.6")
    cases = problem(page, "two-gases", "fluid_tube", TWO_GASES, FINE, metrics)
    order_of_at_least(page, "two gases", cases, "l1rel_density", 0.8)
    picture(page, "two-gases")


def streams(page):
    page.write("## Interfaces in a stream", "", "`inputs/fluid_stream.yaml`: air, water and helium, or air and water, at 1 bar and 100 m/s, carried once around.")
    rows = []
    for fluids, settings in ((2, ["bodies.right.material=air"]), (3, [])):
        for limiter in ("first_order", "default"):
            cases = compared(page, f"stream-{fluids}-{limiter}", "fluid_stream", [*settings, f"method.limiter={limiter}"], "0.02,0.01")
            rows += [(fluids, limiter, row["domain.cell"], row["steps"], floe.figure(float(row["linf_velocity_x"])), floe.figure(float(row["linfrel_pressure"]))) for row in cases.rows]
            page.bar(f"stream of {fluids} fluids, {limiter}: p off by at most", float(cases.numbers("linfrel_pressure")[-1]), "<=", 1e-7, "{:.1e}")
    page.table(("fluids", "limiter", "h", "steps", "linf of u, m/s", "linf of p, over p"), rows)


def blasts(page):
    page.write("## Blasts and implosions", "", "### Noh, against a wall")
    order_of_at_least(page, "Noh, plane", problem(page, "noh-plane", "noh", [], FINE, (*STATE, "l1_internal_energy")), "l1_density", 0.8)
    picture(page, "noh-plane")
    page.write("### Noh, against a line, in the plane")
    order_of_at_least(page, "Noh, line", problem(page, "noh-line", "noh", NOH_LINE, "0.04,0.02,0.01", STATE), "l1_density", 0.6)
    page.write("### Sedov, from a plane")
    order_of_at_least(page, "Sedov, plane", problem(page, "sedov-plane", "sedov", [], "0.02,0.01,0.005", STATE), "l1_density", 0.7)
    picture(page, "sedov-plane")
    page.write("### Sedov, from a line, about the axis")
    order_of_at_least(page, "Sedov, line", problem(page, "sedov-line", "sedov", SEDOV_LINE, "0.03,0.015,0.0075", STATE), "l1_velocity_x", 0.6)
    page.write("The order of density is a half here, 0.8 of the plane: the peak behind the shock is a few cells thin at these spacings.", "", "### Sedov, from a point, about the axis")
    problem(page, "sedov-point", "sedov", SEDOV_POINT, "0.04,0.02", STATE)
    page.write("Two spacings only, and no more than a look: the axisymmetric blast is coarse here.")


def make(page):
    page.write("Validation rows D1, D2 and D7. Errors are means over the cells, of averages over cells (`l1rel`: over that of the exact solution); orders",
               "are slopes in log-log with their standard errors.", "")
    for part in (tubes, two_fluids, streams, blasts):
        part(page)
    page.write("## Bars")
    page.show_bars()
