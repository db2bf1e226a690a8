"""Normals to unconnected points: static tables beside the papers', and membranes run with them."""
import csv
import io
import math

import numpy
from curves import curves
from pages import FLOE, RESULTS, ROOT, measured

TITLE = "Normals to unconnected points"
CIRCLE, BONE = "inputs/membrane_circle.yaml", "inputs/membrane_dogbone.yaml"
NORMALS = "bodies.skin.membrane.normals="
# As the papers have it: strain by its rate, and nothing of what is lost becomes heat.
BY_RATE = ["bodies.skin.membrane.smoothing=0", "bodies.skin.membrane.strain=rate", "method.flip=1", "method.losses=drift"]
LINES = {  # published: least, most, median of the condition by points and slope (Sulsky and York 2000, tables I and II)
    "3,0.1": "3.7e+03, 1.3e+08, 5.0e+03", "3,0.5": "7.8e+01, 4.6e+07, 1.7e+02", "3,1": "3.5e+01, 4.8e+05, 5.9e+01", "3,2": "2.3e+02, 7.3e+16, 3.6e+02",
    "3,10": "3.7e+03, 1.1e+06, 5.4e+03", "3,-10": "3.6e+03, 5.1e+06, 5.3e+03", "3,-2": "2.3e+02, 1.4e+07, 3.3e+02", "3,-1": "3.5e+01, 3.6e+07, 6.1e+01",
    "3,-0.5": "3.5e+01, 3.6e+07, 1.2e+02", "3,-0.1": "3.7e+03, 2.5e+06, 6.0e+03", "4,1": "3.2e+01, 3.2e+05, 7.9e+01", "8,1": "3.6e+01, 1.7e+09, 6.5e+01",
    "4,2": "1.3e+02, 2.9e+06, 1.9e+02", "8,2": "1.7e+02, 9.9e+05, 3.4e+02", "4,10": "4.1e+03, 5.4e+04, 5.8e+03", "8,10": "5.7e+03, 2.2e+05, 7.7e+03"}
CIRCLES = {"3": ("0.1211", "0.0571"), "4": ("0.1091", "0.0434"), "8": ("0.1177", "0.0231"), "16": ("0.1261", "0.0141"), "32": ("0.1308", "0.0092")}  # table III: worst, norm / N


def printed(page, name, bench="normals"):
    """The rows of a table of bench_surface_normals, or of another; the first is the header."""
    program = f"bench_surface_{bench}"
    source = f"bench/surface_{bench}.c"
    page.commands.append([f"build/release/bench/{program}", name])
    if source not in page.also:
        page.also.append(source)
    done, _ = measured([str(FLOE.parent / "bench" / program), name], cwd=ROOT)
    if done.returncode != 0:
        raise RuntimeError(f"{program} {name}: exit status {done.returncode}: {done.stdout[-2000:]}")
    return list(csv.reader(io.StringIO(done.stdout)))


def keep(rows, name):
    with open(RESULTS / f"normals-{name}.csv", "w", newline="", encoding="utf-8") as file:
        csv.writer(file, lineterminator="\n").writerows(rows)


def splines(word):
    return {"1": "linear", "2": "quadratic"}.get(word, "-")


def lines(page):
    rows = printed(page, "lines")[1:]
    found = {",".join(row[:2]): row for row in rows}
    page.write("## Lines (Sulsky and York 2000, tables I and II)", "", "Points evenly along a line through a cell, linear splines, a hundred points off the surface: the condition of the normal equations' matrix,",
               "and the worst angle. The paper does not print its points, and its row for -0.5 repeats figures of that for -1.")
    page.table(("points", "slope", "least", "most", "median", "published: least, most, median", "worst angle"),
               [(*found[key][:5], published, found[key][5]) for key, published in LINES.items()])
    page.bar("lines of any slope: worst angle over all points off the surface", max(float(row[5]) for row in rows), "<=", 1e-9, "{:.1e}", " degrees")


def published_of(table, row):
    """What the paper has of a row of arcs, space or thesis."""
    if table == "arcs":
        if row[2] == "1":
            return "6" if row[0] == "a" else "34"
        return "3 (normal equations)" if row[0] == "a" else ("under 1" if row[3] == "QR" else "19") if row[0] == "b" else "0"
    if table == "space":
        return "13, norm / N 3" if row[0] == "sphere" and row[2] == "1" else "0"
    return {"45 degrees": "0", "80 degrees": "0.01 mean", "circle 0.4": "several"}.get(row[0], "0 (5 digits)" if row[0].startswith("xy") else "figure")


def elements(page):
    found = {row[0]: row for row in printed(page, "circle")[1:]}
    page.write("## A circle by linear splines (Sulsky and York 2000, table III)", "", "Radius 0.8 about the corner of a cell of 1, in radians. The column that the paper heads \"rms\" is the norm over the number of points;",
               "the true root mean square stands beside it. Points evenly in angle from 0.1 to pi/2 - 0.1, the point off the circle at (0.18, 0.93): what the paper does not print.")
    page.table(("points", "worst", "published", "norm / N", "published", "root mean square"),
               [(n, found[n][1], worst, found[n][3], norm, found[n][2]) for n, (worst, norm) in CIRCLES.items()])
    page.bar("circle by linear splines: worst angle off table III by at most", max(abs(float(found[n][1]) - float(worst)) for n, (worst, _) in CIRCLES.items()), "<=", 1e-4, "{:.1e}", " rad")
    page.write("## Arcs, cubics, planes and spheres (Sulsky and York 2000, figures 4 to 11; York 1997, figures 76 to 85)", "",
               "Largest angle over the points, in degrees, for a hundred points off the surface: least, median and most; and with the one that floe takes of eight, by the evenness of the gradient, with its",
               "root mean square. Where quadratic splines are short of equations (sets a and b), their answer hangs on that point, and that of the singular normal equations on round-off besides. Places of",
               "points are ours: the papers show them in figures.")
    page.table(("set", "points", "splines", "solver", "least", "median", "most", "floe", "rms", "published"),
               [(row[0], row[1], splines(row[2]), *row[3:9], published_of(name, row)) for name in ("arcs", "space", "thesis") for row in printed(page, name)[1:]])
    page.write("One point on one axis (Sulsky and York 2000, figures 1 and 8): with the point off it the gradient has a sign and the normal length one. Of the solutions of least norm without it only that",
               "in the middle of the cell has no gradient; elsewhere its sign says on which side of the middle the point is.")
    page.table(("place", "splines", "with", "without"), [(row[0], splines(row[1]), *row[2:4]) for row in printed(page, "line")[1:]])
    page.write("## Degenerate sets (York 1997, figures 80 to 84; Sulsky and York 2000, section 4)", "", "Worst angle in degrees of five points (unless said otherwise) in a cell. *Alone*: linear splines on the one element by",
               "normal equations, as published. \"None\": no direction follows from one point, and a membrane keeps the normal that it had (`normals_kept`).")
    page.table(("set", "alone", "isosurface_linear", "isosurface", "isosurface_quadratic", "quadric"), [row[:6] for row in printed(page, "degenerate")[1:]])


def angles(page, rows, first):
    page.table(("c", first, "connectivity", "isosurface", "isosurface_quadratic", "quadric"), [(*row[:2], *(f"{row[k]}, {row[k + 1]}" for k in (2, 4, 6, 8))) for row in rows])


def cubic(page):
    readings = printed(page, "readings", "cubic")[1:]
    page.write("## A cubic (Sulsky and York 2000, figure 10)", "", "y = c x^2 (x - 1) + x + 0.5, quadratic splines; the paper has 1 degree at worst with c = 2, 32 degrees with c = 4, where its \"rms\" is 5: as in table III the norm over",
               "the number of points, for 5 as a root mean square beside 32 would take forty points and more. It prints neither how many points there are nor where. With eight points, which just determine the",
               "function, evenly along the curve from x = 0.05 to y = 0.85, all three figures come out, wherever the point off the curve is. Starts from 0 to 0.2, ends from 0.8 to 1, 7 to 20 points and both",
               "spacings were tried: what counts is the first point, about 0.05 from the side, at which the worst angle is. Each of the other rows differs in what it names; quartiles of the worst angle over a",
               "hundred points off the curve, and the norm over N of the median.")
    rows = [(row[0], splines(row[1]), *row[2:5], ", ".join(row[5:8]), row[8], row[9], ", ".join(row[10:13]), row[13]) for row in readings]
    page.table(("reading", "splines", "solver", "evenly in", "points", "c = 2: quartiles", "norm / N", "points", "c = 4: quartiles", "norm / N"),
               [*rows, ("*published*", "quadratic", "normal equations", "", "", "1", "", "", "32", "5")])
    nearest = next(row for row in readings if row[0] == "nearest")
    page.bar("cubic (S00 figure 10): worst angles off 1 and 32 degrees by at most", max(abs(float(nearest[6]) - 1), abs(float(nearest[11]) - 32)), "<=", 0.5, "{:.2g}", " degrees")
    page.write("What more points on the one cell bring: the polynomial through the nearest points gains two digits where the points are doubled twice; splines on a cell that is larger than the radius of",
               "curvature stay where they are. Worst angle and root mean square.")
    points = printed(page, "points_cubic", "cubic")[1:]
    angles(page, points, "points")
    page.write("What smaller cells bring, with eight points to a cell of 1, sixteen to two of a half, and so on:")
    angles(page, printed(page, "cells", "cubic")[1:], "h")
    error = {(row[0], row[1]): float(row[8]) for row in points}
    page.bar("cubic, c = 2 and 4: order of the worst angle of quadric from 12 points to 192",
             min(math.log(error[(c, "12")] / error[(c, "192")]) / math.log(16) for c, n in error if n == "12"), ">=", 3, "{:.2g}")


def cylinder(page):
    page.write("## A cylinder of radius 1 (York 1997, figures 67 to 72)", "", "Cells of 0.1, 720 points around; angles in degrees, worst and root mean square, with nothing inside and with 4 and 16 points of a fluid a cell. As in the thesis:",
               "without points inside only the mass-matrix methods (`isosurface*`) are of use; with them the colours come within a few degrees.")
    page.table(("method", "vacuum", "4 points a cell", "16 points a cell"), [(row[0], *(f"{row[k]}, {row[k + 1]}" for k in (1, 3, 5))) for row in printed(page, "cylinder")[1:]])


def contour(page):
    rows = printed(page, "dogbone")
    keep(rows, "dogbone")
    page.write("## The contour of the dog-bone", "", f"Lines and exact arcs of `{BONE}`, and the circle that it becomes, at the four meshes and numbers of points of York 1997, table 5: worst and root mean square angle in",
               "degrees; last with points of that circle moved across it by up to a twentieth of their spacing.")
    page.table(("h", "points", "method", "contour", "circle", "noisy circle"), [(*row[:3], *(f"{row[k]}, {row[k + 1]}" for k in (3, 5, 7))) for row in rows[1:]])
    own = {(row[0], row[2]): [float(word) for word in row[3:7]] for row in rows[1:] if row[2] in ("connectivity", "quadric")}
    meshes = {h for h, _ in own}
    page.bar("dog-bone contour, four meshes: error of quadric over that of connectivity, worst and rms",
             max(own[(h, "quadric")][k] / own[(h, "connectivity")][k] for h in meshes for k in (0, 1)), "<=", 1)
    page.bar("dog-bone circle, four meshes: worst angle of quadric", max(own[(h, "quadric")][2] for h in meshes), "<=", 1e-9, "{:.1e}", " degrees")


def sweeps(page):
    page.write("## Points a cell, noise, curvature", "", "A circle of radius 1, mean over eight places of the mesh. By points a cell: h = 0.2, positions off by up to 0.01 of the spacing. By noise: 7 points a cell. By h over radius: 7 points",
               "a cell, 0.001 of the spacing. What goes by the spacing of the points (`connectivity`, `quadric`) does not see h; what goes by cells does; `spread` smooths noise. The colours have 16 points a cell",
               "inside.")
    for name, label in (("points", "points a cell"), ("noise", "noise over spacing"), ("curvature", "h over radius")):
        head, *rows = printed(page, name)
        keep([head, *rows], name)
        numbers = numpy.array([[float(word or "nan") for word in row] for row in rows])
        curves(page.picture(name, label), {title: (numbers[:, 0], numbers[:, k + 1], {"marker": "o", "markersize": 3}) for k, title in enumerate(head[1:])}, label, "angle, root mean square (degrees)", log=True)


def cost(page):
    page.write("## Cost", "", "Microseconds of one core a point, binning and all, of 4000 points on a circle and on a sphere. In a run it is the stage `mpm_membrane_normals` of `seconds_by_stage`; scenes without such membranes",
               "do not have it, and `connectivity` as a membrane runs it costs nothing beside it.")
    page.table(("method", "2-D: 4 points a cell", "8", "16", "3-D: 4 a cell", "8", "16"), [row[:7] for row in printed(page, "cost")[1:]])


def column(run, name):
    return run.result.history[name].values


def mean_after(run, name, time):
    return float(column(run, name)[column(run, "time") >= time].mean())


def pressures(page, name, runs):
    styles = ({"color": "#606060", "linewidth": 2.5}, {"color": "#c03020"}, {"color": "#1060b0", "linestyle": "--"})
    curves(page.picture(name, "pressure"), {method: (column(run, "time"), column(run, "pressure_gas"), style) for (method, run), style in zip(runs.items(), styles)}, "t", "pressure")


def circle(page):
    page.write("## Slack circular membrane (Sulsky and York 2000, figures 12 and 13)", "", f"`{CIRCLE}`: the rest pressure with its damping; the plot without damping, as published (in figures only). Strain by its rate, as in the papers.")
    rows, free, rest = [], {}, {}
    for method in ("connectivity", "isosurface", "quadric"):
        free[method] = page.run(CIRCLE, f"circle-free-{method}", None, [NORMALS + method, *BY_RATE, "damping=null", "time.end=0.05"], once=True)
        run = page.run(CIRCLE, f"circle-{method}", None, [NORMALS + method, *BY_RATE], once=True)
        rest[method] = mean_after(run, "pressure_gas", 0.059)
        off, summary = rest[method] / rest["connectivity"] - 1, run.result.summary
        spent = summary["seconds_by_stage"].get("mpm_membrane_normals", math.nan) * 1e6 / summary["steps"] / 91
        rows.append((method, f"{rest[method]:.4f}", f"{100 * off:.5f} %", ", ".join(f"{run.error(name):.2g}" for name in ("linf_normal", "l2_normal")), "" if method == "connectivity" else f"{spent:.2g}"))
        if method != "connectivity":
            page.bar(f"circular membrane: rest pressure, {method} against connectivity", 100 * abs(off), "<=", 0.5, "{:.2g}", " %")
    page.table(("normals", "rest pressure", "off connectivity", "normals off the radius: worst, root mean square (degrees)", "microseconds a membrane point and step"), rows)
    pressures(page, "circle", free)


def expansion(page):
    page.write("## Expanding cylinder (York 1997, figures 73 to 75)", "", "Radius 1 in a box of 1.5 with cells of 0.1, 180 points on the membrane and 16 a cell in the gas. The thesis prints neither deck nor pressure; here the membrane and the gas are those of",
               "the circle above, at 1000. Change of the radius, mean of 0 and 90 degrees. In the thesis the membrane bursts with the colours, and holds with the mass-matrix methods.")
    wide = [*BY_RATE, "domain.upper=[1.5, 1.5]", "bodies.gas.shape.ball.radius=1", "bodies.skin.membrane.curve.arc.radius=1", "bodies.skin.membrane.number=180", "boundaries.x.upper=no_slip",
            "boundaries.y.upper=no_slip", "damping=null", "time.end=0.05"]
    rows, series = [], {}
    for method in ("connectivity", "colour", "colour_quadratic", "colour_cubic", "isosurface_linear", "isosurface", "quadric"):
        run = page.run(CIRCLE, f"expansion-{method}", None, [NORMALS + method, *wide], once=True)
        if run.status != 0:
            rows.append((method, f"status {run.status}", ""))
            continue
        change = (column(run, "first_skin_x") + column(run, "last_skin_y")) / 2 - 1
        rows.append((method, f"{change.max():.4f}", f"{change[-1]:.4f}"))
        series[method] = (column(run, "time"), change, {})
    page.table(("normals", "largest change to t = 0.05", "at t = 0.05"), rows)
    curves(page.picture("expansion", "change of the radius"), series, "t", "change of radius")


def bone(page):
    box = ["domain.upper=[2, 2]", "domain.cell=0.2", "bodies.skin.membrane.number=100"]
    page.write("## Dog-bone on a mesh of 10 by 10 (Sulsky and York 2000, figures 14 and 15)", "", f"`{BONE}` with cells of 0.2 in a box of 2, 100 points on the membrane, viscosity 0.2, strain by its rate and MUSL, to t = 4. The gas does not come to rest by then: pressure is the mean",
               "from t = 1 on, with the standard deviation of its swings, which bounds how much a difference says.")
    rows, runs = [], {}
    for method in ("connectivity", "isosurface", "quadric", "{quadric: {spread: 2}}"):
        run = runs[method] = page.run(BONE, "bone-" + "".join(filter(str.isalnum, method)), None, [
            NORMALS + method, *BY_RATE, *box, "method.stress=musl", "materials.gas.viscosity.shear=0.2", "time.end=4", "output.interval=4"], once=True)
        off = mean_after(run, "pressure_gas", 1) / mean_after(runs["connectivity"], "pressure_gas", 1) - 1
        energy = sum(column(run, name) for name in ("kinetic", "strain", "internal"))
        swing = column(run, "pressure_gas")[column(run, "time") >= 1].std()
        rows.append((f"`{method}`", f"{mean_after(run, 'pressure_gas', 1):.3f} +- {swing:.2f}", f"{100 * off:.2f} %", f"{100 * (1 - energy[-1] / energy[0]):.2f} %"))
        if method == "quadric":
            page.bar("dog-bone, 10 x 10: mean pressure, quadric against connectivity", 100 * abs(off), "<=", 0.5, "{:.2g}", " %")
    page.table(("normals", "pressure", "off connectivity", "energy lost"), rows)
    pressures(page, "bone", runs)
    page.write("As the deck is (strain from positions, damping from t = 3), at rest; means from t = 3.6 on. Which points are neighbours follows from `normals`: without connections they are found anew in every",
               "step from where the points lie.")
    rows, rest = [], {}
    for method in ("connectivity", "quadric", "isosurface"):
        run = page.run(BONE, f"rest-{method}", None, [NORMALS + method, *box], once=True)
        rest[method] = mean_after(run, "pressure_in_skin", 3.6)
        rows.append((f"`{method}`", f"{rest[method]:.4f}", f"{100 * (rest[method] / rest['connectivity'] - 1):.4f} %", f"{mean_after(run, 'first_skin_x', 3.6):.4f}"))
    page.table(("normals", "pressure", "off connectivity", "radius"), rows)


def make(page):
    page.write("What `membrane.normals` can be (`floe list normals`), against the figures of Sulsky and York 2000 and of chapter 7 of York 1997. Static tables are printed by `build/release/bench/bench_surface_normals",
               "NAME`; angles are in degrees unless said otherwise. Normals of contacts, of two bars and of ball and net, are on the page of [contacts](contact.md).", "")
    top, page.lines = page.lines, []
    for part in (lines, elements, cubic, cylinder, contour, sweeps, cost, circle, expansion, bone):
        part(page)
    body, page.lines = page.lines, top
    page.write("## Bars")
    page.show_bars()
    page.lines += body
