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

    floe.picture(result, 0.1, points="stress_xx")                       # a figure of matplotlib, which notebooks show
    floe.movie(result, "von_mises")                                     # pictures through time as GIF (floe.movies)
    floe.pictures.write_png("out/sod-ice/fields/000004.h5", "sod.png")
    floe.report.write(floe.report.Request(["out/sod-compare"], "sod.html"))

A deck is stepped by floe's library, fields without copies, with callbacks and laws of your own (floe.scene, floe.laws); numpy alone is needed:

    with floe.Scene("deck.yaml", settings={"domain.cell": 0.05}) as scene:
        scene.step()
        scene.cells["pressure"], scene.points["block"]["stress_xx"]

`floe picture`, `floe report` and the plots of `floe compare`, `study` and `stability` come from here too (floe.command).
"""
import importlib

from .results import Quantity, Result, Snapshot
from .cases import Cases, order
from .tables import Table, figure, markdown, percent

__all__ = ["Cases", "Diverged", "EquationOfState", "Error", "FileError", "InputError", "Interrupted", "LibraryError", "Parameter", "Quantity", "Result",
           "Scene", "Snapshot", "SolidLaw", "Table", "figure", "markdown", "order", "percent", "run"]


_OF_LIBRARY = {"Scene": "scene", "run": "scene", "SolidLaw": "laws", "EquationOfState": "laws", "Parameter": "laws", "Error": "library",
               "LibraryError": "library", "InputError": "library", "Diverged": "library", "FileError": "library", "Interrupted": "library"}
_ON_DEMAND = ("figures", "histories", "laws", "library", "movies", "pictures", "plots", "report", "scene", "snapshots", "units")


def __getattr__(name):
    if name in ("movie", "picture"):
        return getattr(importlib.import_module(f"floe.{name}s"), name)
    if name in _OF_LIBRARY:
        return getattr(importlib.import_module("floe." + _OF_LIBRARY[name]), name)
    if name in _ON_DEMAND:
        return importlib.import_module("floe." + name)
    raise AttributeError(f"module 'floe' has no attribute '{name}'")
