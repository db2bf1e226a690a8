"""Verdicts of scripts/lib/verdict.py on errors and times that are known."""
import math
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "scripts/lib"))
from verdict import Point, secured, time_to, verdict  # noqa: E402


def power(rate, cost, order=1.0, scatter=0.02, floor=0.0):
    """Errors rate h^order in times cost h^-2."""
    return [Point(h, rate * h ** order, cost * h ** -2, scatter, floor) for h in (0.4, 0.2, 0.1)]


def has(text, *words):
    for word in words:
        assert word in text, (text, word)


# By interpolation: 5 % at h = 0.25, 16 times the cost of h = 1.
cpu, first = time_to(secured(power(0.2, 1.0), 0.0), 0.05)
assert abs(cpu - 16.0) < 1e-9 and not first
# Neither reached nor extrapolated; by the coarsest mesh only "at most".
assert math.isnan(time_to(secured(power(0.2, 1.0), 0.0), 0.001)[0]) and time_to(secured(power(0.2, 1.0), 0.0), 0.5)[1]
has(verdict({"a": power(0.2, 1.0), "b": power(0.2, 3.0)}, 0.05), "**a**, 16 s (16 to 16)", "b needs 3 times that")
has(verdict({"a": power(0.2, 1.0), "b": power(0.2, 3.0)}, 0.5), "at most 6.2 s")
has(verdict({"a": power(0.2, 1.0), "b": power(0.9, 1.0)}, 0.05), "not reached by b")
has(verdict({"a": power(0.2, 1.0)}, 0.001), "none reaches it; nearest: a, 2 %")
# The faster one is called slower if the two are exchanged: the verdict hangs on the times.
has(verdict({"a": power(0.2, 3.0), "b": power(0.2, 1.0)}, 0.05), "**b**", "a needs 3 times that")
# Times within their scatter are not told apart, and times taken once have a tenth.
has(verdict({"a": power(0.2, 1.0, scatter=0.3), "b": power(0.2, 1.2, scatter=0.3)}, 0.05), "**a** or **b**: not told apart")
has(verdict({"a": power(0.2, 1.0, scatter=math.nan), "b": power(0.2, 1.15, scatter=math.nan)}, 0.05), "not told apart")
has(verdict({"a": power(0.2, 1.0, scatter=0.01), "b": power(0.2, 1.2, scatter=0.01)}, 0.05), "**a**, 16 s", "b needs 1.2 times")
# So are errors within their floors.
has(verdict({"a": power(0.2, 1.0, floor=0.015), "b": power(0.2, 1.5, floor=0.015)}, 0.05), "not told apart")
# An error that passes through zero at a coarse mesh is no accuracy.
lucky = [Point(0.4, 1e-6, 1.0, 0.01), Point(0.2, 0.03, 4.0, 0.01), Point(0.1, 0.004, 16.0, 0.01)]
has(verdict({"lucky": lucky, "b": power(0.2, 1.0)}, 0.01), "**lucky**")
assert time_to(secured(lucky, 0.0), 0.01)[0] > 4.0
# Below twice what the reference is good for nothing is offered, and nothing on round-off.
has(verdict({"a": power(0.2, 1.0)}, 0.002, 0.0015), "not offered: the reference is good for 0.15 %")
has(verdict({"a": power(1e-11, 1.0), "b": power(1e-12, 1.0)}, 0.05), "none: all are exact to round-off")
print("passed: verdicts")
