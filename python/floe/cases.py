"""The table of cases that `floe study` and `floe compare` write, and orders of what is in it."""
import math
import pathlib

import numpy

from .results import Result, number, read_csv, split_title
from .tables import Table


def order(h, error):
    """Slope of log(error) over log(h) by least squares, and its standard error: (NaN, NaN) of fewer than two values
    above zero, a standard error of NaN of two."""
    pairs = [(math.log(a), math.log(b)) for a, b in zip(h, error) if a > 0 and b > 0]
    if len(pairs) < 2:
        return math.nan, math.nan
    x, y = numpy.array(pairs).T
    x, y = x - x.mean(), y - y.mean()
    slope = float(x @ y / (x @ x))
    rest = y - slope * x
    return slope, math.sqrt(float(rest @ rest) / (len(x) - 2) / float(x @ x)) if len(x) > 2 else math.nan


class Cases:
    """study.csv or compare.csv of a folder: a row a case, in its order."""

    def __init__(self, folder):
        self.folder = pathlib.Path(folder)
        found = [self.folder / (stem + ".csv") for stem in ("study", "compare") if (self.folder / (stem + ".csv")).is_file()]
        if not found:
            raise FileNotFoundError(f"{self.folder}: neither study.csv nor compare.csv")
        titles, rows = read_csv(found[0])
        self.units = dict(split_title(title) for title in titles)       #: unit by name of a column
        self.rows = [dict(zip(self.units, row)) for row in rows]        #: text by name of a column

    def texts(self, name, **where):
        """A column as it is written, of the rows that have the texts of `where`: texts("h", coupling="ice")."""
        if name not in self.units:
            raise KeyError(f"{self.folder}: no column {name}; there are: {', '.join(self.units)}")
        return [row[name] for row in self.rows if all(row[key] == value for key, value in where.items())]

    def numbers(self, name, **where):
        """The same as an array of shape (cases,); NaN where there is no number."""
        return numpy.array([number(text) for text in self.texts(name, **where)])

    def table(self, *names, **where):
        """Columns beside each other, of the rows that have the texts of `where`: a floe.Table. Numbers are short; units stand in the header."""
        def cell(text):
            return number(text) if not math.isnan(number(text)) else text
        header = [name if self.units[name] == "1" else f"{name} ({self.units[name]})" for name in names if self.texts(name) is not None]
        return Table(header, zip(*([cell(text) for text in self.texts(name, **where)] for name in names)))

    def results(self, **where):
        """The result folders of those rows."""
        return [Result(self.folder / text) for text in self.texts("directory", **where)]
