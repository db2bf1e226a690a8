"""Figures: panels of curves, as data (CSV) and as SVG that follows light and dark pages.

What `floe compare`, `study` and `stability` have found they write as NAME.csv (panel, series, x, y, label) and NAME.json (what
stands along the axes, which colours): `read` makes a figure of the two, `draw` an SVG of a figure.
"""
import csv
import dataclasses
import io
import json
import math
import pathlib

import matplotlib
import numpy
from matplotlib.figure import Figure as Paper
from matplotlib.ticker import LogLocator, MaxNLocator, NullLocator

from . import colours, files, svg, units

#: Points of a curve in a drawing: about one for each of its pixels.
MOST = 400
_WIDTH, _HEIGHT = 400, 290  # px of a panel


@dataclasses.dataclass
class Series:
    """A curve: `style` is lines, points, linespoints or steps; `emphasis` marks an exact solution or a Pareto front; `labels` are
    texts beside the points, or none."""
    name: str
    x: numpy.ndarray
    y: numpy.ndarray
    style: str = "lines"
    colour: int = 0
    emphasis: bool = False
    labels: list[str] | None = None


@dataclasses.dataclass
class Panel:
    title: str = ""
    x_label: str = ""
    y_label: str = ""
    log_x: bool = False
    log_y: bool = False
    series: list[Series] = dataclasses.field(default_factory=list)
    floor: float = 0.0       # of a logarithmic y: what is smaller than this share of the largest value lies below
    slopes: list[float] = dataclasses.field(default_factory=list)  # drawn for reference in a panel with two logarithmic axes


@dataclasses.dataclass
class Figure:
    name: str                # stem of its files
    title: str               # above the panels
    panels: list[Panel] = dataclasses.field(default_factory=list)
    columns: int = 1


# ---- data ----

def drawable(panel: Panel, one: Series) -> numpy.ndarray:
    """Which points can be drawn: finite, and above zero on logarithmic axes."""
    with numpy.errstate(invalid="ignore"):
        return (numpy.isfinite(one.x) & numpy.isfinite(one.y) & ((one.x > 0) | (not panel.log_x)) & ((one.y > 0) | (not panel.log_y)))


def _thin_line(x: numpy.ndarray, y: numpy.ndarray, most: int) -> numpy.ndarray:
    """Which points of a line stay: of each of `most` parts the one that makes the largest triangle with the one kept before it and
    the middle of the next part (Steinarsson 2013): corners, steep parts and peaks."""
    n = len(x)
    bounds = numpy.concatenate([[0], 1 + (numpy.arange(most - 1) * (n - 2)) // (most - 2), [n]])
    kept = [0]
    for k in range(1, most - 1):
        part, after = slice(bounds[k], bounds[k + 1]), slice(bounds[k + 1], bounds[k + 2] if k + 2 < most else n)
        a, (cx, cy) = kept[-1], (x[after].mean(), y[after].mean())
        area = abs((x[part] - x[a]) * (cy - y[a]) - (cx - x[a]) * (y[part] - y[a]))
        kept.append(bounds[k] + int(numpy.argmax(area)))
    return numpy.array(kept + [n - 1])


def _thin_cloud(n: int, most: int) -> numpy.ndarray:
    """An even choice of points, from another part of each bucket, as a fixed stride would beat with points that lie regularly."""
    k = numpy.arange(most)
    return numpy.minimum(((k + (0.6180339887498949 * k) % 1) * n / most).astype(int), n - 1)


def thinned(panel: Panel, one: Series, most: int = MOST) -> Series:
    """A curve of at most so many points; one with texts beside its points keeps them all. Gaps stay."""
    fine = numpy.nonzero(drawable(panel, one))[0]
    if len(fine) <= most or one.labels:
        return one
    if one.style == "points":
        kept = fine[_thin_cloud(len(fine), most)]
        return dataclasses.replace(one, x=one.x[kept], y=one.y[kept])
    x, y = (numpy.log10(v[fine]) if log else v[fine] for v, log in ((one.x, panel.log_x), (one.y, panel.log_y)))
    kept = fine[_thin_line(x, y, most)]
    gaps = numpy.nonzero(numpy.diff(kept) > 4 * len(fine) / most)[0] + 1
    x, y = one.x[kept].astype(float), one.y[kept].astype(float)
    return dataclasses.replace(one, x=numpy.insert(x, gaps, math.nan), y=numpy.insert(y, gaps, math.nan))


def thinned_figure(figure: Figure, most: int = MOST) -> Figure:
    panels = [dataclasses.replace(panel, series=[thinned(panel, one, most) for one in panel.series]) for panel in figure.panels]
    return dataclasses.replace(figure, panels=panels)


def csv_text(figure: Figure, digits: int = 10) -> str:
    """All numbers of a figure, drawn or not, to so many digits."""
    out = io.StringIO()
    writer = csv.writer(out, lineterminator="\n")
    writer.writerow(("panel", "series", "x", "y", "label"))
    for panel in figure.panels:
        for one in panel.series:
            labels = one.labels or [""] * len(one.x)
            writer.writerows((panel.title, one.name, f"{x:.{digits}g}", f"{y:.{digits}g}", text) for x, y, text in zip(one.x, one.y, labels))
    return out.getvalue()


def read(folder: pathlib.Path | str, name: str) -> Figure:
    """The figure of NAME.json and NAME.csv, as floe has written them."""
    folder = pathlib.Path(folder)
    told = json.loads(files.read_text(folder / f"{name}.json"))
    rows = list(csv.reader(io.StringIO(files.read_text(folder / f"{name}.csv"))))[1:]
    figure, at = Figure(name, told["title"], columns=max(1, told["columns"])), 0
    for panel in told["panels"]:
        made = Panel(panel["title"], panel["x_label"], panel["y_label"], panel["log_x"], panel["log_y"], slopes=panel["slopes"])
        for one in panel["series"]:
            part = rows[at:at + one["rows"]]
            at += one["rows"]
            x, y = (numpy.array([float(row[k]) for row in part]) for k in (2, 3))
            labels = [row[4] for row in part] if any(row[4] for row in part) else None
            made.series.append(Series(one["name"], x, y, one["style"], one["colour"], one["emphasis"], labels))
        figure.panels.append(made)
    return figure


# ---- drawing ----

def _limits(values: list[numpy.ndarray], log: bool) -> tuple[float, float]:
    every = numpy.concatenate(values)
    low, high = float(every.min()), float(every.max())
    if log:
        return low / 1.25, high * 1.25
    span = high - low
    if not span > 1e-12 * max(abs(low), abs(high)):
        span = abs(low) * 0.2 or 1.0
        return low - 0.5 * span, high + 0.5 * span
    return low - 0.04 * span, high + 0.04 * span


def _tick_text(value: float, _=None) -> str:
    """A number beside a tick: "0.5", "10⁻³", "2.5×10⁴"."""
    return "0" if abs(value) < 1e-300 else units.digits(float(f"{value:.10g}"), 5).replace("1×10", "10") if value > 0 else "−" + _tick_text(-value)


def _axis(axis, log: bool, low: float, high: float) -> None:
    """Ticks: decades and their 2 and 5 where they are few, else round numbers. No mathematics in texts: it costs more than the rest."""
    axis.set_minor_locator(NullLocator())
    axis.set_major_formatter(_tick_text)
    if not log:
        axis.set_major_locator(MaxNLocator(5, steps=[1, 2, 2.5, 5, 10]))
    elif math.log10(high / low) > 5:
        axis.set_major_locator(LogLocator(numticks=6))
    else:
        axis.set_major_locator(LogLocator(subs=(1, 2, 5) if math.log10(high / low) < 2 else (1,), numticks=20))


def _slopes(axes, slopes: list[float]) -> None:
    """Reference slopes from one point in the corner that falling errors leave empty: the lower right one."""
    (x_low, x_high), (y_low, y_high) = axes.get_xlim(), axes.get_ylim()
    x_span, y_span = math.log10(x_high / x_low), math.log10(y_high / y_low)
    length = min(0.3 * x_span, 0.35 * y_span / max(slopes))
    end, foot = math.log10(x_high) - 0.24 * x_span, math.log10(y_low) + 0.05 * y_span
    for slope in slopes:
        axes.plot(10 ** numpy.array([end - length, end]), 10 ** numpy.array([foot, foot + slope * length]), color=colours.INK, linestyle=(0, (3, 2)), linewidth=1)
        axes.annotate(f"slope {slope:g}", (10 ** end, 10 ** (foot + slope * length)), xytext=(4, -3), textcoords="offset points", fontsize=10, color=colours.INK)


def _style(one: Series, k: int) -> dict:
    """Of a curve in matplotlib's words."""
    palette = colours.SERIES
    line = "" if one.style == "points" else "-"
    out = {"color": colours.INK if one.emphasis else palette[one.colour % len(palette)], "linestyle": line, "drawstyle": "steps-post" if one.style == "steps" else "default"}
    if one.emphasis and one.style != "lines":
        return out | {"marker": "o", "markersize": 9, "markerfacecolor": "none", "linestyle": (0, (2, 2)) if line else "", "linewidth": 1, "zorder": 3 + k}
    if one.emphasis:
        return out | {"linewidth": 1.2, "zorder": 3 + k}
    if one.style in ("points", "linespoints"):
        filled = one.colour // len(palette) % 2 == 0
        many = one.style == "points" and len(one.x) > 60
        out |= {"marker": colours.MARKERS[one.colour % len(palette)], "markersize": 3 if many else 5} | ({} if filled else {"markerfacecolor": "none"})
    return out


def _short(text: str, most: int = 46) -> str:
    return text if len(text) <= most else text[:most - 1] + "…"


def _label(axes, x: float, y: float, text: str) -> None:
    """A text beside a point, on the side where the panel has room for all of it."""
    across = axes.transAxes.inverted().transform(axes.transData.transform((x, y)))[0]
    right = across < 0.85
    axes.annotate(text, (x, y), xytext=(5 if right else -5, 4), ha="left" if right else "right", textcoords="offset points", fontsize=9, parse_math=False)


def _draw_panel(axes, panel: Panel) -> int:
    """Draws a panel; returns the number of names in its key."""
    fine = [(k, one, drawable(panel, one)) for k, one in enumerate(panel.series)]
    shown = [(k, one, mask) for k, one, mask in fine if mask.any()]
    axes.set_title(_short(panel.title, 60), fontsize="medium", parse_math=False)
    axes.set_xlabel(panel.x_label, parse_math=False)
    axes.set_ylabel(panel.y_label, parse_math=False)
    if not shown:
        axes.text(0.5, 0.5, "no data", transform=axes.transAxes, ha="center")
        return 0
    for which, log in (("x", panel.log_x), ("y", panel.log_y)):
        low, high = _limits([getattr(one, which)[mask] for _, one, mask in shown], log)
        low = max(low, panel.floor * high) if log and which == "y" else low
        getattr(axes, f"set_{which}scale")("log" if log else "linear")
        getattr(axes, f"set_{which}lim")(low, high)
        _axis(getattr(axes, f"{which}axis"), log, low, high)
    if panel.slopes and panel.log_x and panel.log_y:
        _slopes(axes, panel.slopes)
    for k, one, mask in shown:
        gaps = numpy.where(mask, one.y, math.nan)
        axes.plot(one.x, gaps, label=_short(one.name) if one.name else "_", **_style(one, k))
        for x, y, text in zip(one.x[mask], one.y[mask], [one.labels[i] for i in numpy.nonzero(mask)[0]] if one.labels else []):
            _label(axes, x, y, _short(text, 20))
    return sum(bool(one.name) for _, one, _ in shown)


def _key(axes, names: int, panel: Panel) -> int:
    """The key below a panel; returns its rows."""
    if names < 2:
        return 0
    longest = max(len(_short(one.name)) for one in panel.series)
    columns = max(1, min(names, (_WIDTH - 20) // (longest * 7 + 45)))
    legend = axes.legend(loc="upper center", bbox_to_anchor=(0.5, -0.2), ncol=columns, fontsize=11, handlelength=1.6, columnspacing=1.2, borderaxespad=0)
    for text in legend.get_texts():
        text.set_parse_math(False)
    return -(-names // columns)


def draw(figure: Figure) -> str:
    """A figure as an <svg> element, its curves thinned to what can be seen."""
    figure = thinned_figure(figure)
    columns = min(max(1, figure.columns), max(1, len(figure.panels)))
    rows = -(-len(figure.panels) // columns)
    with matplotlib.rc_context(svg.STYLE):
        paper = Paper()
        grid = paper.subplots(max(1, rows), columns, squeeze=False)
        keys = [0]
        for k, axes in enumerate(grid.flat):
            if k >= len(figure.panels):
                axes.set_visible(False)
                continue
            keys.append(_key(axes, _draw_panel(axes, figure.panels[k]), figure.panels[k]))
        titled = any(panel.title for panel in figure.panels)
        foot, head = 46 + 17 * max(keys), 28 if titled else 14
        height = _HEIGHT - 56 + foot + head
        paper.set_size_inches(columns * _WIDTH / 72, rows * height / 72)
        paper.subplots_adjust(left=78 / (_WIDTH * columns), right=1 - 12 / (_WIDTH * columns), bottom=foot / (height * rows), top=1 - head / (height * rows),
                              wspace=90 / (_WIDTH - 90), hspace=(foot + head) / (height - foot - head))
        for axes in grid.flat:  # the key lies as far below its axes in px, however high they are
            if axes.get_legend():
                axes.get_legend().set_bbox_to_anchor((0.5, -44 / (height - foot - head)))
        return svg.inline(paper, files.stem(figure.name), figure.title)


def write(folder: pathlib.Path | str, figure: Figure) -> str:
    """Writes NAME.csv and NAME.svg, and returns the <svg> element."""
    element, name = draw(figure), files.stem(figure.name)
    files.replace(pathlib.Path(folder) / f"{name}.csv", csv_text(figure))
    files.replace(pathlib.Path(folder) / f"{name}.svg", svg.alone(element))
    return element


def draw_files(folder: pathlib.Path | str, names: list[str]) -> None:
    """NAME.svg of each NAME.json and NAME.csv of a folder."""
    for name in names:
        files.replace(pathlib.Path(folder) / f"{name}.svg", svg.alone(draw(read(folder, name))))
