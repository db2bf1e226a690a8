"""Sod's shock tube by cells and by points."""
import math

import floe
import numpy
from floe import plots
from order_table import order_of
from profiles import profile

TITLE = "Sod's shock tube: cells, and points"
DECK = "inputs/sod.yaml"
FIELDS = ("density", "velocity_x", "pressure", "internal_energy")
AS_POINTS = ("--set", "coupling=mpm", "--set", "runs_as=[mpm]")
# The exact solution at t = 0.143: places of the fan's foot, the contact and the shock; densities on both sides of the contact.
FOOT, CONTACT, SHOCK, LEFT, RIGHT = 0.489951, 0.632626, 0.750558, 0.4263194, 0.2655737


def shock_error(run):
    """The place where the density last falls through the mean of the states beside the shock, less the exact shock's, over its travel."""
    gamma, p_right, rho_right, p_star, time = 1.4, 0.1, 0.125, 0.303130178, 0.143
    b = (gamma - 1) / (gamma + 1)
    middle = rho_right * ((p_star / p_right + b) / (b * p_star / p_right + 1) + 1) / 2
    travel = time * math.sqrt(gamma * p_right / rho_right) * math.sqrt((gamma + 1) / (2 * gamma) * p_star / p_right + (gamma - 1) / (2 * gamma))
    x, rho = run["x"], run["density"]
    last = max(k for k in range(len(x) - 1) if rho[k] >= middle > rho[k + 1])
    at = x[last] + (x[last + 1] - x[last]) * (rho[last] - middle) / (rho[last] - rho[last + 1])
    return abs(at - 0.5 - travel) / travel


def beyond(run, cells):
    """Density above and below what is there, in per cent of it: from the head of the fan to the shock, without eight cells on either side of the contact
    and three of the shock; above, ahead of the fan's foot, only what exceeds the gas at rest."""
    x, rho, h = run["x"], run["density"], 1 / cells
    there = numpy.where(x < FOOT, 1, numpy.where(x < CONTACT, LEFT, RIGHT))
    free = abs(x - CONTACT) >= 8 * h
    over = free & ((x < FOOT) | (x > CONTACT)) & (x < SHOCK + 4 * h)
    under = free & (x > FOOT) & (x < SHOCK - 3 * h)
    return 100 * max(0, (rho / there - 1)[over].max()), 100 * max(0, (1 - rho / there)[under].max())


def rows_of(cases, coupling, points, viscosity):
    for row in (row for row in cases.rows if row["coupling"] == coupling):
        mark = " *" if row["disturbed"] == "yes" else ""
        yield (coupling, round(1 / float(row["h"])), points, viscosity, *(f"{float(row['l1_' + name]):.5f}" for name in FIELDS),
               f"{float(row['drift_energy']):.1e}", floe.figure(float(row["cpu_seconds"]), 2) + mark, floe.figure(float(row["run_seconds"]), 2) + mark)


def york(page):
    """Every variant of York 1997, section 4.1: two decks, with and without artificial viscosity, density of points by each method; with the
    thesis's linear basis and with floe's."""
    rows = []
    for basis in ("linear", "quadratic"):
        for h, points in ((0.01, 9), (0.005, 3)):
            for name, linear, quadratic in (("0.2, 2", 0.2, 2), ("none", 0, 0)):
                cases = page.cases("compare", f"york-{basis}-{points}-{linear}", DECK, *AS_POINTS, "--set", f"method.basis={basis}", "--set", f"domain.cell={h}",
                                   "--set", f"bodies.left.points={points}", "--set", f"bodies.right.points={points}",
                                   "--set", f"materials.gas.artificial_viscosity.linear={linear}", "--set", f"materials.gas.artificial_viscosity.quadratic={quadratic}",
                                   "--set", "compare.axis={method.point_density: [cell, quadratic, continuity]}", "--repeat", 0)
                rows += [(basis, round(1 / h), points, name, row["method.point_density"], *(f"{float(row['l1_' + field]):.5f}" for field in FIELDS)) for row in cases.rows]
    page.write("## York 1997, section 4.1: every variant", "",
               "The thesis prints curves only, and says that density by cell is noisy, and that by quadratic interpolation and by continuity",
               "much alike (at most 0.005 apart).")
    page.table(("basis", "cells", "points a cell", "artificial viscosity", "density by", "L1 rho", "L1 u", "L1 p", "L1 e"), rows)


def make(page):
    both = page.cases("compare", "both", DECK)
    three = page.cases("compare", "three", DECK, *AS_POINTS, "--set", "bodies.left.points=3", "--set", "bodies.right.points=3")
    inviscid = page.cases("compare", "inviscid", DECK, *AS_POINTS, "--set", "materials.gas.artificial_viscosity.linear=0",
                          "--set", "materials.gas.artificial_viscosity.quadratic=0")
    middle, fine = (profile(page.runs / "both" / f"ice-{h}") for h in (0.005, 0.0025))
    over, under = beyond(middle, 200)
    page.bar("ice: L1 of density at 200 cells", float(both.numbers("l1_density", coupling="ice")[1]), "<=", 0.0026, "{:.5f}")
    page.bar("ice: density above what it should be, at 200 cells", over, "<=", 0.5, "{:.2f}", " %")
    page.bar("ice: density below what it should be, at 200 cells", under, "<=", 0.5, "{:.2f}", " %")
    page.bar("ice: order of density", order_of(both, "ice", "l1_density")[0], ">=", 0.8, "{:.2f}")
    page.bar("ice: shock at 400 cells off by (of its travel)", 100 * shock_error(fine), "<=", 0.3, "{:.3f}", " %")
    page.bar("ice: drift of total energy", float(both.numbers("drift_energy", coupling="ice").max()), "<=", 1e-12, "{:.1e}")
    page.write("A gas at rest, its pressure ten times and its density eight times higher on the left, to t = 0.143 (Sod 1978; York 1997,",
               "section 4.1). One deck runs with the gas on cells (`ice`) and as points (`mpm`), against the exact solution: averages over",
               "cells, values at points. Errors are absolute and weighted by volume. Times are those of the steps, of the processor and of the wall; *: others used the",
               "machine meanwhile.", "", "## Bars")
    page.show_bars()
    over, under = beyond(fine, 400)
    page.write("Beside them: a second-order Godunov code has 0.00454, 0.00254 and 0.00136 at 100, 200 and 400 cells.", "",
               "Above and below: from the head of the fan to the shock, without eight cells on either side of the contact and three of the shock. At 400 cells "
               f"{over:.4f} and {under:.4f} %.", "", "## Cells and points")
    page.table(("coupling", "cells", "points a cell", "artificial viscosity", "L1 rho", "L1 u", "L1 p", "L1 e", "energy drift", "CPU, s", "wall, s"),
               [*rows_of(both, "ice", "-", "-"), *rows_of(both, "mpm", 9, "0.2, 2"), *rows_of(three, "mpm", 3, "0.2, 2"), *rows_of(inviscid, "mpm", 9, "none")])
    for coupling in ("ice", "mpm"):
        orders = [(name, *order_of(both, coupling, "l1_" + name)) for name in FIELDS]
        page.write(f"* Orders, {coupling} (as in the deck): " + ", ".join(f"{name} {slope:.2f} ± {error:.2f}" for name, slope, error in orders) + ".")
    page.write("* Points conserve mass and momentum to round-off; their energy drifts as shown.")
    points = profile(page.runs / "both/mpm-0.005")
    dots = {"linestyle": "", "marker": ".", "markersize": 3}
    plots.lines(page.picture("density", "density at 200 cells"), {
        "mpm, 200 cells of 9 points, every third": (points["x"][::3], points["density"][::3], {**dots, "color": plots.COLOURS["mpm"]}),
        "ice, 200 cells": (middle["x"], middle["density"], {**dots, "color": plots.COLOURS["ice"]}),
        "exact (averages over cells)": (middle["x"], middle["exact_density"], plots.EXACT)}, "x", "density")
    york(page)
