"""Edges of solids held by a penalty: stress beside surfaces that cut the mesh; other walls."""
import floe

TITLE = "Edges of solids: stress beside a surface that cuts the mesh"
DECK, WITH_GAS = "inputs/annulus_traction.yaml", "inputs/pressurized_cylinder.yaml"
SPACINGS = (0.1, 0.05, 0.025, 0.0125)
METRICS = ("eq13", "l1_sigma_r", "l1_sigma_theta")
PRESSURE = 19.4e6
SMALL = ["loads.bore.traction.pressure=19.4e4", "verify.exact.lame.inner_pressure=19.4e4", "verify.pressure=19.4e4"]
SOFT = ["verify.metrics=[l1_sigma_r, l1_sigma_theta]", "materials.steel.law={neo_hookean: {bulk_modulus: 970 MPa, shear_modulus: 363.75 MPa}}", "time.increments=4",
        "verify.exact={soft_cylinder: {inner_radius: 0.5, outer_radius: 1.0, inner_pressure: 19.4 MPa, bulk_modulus: 970 MPa, shear_modulus: 363.75 MPa, dead: 1}}"]


def wall(outer, penalty):
    return [f"method.edge_penalty={penalty}", f"bodies.cylinder.shape.annulus.outer_radius={outer:g}", f"verify.exact.lame.outer_radius={outer:g}",
            f"domain.upper=[{outer + 0.2:.1f}, {outer + 0.2:.1f}]"]


def row(said, run, pressure):
    eq13 = run.error("eq13")
    return (said, f"{100 * eq13:.3f}" if eq13 == eq13 else "-", *(f"{100 * run.error(name) / pressure:.3f}" for name in METRICS[1:]), run.result.summary["steps"],
            floe.figure(run.cpu, 2) + (" *" if run.disturbed else ""))


def table(page, title, rows):
    page.table((title, "eq. 13, %", "L1 sigma_r, % of P", "L1 sigma_theta, % of P", "steps", "CPU, s"), rows)


def static(page, name, said, settings, pressure=PRESSURE):
    """The cylinder in static balance at every spacing: rows of the table, {metric: order in h}, and the orders in words."""
    runs = [page.run(DECK, f"{name}-{h:g}", None, ["time.solver=static", f"domain.cell={h:g}", *settings]) for h in SPACINGS]
    orders = {metric: floe.order(SPACINGS, [run.error(metric) for run in runs])[0] for metric in METRICS}
    known = [f"{slope:.2f}" for slope in orders.values() if slope == slope]
    return [row(f"{said}, h = {h:g}", run, pressure) for h, run in zip(SPACINGS, runs)], orders, f"* {said}: orders {', '.join(known)} in h."


def penalties(page):
    """The penalty from none to twice what the decks have, and a hundredth of the pressure."""
    rows, slopes = [], []
    for gamma in (0, 0.02, 0.05, 0.1):
        some, orders, said = static(page, f"static-{gamma}", f"gamma = {gamma}", [f"method.edge_penalty={gamma}"])
        rows, slopes = rows + some, slopes + [said]
    for metric, name in zip(METRICS, ("eq. 13", "L1 of sigma_r", "L1 of sigma_theta")):
        page.bar(f"static: order of {name} in h with gamma = 0.1", orders[metric], ">=", 1.7, "{:.2f}")
    some, orders, said = static(page, "small", "P/100, gamma = 0.05", ["method.edge_penalty=0.05", *SMALL], PRESSURE / 100)
    page.bar("static, P/100: order of L1 of sigma_theta with gamma = 0.05", orders["l1_sigma_theta"], ">=", 1.7, "{:.2f}")
    table(page, "gamma, spacing (m)", rows + some)
    page.write(*slopes, said, "")


def group(page, title, cases):
    """A table of static cases and their orders; `cases`: (folder, what is said, settings)."""
    made = [static(page, *case) for case in cases]
    table(page, title, [one for rows, _, _ in made for one in rows])
    page.write(*(said for _, _, said in made), "")


def stepped(page):
    rows = []
    for h in SPACINGS[:3]:
        for gamma in (0, 0.05):
            settings = [f"domain.cell={h:g}", f"method.edge_penalty={gamma}"]
            runs = {"traction": page.run(DECK, f"stepped-{gamma}-{h:g}", None, settings),
                    **{coupling: page.run(WITH_GAS, f"{coupling}-{gamma}-{h:g}", coupling, settings) for coupling in ("mpm", "ice-mpm")}}
            rows += [row(f"{name}, gamma = {gamma}, h = {h:g}", run, PRESSURE) for name, run in runs.items()]
    table(page, "load, gamma, spacing (m)", rows)
    for name, run in runs.items():
        page.bar(f"{'stepped' if name == 'traction' else name}: eq. 13 at h = 0.025 with gamma = 0.05", 100 * run.error("eq13"), "<=", 0.6, "{:.3f}", " %")


def make(page):
    page.write("The thick cylinder of [a1](a1.md) under a traction on its bore, so that the error is that of the solid alone, against Lamé; quadratic",
               "splines, 2 x 2 points a cell, fitted. No point is left out, no stress smoothed. `method.edge_penalty` is gamma. CPU: processor time of the steps; *: others",
               "used the machine meanwhile.", "",
               "## In static balance (`time.solver: static`)", "",
               "Orders in h are those of eq. 13 and of both L1, by least squares. Lamé is a solution for small strains: some 0.03 to 0.05 % of",
               "eq. 13 is no error of the run, and nothing with a hundredth of the pressure (last rows).")
    penalties(page)
    page.write("## Other bases, gamma = 0 and 0.05")
    group(page, "basis, spacing (m)", [(f"basis-{basis}-{gamma}", f"{basis}, gamma = {gamma}", [f"method.basis={basis}", f"method.edge_penalty={gamma}"])
                                       for basis in ("linear", "gimp", "cubic") for gamma in (0, 0.05)])
    page.write("## Other walls")
    group(page, "outer radius (m), spacing (m)", [(f"wall-{outer}-{gamma}", f"{outer}, gamma = {gamma}", wall(outer, gamma)) for outer in (0.6, 2.0) for gamma in (0, 0.05)])
    page.write("## A soft wall", "",
               "Neo-Hookean, K = 50 P, G = 0.375 K, the pressure a force per area at rest: the bore opens by 4 %. Against the radial solution at large strain",
               "(`soft_cylinder`); orders of both stresses. Here points cross cells, and lines of nodes come and go with what they remember.")
    group(page, "gamma, spacing (m)", [(f"soft-{gamma}", f"gamma = {gamma}", [f"method.edge_penalty={gamma}", *SOFT]) for gamma in (0, 0.05)])
    page.write("## Stepped to rest, and with gas", "",
               "Explicit, damped steps: the traction; then the gas of [a1](a1.md) as points (`mpm`) and on cells (`ice-mpm`).")
    stepped(page)
    page.write("## Bars")
    page.show_bars()
