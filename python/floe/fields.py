"""What a picture shows of a snapshot: fields by their names, components of vectors, what is chosen where nothing is asked for."""
from typing import NamedTuple

import numpy

from . import units
from .files import Refused
from .snapshots import SealedSnapshot


class Choice(NamedTuple):
    """A quantity to show: a field, or a component of a vector; `body` is None for the cells."""
    field: str
    component: int | None
    label: str
    signed: bool
    body: str | None


def axes_of(snapshot: SealedSnapshot) -> str:
    """The names of the axes: "x", "xy", "xyz", "rz"."""
    return ("rz" if snapshot.geometry == "axisymmetric" else "xyz")[:snapshot.dim]


def names_of(snapshot: SealedSnapshot, body: str | None) -> list[str]:
    return snapshot.fields if body is None else snapshot.bodies[body]


def _is_vector(snapshot: SealedSnapshot, body: str | None, name: str) -> bool:
    return snapshot.components(body, name) == 3


def find(snapshot: SealedSnapshot, body: str | None, name: str) -> Choice | None:
    """The quantity of that name: a field (a vector by its magnitude), or velocity_x; None if there is none."""
    names, axes = names_of(snapshot, body), axes_of(snapshot)
    if name == "pressure" and body is None and name not in names and _parted(snapshot):
        return Choice(name, None, name, False, None)
    signed = name.startswith(("stress_", "sigma_"))
    if name in names:
        return Choice(name, None, units.words(name), signed, body)
    vector, _, axis = name.rpartition("_")
    if vector in names and axis in axes and axis and _is_vector(snapshot, body, vector):
        return Choice(vector, axes.index(axis), units.words(name), True, body)
    return None


def _first(snapshot: SealedSnapshot, body: str | None, names: list[str]) -> Choice | None:
    return next((one for one in (find(snapshot, body, name) for name in names) if one), None)


def usual_of_body(snapshot: SealedSnapshot, body: str) -> Choice | None:
    """What colours points where nothing is asked for."""
    if body in snapshot.undeformed:
        return None
    if snapshot.phases[body] == "fluid":
        return _first(snapshot, body, ["pressure", "velocity"])
    return _first(snapshot, body, (["stress_xx"] if snapshot.dim == 1 else []) + ["von_mises", "velocity"])


def usual_of_cells(snapshot: SealedSnapshot) -> Choice | None:
    return _first(snapshot, None, ["pressure"] + [name for name in snapshot.fields if name.startswith("density")])


def unknown(snapshot: SealedSnapshot, points: bool, name: str) -> Refused:
    """That there is no such field, with those that there are."""
    axes, found = axes_of(snapshot), []
    what = "points" if points else "cells"
    for body in (snapshot.bodies if points else [None]):
        for one in names_of(snapshot, body):
            parts = f" ({', '.join('_' + axis for axis in axes)})" if _is_vector(snapshot, body, one) else ""
            if one + parts not in found:
                found.append(one + parts)
    if not found:
        return Refused(f"'{snapshot.path}' holds no {what} to colour by '{name}'", 2)
    return Refused(f"there is no field '{name}' of {what} in '{snapshot.path}'; there are: {', '.join(found)}, none", 2)


def _shares_of(snapshot: SealedSnapshot, body: str | None, field: str) -> list[str]:
    """The shares of a cell that the material whose field this is fills, and that are open to it, by their names."""
    found = []
    for prefix in ("volume_fraction", "open_fraction"):
        for one in names_of(snapshot, body):
            material = one[len(prefix):]
            if one.startswith(prefix) and one != field and len(material) > 1 and field.endswith(material):
                found.append(one)
    return found


def _parted(snapshot: SealedSnapshot) -> list[str]:
    """Gases that membranes keep apart: each has a pressure of its own, and what is open to it of a cell."""
    start = "open_fraction_"
    return [name[len(start):] for name in snapshot.fields if name.startswith(start) and "pressure_" + name[len(start):] in snapshot.fields]


def _parted_pressure(snapshot: SealedSnapshot) -> tuple[numpy.ndarray, str]:
    """In each cell that of the gas which has most of it."""
    gases = _parted(snapshot)
    share = numpy.stack([snapshot.read(None, "open_fraction_" + gas).values for gas in gases])
    pressure = [snapshot.read(None, "pressure_" + gas) for gas in gases]
    most = share.argmax(axis=0)[None]
    found = numpy.take_along_axis(numpy.stack([one.values for one in pressure]), most, axis=0)[0]
    return numpy.where(share.max(axis=0) >= 1e-3, found, numpy.nan), pressure[0].unit


def _nothing(snapshot: SealedSnapshot, shape: tuple[int, ...]) -> numpy.ndarray:
    """Cells that hold no material: beyond a membrane, against which nothing presses."""
    densities = [name for name in snapshot.fields if name.startswith("density_")]
    empty = numpy.full(shape, bool(densities))
    for name in densities:
        empty &= snapshot.read(None, name).values == 0
    return empty


def values(snapshot: SealedSnapshot, choice: Choice) -> tuple[numpy.ndarray, str]:
    """The numbers of a quantity, and their unit. A material's field is NaN where there is next to none of it."""
    if choice.body is None and choice.field not in snapshot.fields:
        return _parted_pressure(snapshot)
    quantity = snapshot.read(choice.body, choice.field)
    out = numpy.array(quantity.values, dtype=float)
    if choice.body is None and choice.field == "pressure":
        out[_nothing(snapshot, out.shape)] = numpy.nan
    if _is_vector(snapshot, choice.body, choice.field):
        out = out[..., choice.component] if choice.component is not None else numpy.sqrt((out ** 2).sum(axis=-1))
    for share in _shares_of(snapshot, choice.body, choice.field):
        out = numpy.where(snapshot.read(choice.body, share).values >= 1e-3, out, numpy.nan)
    return out, quantity.unit
