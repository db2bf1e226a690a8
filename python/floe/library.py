"""libfloe through its C interface (include/floe/floe.h, include/floe/law.h): where it is, its structs and functions, its errors.

`floe.Scene` and `floe.run` stand on this; nothing else needs the library. It is looked for, in this order: FLOE_LIBRARY of the environment
(the file), beside this package in a build tree (build/release, build/...), in the tree where `cmake --install` has put both, where the system
looks.
"""
import ctypes
import functools
import os
import pathlib
from ctypes import (CFUNCTYPE, POINTER, Structure, c_bool, c_char_p, c_double, c_int, c_long, c_size_t, c_ssize_t, c_uint, c_void_p)

#: The release whose headers these structs are of.
RELEASE = "0.2"
SONAME = "libfloe.so.0"
MOST_COMPONENTS, LAW_POINTS, LAW_HISTORY = 3, 64, 24

(OK, RETRY, BAD_INPUT, DIVERGED, IO, NO_MEMORY, INTERRUPTED, MISSED_BAR, INTERNAL) = range(9)


class Error(Exception):
    """What floe says went wrong."""


class LibraryError(Error, ImportError):
    """libfloe is not there, or is of another release."""


class InputError(Error, ValueError):
    """A deck, a name or a value that is refused: the text has place and remedy."""


class UnknownName(InputError, KeyError):
    """There is nothing of that name; the text has the names that there are."""
    __str__ = Exception.__str__  # a KeyError would show it in quotes


class Diverged(Error, ArithmeticError):
    """A step could not be saved by smaller ones, or energy has come from nothing; the state is that of the last good step."""


class FileError(Error, OSError):
    """A file could not be read or written."""


class Interrupted(Error):
    """A run was stopped in order; its checkpoint is written."""


_ERRORS: dict[int, type[Exception]] = {RETRY: Diverged, BAD_INPUT: InputError, DIVERGED: Diverged, IO: FileError, NO_MEMORY: MemoryError,
                                       INTERRUPTED: Interrupted, INTERNAL: Error}

# ---- structs, as the headers have them (tests/cli/scene.sh compares) ----

_AXES = c_double * 3
STEP_CALLBACK = CFUNCTYPE(c_int, c_void_p, c_void_p)
LOG_CALLBACK = CFUNCTYPE(None, c_void_p, c_int, c_char_p)


class Description(Structure):
    _fields_ = [("title", c_char_p), ("coupling", c_char_p), ("dimensionless", c_bool), ("dimension", c_int), ("cells", _AXES), ("materials", c_int),
                ("bodies", c_int), ("compares", c_bool), ("studies", c_bool)]


class Options(Structure):
    _fields_ = [("directory", c_char_p), ("resume", c_bool), ("max_wall", c_double), ("threads", c_int), ("before_step", STEP_CALLBACK),
                ("after_step", STEP_CALLBACK), ("user", c_void_p), ("stop", c_void_p), ("progress", c_void_p)]


class View(Structure):
    _fields_ = [("data", c_void_p * MOST_COMPONENTS), ("components", c_int), ("shape", c_size_t * 3), ("stride", c_ssize_t * 3),
                ("first", c_size_t * 3), ("centring", c_int), ("scale", c_double), ("unit", c_char_p), ("meaning", c_char_p)]


class Mesh(Structure):
    _fields_ = [("dimension", c_int), ("axisymmetric", c_bool), ("lower", _AXES), ("spacing", _AXES), ("cells", c_size_t * 3), ("blocks", c_int)]


class Probe(Structure):
    _fields_ = [("pressure", c_double), ("velocity", _AXES)]


class Totals(Structure):
    _fields_ = [("mass", c_double), ("kinetic_energy", c_double), ("strain_energy", c_double), ("internal_energy", c_double), ("momentum", _AXES)]


class Balance(Structure):
    _fields_ = [("conserved", c_bool)] + [(name, c_double) for name in ("start", "now", "boundary", "source", "damping", "defect", "contact", "drift",
                                                                        "largest_drift")]


QUANTITIES = ("mass", "momentum_x", "momentum_y", "momentum_z", "energy", "moment_x", "moment_y", "moment_z")


class Parameter(Structure):
    _fields_ = [("key", c_char_p), ("unit", c_char_p), ("range", c_int), ("lo", c_double), ("hi", c_double), ("fallback", c_double),
                ("offset", c_size_t), ("count", c_int), ("doc", c_char_p)]


#: The arrays of a batch in their order, and how many rows of LAW_POINTS numbers each has.
BATCH_ROWS = {"L": 9, "F": 9, "J": 1, "J_old": 1, "rho0": 1, "stress": 6, "energy": 1, "q": 1, "history": LAW_HISTORY, "temperature": 1, "heat": 1}


class SolidBatch(Structure):
    _fields_ = [("n", c_size_t), ("dt", c_double)] + [(name, c_double * (rows * LAW_POINTS)) for name, rows in BATCH_ROWS.items()]


class History(Structure):
    _fields_ = [("name", c_char_p), ("unit", c_char_p), ("doc", c_char_p)]


NEEDS_F, HAS_ENERGY, NEEDS_TEMPERATURE, NEEDS_TIME = 1, 2, 4, 8
_STATES = [c_void_p, c_size_t] + 4 * [c_void_p]  # par, n, and four arrays
STRESS = CFUNCTYPE(c_size_t, c_void_p, c_double, c_void_p)
WAVE_SPEED = CFUNCTYPE(None, c_void_p, c_double, c_void_p, c_void_p)
STRAIN_ENERGY = CFUNCTYPE(None, c_void_p, c_void_p, c_void_p)
OF_PARAMETERS = CFUNCTYPE(c_double, c_void_p)
OF_DENSITY = CFUNCTYPE(c_double, c_void_p, c_double)
CHECK = CFUNCTYPE(c_void_p, c_void_p)
TWO_OF_STATES, ONE_OF_STATES = CFUNCTYPE(None, *_STATES), CFUNCTYPE(None, *_STATES[:-1])


class SolidLaw(Structure):
    _fields_ = [("size", c_size_t), ("name", c_char_p), ("doc", c_char_p), ("parameter_size", c_size_t), ("parameters", POINTER(Parameter)),
                ("n_parameters", c_size_t), ("needs", c_uint), ("history", POINTER(History)), ("n_history", c_int), ("stress", STRESS),
                ("wave_speed", WAVE_SPEED), ("strain_energy", STRAIN_ENERGY), ("bulk_modulus", OF_PARAMETERS), ("shear_modulus", OF_PARAMETERS),
                ("yield_stress", OF_PARAMETERS)]


class EquationOfState(Structure):
    _fields_ = [("size", c_size_t), ("name", c_char_p), ("doc", c_char_p), ("parameter_size", c_size_t), ("parameters", POINTER(Parameter)),
                ("n_parameters", c_size_t), ("pressure", TWO_OF_STATES), ("temperature", ONE_OF_STATES), ("energy", ONE_OF_STATES),
                ("volume", TWO_OF_STATES), ("dpde", ONE_OF_STATES), ("heat", TWO_OF_STATES), ("pressure_floor", OF_PARAMETERS),
                ("energy_floor", OF_DENSITY), ("density_limit", OF_PARAMETERS), ("check", CHECK)]


#: By their names in the headers.
STRUCTS = {"floe_description": Description, "floe_options": Options, "floe_view": View, "floe_mesh": Mesh, "floe_probe": Probe, "floe_totals": Totals,
           "floe_balance": Balance, "floe_parameter": Parameter, "floe_solid_batch": SolidBatch, "floe_history": History, "floe_solid_law": SolidLaw,
           "floe_equation_of_state": EquationOfState}

# ---- the library ----

_TEXTS = POINTER(c_char_p)
_FUNCTIONS = {
    "init": (c_int,), "version": (c_char_p,), "create": (c_void_p,), "destroy": (None, POINTER(c_void_p)), "message": (c_char_p, c_void_p),
    "log": (None, c_void_p, LOG_CALLBACK, c_void_p, c_int),
    "add_solid_law": (c_int, c_void_p, POINTER(SolidLaw)), "add_equation_of_state": (c_int, c_void_p, POINTER(EquationOfState)),
    "load": (c_int, c_void_p, c_char_p, _TEXTS, c_size_t, POINTER(c_void_p)),
    "load_text": (c_int, c_void_p, c_char_p, c_char_p, _TEXTS, c_size_t, POINTER(c_void_p)),
    "deck_destroy": (None, POINTER(c_void_p)), "describe": (Description, c_void_p),
    "execute": (c_int, c_void_p, POINTER(Options), POINTER(c_void_p)), "run_destroy": (None, POINTER(c_void_p)),
    "simulation_create": (c_int, c_void_p, POINTER(Options), POINTER(c_void_p)), "simulation_destroy": (None, POINTER(c_void_p)),
    "warning": (c_char_p, c_void_p, c_int), "step": (c_int, c_void_p, c_double), "advance": (c_int, c_void_p, c_double),
    "time": (c_double, c_void_p), "end_time": (c_double, c_void_p), "time_step": (c_double, c_void_p), "step_count": (c_long, c_void_p),
    "is_finished": (c_bool, c_void_p), "save": (c_int, c_void_p, c_char_p), "restore": (c_int, c_void_p, c_char_p),
    "get_mesh": (Mesh, c_void_p), "field_name": (c_char_p, c_void_p, c_int), "field": (c_int, c_void_p, c_char_p, c_int, POINTER(View)),
    "copy_field": (c_int, c_void_p, c_char_p, c_void_p, c_size_t, POINTER(c_size_t)),
    "probe_at": (Probe, c_void_p, _AXES), "field_at": (c_int, c_void_p, c_char_p, _AXES, _AXES),
    "sum": (c_int, c_void_p, POINTER(Totals)), "read_balance": (c_int, c_void_p, c_int, POINTER(Balance)),
    "error": (c_int, c_void_p, c_char_p, POINTER(c_double)),
}


def _places() -> list[pathlib.Path]:
    """Where the library may be, besides where the system looks. This package is ROOT/python/floe, or PREFIX/share/floe/python/floe."""
    package = pathlib.Path(__file__).resolve().parent
    root, found = package.parents[1], []
    if (root / "CMakeLists.txt").is_file():
        builds = [root / "build" / "release"] + sorted((root / "build").glob("*"))
        found += [build / "libfloe.so" for build in builds if (build / "libfloe.so").is_file()]
    elif len(package.parents) > 3:
        found += [path for pattern in (f"lib/{SONAME}", f"lib64/{SONAME}", f"lib/*/{SONAME}") for path in sorted(package.parents[3].glob(pattern))]
    return found


def _open() -> ctypes.CDLL:
    chosen = os.environ.get("FLOE_LIBRARY")
    os.environ.setdefault("OMP_WAIT_POLICY", "passive")  # read once, as the library is loaded; src/cli/thread_wait.c says why
    for name in [chosen] if chosen else [str(path) for path in _places()[:1]] + [SONAME]:
        try:
            return ctypes.CDLL(name)
        except OSError as error:
            reason = str(error)
    raise LibraryError(f"{SONAME} is not found ({reason}): build it (`scripts/build.sh release floe`) or install floe, or set FLOE_LIBRARY to the file")


@functools.cache
def load() -> ctypes.CDLL:
    """The library, ready for use: functions by their names without "floe_". `LibraryError` says in one sentence what is missing."""
    library = _open()
    try:
        for name, (result, *arguments) in _FUNCTIONS.items():
            function = getattr(library, "floe_" + name)
            function.restype, function.argtypes = result, arguments
            setattr(library, name, function)
    except AttributeError as error:
        raise LibraryError(f"{library._name} is no libfloe of release {RELEASE}: {error}") from None
    version = library.version().decode()
    if version.rpartition(".")[0] != RELEASE:
        raise LibraryError(f"{library._name} is of floe {version}, and this package of {RELEASE}: take both from one release")
    if library.init() != OK:
        raise LibraryError(f"{library._name} could not be made ready: HDF5 refuses")
    return library


def raise_for(status: int, message: str) -> None:
    """The exception of a status that is not OK."""
    kind = _ERRORS.get(status, Error)
    raise kind(message or "floe gives no reason")
