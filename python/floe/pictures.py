"""Pictures of snapshots: points in colour over cells in colour, with axes and colour bars; curves over x in one dimension, a
plane in three.

    floe.pictures.write_png("out/cylinder-ice-mpm/fields/000004.h5", "stress.png")
    figure = floe.pictures.figure(result.at(1e-3), Options(points="sigma_theta", plane=("z", 0.5), mirror="x"))

Text is large, for phones: sizes are in units of a 720th of the width.
"""
import dataclasses
import io
import math
import os
from collections.abc import Iterable

import numpy
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator

from . import colours, fields, files, planes, space, units
from . import raster as pixels
from .files import Refused
from .results import Result, Snapshot
from .snapshots import SealedSnapshot, snapshot_files, table

WIDTH, MOST_WIDTH = 720, 8000
_TITLE, _TEXT, _TICK, _MARGIN, _LINE = 29, 25, 23, 22, 38   # sizes in units of a 720th of the width
_TALLEST, _BAR, _PANEL = 860, 24, 330


@dataclasses.dataclass
class Options:
    """What is asked for. `points` and `cells` name a field, "none" leaves them out, None chooses; `ranges` are those of the colour
    bars in turn, None chooses; `plane` is an axis and a place on it, or the three components of a normal and the distance from the origin along it
    (3-D; None: the middle one along z); `mirror` names the axes, "x", "y" or "xy", at whose lower side a symmetric scene is completed; `view` (3-D): seen from an azimuth and an elevation in degrees, cells on
    the `plane` or on the far sides of the domain; `titled`: the scene's title stands above."""
    points: str | None = None
    cells: str | None = None
    ranges: list = dataclasses.field(default_factory=list)
    dark: bool = False
    width: int = WIDTH
    plane: tuple[str | tuple[float, float, float], float] | None = None
    mirror: str = ""
    view: tuple[float, float] | None = None
    titled: bool = True


@dataclasses.dataclass
class Scale:
    """What colours mean, or heights in one dimension."""
    label: str
    unit: str
    signed: bool
    values: list = dataclasses.field(default_factory=list)  # arrays that it is chosen by
    given: tuple[float, float] | None = None


@dataclasses.dataclass
class Points:
    """Points of a body in the plane: places (n, 2), edges of squares of their size (n,), values (n,) or None."""
    name: str
    place: numpy.ndarray
    edge: numpy.ndarray
    values: numpy.ndarray | None
    scale: int


@dataclasses.dataclass
class Sheet:
    """All that a picture of a snapshot shows."""
    snapshot: SealedSnapshot
    options: Options
    axes: list[str]                # the two that are shown
    lower: numpy.ndarray
    upper: numpy.ndarray
    note: str = ""
    scales: list[Scale] = dataclasses.field(default_factory=list)
    cells: numpy.ndarray | None = None   # (n, m), the first along the first axis
    cell_scale: int = 0
    bodies: list[Points] = dataclasses.field(default_factory=list)

    @property
    def caption(self) -> str:
        """ "von Mises stress of points over pressure of cells at t = 1.4 ms" """
        shown = list(dict.fromkeys(self.scales[one.scale].label for one in self.bodies if one.values is not None))
        parts = [f"{' and '.join(shown)}{' of ' if shown else ''}points"] if self.bodies else []
        if self.cells is not None:
            parts.append(f"{self.scales[self.cell_scale].label} of cells")
        plane = f" in the plane {self.note.partition('plane ')[2]}" if "plane " in self.note else ""
        return f"{' over '.join(parts)}{plane} at t = {units.number(self.snapshot.time, self.snapshot.time_unit)}"


# ---- what a sheet holds ----

def _scale_for(sheet: Sheet, choice: fields.Choice, unit: str) -> int:
    for k, one in enumerate(sheet.scales):
        if one.label == choice.label:
            return k
    if len(sheet.scales) == 2:
        names = [f"'{one.label}'" for one in sheet.scales]
        raise Refused(f"a picture shows two quantities, not {', '.join(names)} and '{choice.label}': choose by --points and --cells, 'none' included", 2)
    ranges = sheet.options.ranges
    given = ranges[len(sheet.scales)] if len(ranges) > len(sheet.scales) else None
    sheet.scales.append(Scale(choice.label, unit, choice.signed, given=given))
    return len(sheet.scales) - 1


def _edges(snapshot: SealedSnapshot, body: str, place: numpy.ndarray) -> numpy.ndarray:
    """Edges of squares (cubes) as large as the points are now."""
    names = snapshot.bodies[body]
    if "initial_volume" not in names:
        return numpy.full(len(place), 0.5 * snapshot.spacing[0])
    size = numpy.array(snapshot.read(body, "initial_volume").values, dtype=float)
    gradient = [f"deformation_gradient_{ij}" for ij in ("xx", "yy", "xy", "yx")]
    if "volume_ratio" in names:
        size *= snapshot.read(body, "volume_ratio").values
    elif snapshot.dim == 2 and all(one in names for one in gradient):
        f = [snapshot.read(body, one).values for one in gradient]
        size *= abs(f[0] * f[1] - f[2] * f[3])
    if snapshot.dim == 3:
        return numpy.cbrt(size)
    around = numpy.maximum(place[:, 0], 0.25 * snapshot.spacing[0]) if snapshot.geometry == "axisymmetric" else 1.0
    return numpy.sqrt(size / (snapshot.volume_scale * around))


def _add_body(sheet: Sheet, body: str, choice: fields.Choice | None, plane) -> None:
    snapshot = sheet.snapshot
    try:
        place = snapshot.read(body, "position").values
    except Refused as error:
        raise Refused(f"'{snapshot.path}': body '{body}' has no positions") from error
    edge, values, scale = _edges(snapshot, body, place), None, 0
    if choice:
        values, unit = fields.values(snapshot, choice)
        scale = _scale_for(sheet, choice, unit)
    if plane:
        near = abs(plane.distance(place)) <= 0.5 * abs(plane.normal) @ snapshot.spacing
        place, edge, values = plane.flat(place[near]), edge[near], values[near] if values is not None else None
    else:
        place = place[:, :snapshot.dim] if snapshot.dim > 1 else numpy.column_stack([place[:, 0], numpy.zeros(len(place))])
    if values is not None:
        sheet.scales[scale].values.append(values)
    sheet.bodies.append(Points(body, place, edge, values, scale))


def _add_bodies(sheet: Sheet, plane) -> set[str]:
    """Solids take the first scale; but fluids are drawn first, so that solids keep their outlines. Returns what was asked for and found."""
    snapshot, options = sheet.snapshot, sheet.options
    solids = [body for body, phase in snapshot.phases.items() if phase != "fluid"]
    found = set()
    for body in solids + [body for body in snapshot.bodies if body not in solids]:
        # Beside solids, points of a fluid stand for the cells that it has in other couplings: one command draws the same picture of both.
        asked = "cells" if body not in solids and solids else "points"
        name = getattr(options, asked)
        if name == "none":
            continue
        choice = fields.find(snapshot, body, name) if name else fields.usual_of_body(snapshot, body)
        if name and choice:
            found.add(asked)
        _add_body(sheet, body, choice, plane)
    sheet.bodies.sort(key=lambda one: one.name in solids)
    return found


def _add_cells(sheet: Sheet, plane) -> bool:
    snapshot, name = sheet.snapshot, sheet.options.cells
    if name == "none" or not snapshot.fields:
        return False
    choice = fields.find(snapshot, None, name) if name else fields.usual_of_cells(snapshot)
    if not choice:
        return False
    values, unit = fields.values(snapshot, choice)
    if plane and plane.axis is not None:
        layer = math.floor((plane.at - snapshot.lower[plane.axis]) / snapshot.spacing[plane.axis])
        values = values.take(min(max(layer, 0), values.shape[plane.axis] - 1), axis=plane.axis)
    elif plane:
        values = _leaning_cells(sheet, plane, values)
    sheet.cell_scale = _scale_for(sheet, choice, unit)
    sheet.cells = values
    sheet.scales[sheet.cell_scale].values.append(values)
    return True


def _leaning_cells(sheet: Sheet, plane: planes.Plane, values: numpy.ndarray) -> numpy.ndarray:
    """Values of cells in a plane that leans, on a grid of its own of a third of a cell."""
    snapshot, span = sheet.snapshot, sheet.upper - sheet.lower
    n = [max(2, math.ceil(3 * float(one) / float(min(snapshot.spacing)))) for one in span]
    along = [sheet.lower[k] + (numpy.arange(n[k]) + 0.5) / n[k] * span[k] for k in (0, 1)]
    flat = numpy.stack(numpy.meshgrid(*along, indexing="ij"), axis=-1).reshape(-1, 2)
    return planes.cells_at(values, snapshot.lower, snapshot.spacing, plane.place(flat)).reshape(n)


def _plane_of(snapshot: SealedSnapshot, options: Options) -> planes.Plane | None:
    """The plane that is shown; None but in 3-D, and where all of the domain is seen."""
    if snapshot.dim != 3:
        if options.plane or options.view:
            raise Refused(f"--{'plane' if options.plane else 'view'} is for scenes in 3-D; '{snapshot.path}' has {snapshot.dim} dimension{'s' if snapshot.dim > 1 else ''}", 2)
        return None
    if options.view and not options.plane:
        return None
    if not options.plane:
        cells = round((snapshot.upper[2] - snapshot.lower[2]) / snapshot.spacing[2])
        return planes.Plane.across("z", snapshot.lower[2] + snapshot.spacing[2] * (cells // 2 + 0.5))
    try:
        plane = planes.Plane.across(*options.plane)
    except ValueError as error:
        raise Refused(str(error), 2) from error
    if plane.axis is not None and not snapshot.lower[plane.axis] <= plane.at <= snapshot.upper[plane.axis]:
        raise Refused(f"the plane {plane.names[2]} = {plane.at:g} lies outside the domain, which is from {snapshot.lower[plane.axis]:g} to {snapshot.upper[plane.axis]:g}", 2)
    if plane.axis is None and plane.extent(snapshot.lower, snapshot.upper) is None:
        raise Refused(f"the plane across {plane.names[2]} that is {plane.at:g} from the origin lies outside the domain", 2)
    if plane.axis is None and options.mirror:
        raise Refused("--mirror is for planes across an axis", 2)
    return None if options.view else plane


def make_sheet(snapshot: SealedSnapshot, options: Options) -> Sheet:
    """What a picture shows; `files.Refused` where what is asked for is not there."""
    plane = _plane_of(snapshot, options)
    sheet = Sheet(snapshot, options, list(fields.axes_of(snapshot))[:snapshot.dim], snapshot.lower[:snapshot.dim], snapshot.upper[:snapshot.dim], snapshot.coupling)
    if plane:
        sheet.axes, (sheet.lower, sheet.upper) = list(plane.names[:2]), plane.extent(snapshot.lower, snapshot.upper)
    if options.view:
        size = " × ".join(units.digits(float(one)) for one in (sheet.upper - sheet.lower) / _length(sheet)[0])
        sheet.note += f", domain of {size} {_length(sheet)[1]}".rstrip()
    if plane:
        at = units.number(plane.at, snapshot.length_unit)
        sheet.note += f", plane {plane.names[2]} {'=' if plane.axis is not None else 'at'} {at}"
    found = _add_bodies(sheet, plane)
    if _add_cells(sheet, plane):
        found.add("cells")
    for asked in ("points", "cells"):
        name = getattr(options, asked)
        if name and name != "none" and asked not in found:
            raise fields.unknown(snapshot, asked == "points" or not snapshot.fields, name)
    if not sheet.bodies and sheet.cells is None:
        raise Refused(f"there is nothing to draw: '{snapshot.path}' holds neither points nor cells that are asked for; leave --points or --cells out", 2)
    return sheet


# ---- ranges ----

def range_of(scale: Scale) -> tuple[float, float]:
    """The range that shows the values best: all of them, unless few of them (half a per cent at either end) more than double it; a
    signed one that holds zero is made the same on both sides; ends are rounded outwards."""
    if scale.given:
        return scale.given
    finite = [one[numpy.isfinite(one)].ravel() for one in scale.values]
    every = numpy.concatenate(finite) if finite else numpy.array([])
    if len(every) == 0:
        return -1.0 if scale.signed else 0.0, 1.0
    least, most = float(every.min()), float(every.max())
    few = len(every) // 200
    if few:
        parted = numpy.partition(every, (few, len(every) - 1 - few))
        low, high = float(parted[few]), float(parted[-1 - few])
        if high > low and most - least > 2 * (high - low):
            least, most = low, high
    if not most - least > 1e-9 * max(abs(least), abs(most)):
        middle = 0.5 * (least + most)
        margin = 0.1 * abs(middle) or 1.0
        return (0.0 if middle == 0 and not scale.signed else middle - margin), middle + margin
    if scale.signed and least < 0 < most:
        most = max(-least, most)
        least = -most
    return _rounded(least, most)


def _rounded(least: float, most: float) -> tuple[float, float]:
    step = 0.05 * (most - least)
    power = 10.0 ** math.floor(math.log10(step))
    step = power * max(one for one in (1, 2, 5) if one <= step / power * (1 + 1e-12))
    return step * math.floor(least / step + 1e-6), step * math.ceil(most / step - 1e-6)


def common_ranges(sheets: Iterable[Sheet]) -> list[tuple[float, float]]:
    """Ranges that hold those of all sheets, which show the same quantities."""
    found: list[tuple[float, float]] = []
    for sheet in sheets:
        for k, scale in enumerate(sheet.scales):
            low, high = range_of(scale)
            if k == len(found):
                found.append((low, high))
            elif not scale.given:
                found[k] = min(found[k][0], low), max(found[k][1], high)
    return found


# ---- drawing ----

class Drawn(Figure):
    """A figure of matplotlib that notebooks show."""

    def _repr_png_(self) -> bytes:
        return png(self)


@dataclasses.dataclass
class _Drawing:
    """A sheet on paper. `u` is a unit in px; figures have 100 px an inch."""
    sheet: Sheet
    ranges: list[tuple[float, float]]
    figure: Figure
    u: float
    height: float = 0.0  # of the figure, in units
    ink: str = colours.INK

    def text(self, x: float, y: float, text: str, size: float = _TEXT, **more) -> None:
        """Text at a place in units from the left and from the top."""
        self.figure.text(x / 720, 1 - y / self.height, text, fontsize=size * self.u * 0.72, color=self.ink, parse_math=False, **more)

    def axes(self, x: float, y: float, width: float, height: float):
        """Axes by their upper left corner and size, in units."""
        axes = self.figure.add_axes((x / 720, 1 - (y + height) / self.height, width / 720, height / self.height))
        axes.tick_params(labelsize=_TICK * self.u * 0.72, colors=self.ink, width=1.2 * self.u, length=6 * self.u, pad=4 * self.u)
        for spine in axes.spines.values():
            spine.set(color=self.ink, linewidth=1.2 * self.u)
        return axes


def _wrapped(text: str, most: int = 40) -> list[str]:
    """A title in at most two lines."""
    lines = [""]
    for word in text.split():
        if len(lines[-1]) + len(word) >= most and lines[-1]:
            lines.append("")
        lines[-1] = f"{lines[-1]} {word}".strip()
    if len(lines) > 2:
        lines[1] += " …"
    return [line if len(line) <= most + 8 else line[:most + 6] + "…" for line in lines[:2]]


def _head(sheet: Sheet) -> list[tuple[str, bool]]:
    """Lines above the picture, and whether they are bold."""
    time = f"t = {units.number(sheet.snapshot.time, sheet.snapshot.time_unit)}"
    title = _wrapped(sheet.snapshot.title) if sheet.options.titled else []
    return [(line, True) for line in title if line] + [(f"{time}, {sheet.note}", False)]


def _draw_head(d: _Drawing, lines) -> None:
    for k, (line, bold) in enumerate(lines):
        d.text(_MARGIN, _MARGIN + k * _LINE, line, _TITLE if bold else _TEXT, va="top", weight="bold" if bold else "normal")


def _ticks(axis, most: int, least: int = 2) -> None:
    axis.set_major_locator(MaxNLocator(most, steps=[1, 2, 5, 10], min_n_ticks=least))
    axis.set_major_formatter(lambda value, _: units.digits(0.0 if abs(value) < 1e-12 else float(f"{value:.6g}"), 6))


def _kinds(sheet: Sheet, ranges) -> list[str]:
    """The kind of colours of each scale: two quantities of one picture never share a hue."""
    signs = [scale.signed and abs(low + high) <= 1e-9 * (high - low) for scale, (low, high) in zip(sheet.scales, ranges)]
    if len(signs) == 1:
        return ["signed" if signs[0] else "single"]
    of_points = {one.scale for one in sheet.bodies if one.values is not None}
    return ["signed" if sign else "grey" if signs[1 - k] else "warm" if k in of_points and (k == 0 or 0 not in of_points) else "cool"
            for k, sign in enumerate(signs)]


def _paint_body(sheet: Sheet, body: Points, image: numpy.ndarray, ranges, kinds) -> None:
    none = colours.POINT_DARK if sheet.options.dark else colours.POINT
    grey = [int(none[k:k + 2], 16) for k in (1, 3, 5)] + [255]
    rgba = numpy.tile(numpy.array(grey, dtype=numpy.uint8), (len(body.place), 1))
    if body.values is not None:
        coloured = pixels.colour(body.values, ranges[body.scale], kinds[body.scale], sheet.options.dark)
        rgba = numpy.where(coloured[:, 3:] > 0, coloured, rgba)
    per = numpy.array([image.shape[1], image.shape[0]]) / (sheet.upper - sheet.lower)
    goes_on = [sheet.axes[k] == "r" or "xy"[k] in sheet.options.mirror for k in (0, 1)]
    pixels.paint_points(image, (body.place - sheet.lower) * per, body.edge * per[0], rgba, goes_on)


def raster(sheet: Sheet, ranges, width: int, height: int) -> numpy.ndarray:
    """The domain as RGBA bytes, the lowest row first."""
    image = numpy.zeros((height, width, 4), dtype=numpy.uint8)
    kinds = _kinds(sheet, ranges)
    if sheet.cells is not None:
        k = sheet.cell_scale
        pixels.paint_cells(image, pixels.colour(sheet.cells, ranges[k], kinds[k], sheet.options.dark))
    for body in sheet.bodies:
        _paint_body(sheet, body, image, ranges, kinds)
    if "x" in sheet.options.mirror:
        image = numpy.concatenate([image[:, ::-1], image], axis=1)
    if "y" in sheet.options.mirror:
        image = numpy.concatenate([image[::-1], image], axis=0)
    return image


def _extent(sheet: Sheet) -> tuple[numpy.ndarray, numpy.ndarray]:
    """The corners of what is shown, the mirror image included."""
    lower = sheet.lower.copy()
    for k, axis in enumerate("xy"):
        if axis in sheet.options.mirror:
            lower[k] = 2 * sheet.lower[k] - sheet.upper[k]
    return lower, sheet.upper


def _bar(d: _Drawing, k: int, y: float, left: float) -> None:
    """The colour bar of a scale, its label above it."""
    scale, (low, high) = d.sheet.scales[k], d.ranges[k]
    shown = units.shown(low, high, scale.unit)
    axes = d.axes(left, y + 34, 720 - left - 2 * _MARGIN, _BAR)
    kind = _kinds(d.sheet, d.ranges)[k]
    axes.imshow(numpy.linspace(0, 1, 256)[None, :], cmap=colours.field_map(kind, d.sheet.options.dark), aspect="auto",
                extent=(shown.of(low), shown.of(high), 0, 1))
    axes.set_yticks([])
    _ticks(axes.xaxis, 5)
    every = [one[numpy.isfinite(one)] for one in scale.values]
    values = numpy.concatenate([one.ravel() for one in every]) if every else numpy.array([])
    for at, beyond, mark in ((0, len(values) and values.min() < low - 1e-9 * (high - low), "<"),
                             (1, len(values) and values.max() > high + 1e-9 * (high - low), ">")):
        if beyond:
            axes.plot([at + (0.012 if at else -0.012)], [0.5], marker=mark, markersize=11 * d.u, color=d.ink, transform=axes.transAxes, clip_on=False)
    d.text(left, y + 26, units.label(scale.label, shown), _TEXT, va="baseline")


def _plane_figure(sheet: Sheet, ranges) -> Drawn:
    """Points over cells in a plane, the same scale along both axes."""
    u, head, (lower, upper) = sheet.options.width / 720, _head(sheet), _extent(sheet)
    size = max(abs(lower).max(), abs(upper).max())
    factor, unit = units.choose(float(size), sheet.snapshot.length_unit)
    low, high = lower / factor, upper / factor
    marks = [units.digits(float(f"{one:.3g}"), 3) for one in MaxNLocator(5, steps=[1, 2, 5, 10]).tick_values(low[1], high[1])]
    left = _MARGIN + 52 + 13 * max(len(one) for one in marks)
    span = high - low
    width = min(720 - left - _MARGIN - 14, _TALLEST * span[0] / span[1])
    width, height = max(width, 4.0), max(width * span[1] / span[0], 4.0)
    top = _MARGIN + len(head) * _LINE + 14
    bars = top + height + 74
    d = _Drawing(sheet, ranges, Drawn(facecolor=colours.PAPER_DARK if sheet.options.dark else colours.PAPER), u,
                 bars + len(sheet.scales) * 106 + 10, colours.INK_DARK if sheet.options.dark else colours.INK)
    d.figure.set_size_inches(sheet.options.width / 100, round(d.height * u) / 100)
    _draw_head(d, head)
    axes = d.axes(left + 0.5 * max(0.0, 720 - left - _MARGIN - 14 - width), top, width, height)
    pixels = [max(2, round(one * u / (2 if axis in sheet.options.mirror else 1))) for one, axis in ((width, "x"), (height, "y"))]
    axes.imshow(raster(sheet, ranges, *pixels), origin="lower", extent=(low[0], high[0], low[1], high[1]), aspect="auto", interpolation="none")
    axes.set_facecolor("none")
    axes.set_xlim(low[0], high[0])
    axes.set_ylim(low[1], high[1])
    _ticks(axes.xaxis, max(1, min(5, int(width // 90))), least=2 if width >= 90 else 1)
    _ticks(axes.yaxis, max(1, min(5, int(height // 50))))
    if height < 50:  # two numbers would stand over each other
        axes.set_yticks([high[1]])
    style = {"fontsize": _TEXT * u * 0.72, "color": d.ink}
    axes.set_xlabel(f"{sheet.axes[0]}{f' ({unit})' if unit else ''}", labelpad=2, **style)
    if height >= 90:  # of what is lower, the name would stand over the numbers
        axes.set_ylabel(f"{sheet.axes[1]}{f' ({unit})' if unit else ''}", labelpad=4 * u, **style)
    for k in range(len(sheet.scales)):
        _bar(d, k, bars + 106 * k, 2 * _MARGIN)
    return d.figure


# ---- space ----

def _space_figure(sheet: Sheet, ranges) -> Drawn:
    """The scene as it is seen from a side, in the box of its domain."""
    u, head, camera = sheet.options.width / 720, _head(sheet), space.camera_of(sheet)
    width = min(720 - 2 * _MARGIN, _TALLEST * camera.aspect)
    height, top = width / camera.aspect, _MARGIN + len(head) * _LINE + 10
    bars = top + height + 20
    d = _Drawing(sheet, ranges, Drawn(facecolor=colours.PAPER_DARK if sheet.options.dark else colours.PAPER), u,
                 bars + len(sheet.scales) * 106 + 10, colours.INK_DARK if sheet.options.dark else colours.INK)
    d.figure.set_size_inches(sheet.options.width / 100, round(d.height * u) / 100)
    _draw_head(d, head)
    axes = d.axes(0.5 * (720 - width), top, width, height)
    axes.set_axis_off()
    kinds = _kinds(sheet, ranges)
    image = space.raster(sheet, camera, lambda values, scale: pixels.colour(values, ranges[scale], kinds[scale], sheet.options.dark), round(width * u))
    (left, low), (right, high) = camera.low[:2], camera.high[:2]
    axes.imshow(image, origin="lower", extent=(left, right, low, high), aspect="auto", interpolation="none", zorder=2)
    for order, lines in zip((1, 3), space.edges(camera)):
        for (x0, y0), (x1, y1) in lines:
            axes.plot([x0, x1], [y0, y1], color=d.ink, linewidth=(1.2 if order == 1 else 0.6) * u, alpha=1.0 if order == 1 else 0.35, zorder=order)
    axes.set_xlim(left, right)
    axes.set_ylim(low, high)
    for k in range(len(sheet.scales)):
        _bar(d, k, bars + 106 * k, 2 * _MARGIN)
    return d.figure


# ---- one dimension ----

def exact_curves(snapshot: SealedSnapshot) -> dict[str, tuple[numpy.ndarray, numpy.ndarray]]:
    """Exact values over x beside the run's last snapshot: {quantity: (x, values)}, of profile.csv."""
    folder = snapshot.path.parent.parent
    listed = snapshot_files(folder)
    if not listed or listed[-1] != snapshot.path or not (folder / "profile.csv").is_file():
        return {}
    columns = table(folder / "profile.csv")
    if "x" not in columns:
        return {}
    at = columns["x"][0]
    order = numpy.argsort(at)
    return {name[6:]: (at[order], one[0][order]) for name, one in columns.items() if name.startswith("exact_")}


def _exact_of(scale: Scale, exact: dict) -> tuple | None:
    """The exact curve of a scale's quantity: "density gas" is "density"."""
    name = scale.label.replace(" ", "_")
    return next((curve for one, curve in exact.items() if name == one or name.startswith(one + "_")), None)


def _curves_panel(d: _Drawing, k: int, axes, exact) -> None:
    """One quantity over x: cells as steps, points as dots, the exact solution as a thin line over both."""
    sheet, scale = d.sheet, d.sheet.scales[k]
    low, high = d.ranges[k]
    shown, (factor, _) = units.shown(low, high, scale.unit), _length(sheet)
    palette = colours.SERIES_DARK if sheet.options.dark else colours.SERIES
    if sheet.cells is not None and sheet.cell_scale == k:
        edges = numpy.linspace(sheet.lower[0], sheet.upper[0], len(sheet.cells) + 1) / factor
        axes.stairs(shown.of(sheet.cells), edges, baseline=None, color=palette[0], linewidth=2.4 * d.u, label="cells")
    for b, body in enumerate(sheet.bodies):
        if body.values is not None and body.scale == k:
            with numpy.errstate(invalid="ignore"):
                place = numpy.where(abs(body.place[:, 0]) < 1e30, body.place[:, 0], numpy.nan)
            axes.plot(place / factor, shown.of(body.values), linestyle="", marker="o", color=palette[(b + 1) % len(palette)],
                      markersize=(4 if len(body.values) > 400 else 7) * d.u * 0.72, label=body.name)
    curve = _exact_of(scale, exact)
    if curve:
        axes.plot(curve[0] / factor, shown.of(curve[1]), color=d.ink, linewidth=1.6 * d.u, linestyle=(0, (4, 2)), label="exact")
    margin = 0.06 * (high - low)
    axes.set_xlim(sheet.lower[0] / factor, sheet.upper[0] / factor)
    axes.set_ylim(shown.of(low - margin), shown.of(high + margin))
    axes.set_title(units.label(scale.label, shown), loc="left", fontsize=_TEXT * d.u * 0.72, color=d.ink, pad=8 * d.u * 0.72)
    if len(axes.get_legend_handles_labels()[1]) > 1:
        axes.legend(fontsize=_TICK * d.u * 0.72, frameon=False, labelcolor=d.ink)


def _length(sheet: Sheet) -> tuple[float, str]:
    return units.choose(float(max(abs(sheet.lower).max(), abs(sheet.upper).max())), sheet.snapshot.length_unit)


def _curves_figure(sheet: Sheet, ranges) -> Drawn:
    """Each quantity over x, a panel each."""
    u, head, exact = sheet.options.width / 720, _head(sheet), exact_curves(sheet.snapshot)
    n, top = len(sheet.scales), _MARGIN + len(head) * _LINE + 10
    d = _Drawing(sheet, ranges, Drawn(facecolor=colours.PAPER_DARK if sheet.options.dark else colours.PAPER), u,
                 top + max(1, n) * (_PANEL + 110) + 6, colours.INK_DARK if sheet.options.dark else colours.INK)
    d.figure.set_size_inches(sheet.options.width / 100, round(d.height * u) / 100)
    _draw_head(d, head)
    _, unit = _length(sheet)
    for k in range(n):
        axes = d.axes(_MARGIN + 92, top + 48 + k * (_PANEL + 110), 720 - 2 * _MARGIN - 108, _PANEL)
        axes.set_facecolor("none")
        axes.grid(color=colours.GRID_DARK if sheet.options.dark else colours.GRID, linewidth=u)
        for side in ("top", "right"):
            axes.spines[side].set_visible(False)
        _curves_panel(d, k, axes, exact)
        _ticks(axes.xaxis, 6)
        _ticks(axes.yaxis, 5)
        if k == n - 1:
            axes.set_xlabel(f"{sheet.axes[0]}{f' ({unit})' if unit else ''}", fontsize=_TEXT * u * 0.72, color=d.ink, labelpad=2)
    return d.figure


# ---- results ----

def sheet_figure(sheet: Sheet, ranges=None) -> Drawn:
    """A sheet as a figure of matplotlib; `ranges` of its scales, chosen by its own values where there are none."""
    ranges = list(ranges) if ranges else [range_of(one) for one in sheet.scales]
    if sheet.snapshot.dim == 1:
        return _curves_figure(sheet, ranges)
    return _space_figure(sheet, ranges) if sheet.options.view else _plane_figure(sheet, ranges)


def figure(snapshot: SealedSnapshot, options: Options | None = None) -> Drawn:
    """A picture of a snapshot, as a figure of matplotlib."""
    return sheet_figure(make_sheet(snapshot, options or Options()))


def picture(of: Result | Snapshot | os.PathLike | str, time: float = math.inf, **options) -> Drawn:
    """A picture of a snapshot, or of a run (or its folder) at a time (s), by default at its end; `options` are those of `Options`:

        floe.picture(result, 2e-3, points="sigma_theta", cells="pressure", mirror="xy")"""
    found = of if isinstance(of, (Result, Snapshot)) else Result(of)
    return figure(SealedSnapshot((found.at(time) if isinstance(found, Result) else found).path), Options(**options))


def png(drawn: Figure) -> bytes:
    """A figure as PNG: the same bytes for the same numbers and fonts."""
    out = io.BytesIO()
    FigureCanvasAgg(drawn)
    drawn.savefig(out, format="png", dpi=100, metadata={"Software": None})
    return out.getvalue()


def write_png(snapshot, path, options: Options | None = None, ranges=None) -> str:
    """Writes a picture of a snapshot (or of its file), and returns its caption."""
    if not isinstance(snapshot, SealedSnapshot):
        snapshot = SealedSnapshot(snapshot)
    sheet = make_sheet(snapshot, options or Options())
    files.replace(path, png(sheet_figure(sheet, ranges)))
    return sheet.caption
