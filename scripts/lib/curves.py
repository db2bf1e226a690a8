"""Many curves over one axis, with their names below them instead of over them."""
from floe import plots


def curves(path, series, x, y, log=False):
    """`series` maps a name to (x values, y values, style of matplotlib)."""
    colour = plots.colours(list(series))

    def draw(axes, _):
        for name, (at, values, *style) in series.items():
            axes.plot(at, values, label=name, **{"color": colour[name], **(style[0] if style else {})})
        if log:
            axes.set(xscale="log", yscale="log")
        axes.set(xlabel=x, ylabel=y)
        axes.legend(loc="upper center", bbox_to_anchor=(0.5, -0.16), ncols=2, fontsize=9)

    plots.panels(path, draw, [""], columns=1)
