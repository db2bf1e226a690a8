"""test_floe.py SOD RING: the package on a comparison of Sod's tube and on a run of the cylinder in gas. Needs nothing but the package."""
import math
import pathlib
import shutil
import sys
import tempfile

import h5py
import numpy

import floe
from floe import figures, plots, report, units

SOD, RING = (pathlib.Path(name) for name in sys.argv[1:])


def close(a, b, most=1e-12):
    assert abs(a - b) <= most * max(abs(a), abs(b), 1e-300), (a, b)


def refused(kind, words, function, *arguments):
    try:
        function(*arguments)
    except kind as error:
        assert words in str(error), str(error)
        return
    raise AssertionError(f"{words}: not refused")


def test_cells():
    """Densities times volumes are the history's mass; the state is Sod's; axes go along x first."""
    result = floe.Result(SOD / "ice-0.01")
    assert result.summary["status"] == "done" and 0 < result.summary["cpu_seconds"] < 10
    assert len(result.snapshots) > 2 and result.snapshots[0].time == 0
    last = result.at(math.inf)
    assert last.dim == 1 and last.coupling == "ice" and last.length_unit == "1"
    close(last.time, 0.143)
    assert result.at(0.07) is min(result.snapshots, key=lambda one: abs(one.time - 0.07))
    density, x = last.field("density_gas"), last.centres()
    assert density.values.shape == x.values.shape == (100,) and density.unit == "1" and "mass" in density.meaning
    close(x.values[0], 0.005)
    close(density.values.sum() * 0.01, result.history["mass"].values[-1])
    assert abs(density.values[numpy.argmin(abs(x.values - 0.58))] - 0.42632) < 0.005  # between fan and contact
    assert last.field("velocity_gas").values.shape == (100, 3)
    assert result.history["time"].unit == "1" and math.isnan(result.history["dt_limit"].values[0])
    refused(KeyError, "no cells/nothing", last.field, "nothing")
    refused(FileNotFoundError, "no summary.json", floe.Result, SOD)


def test_points():
    """Points and cells of one file, with units; a square domain's first axis is x."""
    result = floe.Result(RING)
    last = result.at(1e-4)
    assert last.dim == 2 and last.length_unit == "m" and list(last.bodies) == ["cylinder"]
    mass, place = last.points("cylinder", "mass"), last.points("cylinder", "position")
    assert mass.unit == "kg" and place.unit == "m" and place.values.shape == mass.values.shape + (3,)
    close(mass.values.sum(), result.history["mass_steel"].values[-1])
    radius = numpy.hypot(place.values[:, 0], place.values[:, 1])
    assert 0.49 < radius.min() and radius.max() < 1.01
    pressure, velocity = last.field("pressure"), last.field("velocity_gas")
    assert pressure.unit == "Pa" and pressure.values.shape == (12, 12) and velocity.values.shape == (12, 12, 3)
    assert result.history["time"].unit == "s"
    with h5py.File(last.path) as file:  # i is along x
        assert pressure.values[3, 1] == file["cells/pressure"][0, 1, 3] and velocity.values[3, 1, 0] == file["cells/velocity_gas"][0, 1, 3, 0]


def test_links():
    """What leads out of a snapshot is not followed."""
    with tempfile.TemporaryDirectory() as place:
        path = pathlib.Path(place) / "000000.h5"
        shutil.copy(floe.Result(RING).at(0).path, path)
        with h5py.File(path, "r+") as file:
            file["cells/stranger"] = h5py.ExternalLink(str(floe.Result(RING).at(1e-4).path.resolve()), "cells/pressure")
        refused(KeyError, "no cells/stranger", floe.Snapshot(path).field, "stranger")


def test_cases():
    """Orders of a power law, and of what floe itself fits."""
    h = numpy.array([0.4, 0.2, 0.1, 0.05])
    slope, error = floe.order(h, 3 * h ** 1.7)
    close(slope, 1.7, 1e-9)
    assert error < 1e-9 and math.isnan(floe.order(h[:1], h[:1])[0]) and math.isnan(floe.order(h[:2], h[:2])[1])
    cases = floe.Cases(SOD)
    assert cases.texts("coupling") == ["ice", "ice", "mpm", "mpm"] and cases.units["run_seconds"] == "s"
    error = cases.numbers("l1_density", coupling="ice")
    close(floe.order(cases.numbers("h", coupling="ice"), error)[0], math.log(error[0] / error[1]) / math.log(2))
    close(cases.results(coupling="mpm")[0].summary["errors"]["l1_density"], cases.numbers("l1_density", coupling="mpm")[0])
    refused(KeyError, "no column nothing", cases.numbers, "nothing")


def test_tables():
    assert floe.markdown(["a", "b"], [["x|y", 0.12345]]) == ["| a | b |", "|---|---|", "| x\\|y | 0.123 |"]
    assert floe.percent(0.0123) == "1.23 %" and floe.figure(math.nan) == "-"
    refused(ValueError, "2 cells", floe.markdown, ["a"], [[1, 2]])


def test_plots():
    """The same numbers are the same bytes."""
    x = numpy.linspace(0.1, 1, 20)
    with tempfile.TemporaryDirectory() as place:
        pages = [pathlib.Path(place) / name for name in ("one.svg", "two.svg")]
        for page in pages:
            plots.lines(page, {"ice": (x, x ** 2), "exact": (x, x, plots.EXACT)}, plots.label("h", "m"), "error", log=True)
        assert pages[0].read_bytes() == pages[1].read_bytes() and b"<svg" in pages[0].read_bytes()


def test_labels():
    """Texts beside points stay inside the panel: at its right end they stand to the left."""
    from matplotlib.figure import Figure as Paper
    axes = Paper().subplots()
    axes.set_xlim(0, 1)
    for x in (0.1, 0.95):
        figures._label(axes, x, 0.5, "0.025")
    assert [(one.get_ha(), one.xyann[0]) for one in axes.texts] == [("left", 5), ("right", -5)]


def test_answers():
    """What to choose for a level of error has the unit of the errors beside it."""
    class Cases:
        error_text = staticmethod(lambda metric, value: units.number(value, "Pa"))
    told = {"metric": "l1_p", "target": 5e4, "text": "for 50000 Pa in l1_p choose mpm, 0.1 s"}
    assert report._answer(told, Cases) == "For 50 kPa in l1_p choose mpm, 0.1 s."
    assert report._answer({"metric": "l1_p", "target": 5e4, "text": "none reaches 50000 Pa"}, Cases) == "None reaches 50000 Pa."


for name, test in list(globals().items()):
    if name.startswith("test_"):
        test()
        print("passed:", name)
