"""Laws of your own in Python: a solid's stress and an equation of state as functions of numpy arrays, which decks then name like floe's own.

    class Rubber(floe.SolidLaw):
        name = "my_rubber"
        parameters = {"shear_modulus": floe.Parameter("Pa", above=0), "bulk_modulus": floe.Parameter("Pa", above=0)}

        def stress(self, par, batch):
            batch.stress[:3] = par.bulk_modulus * (batch.J - 1)
            ...

    floe.Scene("deck.yaml", laws=[Rubber()])         # law: {my_rubber: {shear_modulus: 1 MPa, bulk_modulus: 2 MPa}}

They are called for batches of up to 64 points, or of as many cells as a kernel holds, from any thread, several times a step: this is for trying a
law out. A scene of solids then takes some four times as long as with a law in C, one of gas up to twice as long. What is called again with the same numbers must give the same numbers; a law
keeps nothing between calls but what is in `batch.history`. It must not call floe.
"""
import ctypes
import dataclasses
import math
import types
from collections.abc import Callable, Iterable, Mapping

import numpy

from . import library


@dataclasses.dataclass(frozen=True)
class Parameter:
    """A number of a law in the deck. `unit` is SI as udunits2 spells it, "1" where there is none; decks may use any unit of that kind. What the
    deck may say: > `above` (which is 0), >= `least`, <= `most`; `default` holds where it says nothing, None: it must say it."""
    unit: str = "1"
    above: float | None = None
    least: float | None = None
    most: float | None = None
    default: float | None = None
    doc: str = ""

    def _range(self) -> tuple[int, float, float]:
        if self.above is not None and (self.above != 0 or self.least is not None or self.most is not None):
            raise ValueError("`above` is 0, and stands alone: give `least` and `most`")
        if self.above is not None:
            return 1, 0.0, 0.0
        if self.least == 0 and self.most is None:
            return 2, 0.0, 0.0
        if self.least is None and self.most is None:
            return 0, 0.0, 0.0
        most = 1.7e308  # of either side that is open
        return 3, self.least if self.least is not None else -most, self.most if self.most is not None else most


class Batch:
    """Points that a law of solids is asked about, always in three dimensions; arrays are floe's, their last axis counts the points.

    dt: s, the step (1 in static and implicit steps, without `needs_time`); L (3, 3, n): 1/s, velocity gradient; F (3, 3, n): deformation gradient at the end of the step (with `needs_F`); J, J_old (n):
    volume over that at rest at the end and at the start; rho0 (n): kg/m3; stress (6, n): Pa, xx yy zz xy yz zx, tension positive: start in, end
    out; energy (n): J/kg, in and out (with `has_energy`); q (n): Pa, artificial viscous pressure; history (k, n): the law's own numbers, in and out.
    With `needs_temperature`, of the start of the step: temperature (n): K; heat (n): J/kg, specific heat times the temperature over that without stress."""

    def __init__(self, address: int):
        numbers = numpy.frombuffer((ctypes.c_double * (ctypes.sizeof(library.SolidBatch) // 8)).from_address(address))
        self.n = ctypes.c_size_t.from_address(address).value
        self.dt = float(numbers[1])
        at = 2
        for name, rows in library.BATCH_ROWS.items():
            size = rows * library.LAW_POINTS
            field = numbers[at:at + size].reshape(rows, library.LAW_POINTS)[:, :self.n]
            setattr(self, name, field.reshape(3, 3, self.n) if rows == 9 else field[0] if rows == 1 else field)
            at += size


class _Law:
    """What both kinds of laws say of themselves."""
    name: str = ""                              #: in the deck: letters, digits, "_"
    doc: str = ""
    parameters: Mapping[str, Parameter] = {}    #: by their keys in the deck


class SolidLaw(_Law):
    """A law of solids. `par` has the deck's parameters as attributes. `stress`, `wave_speed`, `bulk_modulus` and `shear_modulus` are needed."""
    needs_F: bool = False                       #: the deformation gradient is kept; without it only its determinant is
    has_energy: bool = False                    #: internal energy is state of the points
    needs_temperature: bool = False             #: points have a temperature, which the stress depends on; the material has a specific_heat
    needs_time: bool = False                    #: the stress depends on rates: batch.dt is the deck's time also in static and implicit steps
    history: Mapping[str, tuple[str, str]] = {}  #: name: (unit, one line), at most 24

    def stress(self, par, batch: Batch) -> int | None:
        """Sets batch.stress (and energy, history) at the end of the step. May return the first point that is beyond the law, which has the step
        repeated with half its length; points with J <= 0 are, without asking."""
        raise NotImplementedError

    def wave_speed(self, par, batch: Batch) -> numpy.ndarray:
        """m/s, speed of the fastest wave in each point as it is now, > 0: the time step follows from it."""
        raise NotImplementedError

    def bulk_modulus(self, par) -> float:
        """Pa, > 0, isothermal, at rest."""
        raise NotImplementedError

    def shear_modulus(self, par) -> float:
        """Pa, >= 0, at rest."""
        raise NotImplementedError

    #: (par, batch) -> J/m3 of the volume at rest; None: the law has no potential.
    strain_energy: Callable | None = None
    #: (par) -> Pa, stress in uniaxial tension at which it first flows; None: it never does.
    yield_stress: Callable | None = None


class EquationOfState(_Law):
    """An equation of state of fluids, of arrays: rho kg/m3, e J/kg, p Pa (absolute), T K. All functions but the last two are needed."""

    def pressure(self, par, rho, e):
        """p, and c2 = (dp/drho)_e + (dp/de)_rho p / rho^2, the square of the speed of sound."""
        raise NotImplementedError

    def temperature(self, par, rho, e):
        raise NotImplementedError

    def energy(self, par, rho, T):
        """The inverse of `temperature`."""
        raise NotImplementedError

    def volume(self, par, p, T):
        """v(p, T), m3/kg, and (dv/dp)_T < 0, for every p above the pressure floor."""
        raise NotImplementedError

    def dpde(self, par, rho, e):
        """(dp/de)_rho"""
        raise NotImplementedError

    def heat(self, par, rho, e):
        """cv, J/kg/K, and (dv/dT)_p / v, 1/K."""
        raise NotImplementedError

    def pressure_floor(self, par) -> float:
        """`volume` is defined above it; 0 for an ideal gas."""
        raise NotImplementedError

    def energy_floor(self, par, rho: float) -> float:
        """The least internal energy at a density."""
        raise NotImplementedError

    #: (par) -> kg/m3 where the law ends; None: it holds at any density.
    density_limit: Callable | None = None
    #: (par) -> what is wrong with parameters that each are in range, as the end of a sentence, or None.
    check: Callable | None = None


# ---- as the library takes them ----

def _array(address: int, n: int) -> numpy.ndarray:
    return numpy.frombuffer((ctypes.c_double * n).from_address(address))


class Registered:
    """A law in the hands of a context: functions and texts that must stay while the context is there. `fail(error)` is told what a function has
    raised; the step is then rejected, or the run ends, and the error is raised where floe was called."""

    def __init__(self, law: _Law, fail: Callable[[BaseException], None]):
        solid = isinstance(law, SolidLaw)
        if not solid and not isinstance(law, EquationOfState):
            raise TypeError(f"{law!r} is neither a floe.SolidLaw nor a floe.EquationOfState")
        self.law, self.fail, self.kept, self.keys = law, fail, [], list(law.parameters)
        self.struct = (library.SolidLaw if solid else library.EquationOfState)(
            size=ctypes.sizeof(library.SolidLaw if solid else library.EquationOfState), name=law.name.encode(), doc=law.doc.encode(),
            parameter_size=8 * len(self.keys), parameters=self._parameters(), n_parameters=len(self.keys))
        (self._solid if solid else self._fluid)()

    def _parameters(self):
        rows = []
        for k, (key, one) in enumerate(self.law.parameters.items()):
            kind, low, high = one._range()
            rows.append(library.Parameter(key.encode(), one.unit.encode(), kind, low, high, math.nan if one.default is None else one.default, 8 * k, 1,
                                          one.doc.encode()))
        return (library.Parameter * max(1, len(rows)))(*rows)

    def _par(self, address: int | None) -> types.SimpleNamespace:
        return types.SimpleNamespace(**dict(zip(self.keys, _array(address, len(self.keys)).tolist() if self.keys else [])))

    def _set(self, name: str, kind, function: Callable) -> None:
        callback = kind(function)
        self.kept.append(callback)
        setattr(self.struct, name, callback)

    def _number(self, name: str, kind=library.OF_PARAMETERS) -> None:
        """A function that gives one number; NaN where it fails."""
        asked = getattr(self.law, name)
        if asked is None:
            return

        def call(par, *rest):
            try:
                return float(asked(self._par(par), *rest))
            except BaseException as error:  # no exception may pass through C
                self.fail(error)
                return math.nan
        self._set(name, kind, call)

    def _solid(self) -> None:
        law, s = self.law, self.struct
        s.needs = sum(bit for bit, needed in ((library.NEEDS_F, law.needs_F), (library.HAS_ENERGY, law.has_energy),
                                              (library.NEEDS_TEMPERATURE, law.needs_temperature), (library.NEEDS_TIME, law.needs_time)) if needed)
        s.history = (library.History * max(1, len(law.history)))(*(library.History(name.encode(), unit.encode(), doc.encode())
                                                                   for name, (unit, doc) in law.history.items()))
        s.n_history = len(law.history)

        def stress(par, _, batch):
            try:
                points = Batch(batch)
                if not (points.J > 0).all():
                    return 1 + int(numpy.argmin(points.J > 0))
                beyond = law.stress(self._par(par), points)
                return 0 if beyond is None else 1 + int(beyond)
            except BaseException as error:
                self.fail(error)
                return 1

        def into(asked, par, batch, out):
            to = _array(out, ctypes.c_size_t.from_address(batch).value)
            try:
                to[:] = asked(self._par(par), Batch(batch))
            except BaseException as error:
                self.fail(error)
                to[:] = math.nan

        self._set("stress", library.STRESS, stress)
        self._set("wave_speed", library.WAVE_SPEED, lambda par, _, batch, out: into(law.wave_speed, par, batch, out))
        if law.strain_energy is not None:
            self._set("strain_energy", library.STRAIN_ENERGY, lambda par, batch, out: into(law.strain_energy, par, batch, out))
        for name in ("bulk_modulus", "shear_modulus", "yield_stress"):
            self._number(name)

    def _of_states(self, name: str, outputs: int) -> None:
        """A function of n states: two arrays in, one or two out."""
        asked = getattr(self.law, name)

        def call(par, n, first, second, *out):
            arrays = [_array(one, n) if one else None for one in out]
            try:
                given = asked(self._par(par), _array(first, n), _array(second, n))
                for to, value in zip(arrays, (given,) if outputs == 1 else given):
                    if to is not None:
                        to[:] = value
            except BaseException as error:
                self.fail(error)
                for to in arrays:
                    if to is not None:
                        to[:] = math.nan
        self._set(name, library.ONE_OF_STATES if outputs == 1 else library.TWO_OF_STATES, call)

    def _fluid(self) -> None:
        for name, outputs in (("pressure", 2), ("temperature", 1), ("energy", 1), ("volume", 2), ("dpde", 1), ("heat", 2)):
            self._of_states(name, outputs)
        for name in ("pressure_floor", "density_limit"):
            self._number(name)
        self._number("energy_floor", library.OF_DENSITY)
        if self.law.check is None:
            return

        def check(par):
            try:
                wrong = self.law.check(self._par(par))
            except BaseException as error:
                self.fail(error)
                wrong = "its check has failed"
            if not wrong:
                return None
            self.kept.append(ctypes.create_string_buffer(str(wrong).encode()))
            return ctypes.addressof(self.kept[-1])
        self._set("check", library.CHECK, check)


def register(lib, context, laws: Iterable[_Law], fail: Callable[[BaseException], None], done: Callable[[int], None]) -> list[Registered]:
    """Adds laws to a context; the list must be kept as long as the context. `done(status)` is told of each."""
    kept = []
    for law in laws:
        one = Registered(law, fail)
        kept.append(one)
        add = lib.add_solid_law if isinstance(law, SolidLaw) else lib.add_equation_of_state
        done(add(context, ctypes.byref(one.struct)))
    return kept
