"""The implicit pressure at acoustic CFL of 10, 100, 1000 beside the explicit step; iterations; the choice by cost."""
import floe

TITLE = "Implicit pressure: steps bound by the flow, not by sound"
CASES = ("explicit", 10, 100, 1000)
RISE = 2500  # Pa: 0.4 * 1e5 W/m3 * 1 s / 16


def runs_of(page, deck):
    """The explicit step, and the implicit one at each acoustic CFL."""
    return {case: page.run(f"inputs/{deck}.yaml", f"{deck}-{case}", None, ["method.pressure=explicit" if case == "explicit" else f"time.acoustic_cfl={case}"]) for case in CASES}


def last(run, column):
    return float(run.result.history[column].values[-1])


def scene_table(page, runs, heading, error):
    """`error`: what of a run stands in the column of errors."""
    rows = []
    for case, run in runs.items():
        summary = run.result.summary
        solves, drift = summary["counters"]["pressure_solves"], summary["conservation"]
        rows.append(("explicit" if case == "explicit" else f"implicit, {case}", summary["steps"], floe.figure(run.cpu) + (" *" if run.disturbed else ""),
                     floe.figure(runs["explicit"].cpu / run.cpu), f"{summary['counters']['cg_iterations'] / solves:.1f}" if solves else "-", error(run),
                     f"{drift['mass']:.1e}", f"{drift['energy']:.1e}"))
    page.table(("pressure, acoustic CFL", "steps", "CPU, s", "times faster", "CG iterations a step", heading, "drift of mass", "drift of energy"), rows)


def velocity_error(run):
    return run.error("l1rel_velocity_x")


def vortices(page):
    page.write("## Vortices: `inputs/low_mach_vortex.yaml`", "", "Taylor-Green vortices at Mach 7e-4, 32 x 32 cells; the error is the L1 norm of the",
               "velocity along x against the incompressible solution, over that of the solution itself.")
    runs = runs_of(page, "low_mach_vortex")
    scene_table(page, runs, "error", lambda run: floe.figure(velocity_error(run), 4))
    page.bar("vortices: error at acoustic CFL 1000", 100 * velocity_error(runs[1000]), "<=", 1, "{:.2f}", " %")
    page.bar("vortices: error at acoustic CFL 10 over that of the explicit step", velocity_error(runs[10]) / velocity_error(runs["explicit"]), "<=", 1.1, "{:.2f}")
    page.bar("vortices: drift of energy at acoustic CFL 1000", runs[1000].result.summary["conservation"]["energy"], "<=", 1e-12, "{:.1e}")


def channel(page):
    page.write("## Channel: `inputs/low_mach_channel.yaml`", "", "Start-up of the flow between plates under a difference of pressure, Mach 1e-3, 64 x 16 cells; the error is",
               "that of the velocity along x against the series of the incompressible flow.")
    runs = runs_of(page, "low_mach_channel")
    scene_table(page, runs, "error", lambda run: floe.figure(velocity_error(run), 4))
    for cfl in (10, 100):
        page.bar(f"channel: error at acoustic CFL {cfl} over that of the explicit step", velocity_error(runs[cfl]) / velocity_error(runs["explicit"]), "<=", 1.5, "{:.2f}")


def vessel(page):
    page.write("## Vessel: `inputs/heated_vessel.yaml`", "", "Air in a closed box, heated in the middle for a second: its pressure rises by (gamma - 1) q t V_heated/V = "
               f"{RISE} Pa. The", "errors are that of the mean pressure, and what the middle, where the air is hot, is above a corner, both over that rise.")
    runs = runs_of(page, "heated_vessel")

    def mean(run):
        return (last(run, "pressure_air") - 1e5) / RISE - 1

    def unevenness(run):
        return (last(run, "middle_pressure") - last(run, "corner_pressure")) / RISE

    scene_table(page, runs, "rise of the mean, unevenness", lambda run: f"{mean(run):.1e}, {unevenness(run):.1e}")
    page.write("Probes show the pressure at the start of the last step: in a step of a sixteenth of a second that is another one than the mean at its end.", "")
    page.bar("vessel: rise of pressure at acoustic CFL 1000, off by", 100 * abs(mean(runs[1000])), "<=", 0.1, "{:.1e}", " %")
    page.bar("vessel: unevenness at acoustic CFL 1000", abs(unevenness(runs[1000])), "<=", 0.01, "{:.1e}")
    page.bar("vessel: drift of energy at acoustic CFL 1000", runs[1000].result.summary["conservation"]["energy"], "<=", 1e-12, "{:.1e}")


def iterations(page):
    """Three steps at acoustic CFL 100 on two meshes; 32 and 512 cells along each axis."""
    page.write("## Iterations", "", "Iterations of conjugate gradients a step, and searches of the pressure, at an acoustic CFL of 100: air in a box with",
               "a corner at a pressure 0.07 % higher (`inputs/closed_box.yaml`), three steps.")
    rows = []
    for what, width, settings in (("uniform", 1, []), ("jump of 1e4 in density", 1, ["bodies.charge.temperature=0.03"]), ("stretched cells, 4 : 1", 4, [])):
        found = []
        for n in (32, 512):
            run = page.run("inputs/closed_box.yaml", f"box-{what.split()[0]}-{n}", None, [
                "method.pressure=implicit", "time.acoustic_cfl=100", "time.first_step=1", "time.max_steps=3", f"domain.upper=[{width},1]",
                f"bodies.right.shape.box.upper=[{width},1]", "bodies.charge.pressure=101.4 kPa", f"domain.cell=[{width / n:.10g},{1 / n:.10g}]", *settings], once=True)
            counters = run.result.summary["counters"]
            found.append((counters["cg_iterations"] / 3, counters["outer_iterations"] / 3))
        rows.append((what, *(f"{pair[0]:.1f}" for pair in found), *(f"{pair[1]:.1f}" for pair in found)))
        page.bar(f"iterations, {what}: 512 x 512 less 32 x 32", found[1][0] - found[0][0], "<=", 2, "{:.1f}")
    page.table(("scene", "CG, 32 x 32", "CG, 512 x 512", "searches, 32 x 32", "searches, 512 x 512"), rows)


def choice(page):
    page.write("## The choice by cost", "", "`method.pressure: auto` predicts the steps that the rest of the run would take either way, and takes what costs less.")
    rows = []
    for deck, coupling in (("low_mach_vortex", None), ("heated_vessel", None), ("isentropic_vortex", None), ("sod", "ice")):
        summary = page.run(f"inputs/{deck}.yaml", f"auto-{deck}", coupling, ["method.pressure=auto"], once=True).result.summary
        rows.append((f"`{deck}`", summary["pressure"], summary["steps"]))
    page.table(("deck", "pressure", "steps taken"), rows)


def make(page):
    for part in (vortices, channel, vessel, iterations, choice):
        part(page)
    page.write("Times are of the processor, without outputs; *: others used the machine meanwhile.", "", "## Bars", "",
               "The bars on iterations were set first; the others after first trials.")
    page.show_bars()
