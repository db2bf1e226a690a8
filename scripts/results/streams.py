"""Solids in viscous streams: cylinder and flag of Turek and Hron, held and let go; heat between cylinders by natural convection."""
import math

import floe
import numpy

TITLE = "Solids in streams: Turek and Hron's flag, natural convection"
CHANNEL, FLAG, HEAT = "inputs/turek_hron_cfd.yaml", "inputs/turek_hron_fsi.yaml", "inputs/natural_convection.yaml"


def times(run):
    return f"{run.result.summary['steps']}; {floe.figure(run.cpu)}" + (" *" if run.disturbed else "")


def column(run, name):
    return numpy.array(run.result.history[name].values, dtype=float)


def off(value, published):
    return f"{100 * (value / published - 1):+.1f} %"


def held(page):
    """Flow at a Reynolds number of 20 and of 100; forces of the row before the last."""
    page.write("## Held: CFD1 and CFD2", "", f"`{CHANNEL}`: drag and lift of cylinder and flag, N a metre, off by so much of the tables (14.29 and 1.119; 136.7 and 10.53).", "")
    rows = []
    for name, settings, cells, drag, lift in (("CFD1", [], 10, 14.29, 1.119), ("CFD2", ["constants.mean=1", "time.end=4"], 10, 136.7, 10.53)):
        run = page.run(CHANNEL, name, None, settings, once=True)
        found = column(run, "force_body_x")[-2], column(run, "force_body_y")[-2]
        rows.append((name, cells, f"{found[0]:.4g} ({off(found[0], drag)})", f"{found[1]:.4g} ({off(found[1], lift)})", times(run)))
        page.bar(f"{name}, ten cells a diameter: drag off by", 100 * abs(found[0] / drag - 1), "<=", 2, "{:.2f}", " %")
        page.bar(f"{name}, ten cells a diameter: lift off by", 100 * abs(found[1] / lift - 1), "<=", 5, "{:.2f}", " %")
    page.table(("flow", "cells a diameter", "drag", "lift", "steps; CPU, s"), rows)


def swing(time, values):
    """Mean and amplitude over the last third, by the medians of the swings' maxima and minima, as a single row may stand out; and the frequency. Swings begin
    where the values cross their middle upwards."""
    late = time > 0.7 * time[-1]
    t, x = time[late], values[late]
    middle = 0.5 * (numpy.percentile(x, 95) + numpy.percentile(x, 5))
    at = [k for k in range(len(x) - 1) if x[k] < middle <= x[k + 1]]
    if len(at) < 3:
        return middle, 0.5 * (x.max() - x.min()), math.nan
    up = [t[k] + (middle - x[k]) / (x[k + 1] - x[k]) * (t[k + 1] - t[k]) for k in at]
    most, least = (float(numpy.median([one(x[a:b]) for a, b in zip(at, at[1:])])) for one in (numpy.max, numpy.min))
    return 0.5 * (most + least), 0.5 * (most - least), (len(up) - 1) / (up[-1] - up[0])


def let_go(page):
    page.write("## Let go: FSI1 to FSI3", "", f"`{FLAG}`, a flag two cells thick, 41 rows of cells: the middle of its tip, mm, and the forces on cylinder and flag, N a metre; in brackets the table.", "")
    rest = page.run(FLAG, "FSI1", None, [], once=True)
    at = {name: column(rest, name)[-2] for name in ("tip_displacement_x", "tip_displacement_y", "force_body_x", "force_body_y")}
    rows = [("FSI1", f"{1e3 * at['tip_displacement_x']:.4f} (0.0227)", f"{1e3 * at['tip_displacement_y']:.3f} (0.8209)", "at rest",
             f"{at['force_body_x']:.2f} (14.295)", f"{at['force_body_y']:.3f} (0.7638)", times(rest))]
    page.bar("FSI1: tip across the stream off by", 100 * abs(1e3 * at["tip_displacement_y"] / 0.8209 - 1), "<=", 5, "{:.1f}", " %")
    page.bar("FSI1: tip along the stream off by", 100 * abs(1e3 * at["tip_displacement_x"] / 0.0227 - 1), "<=", 5, "{:.1f}", " %")
    page.bar("FSI1: drag off by", 100 * abs(at["force_body_x"] / 14.295 - 1), "<=", 5, "{:.2f}", " %")
    page.bar("FSI1: lift off by", 100 * abs(at["force_body_y"] / 0.7638 - 1), "<=", 5, "{:.2f}", " %")
    for name, settings, along, across, hertz, drag, lift in (
            ("FSI2", ["constants.mean=1", "constants.density=1e4", "time.end=16"], (-14.58, 12.44), (1.23, 80.6), 2.0, (208.83, 73.75), (0.88, 234.2)),
            ("FSI3", ["constants.mean=2", "constants.shear=2e6", "time.end=5"], (-2.69, 2.53), (1.48, 34.38), 5.3, (457.3, 22.66), (2.22, 149.78))):
        run = page.run(FLAG, name, None, settings, once=True)
        t = column(run, "time")
        x, y, u, v = (swing(t, column(run, one)) for one in ("tip_displacement_x", "tip_displacement_y", "force_body_x", "force_body_y"))

        def text(found, table, scale=1.0):
            return f"{scale * found[0]:.3g} ± {scale * found[1]:.3g} ({table[0]:.3g} ± {table[1]:.3g})"

        rows.append((name, text(x, along, 1e3), text(y, across, 1e3), f"{y[2]:.2f} Hz ({hertz})", text(u, drag), text(v, lift), times(run)))
        page.bar(f"{name}: swing of the tip across off by", 100 * abs(1e3 * y[1] / across[1] - 1), "<=", 5, "{:.1f}", " %")
        page.bar(f"{name}: frequency off by", 100 * abs(y[2] / hertz - 1), "<=", 5, "{:.1f}", " %")
        page.bar(f"{name}: mean drag off by", 100 * abs(u[0] / drag[0] - 1), "<=", 5, "{:.1f}", " %")
    page.table(("", "along", "across", "", "drag", "lift", "steps; CPU, s"), rows)


def convection(page):
    """The heat that leaves the rod in the last tenth, over that of conduction alone in this half."""
    page.write("## Natural convection between cylinders", "", f"`{HEAT}`, Prandtl number 0.7: the heat that flows over that of conduction alone; Kuehn and Goldstein 1976.", "")
    rows = []
    for rayleigh, published in ((1e3, 1.081), (1e4, 2.010)):
        for cell, across in (("1.4 / 15", 9), ("1.4 / 29", 17)):
            run = page.run(HEAT, f"heat-{rayleigh:.0e}-{across}", None, [f"constants.rayleigh={rayleigh}", f"domain.cell={cell}"], once=True)
            t, heat = column(run, "time"), column(run, "internal_rod")
            k = int(numpy.searchsorted(t, 0.9 * t[-1]))
            conductivity = 3.5 * math.sqrt(0.001 * 0.1 * 0.8 ** 3 / rayleigh / 0.7)
            ratio = (heat[k] - heat[-1]) / (t[-1] - t[k]) / (math.pi * conductivity * 0.1 / math.log(2.6))
            rows.append((f"{rayleigh:.0e}", across, f"{ratio:.4f}", published, off(ratio, published), f"{run.result.summary['conservation']['energy']:.1e}", times(run)))
        page.bar(f"natural convection, Rayleigh number {rayleigh:.0e}, 17 cells across: heat off by", 100 * abs(ratio / published - 1), "<=", 1, "{:.2f}", " %")
    page.table(("Rayleigh number", "cells across the gap", "heat over conduction", "published", "off by", "drift of energy", "steps; CPU, s"), rows)


def make(page):
    held(page)
    let_go(page)
    convection(page)
