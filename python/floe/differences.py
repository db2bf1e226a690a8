"""What two runs have apart: the columns of their histories, and the fields of their snapshots, at the same times.

    differ = differences.between("out/a", "out/b")
    print(differ.table())            # largest share first
"""
import math
from typing import Callable, NamedTuple

import numpy

from .files import Refused
from .snapshots import Run, SealedSnapshot, snapshot_files

#: Columns that are round-off in a good run: they are shown last, and do not count.
ROUND_OFF = ("drift_", "largest_drift_")
#: Times are the same to this share of the later one.
SAME_TIME = 1e-9


class Difference(NamedTuple):
    """One quantity. `share`: the largest difference over the largest size that either run has of it at all; 0 where both are the same."""
    name: str      #: kinetic, cells/pressure, points/ring/velocity
    unit: str
    largest: float
    share: float
    time: float    #: of the largest difference


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
    if apart.size == 0 or not apart.any():
        return Difference(name, unit, 0.0, 0.0, math.nan)
    sizes = numpy.abs(numpy.concatenate([a.ravel(), b.ravel()]))
    largest, size = float(apart.max()), float(numpy.max(sizes[numpy.isfinite(sizes)], initial=0.0))
    return Difference(name, unit, largest, largest / size if size > 0 else math.inf, float(times[apart.max(axis=1).argmax()]))


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


def _by_id(snapshot: SealedSnapshot, body: str, name: str) -> numpy.ndarray:
    """Points have no order that lasts."""
    return snapshot.read(body, name).values[numpy.argsort(snapshot.read(body, "id").values, kind="stable")]


def _names(snapshot: SealedSnapshot) -> dict[str, tuple[str | None, str]]:
    out: dict[str, tuple[str | None, str]] = {f"cells/{name}": (None, name) for name in snapshot.fields}
    out.update({f"points/{body}/{name}": (body, name) for body, names in snapshot.bodies.items() for name in names if name not in ("id", "index")})
    return out


def _snapshots(a: Run, b: Run, warn: Callable[[str], None]) -> tuple[list[Difference], list[tuple[str, int]], int]:
    worst: dict[str, Difference] = {}
    sizes: dict[str, float] = {}
    alone: dict[tuple[str, int], None] = {}
    one, two = ([SealedSnapshot(path) for path in snapshot_files(run.folder)] for run in (a, b))
    rows, others = _same_times(numpy.array([k.time for k in one]), numpy.array([k.time for k in two]))
    for first, second in zip((one[k] for k in rows), (two[k] for k in others)):
        mine, theirs = _names(first), _names(second)
        alone.update({(name, 0): None for name in mine if name not in theirs} | {(name, 1): None for name in theirs if name not in mine})
        for name, (body, field) in mine.items():
            if name not in theirs:
                continue
            quantity, other = first.read(body, field), second.read(body, field)
            if quantity.values.shape != other.values.shape:
                what = "cells" if body is None else f"points of '{body}'"
                warn(f"{name} is left out at {first.time:.3g}: the runs have other {what} ({len(quantity.values)} and {len(other.values)} along the first axis)")
                continue
            x, y = (quantity.values, other.values) if body is None else (_by_id(first, body, field), _by_id(second, body, field))
            found = _compare(name, quantity.unit, x[None], y[None], numpy.array([first.time]))
            finite = numpy.abs(numpy.concatenate([x.ravel(), y.ravel()]))
            sizes[name] = max(sizes.get(name, 0.0), float(numpy.max(finite[numpy.isfinite(finite)], initial=0.0)))
            if name not in worst or found.largest > worst[name].largest:
                worst[name] = found
    out = [one._replace(share=0.0 if one.largest == 0 else one.largest / sizes[name] if sizes[name] > 0 else math.inf) for name, one in worst.items()]
    return out, list(alone), len(rows)


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
