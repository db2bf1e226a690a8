"""E11: thick cylinders and a sphere in space of other numbers, against Lamé."""
import math

from rows import run

# Deck, coupling, wall (m), bars at twelve and twenty cells (per cent).
CASES = (("e11_cylinder", "mpm", 0.48, 2.0, 1.0), ("e11_cylinder", "ice-mpm", 0.48, 3.0, 1.5),
         ("e11_outside", "mpm", 0.46, 2.0, 1.0), ("e11_sphere", "mpm", 0.48, 2.0, 1.0))


def measure(page):
    page.write("", "## E11: thick cylinders and a sphere of other numbers")
    rows = []
    for deck, coupling, wall, twelve, twenty in CASES:
        for cells, bar in ((12, twelve), (20, twenty)):
            done = run(deck, "%s_%s_%d" % (deck, coupling, cells), coupling=coupling, settings=["domain.cell=%.17g" % (wall / cells)])
            errors = done.summary()["errors"] if done.status == 0 else {}
            radial, hoop = (100.0 * errors.get("l1rel_" + name, math.nan) for name in ("sigma_r", "sigma_theta"))
            rows.append((deck, coupling, cells, "%.2f" % radial, "%.2f" % hoop, "%.1f" % done.cpu))
            page.bar("E11: %s as %s, %d cells of wall, l1rel_sigma_r, %%" % (deck, coupling, cells), radial, None, bar)
    page.table(("deck", "coupling", "cells of wall", "l1rel_sigma_r, %", "l1rel_sigma_theta, %", "CPU, s"), rows)
