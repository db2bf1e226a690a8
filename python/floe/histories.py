"""A run's history.csv and profile.csv as figures: one a subject, with people's units; and its ledger as a table."""
import dataclasses
import math
import pathlib

import numpy

from . import units
from .figures import Figure, Panel, Series
from .results import Quantity
from .snapshots import Run, table


@dataclasses.dataclass
class Group:
    """What stands in one plot: columns by their full names, or by how they begin (those that end in "_")."""
    name: str
    title: str
    columns: tuple[str, ...]
    y_label: str
    log: bool = False


GROUPS = [
    Group("energies", "Energy", ("kinetic", "strain", "internal"), "energy"),
    Group("materials", "Energy by material", ("kinetic_", "strain_", "internal_"), "energy"),
    Group("pressure", "Mean pressure of the fluids", ("pressure_",), "pressure"),
    Group("centre", "Centres of the bodies", ("centre_",), "position"),
    Group("velocity", "Mean velocity of the bodies", ("velocity_",), "velocity"),
    Group("momentum", "Momentum", ("momentum_",), "momentum"),
    Group("angular", "Angular momentum of the bodies", ("angular_momentum_",), "angular momentum"),
    Group("mass", "Mass", ("mass", "mass_", "gas_in_solids"), "mass"),
    Group("volume", "Volume", ("volume_",), "volume"),
    Group("step", "Time step", ("dt",), "time step", log=True),
    Group("drifts", "Drift of what is conserved", ("drift_",), "drift", log=True),
]
_NOT_PLOTTED = ("time", "steps", "rejected_steps", "dt_limit", "ledger_", "largest_drift_")
#: Of many cases side by side: what tells them apart.
BRIEF = ("energies", "pressure")


def _is_of(name: str, columns: tuple[str, ...]) -> bool:
    return any(name.startswith(one) if one.endswith("_") else name == one for one in columns)


def _size(values: numpy.ndarray) -> float:
    finite = values[numpy.isfinite(values)]
    return float(abs(finite).max()) if len(finite) else 0.0


def _is_worth(values: numpy.ndarray, group: str) -> bool:
    """A curve when it is not all zero or missing; a mass only when it changes."""
    size = _size(values)
    return size > 0 and (group != "mass" or bool((abs(values - values[0]) > 1e-9 * size).any()))


def _probes(history: dict[str, Quantity]) -> list[Group]:
    """What no group has, a group for each unit."""
    rest = [name for name in history if not _is_of(name, _NOT_PLOTTED) and not any(_is_of(name, one.columns) for one in GROUPS)]
    found = list(dict.fromkeys(history[name].unit for name in rest))
    return [Group(f"probes-{k}", "Probes", tuple(name for name in rest if history[name].unit == unit), "value") for k, unit in enumerate(found[:6])]


def is_log(sizes: list[float], least: float, always: bool) -> bool:
    """Sizes that differ by more than a thousand are shown on a logarithmic axis, where nothing is negative."""
    return always or (len(sizes) > 1 and max(sizes) > 1e3 * min(sizes) and least >= 0)


def _curve_name(column: str, group: Group) -> str:
    """The name of a curve, without what the title says."""
    prefix = next((one for one in group.columns if one.endswith("_") and column.startswith(one)), "")
    if len(group.columns) == 1 and prefix:
        return column[len(prefix):].replace("_", " ")
    return f"{prefix[:-1]}, {column[len(prefix):].replace('_', ' ')}" if prefix else column.replace("_", " ")


def _panel(curves: list[tuple[str, Quantity, Quantity, int]], label: str, log: bool) -> Panel:
    """Curves (name, time, values, colour) with what they are shown in."""
    ends = [one[1].values[-1] for one in curves if len(one[1].values)]
    time = units.shown(0, max(ends, default=1.0), curves[0][1].unit, offset=False)
    sizes = [_size(one[2].values) for one in curves]
    least = min(float(numpy.nanmin(one[2].values)) for one in curves)
    always, log = log, is_log(sizes, least, log)
    y = units.shown(least, max(float(numpy.nanmax(one[2].values)) for one in curves), curves[0][2].unit, offset=not log)
    if log and curves[0][2].unit == "1":
        y = units.Shown(1.0, "")
    panel = Panel(x_label=units.label("time", time), y_label=units.label(label, y), log_y=log, floor=0.0 if always else 1e-6)
    panel.series = [Series(name, time.of(at.values), y.of(one.values), colour=colour) for name, at, one, colour in curves]
    return panel


def history_figures(result: Run, stem: str) -> list[Figure]:
    """A figure for each subject of a run's history."""
    history, out = result.history, []
    for group in GROUPS + _probes(history):
        names = [name for name in history if _is_of(name, group.columns) and not _is_of(name, _NOT_PLOTTED) and _is_worth(history[name].values, group.name)][:16]
        if names and len(history["time"].values) > 1:
            curves = [(_curve_name(name, group), history["time"], history[name], k) for k, name in enumerate(names)]
            out.append(Figure(f"{stem}-{group.name}", group.title, [_panel(curves, group.y_label, group.log)]))
    return out


def compared_histories(results: list[tuple[str, int, Run]], stem: str) -> list[Figure]:
    """Histories of several runs (name, colour, result), a figure for each column that tells them apart."""
    out = []
    for column, title in (("kinetic", "Kinetic energy"), ("strain", "Strain energy"), ("internal", "Internal energy"), ("drift_energy", "Drift of energy")):
        curves = []
        for name, colour, result in results:
            history = result.history
            if column in history and "time" in history and len(history["time"].values) > 1 and _size(history[column].values) > 0:
                curves.append((name, history["time"], history[column], colour))
        if len(curves) > 1:
            out.append(Figure(f"{stem}-{column}", f"{title}, case by case", [_panel(curves, units.words(column), column == "drift_energy")]))
    return out


# ---- profiles ----

def profile_figures(path: pathlib.Path, stem: str, by: str | None = None) -> list[Figure]:
    """A figure for each quantity of profile.csv that has an exact value; `by`: the column whose values are runs to be told apart."""
    columns = table(path)
    at = next((columns[name][:2] + (name,) for name in ("r", "x") if name in columns), None)
    runs = columns[by][2] if by in columns else ["floe"] * len(next(iter(columns.values()), ([],))[0])
    out: list[Figure] = []
    for name, (values, unit, _) in columns.items():
        if at is None or "exact_" + name not in columns or not len(values):
            continue
        factor, shown = units.choose(max(_size(values), _size(columns["exact_" + name][0])), unit)
        x_factor, x_unit = units.choose(_size(at[0]), at[1])
        panel = Panel(x_label=f"{at[2]} ({x_unit})" if x_unit else at[2], y_label=f"{units.words(name)} ({shown})" if shown else units.words(name))
        for k, run in enumerate(list(dict.fromkeys(runs))[:8]):
            mine = numpy.array([one == run for one in runs])
            panel.series.append(Series(run, at[0][mine] / x_factor, values[mine] / factor, "points", k))
        order = numpy.argsort(at[0])
        panel.series.append(Series("exact", at[0][order] / x_factor, columns["exact_" + name][0][order] / factor, emphasis=True))
        out.append(Figure(f"{stem}-profile-{name}", f"{units.words(name)}, beside the exact solution".capitalize(), [panel]))
    return out[:12]


# ---- the ledger ----

_LEDGER = ("mass", "momentum_x", "momentum_y", "momentum_z", "momentum_r", "momentum_t", "energy")
_KINDS = ("boundary", "source", "damping", "defect")


def ledger(result: Run) -> list[tuple]:
    """Rows of what there was, what came and went, and what there is: (name, unit, start, (through the boundary, from sources, taken by
    damping, lost to floors and guards), end, drift)."""
    history, out = result.history, []

    def value(name: str, row: int) -> float:
        if name == "energy":
            return value("kinetic", row) + value("strain", row) + value("internal", row)
        return float(history[name].values[row]) if name in history else math.nan

    for name in _LEDGER:
        if f"ledger_{name}_boundary" in history and len(history["time"].values):
            unit = units.plain_unit(history[f"ledger_{name}_boundary"].unit)
            kinds = tuple(value(f"ledger_{name}_{kind}", -1) for kind in _KINDS)
            out.append((name.replace("_", " "), unit, value(name, 0), kinds, value(name, -1), value(f"drift_{name}", -1)))
    return out


def step_limits(result: Run) -> list[tuple[str, float]]:
    """What bounded the time step, and the share of steps: the most frequent first."""
    limits, steps = result.columns.get("dt_limit", ([], "", []))[2], result.columns.get("steps", ([], "", []))[0]
    taken: dict[str, float] = {}
    for k in range(1, min(len(limits), len(steps))):
        taken[limits[k]] = taken.get(limits[k], 0.0) + float(steps[k] - steps[k - 1])
    total = sum(taken.values())
    return sorted(((name, steps / total) for name, steps in taken.items()), key=lambda one: -one[1]) if total > 0 else []
