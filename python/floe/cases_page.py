"""The cases of a comparison or a study as a page shows them: in words, as figures of errors, as rows of a table."""
import dataclasses
import math

import numpy

from . import units
from .figures import Figure, Panel, Series


def number_of(found: object) -> float:
    """A number of JSON; NaN where there is none."""
    return float(found) if isinstance(found, (int, float)) and not isinstance(found, bool) else math.nan


def is_done(status: str) -> bool:
    return status in ("done", "at_rest")


@dataclasses.dataclass
class Case:
    run: dict                  # its summary, with directory, axis and settings
    variant: str               # all that tells it from others but its place on the curve: "mpm, method.basis=gimp"
    value: str                 # of what is varied along a curve: "0.05"; "" for nothing
    h: float                   # spacing (m)
    cpu: float                 # processor time without outputs (s): the best of its timed runs, or that of its only one
    wall: float                # run time without outputs (s)
    disturbed: bool            # others used the machine while it was timed
    colour: int = 0            # of its variant

    @property
    def status(self) -> str:
        return str(self.run.get("status", ""))

    @property
    def directory(self) -> str:
        return str(self.run.get("directory", ""))

    def error(self, metric: str) -> float:
        """Its error if it came to its end, else NaN."""
        return number_of(self.run.get("errors", {}).get(metric)) if is_done(self.status) else math.nan

    def quantity(self, name: str) -> float:
        return number_of(self.run.get("quantities", {}).get(name)) if is_done(self.status) else math.nan

    def setting(self, key: str) -> str:
        for place in (self.run.get("settings", {}), self.run.get("axis", {}), self.run):
            if isinstance(place.get(key), str):
                return place[key]
        return ""


def _case(run: dict) -> Case:
    timing, output = run.get("timing") or {}, number_of(run.get("output_seconds"))
    best, cpu = number_of(timing.get("best")), number_of(timing.get("cpu"))
    wall = number_of(run.get("wall_seconds")) - (output if math.isfinite(output) else 0.0)
    wall = best if math.isfinite(best) else wall
    cpu = cpu if math.isfinite(cpu) else number_of(run.get("cpu_seconds"))
    value = next((str(one) for one in (run.get("axis") or {}).values()), "")
    return Case(run, run.get("group") or run.get("coupling") or "", value, number_of(run.get("h")), cpu if math.isfinite(cpu) else wall, wall,
                bool(timing.get("disturbed")))


class CaseList:
    """The cases of study.json or compare.json."""

    def __init__(self, told: dict):
        runs = [run for run in told.get("runs", []) if isinstance(run, dict)]
        self.cases = [_case(run) for run in runs]
        self.axis = next((key for run in runs for key in run.get("axis") or {}), "")     #: what is varied along a curve: "domain.cell"
        self.axes = [one["key"] for one in told.get("axes", []) if "key" in one] or ["coupling"] + ([self.axis] if self.axis else [])
        self.metrics = list(dict.fromkeys(name for run in runs for name in run.get("errors", {})))[:16]
        self.quantities = list(dict.fromkeys(name for run in runs for name in run.get("quantities", {})))[:16]
        self.dimensionless = any(run.get("units") == "none" for run in runs)
        self.variants = list(dict.fromkeys(case.variant for case in self.cases))
        for case in self.cases:
            case.colour = self.variants.index(case.variant)
        places = {case.h for case in self.cases if math.isfinite(case.h)}
        self.along_h = len(places) > 1
        self.along_value = not self.along_h and bool(self.cases) and all(math.isfinite(self._value(case)) for case in self.cases)

    @staticmethod
    def _value(case: Case) -> float:
        try:
            return float(case.value)
        except ValueError:
            return math.nan

    def place(self, case: Case) -> float:
        """Where a case stands on the axis; NaN when that is no number."""
        return case.h if self.along_h else self._value(case) if self.along_value else math.nan

    @property
    def place_label(self) -> str:
        return ("spacing h" + ("" if self.dimensionless else " (m)")) if self.along_h else self.axis

    def title(self, case: Case) -> str:
        return case.variant + (f", {self.axis} = {case.value}" if case.value else "")

    def error_text(self, metric: str, value: float) -> str:
        return units.error_text(metric, value, self.dimensionless)

    def least(self, metric: str) -> Case | None:
        """The case of least error."""
        found = [case for case in self.cases if math.isfinite(case.error(metric))]
        return min(found, key=lambda case: case.error(metric), default=None)

    def front(self, metric: str) -> list[Case]:
        """The cases that no other beats in both error and processor time, by rising time."""
        known = [case for case in self.cases if math.isfinite(case.error(metric)) and math.isfinite(case.cpu)]

        def beats(a: Case, b: Case) -> bool:
            return a.error(metric) <= b.error(metric) and a.cpu <= b.cpu and (a.error(metric) < b.error(metric) or a.cpu < b.cpu)

        return sorted((case for case in known if not any(beats(other, case) for other in known)), key=lambda case: case.cpu)

    def finest(self) -> list[Case]:
        """Of each variant the finest case that came to its end."""
        out = []
        for variant in self.variants:
            done = [case for case in self.cases if case.variant == variant and is_done(case.status)]
            if done:
                out.append(min(done, key=lambda case: case.h if math.isfinite(case.h) else 0.0))
        return out

    def _series(self, k: int, x_of, y_of, labelled: bool = False) -> Series:
        mine = [case for case in self.cases if case.colour == k and math.isfinite(y_of(case))]
        mine.sort(key=x_of)
        style = "linespoints" if self.along_h or self.along_value else "points"
        labels = [case.value for case in mine] if labelled and any(case.value for case in mine) else None
        return Series(self.variants[k], numpy.array([x_of(one) for one in mine]), numpy.array([y_of(one) for one in mine]), style, k, labels=labels)

    def error_figures(self, stem: str) -> list[Figure]:
        """Of each metric the error over the spacing (or another number) and over the processor time."""
        if len(self.cases) < 2:
            return []
        out = []
        for metric in self.metrics:
            scale, unit = 100.0, "%"
            if not units.is_relative(metric):
                known = [case.error(metric) for case in self.cases if math.isfinite(case.error(metric))]
                unit = units.metric_unit(metric, self.dimensionless)
                factor, unit = units.choose(max(known, default=0.0), unit) if unit else (1.0, "")
                scale = 1 / factor
            label = f"{metric} ({unit})" if unit else metric

            def error(case: Case) -> float:
                return scale * case.error(metric)

            if not any(error(case) > 0 for case in self.cases):
                continue
            if self.along_h or self.along_value:
                log = all(self.place(case) > 0 for case in self.cases)
                panel = Panel(x_label=self.place_label, y_label=label, log_x=log, log_y=True, slopes=[1, 2] if self.along_h else [])
                panel.series = [self._series(k, self.place, error) for k in range(len(self.variants))]
                out.append(Figure(f"{stem}-{metric}-place", f"{metric} over {'the spacing' if self.along_h else self.axis}", [panel]))
            panel = Panel(x_label="processor time without outputs (s)", y_label=label, log_x=all(case.cpu > 0 for case in self.cases), log_y=True)
            panel.series = [self._series(k, lambda case: case.cpu, error, labelled=len(self.variants) <= 3) for k in range(len(self.variants))]
            front = self.front(metric)
            panel.series.append(Series("best for their time", numpy.array([case.cpu for case in front]), numpy.array([error(case) for case in front]), "linespoints", emphasis=True))
            out.append(Figure(f"{stem}-{metric}-time", f"{metric} over processor time", [panel]))
        return out

    def quantity_figures(self, stem: str) -> list[Figure]:
        """Quantities at the end of the history over the spacing."""
        if not (self.along_h or self.along_value):
            return []
        out = []
        for name in self.quantities:
            panel = Panel(x_label=self.place_label, y_label=units.words(name))
            panel.series = [self._series(k, self.place, lambda case: case.quantity(name)) for k in range(len(self.variants))]
            out.append(Figure(f"{stem}-quantity-{name}", f"{units.words(name)} at the end".capitalize(), [panel]))
        return out
