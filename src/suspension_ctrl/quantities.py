"""Names and units of quantities; frozen records of them, compared, hashed and shown by their fields."""

import textwrap
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import MISSING, Field, fields
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

_WIDTH, _LINES = 88, 6  # most columns and lines of a record's repr


def unit(text: str, *limits: float) -> dict[str, Any]:
    """Return the metadata of a field in this unit and from a lowest to a highest value, if there are `limits`."""
    return {"unit": text, "limits": limits} if limits else {"unit": text}


def wrapped(text: str) -> str:
    """Return the text of a repr in lines, cut after the last that it may take."""
    return textwrap.fill(text, _WIDTH, subsequent_indent="    ", max_lines=_LINES, placeholder=" ...")


def frozen_array(values: ArrayLike, dtype: type = float) -> NDArray[Any]:
    """Return a read-only copy of the values."""
    array: NDArray[Any] = np.array(values, dtype=dtype)
    array.flags.writeable = False
    return array


class FrozenMapping(Mapping[K, V]):
    """An immutable copy of a mapping, hashable with its values, and fit for pickling."""

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
    """Equality, hash, repr and pickling of a frozen dataclass (``eq=False, repr=False``) by its fields.

    Cached properties are not pickled; arrays stay read-only. The metadata of a field may have its ``unit`` and a
    function ``show`` from the value to the text in `repr`.
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
        shown = (f for f in self._fields() if f.repr and not _is_default(f, getattr(self, f.name)))
        text = f"{type(self).__name__}({', '.join(f'{f.name}={_shown(getattr(self, f.name), f)}' for f in shown)})"
        return wrapped(text)

    def _keep(self, **values: object) -> None:
        """Set fields of this frozen record, in ``__post_init__``."""
        for name, value in values.items():
            object.__setattr__(self, name, value)

    def _values(self) -> tuple[object, ...]:
        return tuple(_hashable(getattr(self, f.name)) for f in self._fields() if f.compare)

    def _fields(self) -> tuple[Field[Any], ...]:
        return fields(self)  # type: ignore[arg-type]


class Checked(Record):
    """A record of numbers within the limits of their fields, or above zero; zero is allowed if it is a default."""

    def __post_init__(self) -> None:
        for one in self._fields():
            value, metadata = getattr(self, one.name), one.metadata
            if "limits" in metadata:
                checks.within(one.name, value, *metadata["limits"])
            elif one.type is float and "unit" in metadata:
                check = checks.not_negative if one.default == 0 else checks.positive
                check(one.name, value, metadata["unit"])


def _hashable(value: object) -> object:
    if isinstance(value, np.ndarray):
        return value.shape, value.dtype.str, value.tobytes()
    if isinstance(value, Mapping) and not isinstance(value, FrozenMapping):
        return FrozenMapping(value)
    if isinstance(value, list | tuple):
        return tuple(map(_hashable, value))
    return value


def _is_default(one: Field[Any], value: object) -> bool:
    default = one.default if one.default_factory is MISSING else one.default_factory()
    return type(default) is type(value) and _hashable(default) == _hashable(value)


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
    """Return the key of a quantity: its name and its unit, ``""`` if it has none."""
    return "_".join([name, *unit.replace("^", "").replace("/", " per ").split()])


def signal_unit(signal: str) -> str:
    """Return the unit of a response or a deflection by its name as a signal, empty if that tells none."""
    if signal in ("pitch_acceleration", "roll_acceleration"):
        return "rad/s^2"
    if signal.endswith("acceleration") or signal.startswith("acceleration_at"):
        return "m/s^2"
    return {"travel": "m", "deflection": "m", "displacement": "m", "load": "N"}.get(signal.rsplit("_", 1)[-1], "")


def column_headers(names: Sequence[str], units: Mapping[str, str]) -> list[str]:
    """Return each name with its unit in brackets, as in the header of a table: ``"SWS [m]"``."""
    return [f"{name} [{units[name]}]" if units.get(name) else name for name in names]
