"""Plots of one house style, as SVG that is the same bytes whenever the numbers are. Needs matplotlib."""
import pathlib

import matplotlib

matplotlib.use("Agg")
from matplotlib import pyplot  # noqa: E402 (after the choice of what draws)

#: A coupling has the same colour in every plot.
COLOURS = {"mpm": "#c03020", "ice": "#1060b0", "ice-mpm": "#208040"}
OTHERS = ["#806020", "#7040a0", "#008080", "#a03070", "#506070", "#b08000"]
EXACT = {"color": "#606060", "linestyle": "-", "linewidth": 1.0, "marker": ""}
STYLE = {"svg.hashsalt": "floe", "svg.fonttype": "path", "font.size": 11, "axes.grid": True, "grid.color": "#d8d8d8", "grid.linewidth": 0.6,
         "axes.axisbelow": True, "lines.linewidth": 1.4, "lines.markersize": 5, "legend.frameon": False, "figure.dpi": 80}


def colours(names):
    """A colour for each name: those of the couplings, and others in turn."""
    spare = iter(OTHERS * len(names))
    return {name: COLOURS.get(name) or next(spare) for name in names}


def label(name, unit="1"):
    """An axis with its unit."""
    return name if unit in ("1", "") else f"{name} ({unit})"


def panels(path, draw, titles, columns=2):
    """A figure of panels: draw(axes, k) draws the k-th of `titles` and labels its axes. Written to `path`."""
    columns = min(columns, len(titles))
    rows = -(-len(titles) // columns)
    with matplotlib.rc_context(STYLE):
        figure, grid = pyplot.subplots(rows, columns, figsize=(5.2 * columns, 3.9 * rows), squeeze=False, layout="constrained")
        for k, axes in enumerate(grid.flat):
            if k < len(titles):
                axes.set_title(titles[k], fontsize="medium")
                draw(axes, k)
            else:
                axes.set_visible(False)
        pathlib.Path(path).parent.mkdir(parents=True, exist_ok=True)
        figure.savefig(path, format="svg", metadata={"Date": None, "Creator": None})
        pyplot.close(figure)


def lines(path, series, x, y, title="", log=False):
    """One panel of curves: `series` maps a name to (x values, y values) or (x values, y values, style of matplotlib)."""
    colour = colours(list(series))

    def draw(axes, _):
        for name, (at, values, *style) in series.items():
            axes.plot(at, values, label=name, **{"color": colour[name], **(style[0] if style else {"marker": "o"})})
        if log:
            axes.set_xscale("log")
            axes.set_yscale("log")
        axes.set_xlabel(x)
        axes.set_ylabel(y)
        axes.legend()

    panels(path, draw, [title])
