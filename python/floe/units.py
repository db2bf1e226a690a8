"""How numbers are shown: SI prefixes, powers of ten, offsets, and labels of axes with their units.

Results are in SI units (or in none); people read kPa, ms and mm. `shown` chooses what a range of numbers is shown in,
`number` writes a single one.
"""
import math
from typing import NamedTuple

_PREFIX = {-9: "n", -6: "µ", -3: "m", 0: "", 3: "k", 6: "M", 9: "G", 12: "T"}
_PREFIXED = ("Pa", "s", "m", "J", "N", "W", "Hz")       # units whose first factor takes a prefix
_RAISED = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")


class Shown(NamedTuple):
    """What is shown of a number is (number - offset) / factor, in `unit`; `offset_text` is " − 101.3 kPa", or nothing."""
    factor: float
    unit: str
    offset: float = 0.0
    offset_text: str = ""

    def of(self, values):
        """The numbers to show, of a number or an array."""
        return (values - self.offset) / self.factor


def plain_unit(unit: str) -> str:
    """A unit as people write it: "kg/m3" as "kg/m³", "1" as nothing. A digit behind a letter is an exponent."""
    if unit in ("1", ""):
        return ""
    return "".join(c.translate(_RAISED) if c.isdigit() and k and unit[k - 1].isalpha() else c for k, c in enumerate(unit))


def _power(size: float, least: float, most: float) -> int:
    """The power of ten, a multiple of three, in which numbers up to `size` are shown; 0 from `least` to below `most`."""
    if not size > 0 or least <= size < most:
        return 0
    return 3 * math.floor(math.log10(1.05 * size) / 3)  # 1 of the larger rather than 999 of the smaller


def _takes_prefix(unit: str) -> bool:
    return any(unit.startswith(one) and unit[len(one):len(one) + 1] in ("", "/", " ") for one in _PREFIXED)


def choose(size: float, unit: str) -> tuple[float, str]:
    """The factor in which numbers up to `size` are shown, and the unit that belongs to it."""
    power = _power(size, 0.1, 1000.0)
    if _takes_prefix(unit) and power in _PREFIX:
        return 10.0 ** power, _PREFIX[power] + plain_unit(unit)
    power = _power(size, 1e-2, 1e4)
    words = [f"10{str(power).translate(_RAISED)}"] if power else []
    return 10.0 ** power, " ".join(words + ([plain_unit(unit)] if plain_unit(unit) else []))


def digits(value: float, figures: int = 4) -> str:
    """A number to so many figures, with a minus that is no hyphen; a dash for what is no number."""
    if math.isnan(value):
        return "–"
    if math.isinf(value):
        return "∞" if value > 0 else "−∞"
    text = f"{value:.{figures}g}"
    if "e" in text:
        head, power = text.split("e")
        text = f"{head}×10{str(int(power)).translate(_RAISED)}"
    return text.replace("-", "−") if value != 0 else "0"


def number(value: float, unit: str = "1", figures: int = 4) -> str:
    """A number with its unit and prefix: "1.4 ms"."""
    factor, text = choose(abs(value), unit)
    return f"{digits(value / factor, figures)} {text}".rstrip()


def shown(lower: float, upper: float, unit: str = "1", offset: bool = True) -> Shown:
    """What a range is shown in. A narrow range far from zero is shown as what is above a round number within it."""
    size, span = max(abs(lower), abs(upper)), upper - lower
    base, text = 0.0, ""
    if offset and 0 < span <= 1e-3 * size:
        grain = 10.0 ** math.ceil(math.log10(span))
        base = grain * math.ceil(0.5 * (lower + upper) / grain - 0.5)
        text = f" {'+' if base < 0 else '−'} {number(abs(base), unit, 12)}"
    factor, name = choose(max(abs(lower - base), abs(upper - base)), unit)
    return Shown(factor, name, base, text)


def label(name: str, scale: Shown) -> str:
    """An axis with its unit: "pressure − 101.3 kPa (Pa)"."""
    return f"{name}{scale.offset_text}" + (f" ({scale.unit})" if scale.unit else "")


def seconds(value: float) -> str:
    """A time that passed on a clock: "0.031 s", "12.3 s", "4 min 05 s", "2 h 10 min"."""
    if not math.isfinite(value):
        return "–"
    if value < 100:
        return f"{digits(value, 3)} s"
    whole = round(value)
    return f"{whole // 60} min {whole % 60:02d} s" if whole < 3600 else f"{whole // 3600} h {whole % 3600 // 60:02d} min"


def count(value: float) -> str:
    """A whole number, its digits in groups of three."""
    if not math.isfinite(value) or abs(value) >= 1e15:
        return digits(value)
    return f"{value:,.0f}".replace(",", "\u202f").replace("-", "−")


def bytes_text(value: float) -> str:
    """Bytes as "12.3 MB"."""
    for unit in ("B", "kB", "MB", "GB"):
        if value < 1000:
            return f"{value:.3g} {unit}"
        value /= 1000
    return f"{value:.3g} TB"


#: Names that are no words.
_WORDS = {"von_mises": "von Mises stress", "sigma_r": "radial stress", "sigma_theta": "hoop stress", "velocity": "speed", "dt": "time step",
          "kinetic": "kinetic energy", "strain": "strain energy", "internal": "internal energy", "eq13": "relative error of stress (eq13)"}


def words(name: str) -> str:
    """A name of floe's files as words: "density_gas" as "density gas", "von_mises" as "von Mises stress"."""
    return _WORDS.get(name, name.replace("_", " "))


_METRICS = {"density": "kg/m3", "velocity": "m/s", "pressure": "Pa", "internal_energy": "J/kg", "temperature": "K", "stress": "Pa", "sigma": "Pa",
            "displacement": "m"}
_HISTORY = ("rel_", "hmax_", "hrms_", "hend_", "hlate_", "hperiod_", "hturns_", "l1rel_", "l2rel_", "linfrel_")


def is_relative(metric: str) -> bool:
    """Whether an error is a ratio, shown in per cent (docs/outputs.md, Metrics)."""
    return metric == "eq13" or metric.startswith(_HISTORY)


def metric_unit(metric: str, dimensionless: bool = False) -> str:
    """The unit of an error: "%" of a ratio, the quantity's of others, "" where there is none."""
    if is_relative(metric):
        return "%"
    quantity = metric.partition("_")[2]
    if dimensionless:
        return ""
    if quantity == "normal":
        return "degrees"
    return next((unit for name, unit in _METRICS.items() if quantity == name or quantity.startswith(name + "_")), "")


def error_text(metric: str, value: float, dimensionless: bool = False) -> str:
    """An error as people read it: "2.1 %", "30.5 kPa"."""
    if value is None or not math.isfinite(value):
        return "–"
    unit = metric_unit(metric, dimensionless)
    return f"{digits(100 * value)} %" if unit == "%" else number(value, unit or "1")
