"""Results of floe in Python: result folders, tables of cases, Markdown, and plots of one style.

    import floe
    result = floe.Result("out/sod-ice")
    result.summary["errors"]["l1_density"]
    snapshot = result.at(0.1)
    density = snapshot.field("density_gas")   # density.values[i, j, k], density.unit
    stress = snapshot.points("ring", "stress_xx")
    cases = floe.Cases("out/sod-compare")
    floe.order(cases.numbers("h", coupling="ice"), cases.numbers("l1_density", coupling="ice"))

Pictures, figures and pages are modules of their own, which need matplotlib (and a page jinja2), and are imported when they are asked for:

    floe.movie(result, "von_mises")                                     # pictures through time as GIF (floe.movies)
    floe.pictures.write_png("out/sod-ice/fields/000004.h5", "sod.png")
    floe.report.write(floe.report.Request(["out/sod-compare"], "sod.html"))

`floe picture`, `floe report` and the plots of `floe compare`, `study` and `stability` come from here too (floe.command).
"""
import importlib

from .results import Quantity, Result, Snapshot
from .cases import Cases, order
from .tables import figure, markdown, percent

__all__ = ["Cases", "Quantity", "Result", "Snapshot", "figure", "markdown", "order", "percent"]


_ON_DEMAND = ("figures", "histories", "movies", "pictures", "plots", "report", "snapshots", "units")


def __getattr__(name):
    if name == "movie":
        return importlib.import_module("floe.movies").movie
    if name in _ON_DEMAND:
        return importlib.import_module("floe." + name)
    raise AttributeError(f"module 'floe' has no attribute '{name}'")
