"""Error against processor time: which variant to choose for a level of error, with what is uncertain in that.

An error counts for a mesh only if no finer mesh of the variant has a larger one: a value that passes through zero on its way is no accuracy.
An error is known to within its floor: what the reference is good for, and what the run itself leaves open (a rest that still swings).
A level is offered only from twice the reference's floor on. What is below ROUND_OFF is exact, and nothing is chosen by it.
"""
import dataclasses
import math

ROUND_OFF = 1e-9       # relative errors below are those of the arithmetic
UNKNOWN_SCATTER = 0.1  # of a time that was taken once


@dataclasses.dataclass
class Point:
    """One case of a variant."""
    h: float
    error: float          # relative; NaN: the run has none
    cpu: float            # s
    scatter: float = math.nan
    floor: float = 0.0    # what the error is known to
    disturbed: bool = False


@dataclasses.dataclass
class Reach:
    """When a variant reaches a level: processor seconds, and the least and the most that they may be."""
    name: str
    cpu: float
    low: float
    high: float
    first: bool  # by its coarsest mesh: a coarser one might do


def secured(points, shift):
    """(cpu, error) from the coarsest mesh to the finest, each error the largest of its own and all finer ones, shifted by so many floors."""
    cases = sorted((one for one in points if one.error == one.error and one.cpu > 0), key=lambda one: -one.h)
    out, largest = [], 0.0
    for one in reversed(cases):
        largest = max(largest, one.error + shift * one.floor, 0.0)
        out.append((one.cpu, largest))
    return out[::-1]


def time_to(curve, level):
    """Processor time to a level, interpolated between the logarithms of two meshes; NaN: not reached. And whether the coarsest does."""
    for k, (cpu, error) in enumerate(curve):
        if error > level:
            continue
        if k == 0 or not error > 0:
            return cpu, k == 0
        before_cpu, before = curve[k - 1]
        part = math.log(level / before) / math.log(error / before)
        return before_cpu * (cpu / before_cpu) ** part, False
    return math.nan, False


def reach(name, points, level):
    """None: no mesh of the variant reaches the level, even where its errors are taken as they are."""
    cpu, first = time_to(secured(points, 0.0), level)
    if math.isnan(cpu):
        return None
    low, high = time_to(secured(points, -1.0), level)[0], time_to(secured(points, 1.0), level)[0]
    scatter = max(one.scatter if one.scatter == one.scatter else UNKNOWN_SCATTER for one in points)
    high = math.inf if math.isnan(high) else high
    return Reach(name, cpu, min(low, cpu) / (1 + scatter), max(high, cpu) * (1 + scatter), first)


def seconds(value):
    return f"{value:.2g} s"


def span(one):
    """A time with its bounds."""
    bounds = f"{one.low:.2g} to {one.high:.2g}" if math.isfinite(one.high) else f"{one.low:.2g} or more"
    return f"{'at most ' if one.first else ''}{seconds(one.cpu)} ({bounds})"


def verdict(variants, level, reference=0.0):
    """In words, for variants {name: points} and a level; `reference`: the relative error that the reference itself may have."""
    if level < 2 * reference:
        return f"not offered: the reference is good for {100 * reference:.2g} %"
    known = {name: points for name, points in variants.items() if any(one.error == one.error for one in points)}
    if not known:
        return "no variant runs"
    if all(one.error < ROUND_OFF for points in known.values() for one in points if one.error == one.error):
        return "none: all are exact to round-off"
    found = sorted((one for one in (reach(name, points, level) for name, points in known.items()) if one), key=lambda one: one.cpu)
    if not found:
        name, error = min(((name, secured(points, 0.0)[-1][1]) for name, points in known.items()), key=lambda pair: pair[1])
        return f"none reaches it; nearest: {name}, {100 * error:.2g} %"
    best, rest = found[0], found[1:]
    alike = [one for one in rest if one.low < best.high]
    if alike:
        return " or ".join(f"**{one.name}**" for one in [best] + alike) + ": not told apart, " + ", ".join(span(one) for one in [best] + alike)
    if rest:
        return f"**{best.name}**, {span(best)}; {rest[0].name} needs {rest[0].cpu / best.cpu:.2g} times that"
    others = [name for name in known if name != best.name]
    return f"**{best.name}**, {span(best)}" + (f"; not reached by {', '.join(others)}" if others else "")
