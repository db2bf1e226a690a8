"""York's airbag hit by two cylinders: meshes, tethers, pressures, contact; gas as points and on cells."""
import re

import numpy
from curves import curves
from floe import figure

TITLE = "York's airbag hit by two cylinders"
MESHES = (0.02, 0.01, 0.006666666666666667)
ENDS = {200: 0.07, 500: 0.06}
SPRING = "springs.tether={from: {body: bag, point: 44}, to: {body: bag, point: 243}, stiffness: 71500, one_way: true}"
CONE = "bodies.tether={material: fabric, membrane: {curve: {segment: {from: [0.11, 0.0083], to: [0.11, 0.299]}}, thickness: 0.0005}, points: 8}"
CONTACT, AT_NODES = "contact={between: [bag, probe]}", "contact={between: [bag, probe], touch: nodes}"
# The bag at 105.3 kPa against air at 101.3.
AIR = ["reference_pressure=101300", "time.end=0.06", *(f"bodies.{body}.pressure=105300" for body in ("core", "waist", "inner", "outer", "shoulder", "rim"))]
AS_POINTS = (
    ("as printed", MESHES, []), ("105.3 kPa against 101.3", MESHES[:2], AIR), ("contact released at nodes", MESHES[:1], [AT_NODES]), ("contact released", MESHES[:2], [CONTACT]),
    ("tether, a spring", MESHES[:1], [SPRING]), ("tether, points", MESHES[:1], [CONE]), ("linear basis", MESHES[:1], ["method.basis=linear"]))
ON_CELLS = (
    ("as printed", MESHES, []), ("contact released", MESHES[:2], [CONTACT]), ("105.3 kPa against 101.3", MESHES[:2], AIR), ("105.3 kPa against 101.3, contact released", MESHES[:2], [*AIR, CONTACT]))
LOOK = ("--range", "0:2e6", "--range", "2000:8000", "--width", 420)
HEADER = ("probe", "h (mm)", "", "greatest depth (mm)", "at (ms)", "mean pressure then (kPa)", "velocity (m/s)", "energy: change that the budget misses", "mass: drift")


def column(run, name):
    return run.result.history[name].values


class Hit:
    """What a run says of the probe and of the bag."""

    def __init__(self, run):
        place, time = column(run, "centre_probe_z"), column(run, "time")
        deepest = len(place) - 1 - place[::-1].argmin()
        energy = sum(column(run, name) for name in ("kinetic", "strain", "internal"))
        missed = abs(energy - column(run, "ledger_energy_boundary") - energy[0]).max()
        self.run, self.depth, self.time = run, 1000 * (place[0] - place[deepest]), 1000 * time[deepest]
        self.pressure, self.velocity, self.end = column(run, "pressure_gas")[deepest] / 1000, column(run, "velocity_probe_z")[-1], 1000 * time[-1]
        self.missed, self.share, self.drift = float(missed), float(missed / energy[0]), column(run, "drift_mass").max()

    def beyond(self):
        """The largest share of the gas outside the bag."""
        return float((column(self.run, "outside_bag") / column(self.run, "mass_gas")).max())

    def row(self, probe, h, what):
        return (f"{probe} mm", f"{1000 * h:.2f}", what, f"**{self.depth:.1f}**", f"{self.time:.1f}", f"{self.pressure:.2f}", f"{self.velocity:.2f} at {self.end:.0f} ms",
                f"{self.missed:.2f} J, {figure(100 * self.share, 2)} %", f"{self.drift:.1e}")


def hits(page, probe, cases, coupling):
    """The runs of a probe: {(what, h): Hit}."""
    found = {}
    for what, meshes, settings in cases:
        for h in meshes:
            end = [] if settings is AIR or settings[:1] == AIR[:1] else [f"time.end={ENDS[probe]}"]
            folder = f"{probe}-{1000 * h:.3g}-{coupling}-" + re.sub("[^a-z0-9]+", "-", what)
            found[(what, h)] = Hit(page.run(f"inputs/airbag_{probe}.yaml", folder, coupling, [f"domain.cell={h}", *end, *settings], once=True))
    return found


def as_points(page):
    page.write("Gas points in a membrane of points about an axis, hit by an elastic cylinder (York 1997, section 6.3, boxes 10 and 11; York 2000, section 4.4; `inputs/airbag_200.yaml`,",
               "`inputs/airbag_500.yaml`, which say what the boxes leave open). The published curves survive only as figures; in words: the probe is stopped and thrown back; a tether of points lets it go",
               "20 mm farther; the probe pushes the bag before it without touching it.")
    found = {probe: hits(page, probe, AS_POINTS, "mpm") for probe in ENDS}
    page.table(HEADER, [hit.row(probe, h, what) for probe, own in found.items() for (what, h), hit in own.items()])
    for probe, own in found.items():
        page.bar(f"{probe} mm: energy that the budget misses, three meshes, as printed", 100 * max(own[("as printed", h)].share for h in MESHES), "<=", 1, "{:.2f}", " %")
    page.write("The depth is how far the probe has moved, and its rebound begins at the time of the greatest. The mean pressure is that of the gas points, weighted with their volumes.", "")
    notes(page, found)
    return found


def ratios(found, key, against, name="depth"):
    """The quotient of a figure of two runs, for each probe, in words."""
    return " and ".join(f"{getattr(own[key], name) / getattr(own[against], name):.2f}" for own in found.values())


def notes(page, found):
    coarse = MESHES[0]
    printed, air, linear = ("as printed", coarse), ("105.3 kPa against 101.3", coarse), ("linear basis", coarse)
    page.write("* **As printed** 4000 Pa stands against vacuum, so that the bag is soft. Against air at 101.3 kPa it is stiff, and the probe turns in",
               f"  {ratios(found, air, printed, 'time')} of the time (h = 20 mm; 200 and 500 mm).",
               "* **Meshes**: the probe pushes the bag from a distance of a cell or less, as the thesis says of its own runs; the depth grows by that as h falls.",
               f"* **Contact** released where points have met lets the bag lie on the probe: {ratios(found, ('contact released', coarse), printed)} of the depth at h = 20 mm,",
               f"  {ratios(found, ('contact released', MESHES[1]), ('as printed', MESHES[1]))} at 10 mm; at shared nodes, which is York's rule, {ratios(found, ('contact released at nodes', coarse), printed)} at 20 mm.",
               f"* **Tethers**: {ratios(found, ('tether, points', coarse), printed)} of the depth with one of points, {ratios(found, ('tether, a spring', coarse), printed)} with a spring. The 20 mm more that the papers had with a",
               "  tether of points, and blame on the gas that the cone holds up, are not seen: the bag starts in the shape that a tether has given it, and is pushed in.",
               f"* **Linear basis**, the papers' own: the budget misses {ratios(found, linear, printed, 'missed')} times what it does with quadratic splines: volumes of gas points drift from the space that they fill.", "")


def on_cells(page, points):
    page.write("## Gas on cells", "", "The same decks as `ice-mpm`: the gas is on the cells, the bag holds it ([embedded](embedded.md)), outside is a vacuum, or the reference pressure where that is set; the probe stands there, which",
               "cells do not see, and meets the bag at shared nodes or in a contact as above.")
    found = {probe: hits(page, probe, ON_CELLS, "ice-mpm") for probe in ENDS}
    page.table((*HEADER, "beyond the bag, share"), [(*hit.row(probe, h, what), f"{hit.beyond():.1e}") for probe, own in found.items() for (what, h), hit in own.items()])
    for probe, own in found.items():
        page.bar(f"{probe} mm, gas on cells: energy that the budget misses, all rows", 100 * max(hit.share for hit in own.values()), "<=", 0.1, "{:.2g}", " %")
        page.bar(f"{probe} mm, gas on cells: share of the gas beyond the bag, all rows", max(hit.beyond() for hit in own.values()), "<=", 1e-4, "{:.1e}")
    page.write("Depth, and mean pressure then, with gas on cells over those with gas as points:")
    page.table(("probe", "h (mm)", "", "depth", "pressure", "energy that the budget misses"), [
        (f"{probe} mm", f"{1000 * h:.2f}", what, *(f"{getattr(hit, name) / getattr(points[probe][(what, h)], name):.3f}" for name in ("depth", "pressure", "missed")))
        for probe, own in found.items() for (what, h), hit in own.items() if (what, h) in points[probe]])
    page.write("Without a contact bag and probe share nodes, and a bag in tension holds on to the probe that leaves it.", "", f"Shapes at 40 ms, as printed, h = {1000 * MESHES[-1]:.2f} mm; probes of 200 and 500 mm.")
    for probe, own in found.items():
        page.drawn(own[("as printed", MESHES[-1])].run, f"airbag-cells-{probe}-40", f"{probe} mm", "--time", "0.04", *LOOK)
    return found


def start_shape(page):
    page.write("## Start shape", "", "The bag without a probe, damped by 300 1/s for 60 ms, h = 20 mm. The box's outline is that of a bag at rest with a tether: a cap that bulges to 318 mm at the axis inside a ring at 299 mm.")
    rows, drawn = [("box 10, start", 318, "4.00")], None
    for what, settings in (("tether, points", [CONE]), ("tether, a spring", [SPRING]), ("none", [])):
        run = page.run("inputs/airbag_200.yaml", "rest-" + re.sub("[^a-z]+", "-", what), None, ["bodies.probe=null", "damping.rate=300", "time.end=0.06", *settings], once=True)
        drawn = drawn or run
        rows.append((what, f"{1000 * column(run, 'last_bag_z')[-1]:.0f}", f"{column(run, 'pressure_gas')[-1] / 1000:.2f}"))
    page.table(("", "height at the axis (mm)", "mean pressure (kPa)"), rows)
    page.drawn(drawn, "airbag-rest", "at rest with a tether of points", "--cells", "none", "--width", 420)


def displacement(page, probe, points, cells):
    number = {200: 60, 500: 63}[probe]
    page.write(f"## Displacement, {probe} mm (York 1997, figure {number})")

    def curve(hit, **style):
        place = column(hit.run, "centre_probe_z")
        return 1000 * column(hit.run, "time"), 1000 * (place[0] - place), style

    colours, middle = ("#606060", "#1060b0", "#c03020"), MESHES[1]
    series = {f"as printed, h = {1000 * h:.1f} mm": curve(points[("as printed", h)], color=colour) for h, colour in zip(MESHES, colours)}
    series["105.3 kPa against air, h = 10 mm"] = curve(points[("105.3 kPa against 101.3", middle)], color=colours[1], linestyle="--")
    series["contact released, h = 10 mm"] = curve(points[("contact released", middle)], color=colours[0], linestyle="--")
    series["as printed, gas on cells, h = 10 mm"] = curve(cells[("as printed", middle)], color=colours[2], linestyle=":")
    curves(page.picture(str(probe), "displacement"), series, "t (ms)", "displacement of the probe (mm)")


def shapes(page, probe, points):
    finest = points[("as printed", MESHES[-1])].run
    page.write(f"## Shapes, {probe} mm, h = {1000 * MESHES[-1]:.2f} mm (York 1997, figure {probe // 100 + 57})", "", "At 0, 20, 40 and 60 ms.")
    for time in (0, 20, 40, 60):
        page.drawn(finest, f"airbag-{probe}-{time}", f"{time} ms", "--time", f"{time / 1000:g}", *LOOK)


def budget(page, probe, hit, said):
    page.write(f"## Energy, {probe} mm{said}, J")
    names, run = ("kinetic_probe", "kinetic_gas", "kinetic_fabric", "strain_fabric", "strain_probe", "internal_gas"), hit.run
    time, rows = column(run, "time"), []
    for at in numpy.arange(0, time[-1] + 1e-6, 0.01):
        k = (time >= at - 1e-9).argmax()
        values = [column(run, name)[k] for name in names]
        rows.append((f"{1000 * time[k]:.0f}", *(f"{value:.2f}" for value in values), f"{sum(values):.2f}", f"{column(run, 'pressure_gas')[k] / 1000:.2f}"))
    page.table(("t (ms)", "probe, kinetic", "gas, kinetic", "bag, kinetic", "bag, strain", "probe, strain", "gas, internal", "sum", "mean pressure (kPa)"), rows)


def make(page):
    points = as_points(page)
    cells = on_cells(page, points)
    page.write("## Bars")
    page.show_bars()
    start_shape(page)
    for probe in ENDS:
        displacement(page, probe, points[probe], cells[probe])
        shapes(page, probe, points[probe])
        budget(page, probe, points[probe][("as printed", MESHES[-1])], "")
        budget(page, probe, cells[probe][("as printed", MESHES[-1])], ", gas on cells")
