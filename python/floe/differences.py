"""What two runs have apart: the columns of their histories, and the fields of their snapshots, at the same times.

    differ = differences.between("out/a", "out/b")
    print(differ.table())            # largest share first
"""
import math
from typing import Callable, NamedTuple

import numpy

from .files import Refused
from .results import Quantity
from .snapshots import Run, SealedSnapshot, snapshot_files

#: Columns that are round-off in a good run: they are shown last, and do not count.
ROUND_OFF = ("drift_", "largest_drift_")
#: Times are the same to this share of the later one.
SAME_TIME = 1e-9


class Difference(NamedTuple):
    """One quantity."""
    name: str      #: kinetic, cells/pressure, points/ring/velocity
    unit: str
    largest: float #: difference
    size: float    #: the largest that either run has of it at all
    time: float    #: of the largest difference

    @property
    def share(self) -> float:
        """The largest difference over the size; 0 where both are the same."""
        if self.largest == 0:
            return 0.0
        return self.largest / self.size if self.size > 0 else math.inf

    def with_later(self, other: "Difference") -> "Difference":
        """Of two times: the larger difference, and the larger size."""
        return max(self, other, key=lambda one: one.largest)._replace(size=max(self.size, other.size))


class Differences(NamedTuple):
    """All quantities that both runs have; `alone`: those that one has, with its number (0, 1)."""
    quantities: list[Difference]
    alone: list[tuple[str, int]]
    rows: int          #: of the histories, that were compared
    snapshots: int     #: pairs of them

    @property
    def share(self) -> float:
        """The largest of all but drifts."""
        return max((one.share for one in self.quantities if not one.name.startswith(ROUND_OFF)), default=0.0)

    def lone(self, run: int, most: int | None = None) -> str:
        """The names that one run alone has: "a, b, c and 4 more"; "" where there are none."""
        names = [name for name, of in self.alone if of == run]
        shown = names[:most]
        return ", ".join(shown) + (f" and {len(names) - len(shown)} more" if len(names) > len(shown) else "")

    def table(self, most: int | None = None) -> str:
        """The quantities that differ, largest share first and drifts last, in columns of 80 letters."""
        found = sorted((one for one in self.quantities if one.share > 0), key=lambda one: (one.name.startswith(ROUND_OFF), -one.share))
        lines = [f"{'quantity':40s} {'largest difference':>20s} {'of largest':>10s} {'at':>8s}"] if found else []
        for one in found[:most]:
            size = f"{one.largest:.3g}" + (f" {one.unit}" if one.unit != "1" else "")
            name = one.name if len(one.name) <= 40 else one.name[:18] + "..." + one.name[-19:]
            lines.append(f"{name:40s} {size:>20s} {one.share:>10.2g} {one.time:>8.3g}")
        if most is not None and len(found) > most:
            lines.append(f"and {len(found) - most} more (--all)")
        return "\n".join(lines)


def _compare(name: str, unit: str, a: numpy.ndarray, b: numpy.ndarray, times: numpy.ndarray) -> Difference:
    """Two arrays whose first axis is time. What is no number in both is the same; in one of them, it is all apart."""
    shape = (len(times), -1)
    a, b = (numpy.reshape(one.astype(float), shape) for one in (a, b))
    with numpy.errstate(invalid="ignore"):
        apart = numpy.abs(a - b)
    apart[(a == b) | (numpy.isnan(a) & numpy.isnan(b))] = 0
    apart[numpy.isnan(apart)] = math.inf
    sizes = numpy.abs(numpy.concatenate([a.ravel(), b.ravel()]))
    size = float(numpy.max(sizes[numpy.isfinite(sizes)], initial=0.0))
    if not apart.any():
        return Difference(name, unit, 0.0, size, math.nan)
    return Difference(name, unit, float(apart.max()), size, float(times[apart.max(axis=1).argmax()]))


def _same_times(a: numpy.ndarray, b: numpy.ndarray) -> tuple[list[int], list[int]]:
    """Places of the times that both have; both rise."""
    i = j = 0
    found: tuple[list[int], list[int]] = ([], [])
    while i < len(a) and j < len(b):
        if abs(a[i] - b[j]) <= SAME_TIME * max(abs(a[i]), abs(b[j])):
            found[0].append(i)
            found[1].append(j)
            i, j = i + 1, j + 1
        elif a[i] < b[j]:
            i += 1
        else:
            j += 1
    return found


def _histories(a: Run, b: Run) -> tuple[list[Difference], list[tuple[str, int]], int]:
    """Rows at the same times; where the runs have less than half of their rows so, the second one's between its rows."""
    one, two = a.history, b.history
    if "time" not in one or "time" not in two:
        return [], [], 0
    alone = [(name, 0) for name in one if name not in two] + [(name, 1) for name in two if name not in one]
    first, second = one["time"].values, two["time"].values
    rows, others = _same_times(first, second)
    between = 2 * len(rows) < min(len(first), len(second))
    if between:
        rows = [k for k, time in enumerate(first) if second[0] <= time <= second[-1]]
    times, out = first[rows], []
    for name in one:
        if name in ("time", "steps") or name not in two:
            continue
        values = numpy.interp(times, second, two[name].values) if between else two[name].values[others]
        out.append(_compare(name, one[name].unit, one[name].values[rows], values, times))
    return out, alone, len(rows)


class _Ordered:
    """A snapshot's quantities with its points by their id: they have no order that lasts."""

    def __init__(self, snapshot: SealedSnapshot):
        self.snapshot, self.names = snapshot, _names(snapshot)
        self.order = {body: numpy.argsort(snapshot.read(body, "id").values, kind="stable") for body in snapshot.bodies}

    def read(self, name: str) -> Quantity:
        body, field = self.names[name]
        found = self.snapshot.read(body, field)
        return found if body is None else found._replace(values=found.values[self.order[body]])


def _names(snapshot: SealedSnapshot) -> dict[str, tuple[str | None, str]]:
    out: dict[str, tuple[str | None, str]] = {f"cells/{name}": (None, name) for name in snapshot.fields}
    out.update({f"points/{body}/{name}": (body, name) for body, names in snapshot.bodies.items() for name in names if name not in ("id", "index")})
    return out


def _snapshots(a: Run, b: Run, warn: Callable[[str], None]) -> tuple[list[Difference], list[tuple[str, int]], int]:
    worst: dict[str, Difference] = {}
    alone: dict[tuple[str, int], None] = {}
    one, two = ([SealedSnapshot(path) for path in snapshot_files(run.folder)] for run in (a, b))
    rows, others = _same_times(numpy.array([k.time for k in one]), numpy.array([k.time for k in two]))
    for i, j in zip(rows, others):
        first, second, time = _Ordered(one[i]), _Ordered(two[j]), one[i].time
        alone.update({(name, 0): None for name in first.names if name not in second.names} | {(name, 1): None for name in second.names if name not in first.names})
        for name in first.names:
            if name not in second.names:
                continue
            mine, theirs = first.read(name), second.read(name)
            if mine.values.shape != theirs.values.shape:
                body = first.names[name][0]
                what = "cells" if body is None else f"points of '{body}'"
                warn(f"{name} is left out at {time:.3g}: the runs have other {what} ({len(mine.values)} and {len(theirs.values)} along the first axis)")
                continue
            found = _compare(name, mine.unit, mine.values[None], theirs.values[None], numpy.array([time]))
            worst[name] = worst[name].with_later(found) if name in worst else found
    return list(worst.values()), list(alone), len(rows)


def between(a: str, b: str, warn: Callable[[str], None] = lambda text: None) -> Differences:
    """Compares the folders of two runs; `warn(text)` is told what cannot be compared."""
    runs = Run(a, {}), Run(b, {})
    for folder, run in zip((a, b), runs):
        if not run.history and not snapshot_files(folder):
            raise Refused(f"'{folder}' holds no history.csv and no snapshots: is it the folder of a run?")
    history, lone_columns, rows = _histories(*runs)
    fields, lone_fields, pairs = _snapshots(*runs, warn)
    if rows == 0 and pairs == 0:
        raise Refused(f"'{a}' and '{b}' have no times in common", 2)
    return Differences(history + fields, lone_columns + lone_fields, rows, pairs)
