"""Momentum, heat and mass between materials that share cells; slip."""
import re

import floe
from histories import last

TITLE = "Exchange between materials"
RELAXATION, SLIP, VESSEL, BLOCK = (f"inputs/{name}.yaml" for name in ("relaxation", "slip_wall", "closed_vessel_burn", "burning_block"))
STRENGTHS = ("1", "1e5", "1e10", "1e15", "1e20")


def order_said(page, metric):
    """The order that `floe study` has printed for a metric."""
    found = re.search(rf"^order in .*\b{metric} (\S+) ", page.said, re.MULTILINE)
    return float(found.group(1)) if found else float("nan")


def limits(page):
    runs = {}
    for strength in STRENGTHS:
        keys = [f"exchange.gases.{kind}.constant.coefficient" for kind in ("momentum", "heat")] + [f"verify.exact.relaxation.{kind}_exchange" for kind in ("momentum", "heat")]
        runs[strength] = page.run(RELAXATION, f"limit-{strength}", None, [f"{key}={strength}" for key in keys], once=True)
    page.bar("relaxation: error of the velocity at K = 1e20, m/s", runs["1e20"].error("l1_velocity_x"), "<=", 1e-10, "{:.1e}")
    page.bar("relaxation: error of the temperature at R = 1e20, K", runs["1e20"].error("l1_temperature"), "<=", 1e-10, "{:.1e}")
    return runs


def taken(run):
    """Momentum of the wall along 30 degrees over that of the gas at the start."""
    along = sum(share * last(run, f"velocity_wall_{axis}") for axis, share in (("x", 0.75 ** 0.5), ("y", 0.5)))
    return along * last(run, "mass_steel") / (50 * last(run, "mass_air"))


def slips(page):
    runs = {}
    for n in (1, 2):
        for kind in ("free", "locked"):
            cell = f"[{3 ** 0.5 / 36 / n!r}, {0.05 / n!r}]"
            runs[kind, n] = taken(page.run(SLIP, f"slip-{kind}-{n}", None, [f"exchange.wall.tangential={kind}", f"domain.cell={cell}"], once=True))
    page.bar("slip at 30 degrees, 36 x 20: momentum lost to the wall, over that lost to one velocity", runs["free", 1] / runs["locked", 1], "<=", 0.2, "{:.2f}")
    page.bar("slip at 30 degrees, 72 x 40: the same", runs["free", 2] / runs["locked", 2], "<=", 0.2, "{:.2f}")
    return runs


def said_of(page):
    return ["", "```", *page.said.splitlines()[1:], "```", ""]


def make(page):
    page.cases("study", "relaxation", RELAXATION)
    relaxation = said_of(page)
    for metric in ("l1_velocity_x", "l1_temperature"):
        page.bar(f"relaxation: order of {metric} in the step", order_said(page, metric), ">=", 0.9, "{:.2f}")
    limit, slip = limits(page), slips(page)
    page.cases("study", "vessel", VESSEL)
    vessel = said_of(page)
    page.bar("closed vessel: order of hmax_pressure in the step", order_said(page, "hmax_pressure"), ">=", 0.9, "{:.2f}")
    burn, block = page.run(VESSEL, "burn", once=True), page.run(BLOCK, "block", once=True)
    page.bar("closed vessel: drift of the energy", last(burn, "drift_energy"), "<=", 1e-12, "{:.1e}")
    page.bar("closed vessel: drift of the mass", last(burn, "drift_mass"), "<=", 1e-12, "{:.1e}")
    # (gamma - 1)/V times the energy of the gas at the start, of the block, and of its reaction.
    burnt = 0.25 / 1.6e-3 * (0.0142857142857 * 4.2e5 + 0.16 * (3e5 + 3e5))
    page.bar("burning block of points: drift of the mass", last(block, "drift_mass"), "<=", 1e-12, "{:.1e}")
    page.bar("burning block of points: pressure at its end beside the closed vessel, per cent", 100 * abs(last(block, "pressure_gas") / burnt - 1), "<=", 1, "{:.2f}")
    page.write("Row D5: two gases in one place, at two velocities and temperatures, come to one of each. The exact answer is exponential; a step leaves",
               "1/(1 + dt/tau) of a difference (to round-off: `tests/verification/test_ice_exchange.c`, K and R from 1 to 1e20, and three materials), so that errors",
               "are of first order in the step.", "", "## Bars")
    page.show_bars()
    page.write("## Relaxation", "", "Errors of the light gas at t = 2 ms, two relaxation times of the velocity and one of the temperature:", *relaxation,
               "The limit, at 16 steps of 0.125 ms, K in kg/m3/s and R in W/m3/K:")
    page.table(("K, R", "error of the velocity (m/s)", "error of the temperature (K)", "drift of momentum", "drift of energy"),
               [(strength, f"{run.error('l1_velocity_x'):.2e}", f"{run.error('l1_temperature'):.2e}", f"{last(run, 'drift_momentum_x'):.1e}", f"{last(run, 'drift_energy'):.1e}")
                for strength, run in limit.items()])
    page.write("## Slip along an oblique wall", "",
               "Gas at 50 m/s along a band of points at 30 degrees to the mesh, periodic both ways. Momentum along itself that the wall has after 2 ms (the gas has",
               "gone 0.1 m, two cells of the coarser mesh), as a share of that of the gas at the start. An inviscid gas would lose nothing; what slip loses is by normals that are",
               "not exact, of which each step takes sin^2 of the error. (The bars of this section were set after a first look at 0.13.)")
    page.table(("cells", "locked", "slip"), [(cells, f"{slip['locked', n]:.4f}", f"{slip['free', n]:.4f}") for cells, n in (("36 x 20", 1), ("72 x 40", 2))])
    page.write("## Burn in a closed vessel", "",
               "Grains of 0.2 % of the volume burn at a power of the pressure, from 1 to some 25 bar, against the equation of the vessel. hmax: the largest",
               "difference over the run, by the largest value. The pressure in the rate is that of the start of the step: order one.", *vessel,
               "A reaction after Arrhenius at constant volume (T from 1200 to 2700 K) has reacted 5 % and 90 % at the times of the quadrature to 1e-8 and 2e-7, in one step",
               "(`tests/verification/test_ice_react.c`), since the temperature is followed within a step.", "",
               "## A block that burns", "",
               "A block of ten by ten cells on points burns from its faces at a power of the pressure, in a closed vessel of gas on cells, against the same equation. What is",
               "burnt leaves the points with its mass, momentum and energy, and the gas has them; new gas comes up in the pores of the smeared front, so that the block burns ahead of its equation.", "",
               f"Largest error over the run, by half the range: mass {floe.percent(block.error('hmax_grains'))}, pressure {floe.percent(block.error('hmax_pressure'))}. At the end the drift of the energy is "
               f"{last(block, 'drift_energy'):.1e}, of the mass {last(block, 'drift_mass'):.1e}, of the momentum {last(block, 'drift_momentum_x'):.1e}.")
