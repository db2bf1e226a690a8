"""Cells, points and membranes about an axis: solids in gas against Lamé, membranes that hold gas, blasts."""
import math

import floe
from histories import largest
from order_table import order_of

TITLE = "About an axis: solids, membranes and blasts in gas"
BALLOON = "inputs/membrane_balloon.yaml"
SPACINGS = (0.1, 0.05, 0.025)
AXIS = ["--axis", "domain.cell=" + ",".join(f"{h:g}" for h in SPACINGS)]
SLAB = ["domain.geometry=axisymmetric", "domain.stress_state=null", "domain.upper=[1.2, 0.2]",
        "boundaries={r: {lower: symmetry, upper: {outlet: {pressure: 101325, temperature: 300}}}, z: symmetry}",
        "bodies.cylinder.shape={box: {lower: [0.5, 0], upper: [1, 0.2]}}", "bodies.bore.shape={box: {lower: [0, 0], upper: [0.5, 0.2]}}",
        "loads.heating.pressurise.region={box: {lower: [0, 0], upper: [0.75, 0.2]}}", "verify.metrics=[eq13, l1rel_sigma_r, l1rel_sigma_theta]", "method.edge_penalty=0"]
TUBE = ["domain.upper=[0.8, 0.2]", "boundaries.z=symmetry", "bodies.gas.shape={box: {lower: [0, 0], upper: [0.5, 0.2]}}",
        "bodies.skin.membrane.curve={segment: {from: [0.5, 0], to: [0.5, 0.2]}}",
        "verify.reference={membrane_rest: {share: 0.2, rest_radius: 0.5, thickness: 0.1, modulus: 54945.05494505494, constant_volume: 1, gas_pressure: 1000, "
        "gas_volume: 0.15707963267948966}}", "verify.history.radius_last=last_skin_r"]
TWO_GASES = ["method={basis: quadratic, flip: 1}", "materials.air={eos: {ideal: {gamma: 1.4, specific_heat: 1}}}", "damping=null", "verify=null"]
STREAM = [*TWO_GASES, "materials.gas.viscosity=null", "bodies.skin.velocity=[0, 10]", "time.end=0.05",
          "bodies.air={material: air, shape: {box: {lower: [0, 0], upper: [0.5, 1.5]}}, pressure: 1000, temperature: 700, velocity: [0, 10]}"]
RESTS = ("radius", "radius_last", "area", "pressure", "hoop_stress", "gas_energy")


def lame_table(page, cases, columns):
    """Errors in per cent with their orders; `columns`: (title, metric)."""
    rows = []
    for coupling in ("ice-mpm", "mpm"):
        errors = [cases.numbers(metric, coupling=coupling) for _, metric in columns]
        rows += [(coupling, f"{h:g}", *(f"{100 * error[k]:.2f}" for error in errors)) for k, h in enumerate(cases.numbers("h", coupling=coupling))]
        rows.append((coupling, "order", *(f"{order_of(cases, coupling, metric)[0]:.2f}" for _, metric in columns)))
    page.table(("coupling", "h (m)", *(title for title, _ in columns)), rows)


def lame_bars(page, what, name, cases, metric):
    page.bar(f"{what}, ice-mpm, h = 0.05: {name}", 100 * cases.numbers(metric, coupling="ice-mpm")[1], "<=", 10, "{:.2f}", " %")


def solids(page):
    page.write("## Solids in gas, against Lamé", "", "`inputs/pressurized_cylinder.yaml` as a slab in (r, z), edges not held: eq. 13 and L1 of the stresses over their means, per cent.")
    cylinder = page.cases("compare", "cylinder", "inputs/pressurized_cylinder.yaml", *(word for one in SLAB for word in ("--set", one)), *AXIS)
    lame_table(page, cylinder, [("eq. 13", "eq13"), ("sigma_r", "l1rel_sigma_r"), ("sigma_theta", "l1rel_sigma_theta")])
    lame_bars(page, "cylinder in (r, z)", "eq. 13", cylinder, "eq13")
    page.bar("cylinder in (r, z), ice-mpm: order of eq. 13", order_of(cylinder, "ice-mpm", "eq13")[0], ">=", 0.89, "{:.2f}")
    page.write("`inputs/pressurized_sphere.yaml`, half of a sphere; displacements along r and z.")
    sphere = page.cases("compare", "sphere", "inputs/pressurized_sphere.yaml", *AXIS)
    lame_table(page, sphere, [("sigma_r", "l1rel_sigma_r"), ("sigma_theta", "l1rel_sigma_theta"), ("u_r", "l1rel_displacement_x"), ("u_z", "l1rel_displacement_y")])
    lame_bars(page, "sphere", "L1 of sigma_theta", sphere, "l1rel_sigma_theta")
    page.bar("sphere, ice-mpm: order of sigma_theta", order_of(sphere, "ice-mpm", "l1rel_sigma_theta")[0], ">=", 0.89, "{:.2f}")


def still_row(said, run, velocity):
    return (said, f"{largest(run, 'pressure_gas', 1000):.2g}, {largest(run, 'pressure_air', 1000):.2g}", f"{largest(run, 'velocity_skin_z', velocity):.2g}",
            f"{largest(run, 'outside_skin'):.2g}")


def disc_in_a_stream():
    return [*STREAM, "domain={dim: 2, geometry: axisymmetric, lower: [0, 0], upper: [0.3, 1], cell: 0.05}",
            "boundaries={r: {lower: symmetry, upper: slip}, z: {lower: {inlet: {velocity: [0, 10], material: gas, pressure: 1000, temperature: 2500}}, upper: free}}",
            "bodies.gas={material: gas, shape: {box: {lower: [0, 0], upper: [0.3, 0.313]}}, pressure: 1000, density: 1, velocity: [0, 10]}",
            "bodies.skin.membrane.curve={segment: {from: [0.3, 0.313], to: [0, 0.313]}}"]


def ball_in_a_stream(h):
    return [*STREAM, f"domain={{dim: 2, geometry: axisymmetric, lower: [0, 0], upper: [0.5, 1.5], cell: {h:g}}}",
            "boundaries={r: {lower: symmetry, upper: slip}, z: {lower: {inlet: {velocity: [0, 10], material: air, pressure: 1000, temperature: 700}}, upper: free}}",
            "bodies.gas={material: gas, shape: {ball: {centre: [0, 0.5], radius: 0.26}}, pressure: 1000, density: 1, velocity: [0, 10]}",
            "bodies.skin.membrane={curve: {arc: {centre: [0, 0.5], radius: 0.25, from: -1.5707963267948966, to: 1.5707963267948966}}, thickness: 0.1, number: 150, encloses: gas}"]


def still_membranes(page):
    page.write("## Two gases and a membrane", "",
               "`inputs/membrane_balloon.yaml` as `ice-mpm`, gases of one pressure, 1000: at rest on both sides of the ball; a disc across a pipe",
               "in a stream at 10, and a ball in such a stream. Areas are means over places in the step, which a curved line closes nearly ([theory](../theory/README.md)).")
    rest = page.run(BALLOON, "rest", "ice-mpm", [*TWO_GASES, "ambient={material: air, pressure: 1000, temperature: 700}", "boundaries={r: symmetry, z: symmetry}", "time.end=0.1"], once=True)
    disc = page.run(BALLOON, "disc", "ice-mpm", disc_in_a_stream(), once=True)
    rows = [still_row(f"at rest, {rest.result.summary['steps']} steps", rest, 0), still_row("a disc in a stream, ten sides of cells", disc, 10)]
    for h in (0.05, 0.025):
        rows.append(still_row(f"a ball in a stream, cells of {h:g}", page.run(BALLOON, f"carried-{h:g}", "ice-mpm", ball_in_a_stream(h), once=True), 10))
    page.table(("what", "largest change of either pressure", "of the velocity of the membrane", "gas beyond it"), rows)
    page.bar("two gases at rest about an axis: largest change of pressure, share", largest(rest, "pressure_gas", 1000) / 1000, "<=", 1e-12, "{:.1e}")
    page.bar("two gases at rest about an axis: gas beyond the membrane", largest(rest, "outside_skin"), "<=", 0, "{:.2g}")
    page.bar("disc in a stream about an axis: largest change of pressure, share", largest(disc, "pressure_gas", 1000) / 1000, "<=", 1e-12, "{:.1e}")


def rests(page, name, number, settings=()):
    """A membrane blown up to its exact rest; `number` over h points."""
    runs = {(coupling, h): page.run(BALLOON, f"{name}-{coupling}-{h:g}", coupling, [f"domain.cell={h:g}", f"bodies.skin.membrane.number={number / h:.0f}", *settings], once=True)
            for coupling in ("ice-mpm", "mpm") for h in SPACINGS}
    errors = {case: {quantity: 100 * run.error("hlate_" + quantity) for quantity in RESTS} for case, run in runs.items()}
    page.table(("coupling", "h", "r, first end", "r, last end", "volume", "pressure", "hoop stress", "energy of the gas", "drift of energy", "gas beyond"),
               [(coupling, f"{h:g}", *(floe.figure(errors[coupling, h][quantity]) for quantity in RESTS), f"{100 * largest(run, 'drift_energy'):.3f}",
                 f"{largest(run, 'outside_skin'):.2g}") for (coupling, h), run in runs.items()])
    coarse, fine = errors["ice-mpm", SPACINGS[0]], errors["ice-mpm", SPACINGS[-1]]
    slopes = [math.log(coarse[quantity] / fine[quantity]) / math.log(SPACINGS[0] / SPACINGS[-1]) for quantity in ("radius_last", "pressure", "hoop_stress")]
    page.write(f"Order from the coarsest to the finest cells, `ice-mpm`: last end {slopes[0]:.2f}, pressure {slopes[1]:.2f}, hoop stress {slopes[2]:.2f}.", "")
    for h in (0.1, 0.05):
        page.bar(f"{name}, ice-mpm, h = {h:g}: pressure", errors["ice-mpm", h]["pressure"], "<=", 0.2, "{:.2g}", " %")
        page.bar(f"{name}, ice-mpm, h = {h:g}: r", errors["ice-mpm", h]["radius_last"], "<=", 0.1, "{:.2g}", " %")


def blasts(page):
    said = page.test("verification_ice_blast", "tests/verification/test_ice_blast.c")
    page.write("## Blasts", "",
               "A ball, and a cylinder, of radius 0.4 and pressure and density 1 bursts into 0.1 and 0.125 (Toro, 3rd ed., section 17.1), t = 0.25: cells in (r, z) against",
               "a reference along the radius by another method on 2000 cells (`verification_ice_blast`). Against the exact solution of Sedov: [shocks](shocks.md).", "",
               *("    " + line for line in said.splitlines() if "L1" in line or "order" in line))


def make(page):
    solids(page)
    still_membranes(page)
    page.write("## Balloon", "", "`inputs/membrane_balloon.yaml` against its exact rest (reference `membrane_rest`): errors in per cent, of means over the last tenth of the time. The first end is on the mirror",
               "z = 0, the last one at the axis.")
    rests(page, "balloon", 6)
    page.write("## Tube", "", "The same membrane as a cylinder between two mirrors, 0.2 long.")
    rests(page, "tube", 0.8, TUBE)
    page.write("Airbags hit by cylinders are in [airbag](airbag.md).", "")
    blasts(page)
    page.write("", "## Bars")
    page.show_bars()
