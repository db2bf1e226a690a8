"""Sub-steps of the points in a step of the cells: a stiff ring, a shock on steel, how stiff and how heavy."""
import math

from histories import column, last

TITLE = "Sub-steps of the points"
RING, PLATE = "inputs/stiff_cylinder.yaml", "inputs/shock_plate.yaml"
STEEL = "materials.plate={density: 7850, law: {linear_elastic: {bulk_modulus: 160e9, shear_modulus: 80e9}}, specific_heat: 460}"
FREE_PLATE = [STEEL, "domain.upper=[2.1, 0.02]", "boundaries.x=free", "bodies.plate.shape={box: {lower: [0.6037, 0], upper: [0.9037, 0.02]}}", "time.end=1.2e-3"]
# A free plate of steel, hit by the shock of shock_plate: p - p1 = PRESSURE from ARRIVES on.
PRESSURE, ARRIVES, HEIGHT = 274992.644, 6.41884e-4, 0.02


def in_the_mean(run):
    """Sub-steps in a step, in the mean."""
    summary = run.result.summary
    return f"{summary['point_updates'] / summary['steps'] / summary['points']:.1f}"


def seconds(run, *stages):
    """s in stages whose names begin so."""
    return sum(value for name, value in run.result.summary["seconds_by_stage"].items() if name.split("_")[0] in stages)


def times(run):
    """Of the points' stages, and of those of cells and lines."""
    mark = " *" if run.disturbed else ""
    return f"{seconds(run, 'mpm'):.3g}{mark}", f"{seconds(run, 'ice', 'embedded'):.3g}{mark}"


def ring(page):
    page.write("## A stiff ring in air", "",
               "`inputs/stiff_cylinder.yaml`: the cylinder of [a1](a1.md), a hundred times as stiff, under 0.2 MPa of air, to rest. Equation 13 has the error of the solid by itself; what counts is that it is the same.")
    rows, shares = [], []
    for h in (0.1, 0.05):
        runs = {n: page.run(RING, f"ring-{h:g}-{n}", None, [f"domain.cell={h:g}", f"time.substeps={n}"], once=True) for n in (1, 4, 16, "auto")}
        rows += [(f"{h:g}", n, in_the_mean(run), f"{100 * run.error('eq13'):.6f} %", f"{run.error('l1_sigma_theta'):.1f}", run.result.summary["steps"], *times(run), f"{last(run, 'drift_energy'):.1e}")
                 for n, run in runs.items()]
        page.bar(f"stiff ring, h = {h:g}: equation 13, auto beside 1, share", abs(runs["auto"].error("eq13") / runs[1].error("eq13") - 1), "<=", 1e-4, "{:.1e}")
        page.bar(f"stiff ring, h = {h:g}: steps of the cells, auto over 1", runs["auto"].result.summary["steps"] / runs[1].result.summary["steps"], "<=", 0.025, "{:.3f}")
        shares.append(seconds(runs[1], "ice", "embedded") / (seconds(runs[1], "ice", "embedded") + seconds(runs[1], "mpm")))
    page.table(("h (m)", "sub-steps", "in the mean", "eq. 13", "L1 of sigma_theta (Pa)", "steps of the cells", "stages of the points (s)", "of cells and lines (s)", "drift of energy"), rows)
    page.write(f"The points cost what they cost without; what is saved is nearly all of the cells' part of the time, here {100 * min(shares):.0f} to {100 * max(shares):.0f} % of it. *: others used the machine meanwhile.", "")


def plate(page):
    page.write("## A shock on a plate of steel", "",
               "`inputs/shock_plate.yaml`, the plate 0.3 m of steel, free at its back and with the gas behind it: its impulse at 1.2 ms against (p - p1) A t by Rankine and Hugoniot, its energy",
               "against that of a rigid plate with this impulse (ten waves have crossed it by then).")
    rows, exact = [], PRESSURE * HEIGHT * (1.2e-3 - ARRIVES)
    for h in (0.01, 0.005):
        for n in (1, 2, 4, "auto"):
            run = page.run(PLATE, f"plate-{h:g}-{n}", None, [*FREE_PLATE, f"domain.cell=[{h:g}, 0.01]", f"time.substeps={n}"], once=True)
            impulse = last(run, "mass_plate") * last(run, "velocity_plate_x") / exact - 1
            motion = (last(run, "kinetic_plate") + last(run, "strain_plate")) * 2 * last(run, "mass_plate") / exact ** 2 - 1
            rows.append((f"{h:g}", n, in_the_mean(run), f"{100 * impulse:+.3f} %", f"{100 * motion:+.3f} %", f"{last(run, 'drift_momentum_x'):.1e}", f"{last(run, 'drift_energy'):.1e}",
                         run.result.summary["steps"], *times(run)))
        page.bar(f"steel plate, h = {h:g}, auto: impulse", 100 * abs(impulse), "<=", 0.5, "{:.2g}", " %")
        page.bar(f"steel plate, h = {h:g}, auto: momentum of the whole", last(run, "drift_momentum_x"), "<=", 1e-13, "{:.1e}")
    page.table(("h (m)", "sub-steps", "in the mean", "impulse, error", "energy, error", "momentum of the whole: drift", "energy", "steps of the cells", "stages of the points (s)", "of cells and lines (s)"), rows)


def disc(page, ratio, speeds, substeps, more=(), steps=1000):
    """A disc of steel in a box of gas whose density is `ratio` of its own and whose sound is `speeds` times slower, set going by half as much pressure again at
    one side: the run, and the largest energy of the disc in the last fifth of it over the largest in the first."""
    density, sound = 7850 * ratio, math.sqrt(266.6666667e9 / 7850) / speeds
    pressure, step = density * sound ** 2 / 1.4, 0.5 * 0.08 / 2 / sound
    temperature = f"{pressure / density / 0.4 / 717.5:.8g}"
    run = page.run(PLATE, f"disc-{ratio}-{speeds}-{substeps}-{len(more)}", None, [
        "domain={dim: 2, stress_state: plane_strain, lower: [0, 0], upper: [0.96, 0.96], cell: 0.08}", "boundaries.x=slip", "boundaries.y=slip", STEEL,
        "bodies.plate.shape={ball: {centre: [0.47, 0.49], radius: 0.27}}", f"reference_pressure={pressure:.8g}", f"ambient={{material: air, pressure: {pressure:.8g}, temperature: {temperature}}}",
        f"bodies.behind={{material: air, shape: {{box: {{lower: [0, 0], upper: [0.16, 0.96]}}}}, pressure: {1.5 * pressure:.8g}, temperature: {temperature}}}",
        f"time.end={steps * step:.8g}", f"output.interval={steps * step:.8g}", f"output.history_interval={steps * step / 100:.8g}", f"time.substeps={substeps}", *more], once=True)
    energy = column(run, "kinetic_plate") + column(run, "strain_plate")
    return run, float(energy[81:].max() / energy[1:21].max())


def sweep(page):
    page.write("## How stiff, how heavy", "",
               "A disc of steel (radius 0.27 m, h = 0.08 m) in a closed box of gas of a given share of its density, whose sound is so many times slower; no damping of any kind, no viscosity. Half as much pressure again at one side",
               "sets all of it going. *Energy of the disc*: the largest of the last fifth of 1000 steps of the cells, over the largest of the first; a force that feeds vibrations would let it grow.")
    rows, worst = [], 0.0
    for ratio in (0.001, 0.1, 0.5, 3):
        for speeds in (4, 16):
            (_, one), (run, auto), (_, flip) = disc(page, ratio, speeds, 1), disc(page, ratio, speeds, "auto"), disc(page, ratio, speeds, "auto", ["method.transfer=flip"])
            rows.append((ratio, speeds, f"{ratio / speeds ** 2:.1e}", in_the_mean(run), f"{auto:.3f}", f"{one:.3f}", f"{flip:.3f}", f"{last(run, 'drift_energy'):.1e}", run.result.summary["rejected_steps"]))
            worst = auto if not auto <= worst else worst
    page.table(("density of the gas, share", "sound of the solid over the gas's", "kappa = gamma p/(rho c^2)", "sub-steps in the mean", "energy of the disc, auto", "with one", "auto, `transfer: flip`", "drift of energy, auto",
                "rejected steps"), rows)
    if worst > 1:
        page.write("The vibration that grows is fed through the default transfer of solids beside cells (`afmpm`) where several sub-steps stand against one step of a gas of some tenths of the solid's density; with `transfer: flip` it dies out.", "")
    page.write("Where the gas is denser than a solid the points take no sub-steps. Without that rule, and sixteen times slower sound, the disc kept ringing in gas of twice its density, and at three times its energy grew four-hundredfold in 750",
               "steps (2.3 times at ten, and at four and eight times slower sound not at all): the vibration grows of which a step of the gas takes half a period. With the velocity of the last sub-step in place of that over all of them",
               "three times were stable at sixteen, and ten were not at eight. At the same density 68 sub-steps a step were stable, and water (0.13, 0.37 and 0.67 of the density of what stood in it, 3, 3 and 12 sub-steps) over 1500 steps.", "")
    page.bar("disc in gas: energy late over early, the largest", worst, "<=", 1, "{:.2f}")


def make(page):
    page.write("With `time.substeps` the points take several steps in one of the cells, under a traction of the gas that stays as it is ([theory](../theory/README.md), Sub-steps of the points). `auto` takes as many as their stable",
               "steps ask for; *in the mean* is what came of it.", "")
    for part in (ring, plate, sweep):
        part(page)
    page.write("## Bars")
    page.show_bars()
