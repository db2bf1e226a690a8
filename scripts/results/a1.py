"""The pressurised cylinder of Guilkey et al. 2003, both couplings, floe's settings and the paper's."""
import numpy
from floe import plots
from order_table import order_of, time_column
from profiles import profile

TITLE = "Pressurised cylinder: points, and cells with points"
DECK = "inputs/pressurized_cylinder.yaml"
SPACINGS = (0.1, 0.05, 0.025, 0.0125)
COUPLINGS = ("mpm", "ice-mpm")
METRICS = ("eq13", "l1_sigma_r", "l1_sigma_theta")
PRESSURE = 19.4e6
PAPER = ["method.basis=linear", "method.edge_penalty=0", "bodies.cylinder.seeding=lattice", "bodies.bore.seeding=lattice"]
# The wall and its reference at large strain: what Lamé leaves out is no error then. The gas's pressure is per area as it is.
MODULI = "bulk_modulus: 117 GPa, shear_modulus: 43.8 GPa"
LARGE_STRAIN = [f"materials.steel.law={{neo_hookean: {{{MODULI}}}}}", "verify.metrics=[l1_sigma_r, l1_sigma_theta]",
                f"verify.exact={{soft_cylinder: {{inner_radius: 0.5, outer_radius: 1.0, inner_pressure: 19.4 MPa, {MODULI}, dead: 0}}}}"]
# Uintah on this problem: eq. 13 (per cent) and wall time (s) by spacing.
PEER = {0.1: (25.8, 1.4), 0.05: (13.3, 5.8), 0.025: (7.0, 37.0), 0.0125: (3.8, 289.0)}
# The largest eq. 13 (per cent) that is allowed.
MOST = {0.1: 20, 0.05: 10, 0.025: 5, 0.0125: 2.7}


def at(cases, coupling, h, name):
    """A number of the case at a spacing."""
    spacing = cases.numbers("h", coupling=coupling)
    return float(cases.numbers(name, coupling=coupling)[int(numpy.argmin(abs(spacing - h)))])


def table(page, cases, held):
    rows = []
    for coupling in COUPLINGS:
        seconds = time_column(cases, coupling)[1]
        for k, h in enumerate(SPACINGS):
            def share(name):
                value = at(cases, coupling, h, name)
                return f"{value:.3g} Pa ({100 * value / PRESSURE:.2f} % of P)"
            rows.append((coupling, h, *(f"{at(cases, coupling, h, name):.0f}" for name in ("points", "cells", "steps")), f"**{100 * at(cases, coupling, h, 'eq13'):.2f} %**",
                         f"{MOST[h]} %" if held else "-", f"{PEER[h][0]} %", share("l1_sigma_r"), share("l1_sigma_theta"),
                         f"{100 * at(cases, coupling, h, 'rel_gas_pressure'):.1e} %", seconds(k), f"{at(cases, coupling, h, 'run_seconds'):.3g}"))
    page.table(("coupling", "h (m)", "points", "cells", "steps", "eq. 13", "bar", "Uintah", "L1 sigma_r", "L1 sigma_theta", "gas pressure off by", "CPU, s", "wall, s"), rows)
    for coupling in COUPLINGS:
        slopes = ", ".join("%s %.2f ± %.2f" % (name, *order_of(cases, coupling, name)) for name in METRICS)
        page.write(f"* Fitted slope in h, {coupling}: {slopes}.")


def large_strain(page, cases):
    page.write("", "## Against a reference at large strain", "",
               "Lamé's strains are small, and those of the bore are 3.2e-4: what that leaves out bends the slopes of sigma_theta at the finest spacings. (In static balance a hundredth",
               "of the pressure takes L1 of sigma_theta at h = 0.0125 from 0.028 to 0.016 % of it, [edges](edges.md).) With a neo-Hookean wall of the same moduli and the radial",
               "solution at large strain under a pressure per area as it is (`soft_cylinder`, `dead: 0`):")
    rows = []
    for coupling in COUPLINGS:
        seconds = time_column(cases, coupling)[1]
        rows += [(coupling, h, *(f"{100 * at(cases, coupling, h, name) / PRESSURE:.4f}" for name in METRICS[1:]), seconds(k)) for k, h in enumerate(SPACINGS)]
    page.table(("coupling", "h (m)", "L1 sigma_r, % of P", "L1 sigma_theta, % of P", "CPU, s"), rows)


def bars(page, deck, paper, strain):
    for coupling in COUPLINGS:
        for h in SPACINGS:
            page.bar(f"{coupling}: eq. 13 at h = {h:g}", 100 * at(deck, coupling, h, "eq13"), "<=", MOST[h], "{:.2f}", " %")
    for coupling in COUPLINGS:
        page.bar(f"{coupling}: eq. 13 at h = 0.025, within", 100 * at(deck, coupling, 0.025, "eq13"), "<=", 0.6, "{:.3f}", " %")
        for name in METRICS:
            page.bar(f"{coupling}: slope of {name}, 0.1 to 0.0125", order_of(deck, coupling, name)[0], ">=", 1.7, "{:.2f}")
        for name in METRICS[1:]:
            page.bar(f"{coupling}: slope of {name} against the solution at large strain", order_of(strain, coupling, name)[0], ">=", 1.7, "{:.2f}")
        page.bar(f"{coupling}: wall time at h = 0.025", at(deck, coupling, 0.025, "wall_seconds"), "<=", 10, "{:.2f}", " s")
        slope, error = order_of(paper, coupling, "eq13")
        page.bar(f"{coupling}: slope with the paper's settings plus two standard errors", slope + 2 * error, ">=", 0.89, "{:.3f}")
        worst = max(float(cases.numbers("rel_gas_pressure", coupling=coupling).max()) for cases in (deck, paper))
        page.bar(f"{coupling}: gas pressure off by at most", 100 * worst, "<=", 0.5, "{:.1e}", " %")
    page.bar("runs that did not come to rest", sum(text != "at_rest" for cases in (deck, paper) for text in cases.texts("status")), "<=", 0, "{:d}")


def curves(page, deck, paper):
    """Eq. 13 over the spacing and over processor time (Fig. 2b of the paper)."""
    page.write("", "## Error against h and against run time (Fig. 2b)")

    def draw(axes, k):
        for cases, name, style in ((deck, "{}", {"linestyle": "-"}), (paper, "{}, paper's settings", {"linestyle": "--", "fillstyle": "none"})):
            for coupling in COUPLINGS:
                slope = order_of(cases, coupling, "eq13")[0]
                axes.plot(cases.numbers(("h", "cpu_seconds")[k], coupling=coupling), 100 * cases.numbers("eq13", coupling=coupling), marker="o",
                          color=plots.COLOURS[coupling], label=name.format(coupling) + (f", slope {slope:.2f}" if k == 0 else ""), **style)
        axes.plot([(h, PEER[h][1])[k] for h in PEER], [error for error, _ in PEER.values()], linestyle=":", marker="x", color="#606060", label="Uintah")
        axes.set_xscale("log")
        axes.set_yscale("log")
        axes.set_xlabel(("h (m)", "processor time (s); Uintah: wall time")[k])
        axes.set_ylabel("error of eq. 13 (%)")
        axes.legend(fontsize="small")

    plots.panels(page.picture("errors", "error against spacing and processor time"), draw, ["spacing", "time"])


def along_the_axis(page):
    """Fig. 2a of the paper: both couplings at its spacing."""
    mpm, ice = (profile(page.runs / "deck" / f"{coupling}-0.025") for coupling in COUPLINGS)
    if not (numpy.array_equal(mpm["x"], ice["x"]) and numpy.array_equal(mpm["y"], ice["y"])):
        raise RuntimeError("the couplings have other points along the axis")
    page.write("## Stress along the x axis, h = 0.025 m (Fig. 2a)")
    colours, marker = plots.COLOURS, {"linestyle": "", "fillstyle": "none"}
    series = {"Lamé": (mpm["r"], mpm["exact_sigma_r"] / 1e6, plots.EXACT), "Lamé, hoop": (mpm["r"], mpm["exact_sigma_theta"] / 1e6, plots.EXACT)}
    for name, run in (("mpm", mpm), ("ice-mpm", ice)):
        series[f"σ_r, {name}"] = (run["r"], run["sigma_r"] / 1e6, {**marker, "marker": "o" if name == "mpm" else "x", "color": colours[name]})
        series[f"σ_θ, {name}"] = (run["r"], run["sigma_theta"] / 1e6, {**marker, "marker": "s" if name == "mpm" else "+", "color": colours[name]})
    plots.lines(page.picture("profile", "stress along the x axis"), series, "r (m)", "stress along the x axis (MPa)")
    columns = [mpm["r"], *(run[name] / 1e6 for name in ("sigma_r", "sigma_theta") for run in ({name: mpm["exact_" + name]}, mpm, ice))]
    header = ("r (m)", "sigma_r Lamé", "mpm", "ice-mpm", "sigma_theta Lamé", "mpm", "ice-mpm")
    page.write("The row of points nearest the axis, in MPa.")
    page.table(header, [[f"{value:.4f}" if k == 0 else f"{value:.3f}" for k, value in enumerate(row)] for row in zip(*columns)])


def make(page):
    axis = "domain.cell=" + ",".join(f"{h:g}" for h in SPACINGS)
    deck, paper, strain = (page.cases("compare", folder, DECK, "--axis", axis, *(word for one in settings for word in ("--set", one)))
                           for folder, settings in (("deck", []), ("paper", PAPER), ("strain", LARGE_STRAIN)))
    bars(page, deck, paper, strain)
    page.write("A thick steel cylinder, r from 0.5 to 1 m in plane strain, is pressurised from inside to P = 19.4 MPa (gauge, from the",
               "deck) by heating its gas for 1.4 ms, and damped to rest (Guilkey, Harman, Xia, Kashiwa and McMurtry 2003, section 3). The",
               "same deck runs with the gas as material points (`mpm`) and with the gas on cells (`ice-mpm`). The reference is the",
               "solution of Lamé. Eq. 13 is the mean over all points of | |sigma_r + sigma_theta| - 2P/3 | / (2P/3); L1 is weighted by",
               "volume. No point is left out and no stress is smoothed. At rest means that the kinetic energy of the solid is at most",
               "1e-6 of its strain energy for 1.3 ms, longer than a breathing period (1.23 ms); times are those to that state, of the processor and of the wall, without outputs (the bars of",
               "wall time: with them); *: others used the machine meanwhile. Lamé is a solution for small",
               "strains: with a bore strain of 3.2e-4 some 0.03 to 0.05 % of eq. 13 is not an error of the run.", "", "## Bars")
    page.show_bars()
    page.write("## With floe's settings", "",
               "The deck as it is: quadratic B-splines; 2 x 2 points a cell, fitted to the surface; nodes that the ring fills in part held to the motion of those",
               "inside (`method.edge_penalty: 0.05`, [edges](edges.md)). The state of rest solved for, without steps: [statics](statics.md); load where the surface is:",
               "[interface](interface.md). Uintah, of July 2026, ran the same problem in its own",
               "ICE-MPM with GIMP and 2 x 2 points a cell on a lattice, on one core of a 2-vCPU x86-64 machine (gcc 12), in 1.4, 5.8, 37 and 289 s of wall time; its input files",
               "are not kept here. The",
               "paper gives a slope of 0.89 and its spacing of 0.025; the bars are those of this project.")
    table(page, deck, True)
    large_strain(page, strain)
    page.write("## With the paper's settings", "",
               "The linear basis and points on a lattice, for the solid and, in `mpm`, for the gas. The static limit of this",
               "discretisation, computed apart, has 24.7, 12.7 and 6.8 % at h = 0.1, 0.05 and 0.025: the linear basis is first order in",
               "stress whatever else is done.")
    table(page, paper, False)
    curves(page, deck, paper)
    along_the_axis(page)
