"""Checks of user input: each raises a ValueError with the parameter, what is allowed and the value."""

import reprlib
import stat
import sys
from collections.abc import Callable, Collection, Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from math import ceil, floor
from operator import eq
from os import PathLike, fspath
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

_LARGEST = sys.float_info.max
_SLACK = 1e-9  # tolerance of a bound, as a share of the range of the variable
_SHOWN = 40  # characters of a value in an error
_ALL, _TOLD = 12, 8  # most names in an error, and how many of more
_KINDS: dict[str, tuple[str, Callable[[float, float], bool]]] = {
    "integer": (
        "hold a whole number of at most 1e15",
        lambda low, high: -1e15 <= ceil(low) <= floor(high) <= 1e15,
    ),
    "log": ("be above 0", lambda low, _: low > 0),
    "fixed": ("be equal", eq),
}
_BRIEF = reprlib.Repr()
_BRIEF.maxstring = _BRIEF.maxother = _BRIEF.maxlong = _SHOWN


@contextmanager
def installed(extra: str) -> Iterator[None]:
    """Replace a ModuleNotFoundError of the block by an ImportError that names the extra to install."""
    try:
        yield
    except ModuleNotFoundError as error:
        message = f'{error.name} must be installed, by: pip install "suspension-ctrl[{extra}]"'
        raise ImportError(message, name=error.name) from None


@contextmanager
def readable(kind: str) -> Iterator[None]:
    """Replace any error of a reader, on a damaged file, by a ValueError of one line."""
    try:
        yield
    except Exception:
        raise ValueError(f"the file must be {kind}, got one that cannot be read") from None


def shown(value: object) -> str:
    """Return the repr of a value for an error: one line without control characters, cut to 40 characters."""
    try:
        text = " ".join(_BRIEF.repr(value).split())
    except ValueError:  # Python converts no integer of more than 4300 digits
        text = "a number of thousands of digits"
    return text if len(text) <= _SHOWN else f"{text[: _SHOWN - 3]}..."


def regular(path: Path, most: float) -> None:
    """Raise ValueError unless a file is regular and has at most `most` MB; OSError if it does not exist."""
    status = path.stat()
    got = f"{status.st_size / 1e6:.6g} MB" if stat.S_ISREG(status.st_mode) else "another kind"
    if got == "another kind" or status.st_size > most * 1e6:
        raise ValueError(f"the file must be a regular one of at most {most:g} MB, got {got}")


def positive(name: str, value: float, unit: str = "") -> None:
    """Raise ValueError unless `value` is a finite number above zero."""
    if not (_is_real(value) and 0 < value <= _LARGEST):
        raise ValueError(f"{name} must be finite and > 0{f' {unit}'.rstrip()}, got {shown(value)}")


def not_negative(name: str, value: float, unit: str = "") -> None:
    """Raise ValueError unless `value` is a finite number of zero or more."""
    if not (_is_real(value) and 0 <= value <= _LARGEST):
        raise ValueError(f"{name} must be finite and >= 0{f' {unit}'.rstrip()}, got {shown(value)}")


def at_least(name: str, value: int, minimum: int) -> int:
    """Return an integer of any type as int; ValueError unless it is at least `minimum`."""
    if not (isinstance(value, int | np.integer) and not isinstance(value, bool) and value >= minimum):
        raise ValueError(f"{name} must be a whole number >= {minimum}, got {shown(value)}")
    return int(value)


def reals(subject: str, values: object) -> NDArray[np.float64]:
    """Return values as a new float array; ValueError for texts, masked arrays and ragged rows."""
    return np.array(_of_reals(subject, values), dtype=float, order="C")


def _of_reals(subject: str, values: object) -> NDArray[Any]:
    needed = "an array of real numbers"
    if np.ma.isMaskedArray(values) or isinstance(values, str | bytes | Mapping | Iterator | None):
        raise ValueError(f"{subject} {needed}, got {shown(values)}")
    try:
        array = np.asarray(values)
        if array.dtype.kind in "biuf":
            return array
        if array.dtype.kind == "O":
            return array.astype(float)
    except (TypeError, ValueError):  # rows of unequal length, texts or objects among the numbers
        pass
    raise ValueError(f"{subject} {needed}, got {shown(values)}")


def within(name: str, value: float, lowest: float, highest: float) -> None:
    """Raise ValueError unless `value` lies in the closed interval from `lowest` to `highest`."""
    if not (_is_real(value) and lowest <= value <= highest):
        raise ValueError(f"{name} must be a number from {lowest} to {highest}, got {shown(value)}")


def interval(name: str, value: ArrayLike, unit: str, *, equal: bool = False, signed: bool = False) -> None:
    """Raise ValueError unless `value` is a pair of finite numbers, 0 <= lower < upper, or <= if `equal`.

    A `signed` lower one may be below 0.
    """
    pair = list(value) if isinstance(value, Sequence | np.ndarray) else []
    real = (
        len(pair) == 2
        and all(map(_is_real, pair))
        and (-_LARGEST if signed else 0) <= pair[0] <= pair[1] <= _LARGEST
    )
    if not real or (pair[0] == pair[1] and not equal):
        needed = f"{'' if signed else '0 <= '}lower {'<=' if equal else '<'} upper"
        raise ValueError(f"{name} must be finite with {needed} [{unit}], got {shown(value)}")


def ascending(name: str, values: NDArray[np.float64]) -> None:
    """Raise ValueError unless values (k,) are finite, above zero and ascending."""
    wrong = ~(np.isfinite(values) & (np.diff(values, prepend=0.0) > 0))
    if wrong.any():
        got = f"{values[wrong.argmax()]} in row {wrong.argmax() + 1}"
        raise ValueError(f"{name} must be finite, above zero and ascend, got {got}")


def position(name: str, value: object) -> tuple[float, float]:
    """Return a pair of floats; ValueError unless `value` is two finite numbers."""
    pair = list(value) if isinstance(value, Sequence | np.ndarray) and not isinstance(value, str) else []
    if not (len(pair) == 2 and all(_is_real(x) and abs(x) <= _LARGEST for x in pair)):
        raise ValueError(f"{name} must be two finite numbers, x and y [m], got {shown(value)}")
    return float(pair[0]), float(pair[1])


def mapped(name: str, value: object) -> None:
    """Raise ValueError unless `value` is a mapping."""
    if not isinstance(value, Mapping):
        raise ValueError(f"{name} must be a mapping by name, got {shown(value)}")


def of_kind(name: str, value: object, *kinds: type) -> None:
    """Raise ValueError unless `value` is of one of the `kinds`."""
    if not isinstance(value, kinds):
        raise ValueError(f"{name} must be a {' or '.join(kind.__name__ for kind in kinds)}, got {shown(value)}")


def with_method(name: str, value: object, method: str) -> None:
    """Raise ValueError unless `value` is an object, no class, with a `method`."""
    if isinstance(value, type) or not callable(getattr(value, method, None)):
        raise ValueError(f"{name} must be an object with a method {method}, got {shown(value)}")


def path_of(name: str, value: object) -> Path:
    """Return the path; ValueError unless `value` is a text or path-like."""
    if not isinstance(value, str | PathLike) or isinstance(fspath(value), bytes):
        raise ValueError(f"{name} must be a text or a path, got {shown(value)}")
    return Path(value)


def listed(name: str, value: object) -> None:
    """Raise ValueError unless `value` is a collection other than a string."""
    if isinstance(value, str) or not isinstance(value, Iterable):
        raise ValueError(f"{name} must be a list, got {shown(value)}")


def one_of(name: str, value: object, allowed: Collection[object]) -> None:
    """Raise ValueError unless `value` is one of `allowed`."""
    if not any(value == choice for choice in allowed):
        raise ValueError(f"{name} must be one of {listing(allowed, value)}, got {shown(value)}")


def listing(names: Iterable[object], near: object = "") -> str:
    """Return names for an error: all up to 12, of more the 8 that are most like `near`, then the first.

    >>> listing(["front", "rear"])
    'front, rear'
    >>> listing([f"axle_{n}" for n in range(30)], "axle29")
    'axle_29, axle_9, axle_2, axle_0, axle_1, axle_3, axle_4, axle_5, ... and 22 more'
    """
    texts = list(map(str, names))
    if len(texts) <= _ALL:
        return ", ".join(texts)
    from difflib import get_close_matches

    alike = get_close_matches(near[:100] if isinstance(near, str) else shown(near), texts)
    told = list(dict.fromkeys([*alike, *texts]))[:_TOLD]
    return f"{', '.join(told)}, ... and {len(texts) - len(told)} more"


def ordered(lower_name: str, upper_name: str, lower: ArrayLike, upper: ArrayLike) -> None:
    """Raise ValueError unless bounds (d,) are finite, lower <= upper, and lower < upper in one variable."""
    low, high = reals(f"{lower_name} must be", lower), reals(f"{upper_name} must be", upper)
    if low.ndim != 1 or low.shape != high.shape or low.size == 0:
        needed, got = "one-dimensional and of one length", f"{lower!r} and {upper!r}"
        raise ValueError(f"{lower_name} and {upper_name} must be {needed}, got {got}")
    if not (np.isfinite(low).all() and np.isfinite(high).all() and (low <= high).all() and (low < high).any()):
        needed = f"finite, <= {upper_name} in every variable and < {upper_name} in one"
        raise ValueError(f"{lower_name} must be {needed}, got {low.tolist()} and {high.tolist()}")


def kinds(
    given: Mapping[str, object], variables: Sequence[str], lower: Sequence[float], upper: Sequence[float]
) -> dict[str, str | tuple[float, ...]]:
    """Return the kinds of variables by name, catalogues sorted; ValueError unless they fit the bounds (d,)."""
    if not isinstance(given, Mapping):
        raise ValueError(f"kinds must be a mapping by variable, got {shown(given)}")
    checked: dict[str, str | tuple[float, ...]] = {}
    for name, kind in given.items():
        one_of("kinds", name, variables)
        low, high = (bound[variables.index(name)] for bound in (lower, upper))
        if isinstance(kind, str) and kind in _KINDS:
            needed, fits = _KINDS[kind]
            if not fits(low, high):
                raise ValueError(f"bounds of {name} must {needed}, got {low} and {high}")
            checked[name] = kind
            continue
        listed = kind.tolist() if isinstance(kind, np.ndarray) else kind
        values = list(listed) if isinstance(listed, Iterable) and not isinstance(listed, str) else []
        if not values or not all(_is_real(value) and low <= value <= high for value in values):
            allowed = f"{', '.join(_KINDS)} or values from {low:g} to {high:g}"
            raise ValueError(f"kinds of {name} must be {allowed}, got {shown(kind)}")
        checked[name] = tuple(sorted({float(value) for value in values}))
    ends = [kind_ends(checked.get(name, ""), *pair) for name, *pair in zip(variables, lower, upper, strict=True)]
    if all(first == last for first, last in ends):
        raise ValueError(f"kinds must leave a variable that is not held, got {shown(given)}")
    return checked


def kind_ends(kind: str | tuple[float, ...], lower: float, upper: float) -> tuple[float, float]:
    """Return the least and the greatest value of a variable of this kind within its bounds."""
    if isinstance(kind, tuple):
        return kind[0], kind[-1]
    return (float(ceil(lower)), float(floor(upper))) if kind == "integer" else (lower, upper)


def designs(values: ArrayLike, variables: int) -> NDArray[np.float64]:
    """Return designs as a float array (n, variables); ValueError for another shape."""
    array = np.ascontiguousarray(_of_reals("designs must be", values), dtype=float)
    if array.ndim != 2 or array.shape[1] != variables:
        raise ValueError(f"designs must have shape (n, {variables}), got {array.shape}")
    return array


def rows_within(name: str, rows: NDArray[np.float64], lower: Iterable[float], upper: Iterable[float]) -> None:
    """Raise ValueError unless all rows (n, d) are within `lower` and `upper` (d,), up to rounding."""
    columns = np.ascontiguousarray(rows.T)  # numpy is slow along short rows
    least, largest = columns.min(axis=1, initial=np.inf), columns.max(axis=1, initial=-np.inf)
    ends = zip(lower, least.tolist(), largest.tolist(), upper, strict=True)  # and slow with few numbers
    if not all(a - _SLACK * (b - a) <= low and high <= b + _SLACK * (b - a) for a, low, high, b in ends):  # or NaN
        low, high = (np.asarray(bound, dtype=float) for bound in (lower, upper))
        slack = _SLACK * (high - low)
        inside = (rows >= low - slack) & (rows <= high + slack)
        got = rows[inside.all(axis=1).argmin()].tolist()
        raise ValueError(f"{name} must lie within {low.tolist()} and {high.tolist()}, got {got}")


def _is_real(value: object) -> bool:
    return isinstance(value, int | float | np.integer | np.floating) and not isinstance(value, bool)
