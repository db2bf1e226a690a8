"""A result folder: summary, history, and snapshots with their fields and points."""
import csv
import functools
import json
import math
import pathlib
from typing import NamedTuple

import h5py
import numpy


class Quantity(NamedTuple):
    """Numbers with what they are. `unit` is "1" where they have none."""
    values: numpy.ndarray
    unit: str
    meaning: str = ""


def number(text):
    """A number from text; NaN where it is none."""
    try:
        return float(text)
    except ValueError:
        return math.nan


def split_title(title):
    """Name and unit of a column's title: "time (s)" is ("time", "s"), "steps" is ("steps", "1")."""
    name, _, unit = title.partition(" (")
    return name, unit[:-1] if unit else "1"


def read_csv(path):
    """Titles and rows of a CSV file, as text."""
    with open(path, newline="", encoding="utf-8") as file:
        rows = list(csv.reader(file))
    return rows[0], rows[1:]


class Result:
    """The folder that `floe run -o` fills. Files are read when they are asked for, and once."""

    def __init__(self, folder):
        self.folder = pathlib.Path(folder)
        if not (self.folder / "summary.json").is_file():
            raise FileNotFoundError(f"{self.folder}: no summary.json, so no result of a run that has ended")

    @functools.cached_property
    def summary(self):
        """summary.json: status, time (s), steps, wall_seconds, errors {metric: value}, conservation, counters, ..."""
        return json.loads((self.folder / "summary.json").read_text(encoding="utf-8"))

    @functools.cached_property
    def history(self):
        """history.csv: Quantity by name, each of shape (rows,); columns of words are NaN."""
        titles, rows = read_csv(self.folder / "history.csv")
        columns = {}
        for k, title in enumerate(titles):
            name, unit = split_title(title)
            columns[name] = Quantity(numpy.array([number(row[k]) for row in rows]), unit)
        return columns

    @functools.cached_property
    def snapshots(self):
        """All snapshots, earliest first."""
        return sorted((Snapshot(path) for path in (self.folder / "fields").glob("*.h5")), key=lambda one: one.time)

    def at(self, time):
        """The snapshot nearest to a time (s); the last one at `math.inf`."""
        if not self.snapshots:
            raise FileNotFoundError(f"{self.folder}: no snapshots")
        return min(self.snapshots, key=lambda one: abs(one.time - time)) if math.isfinite(time) else self.snapshots[-1]


def dataset(file, path):
    """A dataset of the file itself: what leads into other files is not followed."""
    for k in range(len(path.split("/"))):
        link = "/".join(path.split("/")[:k + 1])
        if link not in file or not isinstance(file.get(link, getlink=True), h5py.HardLink):
            raise KeyError(f"{file.filename}: no {path}")
    found = file[path]
    if not isinstance(found, h5py.Dataset) or found.external:
        raise KeyError(f"{file.filename}: no {path}")
    return found


class Snapshot:
    """One file of fields/: the state at a time. The file is open only while it is read."""

    def __init__(self, path):
        self.path = pathlib.Path(path)
        with h5py.File(self.path, "r") as file:
            if file.attrs.get("content") != "floe snapshot":
                raise ValueError(f"{self.path}: no snapshot of floe")
            attrs = dict(file.attrs)
            self.time = float(attrs["time"])                   #: s, or 1 of a scene without units
            self.step = int(attrs["step"])                     #: steps until then
            self.coupling = str(attrs["coupling"])             #: mpm, ice, ice-mpm
            self.geometry = str(attrs["geometry"])             #: cartesian, axisymmetric
            self.length_unit = str(attrs["length_unit"])
            self.lower = numpy.atleast_1d(attrs["domain_lower"])     #: of the domain, shape (dim,)
            self.upper = numpy.atleast_1d(attrs["domain_upper"])
            self.spacing = numpy.atleast_1d(attrs["cell"])           #: of the cells, shape (dim,)
            self.dim = len(self.lower)
            self.fields = sorted(file["cells"]) if "cells" in file else []                #: names of fields of cells
            self.bodies = {body: sorted(file["points"][body]) for body in file.get("points", {})}  #: body: names of its quantities

    def field(self, name):
        """A field of the cells: values[i], [i, j] or [i, j, k] by the scene's dimension, i along x; vectors have a last axis of 3."""
        with h5py.File(self.path, "r") as file:
            found = dataset(file, "cells/" + name)
            values, attrs = found[()], dict(found.attrs)
        vector = values.ndim == 4
        values = values.transpose((2, 1, 0, 3) if vector else (2, 1, 0))
        values = values.reshape(values.shape[:self.dim] + values.shape[3:])
        return Quantity(values, str(attrs.get("unit", "1")), str(attrs.get("meaning", "")))

    def centres(self, axis=0):
        """Centres of the cells along an axis, shape (cells,)."""
        count = round(float((self.upper[axis] - self.lower[axis]) / self.spacing[axis]))
        return Quantity(self.lower[axis] + (numpy.arange(count) + 0.5) * self.spacing[axis], self.length_unit)

    def points(self, body, name):
        """A quantity of a body's points: shape (points,), vectors (points, 3). Points have no order that lasts; `id` has names."""
        with h5py.File(self.path, "r") as file:
            found = dataset(file, f"points/{body}/{name}")
            return Quantity(found[()], str(found.attrs.get("unit", "1")), str(found.attrs.get("meaning", "")))
