"""Quantities with units, and frozen records: equality, hash and repr by their fields."""

import re
import textwrap
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import MISSING, Field, fields
from fractions import Fraction
from math import pi
from typing import Any, TypeVar

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import checks

Real = NDArray[np.float64]
Complex = NDArray[np.complex128]
Integer = NDArray[np.int64]
Bool = NDArray[np.bool_]
K = TypeVar("K")
V = TypeVar("V", covariant=True)

_WIDTH, _LINES = 88, 6  # columns and lines of a repr
_QUANTITY = re.compile(
    r"\s*([+-]?(?:\d{1,20}\.?\d{0,20}|\.\d{1,20})(?:[eE][+-]?\d{1,3})?)([^\d.].{0,29})?", re.ASCII
)
_TERM = re.compile(r"([A-Za-z%]+)\^?(-?\d?)", re.ASCII)
_SIGNALS = {
    "displacement": "m", "velocity": "m/s", "acceleration": "m/s^2", "jerk": "m/s^3", "travel": "m",
    "travel_rate": "m/s", "deflection": "m", "deflection_rate": "m/s", "load": "N", "force": "N",
}  # fmt: skip
_BASE = ("kg", "m", "s", "rad", "cycle")
_UNITS = {  # in other units; g is standard gravity as in deg/g, not gram
    "t": "1000 kg", "lb": "0.45359237 kg", "km": "1000 m", "cm": "0.01 m", "mm": "0.001 m", "in": "0.0254 m",
    "ft": "0.3048 m", "ms": "0.001 s", "min": "60 s", "h": "3600 s", "mph": "0.44704 m/s", "Hz": "1 s^-1",
    "N": "1 kg m/s^2", "kN": "1000 N", "lbf": "4.4482216152605 N", "g": "9.80665 m/s^2", "%": "0.01",
    "deg": f"{pi / 180} rad",
}  # fmt: skip


def unit(text: str, *limits: float) -> dict[str, Any]:
    """Return the metadata of a field in this unit; `limits` are its lowest and highest value."""
    return {"unit": text, "limits": limits} if limits else {"unit": text}


def quantity(name: str, text: str, unit: str = "", *, bare: bool = True) -> float:
    """Return the number in `unit` of a text with a unit of the same dimension, ``"100 km/h"``.

    A text of a `bare` number is in `unit`. The result is rounded once; factors of units are exact, except degrees.
    """
    match = _QUANTITY.fullmatch(text) if isinstance(text, str) else None
    if not match or not (match[2] or bare):
        raise ValueError(f"{name} must be a number with a unit like {unit or '%'}, got {checks.shown(text)}")
    number, given = Fraction(match[1]), (match[2] or "").strip()
    try:
        (factor, dimension), (size, needed) = _dimension(given or unit), _dimension(unit)
    except KeyError:
        symbols = ", ".join([*_BASE, *_UNITS])
        raise ValueError(f"{name} must be in units of {symbols}, got {checks.shown(given)}") from None
    if dimension != needed:
        needed_unit = f"in {unit} or a unit like it" if unit else "a number without unit"
        raise ValueError(f"{name} must be {needed_unit}, got {checks.shown(text)} in {given}")
    try:
        return float(number * factor / size)
    except OverflowError:
        raise ValueError(f"{name} must be of moderate size, got {checks.shown(text)}") from None


def _dimension(unit: str) -> tuple[Fraction, Counter[str]]:
    """Return the factor of a unit to base units, and the exponents of these; KeyError for an unknown symbol."""
    factor, exponents = Fraction(1), Counter[str]()
    written = re.sub(r"^(?!/)(?=.)", "*", re.sub(r"^1?\s*/\s*", "/", unit))  # "1/km" and "/km" too
    terms = re.split(r"\s*([/ *])\s*", written)[1:]
    for sign, term in zip(terms[::2], terms[1::2], strict=True):
        name, exponent = match.groups() if (match := _TERM.fullmatch(term)) else (term, "")
        size, base = Fraction(1), Counter({name: 1})
        if name not in _BASE:
            number, _, definition = _UNITS[name].partition(" ")
            size, base = _dimension(definition)
            size *= Fraction(number)
        power = int(exponent or 1) * (-1 if sign == "/" else 1)
        factor *= size**power
        exponents.update({one: n * power for one, n in base.items()})
    return factor, Counter({one: n for one, n in exponents.items() if n})


def wrapped(text: str) -> str:
    """Return the text of a repr wrapped into lines and cut."""
    return textwrap.fill(text, _WIDTH, subsequent_indent="    ", max_lines=_LINES, placeholder=" ...")


def frozen_array(values: ArrayLike, dtype: type = float) -> NDArray[Any]:
    """Return a read-only copy of the values."""
    array: NDArray[Any] = np.array(values, dtype=dtype)
    array.flags.writeable = False
    return array


def kept(values: ArrayLike) -> NDArray[Any]:
    """Return an array that is read-only for good as it is, a read-only copy of other values, as floats."""
    if isinstance(values, np.ndarray) and not values.flags.writeable and values.flags.c_contiguous:
        owner = values if values.base is None else values.base
        if isinstance(owner, np.ndarray) and owner.base is None and not owner.flags.writeable:
            return values
    return frozen_array(values)


def frozen(array: NDArray[Any]) -> NDArray[Any]:
    """Make a new array read-only and return it, for `kept`."""
    array.flags.writeable = False
    return array


class FrozenMapping(Mapping[K, V]):
    """An immutable copy of a mapping, hashable by its items, which can be pickled."""

    def __init__(self, items: Mapping[K, V]) -> None:
        self._items = dict(items)

    def __getitem__(self, key: K) -> V:
        return self._items[key]

    def __iter__(self) -> Iterator[K]:
        return iter(self._items)

    def __len__(self) -> int:
        return len(self._items)

    def __hash__(self) -> int:
        return hash(frozenset((key, _hashable(value)) for key, value in self._items.items()))

    def __repr__(self) -> str:
        return repr(self._items)


class Record:
    """Base of frozen dataclasses (``eq=False, repr=False``): equality, hash, repr and pickling by fields.

    Cached properties are not pickled; arrays remain read-only. The metadata of a field may have its ``unit`` and a
    function ``show``, which returns the text of the value in the repr.
    """

    def __eq__(self, other: object) -> bool:
        if type(self) is not type(other):
            return NotImplemented
        return self._values() == other._values()

    def __hash__(self) -> int:
        return hash((type(self), self._values()))

    def __getstate__(self) -> dict[str, Any]:
        return {f.name: self.__dict__[f.name] for f in self._fields()}

    def __setstate__(self, state: dict[str, Any]) -> None:
        for value in state.values():
            if isinstance(value, np.ndarray):
                value.flags.writeable = False
        self.__dict__.update(state)

    def __repr__(self) -> str:
        shown = (f for f in self._fields() if f.repr and not same(default_of(f), getattr(self, f.name)))
        text = f"{type(self).__name__}({', '.join(f'{f.name}={_shown(getattr(self, f.name), f)}' for f in shown)})"
        return wrapped(text)

    def _keep(self, **values: object) -> None:
        """Set fields of this frozen record in ``__post_init__``."""
        for name, value in values.items():
            object.__setattr__(self, name, value)

    def _values(self) -> tuple[object, ...]:
        return tuple(_hashable(getattr(self, f.name)) for f in self._fields() if f.compare)

    def _fields(self) -> tuple[Field[Any], ...]:
        return fields(self)  # type: ignore[arg-type]


class Checked(Record):
    """A record whose numbers must be within the limits of their fields, see `check_limits`."""

    def __post_init__(self) -> None:
        for one in self._fields():
            check_limits(one.name, getattr(self, one.name), one)


def check_limits(name: str, value: Any, one: Field[Any]) -> None:
    """Raise ValueError if the value of a field is outside its limits; by default > 0, or >= 0 if 0 is default."""
    if value is None and one.default is None:
        return
    if "limits" in one.metadata:
        checks.within(name, value, *one.metadata["limits"])
    elif one.type is float and "unit" in one.metadata:
        check = checks.not_negative if one.default == 0 else checks.positive
        check(name, value, one.metadata["unit"])


def _hashable(value: object) -> object:
    if isinstance(value, np.ndarray):
        return value.shape, value.dtype.str, value.tobytes()
    if isinstance(value, Mapping) and not isinstance(value, FrozenMapping):
        return FrozenMapping(value)
    if isinstance(value, list | tuple):
        return tuple(map(_hashable, value))
    return value


def default_of(one: Field[Any]) -> object:
    """Return the default of a field, or MISSING."""
    return one.default if one.default_factory is MISSING else one.default_factory()


def same(one: object, other: object) -> bool:
    """Whether two values of a field are equal and of the same type."""
    return type(one) is type(other) and _hashable(one) == _hashable(other)


def _shown(value: object, one: Field[Any]) -> str:
    if "show" in one.metadata:
        return str(one.metadata["show"](value))
    if isinstance(value, np.ndarray) and value.size > 2 and value.dtype.kind in "if":
        text = f"{value.shape} from {value.min():.6g} to {value.max():.6g}"
    elif isinstance(value, float):
        text = f"{value:.6g}"
    else:
        text = str(value) if isinstance(value, np.ndarray) else repr(value)
    return f"{text} {one.metadata.get('unit', '')}".rstrip()


def key_of(name: str, unit: str) -> str:
    """Return the key of a quantity in a file: its name and its unit, if any."""
    return "_".join([name, *unit.replace("^", "").replace("/", " per ").split()])


def signal_unit(signal: str) -> str:
    """Return the unit of a response or a deflection by the name of its signal, ``""`` if unknown."""
    if signal.startswith("acceleration_at"):
        return "m/s^2"
    what, _, kind = signal.rpartition("_")
    if kind == "rate":
        kind = f"{what.rpartition('_')[2]}_rate"
    unit = _SIGNALS.get(kind, "")
    return unit.replace("m", "rad") if what.rpartition("_")[2] in ("pitch", "roll") else unit


def column_headers(names: Sequence[str], units: Mapping[str, str]) -> list[str]:
    """Return the headers of columns, each name with its unit in brackets: ``"SWS [m]"``."""
    return [f"{name} [{units[name]}]" if units.get(name) else name for name in names]
