"""Results as a page or a picture reads them: of any origin, whole or not. What is no ordinary file is not waited for, a snapshot whose
seal is broken is not opened, half a row at the end of a table is left out."""
import csv
import functools
import hashlib
import io
import json
import math
import pathlib

import h5py
import numpy

from . import files
from .files import Refused
from .results import Quantity, Snapshot, dataset, number, split_title


def table(path: pathlib.Path | str) -> dict[str, tuple[numpy.ndarray, str, list[str]]]:
    """A table: (values, unit, texts) by name of a column. Half a row at its end is left out; values are NaN where there is no number."""
    rows = list(csv.reader(io.StringIO(files.read_text(path))))
    if not rows:
        return {}
    names = [split_title(one) for one in rows[0]]
    whole = [row for row in rows[1:] if len(row) == len(names)]
    return {name: (numpy.array([number(row[k]) for row in whole]), unit, [row[k] for row in whole]) for k, (name, unit) in enumerate(names)}


def json_file(path: pathlib.Path | str) -> dict:
    """An object of JSON, as floe writes it."""
    try:
        found = json.loads(files.read_text(path))
    except ValueError as error:
        raise Refused(f"'{path}' is not what floe writes ({error}): make it anew, or leave the folder out") from error
    if not isinstance(found, dict):
        raise Refused(f"'{path}' is not what floe writes: make it anew, or leave the folder out")
    return found


class Run:
    """The folder of a run; `summary` is given where another file has it already. What is missing is empty."""

    def __init__(self, folder: pathlib.Path | str, summary: dict | None = None):
        self.folder = pathlib.Path(folder)
        self.summary = json_file(self.folder / "summary.json") if summary is None else summary

    @functools.cached_property
    def columns(self) -> dict[str, tuple[numpy.ndarray, str, list[str]]]:
        """history.csv, as `table` reads it."""
        path = self.folder / "history.csv"
        return table(path) if path.exists() else {}

    @property
    def history(self) -> dict[str, Quantity]:
        return {name: Quantity(values, unit) for name, (values, unit, _) in self.columns.items()}

    def text(self, name: str) -> str:
        """A text file of the folder; "" where there is none."""
        path = self.folder / name
        return files.read_text(path) if path.exists() else ""

    @functools.cached_property
    def deck(self) -> str:
        return self.text("deck.yaml")

    def deck_key(self, key: str) -> str:
        """The value of a key at the left of the deck, without its quotes; "" if there is none."""
        for line in self.deck.splitlines():
            if line.startswith(key + ": "):
                value = line[len(key) + 2:].strip()
                if not value.startswith('"'):
                    return value
                try:
                    return str(json.loads(value))
                except ValueError:
                    return value.strip('"')
        return ""

    @property
    def title(self) -> str:
        return self.deck_key("title") or self.folder.name

    @property
    def dimensionless(self) -> bool:
        return "none" in (self.deck_key("units"), self.summary.get("units"))


def rigid_bodies(deck: pathlib.Path) -> set[str]:
    """Bodies with a `motion` in a deck as floe writes it: they have no stress. None where there is no deck."""
    found: set[str] = set()
    section = body = ""
    for line in files.read_text(deck).splitlines() if deck.is_file() else []:
        if line[:1].isalpha():
            section = line.partition(":")[0]
        elif line[:3].strip() and line.startswith("  ") and section == "bodies":
            body = line.strip().partition(":")[0].strip('"')
        elif line.startswith("    motion:") and section == "bodies":
            found.add(body)
    return found


def check_seal(path: pathlib.Path | str) -> None:
    """A snapshot's file is what floe once wrote, by the SHA-256 in its header (docs/outputs.md); `files.Refused` says what is wrong."""
    data = files.read(path)
    if data[:8] != b"\x89floe\r\n\x1a":
        raise Refused(f"'{path}' is not a file of floe's, or its first bytes are damaged")
    follow = int.from_bytes(data[16:24], "little")
    if len(data) < 512 or follow != len(data) - 512:
        raise Refused(f"'{path}' is {'too long' if 512 <= len(data) and follow < len(data) - 512 else 'cut short'}")
    if hashlib.sha256(data[:480] + data[512:]).digest() != data[480:512]:
        raise Refused(f"'{path}' is damaged: its SHA-256 is not that of its content")


def check_whole(group: h5py.Group, depth: int = 0) -> None:
    """Everything in the file is as floe writes it: groups and datasets by links that lead nowhere else, data in one piece, through no
    filter. A stranger's file could have HDF5 open others, or load plug-ins."""
    for name in group:
        if depth > 4 or not isinstance(group.get(name, getlink=True), h5py.HardLink):
            raise Refused(f"'{group.file.filename}' is no snapshot that can be read: '{group.name.rstrip('/')}/{name}' is a link out of it")
        found = group[name]
        if isinstance(found, h5py.Group):
            check_whole(found, depth + 1)
        elif not isinstance(found, h5py.Dataset) or found.external or found.is_virtual or found.id.get_create_plist().get_nfilters() or found.dtype.kind not in "fiuS":
            raise Refused(f"'{group.file.filename}' is no snapshot that can be read: '{found.name}' is not stored as floe does")


class SealedSnapshot(Snapshot):
    """A snapshot whose seal is whole, with what a picture needs besides."""

    def __init__(self, path: pathlib.Path | str):
        check_seal(path)
        try:
            with h5py.File(path, "r") as file:
                check_whole(file)
            super().__init__(path)
            with h5py.File(self.path, "r") as file:
                self.time_unit = str(file["time"].attrs.get("unit", "s")) if "time" in file else "s"
                self.title = str(file.attrs.get("title", ""))                #: of the deck
                self.volume_scale = float(file.attrs.get("volume_scale", 1))  #: of volumes and masses: thickness in 2-D, 2 pi if axisymmetric
                self.phases = {body: str(file["points"][body].attrs.get("phase", "solid")) for body in self.bodies}  #: body: solid, fluid
                self.undeformed = rigid_bodies(self.path.parent.parent / "deck.yaml") & set(self.bodies)  #: bodies whose motion is given, or rigid
        except (OSError, KeyError, ValueError, RuntimeError) as error:
            raise Refused(f"'{path}' is no snapshot that can be read: {error}") from error
        if not (math.isfinite(self.time) and 1 <= self.dim <= 3 and (self.upper > self.lower).all() and (self.spacing > 0).all()):
            raise Refused(f"'{path}' is no snapshot that can be read: its time or its domain is none")

    def read(self, body: str | None, name: str) -> Quantity:
        """A quantity of a body's points, or a field of the cells where the body is None."""
        try:
            return self.field(name) if body is None else self.points(body, name)
        except (OSError, KeyError, ValueError, RuntimeError) as error:
            raise Refused(f"'{self.path}': '{name}' cannot be read: {error}") from error

    def components(self, body: str | None, name: str) -> int:
        """Numbers of an entry: 1, or 3 of vectors."""
        with h5py.File(self.path, "r") as file:
            shape = dataset(file, f"points/{body}/{name}" if body is not None else "cells/" + name).shape
        return 3 if len(shape) == (4 if body is None else 2) else 1


def snapshot_files(folder: pathlib.Path | str) -> list[pathlib.Path]:
    """Files of a run's snapshots, earliest first."""
    found = [path for path in (pathlib.Path(folder) / "fields").glob("*.h5") if path.stem.isdigit()]
    return sorted(found, key=lambda path: int(path.stem))


def snapshots(folder: pathlib.Path | str, warn, most: int | None = None) -> list[SealedSnapshot]:
    """The snapshots of a run, earliest first, or the last `most`. Damaged ones are passed over: `warn(text)` is told."""
    out, listed = [], snapshot_files(folder)
    for path in reversed(listed):
        if most is not None and len(out) == most:
            break
        try:
            out.append(SealedSnapshot(path))
        except Refused as error:
            warn(f"passed over: {error}")
    if not out:
        raise Refused(f"'{folder}/fields' holds no {'readable ' if listed else ''}snapshot: is '{folder}' the folder of a run?")
    return out[::-1]
