"""A deck stepped from Python, by floe's library (floe.library): nothing is written, fields are read where they lie.

    with floe.Scene("deck.yaml", settings={"domain.cell": 0.05}) as scene:
        while not scene.finished:
            scene.step()
            if scene.cells["pressure"].max() > 2e5:
                break
        scene.points["block"]["stress_xx"], scene.probe([0.3, 0.1]).pressure, scene.balance("energy").drift

Numbers are in SI units. One scene belongs to one thread at a time; several scenes may be there at once.
"""
import contextlib
import ctypes
import json
import logging
import os
import signal
import threading
import weakref
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from typing import NamedTuple

import numpy

from . import laws as laws_of_programs
from . import library
from .results import Result

_LOG = logging.getLogger("floe")
_LEVELS = (logging.ERROR, logging.WARNING, logging.INFO, logging.DEBUG)

#: Called around a step with the scene; anything true ends the stepping in order.
Callback = Callable[["Scene"], object]
Settings = Mapping[str, object] | Iterable[str]


class Mesh(NamedTuple):
    """Where the mesh is: tuples of the scene's dimension, in m. `axes` is "x", "xy", "xyz", "rz"; it is stored in so many `blocks`."""
    axes: str
    lower: tuple[float, ...]
    spacing: tuple[float, ...]
    cells: tuple[int, ...]
    blocks: int

    def centres(self, axis: int = 0) -> numpy.ndarray:
        """Centres of the cells along an axis."""
        return self.lower[axis] + self.spacing[axis] * (numpy.arange(self.cells[axis]) + 0.5)


class Probe(NamedTuple):
    """What is at a place: absolute pressure (Pa) and velocity of all materials there together (m/s); NaN where nothing is."""
    pressure: float
    velocity: numpy.ndarray


class Totals(NamedTuple):
    """Sums over the scene (kg, J, N s): in 2-D over its thickness, in 1-D per m2, axisymmetric over the whole turn."""
    mass: float
    kinetic_energy: float
    strain_energy: float
    internal_energy: float
    momentum: numpy.ndarray


class Balance(NamedTuple):
    """The account of a conserved quantity since the start (floe.h, floe_balance); `drift` is what is not accounted for, as a share."""
    conserved: bool
    start: float
    now: float
    boundary: float
    source: float
    damping: float
    defect: float
    contact: float
    drift: float
    largest_drift: float


def _texts(settings: Settings | None) -> list[bytes]:
    """Replacements as "KEY=VALUE", as --set takes them."""
    if settings is None:
        return []
    if not isinstance(settings, Mapping):
        return [one.encode() for one in ([settings] if isinstance(settings, str) else settings)]

    def value(one) -> str:
        one = one.tolist() if isinstance(one, (numpy.generic, numpy.ndarray)) else one
        return one if isinstance(one, str) else json.dumps(one)
    return [f"{key}={value(one)}".encode() for key, one in settings.items()]


def _decode(text: bytes | None) -> str:
    return (text or b"").decode("utf-8", errors="replace")


class _Source(NamedTuple):
    """A deck as it is asked for."""
    path: str | None
    text: str | None
    settings: list[bytes]
    laws: list
    threads: int


class _Deck:
    """A context and a deck in it; both go when the last who holds this has gone."""

    def __init__(self, source: _Source):
        self.lib, self.context, self.deck, self.failure = library.load(), ctypes.c_void_p(), ctypes.c_void_p(), None
        self.context.value = self.lib.create()
        if not self.context:
            raise MemoryError("floe has no memory for a context")
        me = weakref.ref(self)  # callbacks keep nothing alive that holds them
        self.log_callback = library.LOG_CALLBACK(lambda _, level, line: _LOG.log(_LEVELS[level], "%s", _decode(line)) if level else None)
        detail = 3 if _LOG.isEnabledFor(logging.DEBUG) else 2 if _LOG.isEnabledFor(logging.INFO) else 1
        self.lib.log(self.context, self.log_callback, None, detail)
        self.laws = laws_of_programs.register(self.lib, self.context, source.laws, lambda error: me().note(error) if me() else None, self.done)
        texts = (ctypes.c_char_p * max(1, len(source.settings)))(*source.settings)
        if source.path is not None:
            status = self.lib.load(self.context, os.fsencode(source.path), texts, len(source.settings), ctypes.byref(self.deck))
        else:
            status = self.lib.load_text(self.context, b"deck", (source.text or "").encode(), texts, len(source.settings), ctypes.byref(self.deck))
        self.done(status)
        self.description = self.lib.describe(self.deck)
        self.title, self.coupling = _decode(self.description.title), _decode(self.description.coupling)

    def note(self, error: BaseException) -> None:
        """Keeps the first thing that a function of the program has raised, until floe has come back."""
        self.failure = self.failure or error

    def done(self, status: int) -> None:
        """Raises what has gone wrong: what the program's own functions have raised comes first."""
        failure, self.failure = self.failure, None
        if failure is not None:
            raise failure
        if status != library.OK:
            library.raise_for(status, _decode(self.lib.message(self.context)))

    def __del__(self):
        if getattr(self, "deck", None):
            self.lib.deck_destroy(ctypes.byref(self.deck))
        if getattr(self, "context", None):
            self.lib.destroy(ctypes.byref(self.context))


def _callback(owner, call: Callback | None, scene: Callable[[], object], always: bool):
    """A callback as floe calls it; `always`: also where there is none, so that Ctrl-C ends the stepping between two steps."""
    if call is None and not always:
        return library.STEP_CALLBACK()

    def around(_, __):
        ended: object = False
        try:
            ended = call is not None and call(scene())
        except BaseException as error:  # no exception may pass through C
            owner().note(error)
        return library.INTERRUPTED if owner().failure is not None or ended else library.OK
    return library.STEP_CALLBACK(around)


@contextlib.contextmanager
def _interruptible(of: _Deck):
    """Ctrl-C is kept until floe has come back: an exception that comes up just as floe calls would be lost."""
    mine = threading.current_thread() is threading.main_thread() and signal.getsignal(signal.SIGINT) is signal.default_int_handler
    if mine:
        signal.signal(signal.SIGINT, lambda *_: of.note(KeyboardInterrupt()))
    try:
        yield
    finally:
        if mine:
            signal.signal(signal.SIGINT, signal.default_int_handler)


class _Simulation:
    """A deck made ready, and what is known of its fields."""

    def __init__(self, source: _Source, before: Callback | None, after: Callback | None, scene: Callable[[], object]):
        self.of, self.pointer = _Deck(source), ctypes.c_void_p()
        deck = weakref.ref(self.of)
        self.callbacks = _callback(deck, before, scene, False), _callback(deck, after, scene, True)
        options = library.Options(threads=source.threads, before_step=self.callbacks[0], after_step=self.callbacks[1])
        self.of.done(self.lib.simulation_create(self.of.deck, ctypes.byref(options), ctypes.byref(self.pointer)))
        mesh = self.lib.get_mesh(self.pointer)
        n = mesh.dimension
        self.mesh = Mesh(("rz" if mesh.axisymmetric else "xyz")[:n], tuple(mesh.lower[:n]), tuple(mesh.spacing[:n]), tuple(mesh.cells[:n]), mesh.blocks)
        self.names = self._all(self.lib.field_name)
        self.warnings = self._all(self.lib.warning)

    @property
    def lib(self):
        return self.of.lib

    def _all(self, function) -> list[str]:
        out: list[str] = []
        while (one := function(self.pointer, len(out))) is not None:
            out.append(_decode(one))
        return out

    def __del__(self):
        if getattr(self, "pointer", None):
            self.lib.simulation_destroy(ctypes.byref(self.pointer))


class _Memory:
    """floe's numbers as numpy takes them; it holds the simulation, so that they stay while an array of them is there."""

    def __init__(self, owner: _Simulation, address: int, shape: tuple[int, ...], strides: tuple[int, ...]):
        self.owner = owner
        self.__array_interface__ = {"version": 3, "typestr": numpy.dtype(float).str, "data": (address, True), "shape": shape, "strides": strides}


class Fields(Mapping):
    """Fields by their names, as they are now: `scene.cells["pressure"]`, values[i], [i, j] or [i, j, k] with i along x (r), of points values[i].

    An array is a view of floe's own numbers and cannot be written to. It shows one moment: take it anew after a step, or `copy()` what is to last.
    The components of a vector lie apart: `velocity_x` is one of them, `velocity` the tuple of all (in 1-D it is one array). Masses and volumes of points are stored per metre
    of depth in 2-D and per radian about an axis; `scale(name)` leads to what outputs show."""

    def __init__(self, scene: "Scene", group: str):
        self._scene, self._group = scene, group

    def _vector(self, name: str) -> tuple[str, int | None]:
        """The field and the component that a name means."""
        names, (whole, _, axis) = list(self), name.rpartition("_")
        axes = self._scene.mesh.axes
        if name not in names and whole in names and axis in axes and len(axis) == 1 and self._view(whole).components > 1:
            return whole, axes.index(axis)
        return name, None

    def _view(self, name: str, block: int = 0) -> library.View:
        simulation, view = self._scene._now, library.View()
        if f"{self._group}/{name}" not in simulation.names:
            raise library.UnknownName(f"there is no field '{name}' of {self._group}; there are: {', '.join(self)}")
        simulation.of.done(simulation.lib.field(simulation.pointer, f"{self._group}/{name}".encode(), block, ctypes.byref(view)))
        return view

    def view(self, name: str, block: int = 0) -> numpy.ndarray | tuple[numpy.ndarray, ...]:
        """The field in one block of the mesh, where the deck asks for several."""
        simulation, (field, component) = self._scene._now, self._vector(name)
        view = self._view(field, block)
        used = 1 if view.centring == 2 else len(simulation.mesh.axes)
        shape, strides = tuple(view.shape[:used]), tuple(8 * one for one in view.stride[:used])
        empty = 0 in shape
        found = [numpy.empty(shape) if empty else numpy.asarray(_Memory(simulation, view.data[c], shape, strides))
                 for c in ([component] if component is not None else range(view.components))]
        return found[0] if len(found) == 1 else tuple(found)

    def __getitem__(self, name: str) -> numpy.ndarray | tuple[numpy.ndarray, ...]:
        blocks = self._scene.mesh.blocks
        if blocks > 1:
            raise library.InputError(f"the deck asks for {blocks} blocks: take view(\"{name}\", block), or copy(\"{name}\") for the whole field")
        return self.view(name)

    def copy(self, name: str) -> numpy.ndarray:
        """The field whole and times its scale, in the order of snapshots: blocks or not, points by their ids, vectors with a last axis."""
        simulation, (field, component) = self._scene._now, self._vector(name)
        view, mesh = self._view(field), simulation.mesh
        full, needed = f"{self._group}/{field}".encode(), ctypes.c_size_t()
        simulation.of.done(simulation.lib.copy_field(simulation.pointer, full, None, 0, ctypes.byref(needed)))
        out = numpy.empty(needed.value)
        simulation.of.done(simulation.lib.copy_field(simulation.pointer, full, out.ctypes.data, len(out), None))
        if view.centring == 2:
            out = out.reshape(-1, view.components)
        else:
            entries = [n + (1 if view.centring == 1 else 0) for n in mesh.cells]
            out = out.reshape(*reversed(entries), view.components)
            out = out.transpose(*reversed(range(len(entries))), len(entries))
        return out[..., 0] if view.components == 1 else out[..., component] if component is not None else out

    def unit(self, name: str) -> str:
        """The unit, as udunits2 spells it; "1" where there is none."""
        return _decode(self._view(self._vector(name)[0]).unit)

    def meaning(self, name: str) -> str:
        """What it is, in a line."""
        return _decode(self._view(self._vector(name)[0]).meaning)

    def scale(self, name: str) -> float:
        """Times this, a value is that of outputs: 1 but for masses and volumes of points."""
        return self._view(self._vector(name)[0]).scale

    def __iter__(self) -> Iterator[str]:
        start = self._group + "/"
        return (name[len(start):] for name in self._scene._now.names if name.startswith(start))

    def __len__(self) -> int:
        return sum(1 for _ in self)


class Bodies(Mapping):
    """Bodies of points by their names: `scene.points["block"]["stress_xx"]`. Points have no order that lasts; `id` tells them apart."""

    def __init__(self, scene: "Scene"):
        self._scene = scene

    def _names(self) -> list[str]:
        return list(dict.fromkeys(name.split("/")[1] for name in self._scene._now.names if name.startswith("points/")))

    def __getitem__(self, body: str) -> Fields:
        if body not in self._names():
            raise library.UnknownName(f"there is no body '{body}' of points; there are: {', '.join(self._names()) or 'none'}")
        return Fields(self._scene, "points/" + body)

    def __iter__(self) -> Iterator[str]:
        return iter(self._names())

    def __len__(self) -> int:
        return len(self._names())


class Scene:
    """A deck that is stepped. `settings` replaces keys, as --set does: {"domain.cell": 0.05, "time.end": "3 ms"}, None takes a key away. `laws` are
    floe.SolidLaw and floe.EquationOfState, which the deck may name. `before_step` and `after_step` are called with the scene around each step; they
    may read it, and end the stepping in order by returning something true. What they raise comes out of `step` and `advance`, and Ctrl-C does.

    floe's warnings are in `warnings` and go to the logger "floe" (module logging). Refused input is floe.InputError with floe's message."""

    def __init__(self, deck: os.PathLike | str | None = None, *, text: str | None = None, settings: Settings | None = None,
                 laws: Sequence[laws_of_programs.SolidLaw | laws_of_programs.EquationOfState] = (), threads: int = 0,
                 before_step: Callback | None = None, after_step: Callback | None = None):
        if (deck is None) == (text is None):
            raise TypeError("a scene is made of a deck's file, or of its text")
        self._source = _Source(os.fspath(deck) if deck is not None else None, text, _texts(settings), list(laws), threads)
        self._call, self._busy = (before_step, after_step), False
        self._simulation: _Simulation | None = self._make()

    def _make(self) -> _Simulation:
        return _Simulation(self._source, *self._call, weakref.ref(self))

    @property
    def _now(self) -> _Simulation:
        if self._simulation is None:
            raise library.InputError("the scene is closed")
        return self._simulation

    def close(self) -> None:
        """Gives the memory back, once no array of it is left."""
        if self._busy:
            raise library.InputError("a callback must not close its scene")
        self._simulation = None

    def __enter__(self) -> "Scene":
        return self

    def __exit__(self, *_) -> None:
        self.close()

    # ---- what it is ----

    @property
    def title(self) -> str:
        return self._now.of.title

    @property
    def coupling(self) -> str:
        """mpm, ice or ice-mpm."""
        return self._now.of.coupling

    @property
    def mesh(self) -> Mesh:
        return self._now.mesh

    @property
    def warnings(self) -> list[str]:
        """What will not be right in this scene, and why."""
        return self._now.warnings

    # ---- stepping ----

    @property
    def time(self) -> float:
        """s, since the start."""
        return self._now.lib.time(self._now.pointer)

    @property
    def end(self) -> float:
        """s: the deck's time.end."""
        return self._now.lib.end_time(self._now.pointer)

    @property
    def time_step(self) -> float:
        """s: what the next step would be, were nothing in its way; 0 before the first."""
        return self._now.lib.time_step(self._now.pointer)

    @property
    def step_count(self) -> int:
        """Steps made."""
        return self._now.lib.step_count(self._now.pointer)

    @property
    def finished(self) -> bool:
        """Whether time.end, time.max_steps or rest is reached."""
        return self._now.lib.is_finished(self._now.pointer)

    def _run(self, function: str, until: float | None) -> bool:
        """Whether it has come to its end; False: a callback has ended it."""
        now, outer = self._now, self._busy  # a callback that steps is refused by floe, with its reason
        self._busy = True
        try:
            with _interruptible(now.of):
                status = getattr(now.lib, function)(now.pointer, self.end if until is None else until)
        finally:
            self._busy = outer
        if status == library.INTERRUPTED and now.of.failure is None:
            return False
        now.of.done(status)
        return True

    def step(self, until: float | None = None) -> float:
        """Makes one step, which does not pass the time `until` (the deck's end); returns the time. Of a static scene, a load increment."""
        self._run("step", until)
        return self.time

    def advance(self, until: float | None = None) -> bool:
        """Steps to a time (the deck's end), which is reached exactly. False: a callback has ended it before."""
        return self._run("advance", until)

    def steps(self, until: float | None = None) -> Iterator[float]:
        """The time after each step, up to `until` (the deck's end): `for time in scene.steps(): ...`"""
        until = self.end if until is None else until
        while self.time < until and not self.finished:
            yield self.step(until)

    def save(self, path: os.PathLike | str) -> None:
        """Writes a checkpoint."""
        self._now.of.done(self._now.lib.save(self._now.pointer, os.fsencode(path)))

    def restore(self, path: os.PathLike | str) -> None:
        """Goes back (or on) to a checkpoint of the same deck, to the same bits. Arrays from before keep their numbers."""
        if self._busy:
            raise library.InputError("a callback must not restore its scene")
        anew = self._make()
        anew.of.done(anew.lib.restore(anew.pointer, os.fsencode(path)))
        self._simulation = anew

    # ---- what is there ----

    @property
    def cells(self) -> Fields:
        """Fields of the cells, named as in snapshots."""
        return Fields(self, "cells")

    @property
    def nodes(self) -> Fields:
        """What the last step has left at the nodes."""
        return Fields(self, "nodes")

    @property
    def points(self) -> Bodies:
        """Bodies of points."""
        return Bodies(self)

    def _place(self, x: Sequence[float] | float):
        place = numpy.atleast_1d(numpy.asarray(x, dtype=float))
        if place.shape != (len(self.mesh.axes),):
            raise library.InputError(f"a place in this scene has {len(self.mesh.axes)} coordinate{'s' if len(self.mesh.axes) > 1 else ''}, not {place.size}")
        return (ctypes.c_double * 3)(*place)

    def probe(self, x: Sequence[float] | float) -> Probe:
        """Pressure and velocity of the cell that holds a place (m); NaN outside the mesh."""
        now = self._now
        found = now.lib.probe_at(now.pointer, self._place(x))
        return Probe(found.pressure, numpy.array(found.velocity[:len(now.mesh.axes)]))

    def at(self, name: str, x: Sequence[float] | float) -> float | numpy.ndarray:
        """The value of a field of cells in the cell that holds a place; of a vector, all components."""
        now, (field, component), value = self._now, self.cells._vector(name), (ctypes.c_double * 3)()
        view = self.cells._view(field)
        now.of.done(now.lib.field_at(now.pointer, f"cells/{field}".encode(), self._place(x), value))
        return value[component or 0] if view.components == 1 or component is not None else numpy.array(value[:view.components])

    def totals(self) -> Totals:
        """Mass, energies and momentum of the whole scene."""
        now, t = self._now, library.Totals()
        now.of.done(now.lib.sum(now.pointer, ctypes.byref(t)))
        return Totals(t.mass, t.kinetic_energy, t.strain_energy, t.internal_energy, numpy.array(t.momentum[:len(now.mesh.axes)]))

    def balance(self, quantity: str) -> Balance:
        """The account of mass, momentum_x, ..., energy, moment_x, ... since the start."""
        if quantity not in library.QUANTITIES:
            raise library.UnknownName(f"there is no account of '{quantity}'; there are: {', '.join(library.QUANTITIES)}")
        now, b = self._now, library.Balance()
        now.of.done(now.lib.read_balance(now.pointer, library.QUANTITIES.index(quantity), ctypes.byref(b)))
        return Balance(*(getattr(b, name) for name in Balance._fields))

    def error(self, metric: str) -> float:
        """The error now of a metric of verify.metrics that compares with an exact solution."""
        now, value = self._now, ctypes.c_double()
        now.of.done(now.lib.error(now.pointer, metric.encode(), ctypes.byref(value)))
        return value.value


def run(deck: os.PathLike | str, folder: os.PathLike | str, *, settings: Settings | None = None,
        laws: Sequence[laws_of_programs.SolidLaw | laws_of_programs.EquationOfState] = (), threads: int = 0, resume: bool = False,
        max_wall: float = 0.0) -> Result:
    """Runs a deck to its end with its outputs in a folder, as `floe run -o` does, and opens them. Ctrl-C and `max_wall` (s) leave a checkpoint that
    `resume` goes on from."""
    of, run_pointer = _Deck(_Source(os.fspath(deck), None, _texts(settings), list(laws), threads)), ctypes.c_void_p()
    after = _callback(weakref.ref(of), None, lambda: None, True)
    options = library.Options(directory=os.fsencode(folder), resume=resume, max_wall=max_wall, threads=threads, after_step=after)
    with contextlib.ExitStack() as stack:
        stack.callback(of.lib.run_destroy, ctypes.byref(run_pointer))
        with _interruptible(of):
            status = of.lib.execute(of.deck, ctypes.byref(options), ctypes.byref(run_pointer))
        of.done(status)
    return Result(folder)
