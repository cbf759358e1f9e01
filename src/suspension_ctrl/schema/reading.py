"""Dataclasses read from tables of a file; all mistakes of the file are listed at once."""

import difflib
from collections.abc import Callable, Mapping
from contextlib import AbstractContextManager
from dataclasses import is_dataclass
from typing import Any, TypeVar, get_args

from numpy.typing import ArrayLike

from .. import checks, escaping
from ..documents import Mistakes, Table, keyed
from ..quantities import Real, quantity
from .keys import BAD, KIND, Key, bad, keys_of

T = TypeVar("T")

_SMALLEST, _LARGEST = 1e-12, 1e12  # beyond any vehicle; their squares, products and quotients are finite
_NUMBER = f"a number from {_SMALLEST:g} to {_LARGEST:g} in size or 0"


def read(table: Table, keys: Mapping[str, Key], mistakes: Mistakes, others: bool = False) -> dict[str, Any]:
    """Return the values of a table by name, `Key.stand_in` for a wrong or missing one; note all mistakes.

    Unknown keys are mistakes, unless `others` are allowed.
    """
    with_unit = {one.name: one for one in keys.values() if one.unit}
    values: dict[str, Any] = {}
    misspelt: set[str | None] = set()
    for key, value in table.content.items():
        one = keys.get(key) or with_unit.get(key)
        if one is None and not others:
            misspelt.add(near := _nearest(key, keys))
            allowed = "a known key" if near else f"one of the keys {checks.listing(keys, key)}"
            hint = f": did you mean {near}?" if near else ""
            named = table.name + escaping.terminal(key)[:40]
            mistakes.note(f"{named} must be {allowed}, got {checks.shown(value)}{hint}")
        elif one and one.name in values:
            mistakes.note(f"{table.name}{key} must be given once, got {one.name} and {one.key}")
        elif one:
            values[one.name] = one.stand_in
            with mistakes.noted():
                values[one.name] = _value(one, table, key, value, mistakes)
    for one in keys.values():
        required = one.required or (one.instead and one.instead not in table.content)
        if required and one.name not in values:
            values[one.name] = one.stand_in
            if one.key not in misspelt:
                mistakes.note(f"{table.name}{one.key} must be given, got none")
    return values


def _nearest(key: str, keys: Mapping[str, Key]) -> str | None:
    """Return the key of the same name in another unit, or the key of the nearest spelling, if any."""
    named = [(len(one.name), one.key) for one in keys.values() if f"{key}_".startswith(f"{one.name}_")]
    alike = difflib.get_close_matches(key[:100], keys, 1, 0.7)
    heads = [text.partition(".")[0] for text in (key[:100], *alike)]
    if len(set(heads)) == 2 and difflib.SequenceMatcher(None, *heads).ratio() < 0.6:  # another strut's coefficient
        alike = []
    return max(named)[1] if named else next(iter(alike), None)


def read_record(record: type[T], table: Table, mistakes: Mistakes, beside: Mapping[str, Key] | None = None) -> T:
    """Return the dataclass in a table that may have keys `beside` its fields, `BAD` after a mistake."""
    before = len(mistakes)
    values = read(table, {**keys_of(record), **(beside or {})}, mistakes)
    return constructed(record, values, table.name, mistakes if len(mistakes) == before else Mistakes())


def constructed(record: type[T], values: Mapping[str, Any], name: str, mistakes: Mistakes) -> T:
    """Return a dataclass with its values of the table `name`, `BAD` after a mistake."""
    own = {one.name: values[one.name] for one in keys_of(record).values() if one.name in values}
    if bad(*own.values()):
        return BAD
    with mistakes.noted(), fields_named(record, name):
        return record(**own)
    return BAD


def fields_named(record: Any, name: str) -> AbstractContextManager[None]:
    """Return a context in which errors about the fields of a dataclass name the keys of the table `name`."""
    return keyed(name, {one.name: key for key, one in keys_of(record).items()})


def kind_of(kinds: Mapping[str, type[T]], table: Table, mistakes: Mistakes) -> type[T]:
    """Return the dataclass that the key ``kind`` of a table names, `BAD` after a mistake."""
    with mistakes.noted():
        checks.one_of(f"{table.name}kind", table.content.get("kind"), tuple(kinds))
        return kinds[table.content["kind"]]
    return BAD


def _value(one: Key, table: Table, key: str, value: Any, mistakes: Mistakes) -> Any:
    """Return the value of a key, with its unit if the key has none; note mistakes of inner tables, raise other."""
    if one.own:
        return one.own.read(table.inner(key, value), mistakes)
    if one.kinds:
        inner = table.inner(key, value)
        record: Any = kind_of(one.kinds, inner, mistakes)
        return BAD if bad(record) else read_record(record, inner, mistakes, KIND)
    if one.rows:
        return _mapping(_tables(one.rows, one.most, table, key, value, mistakes), table.name + key)
    records: list[Any] = [part for part in (one.form, *get_args(one.form)) if is_dataclass(part)]
    if not records:
        return _without_table(one, table.name + key, value, typed=key != one.key)
    if ... in get_args(one.form):
        return _tables(records[0], one.most, table, key, value, mistakes)
    return read_record(records[0], table.inner(key, value), mistakes)


def _tables(record: type[T], most: int, table: Table, key: str, value: Any, mistakes: Mistakes) -> tuple[T, ...]:
    """Return the dataclasses in an array of tables, `BAD` for a table with a mistake."""
    if not (isinstance(value, list) and len(value) <= most):
        needed = f"an array of up to {most} tables"
        raise ValueError(f"{table.name}{key} must be {needed}, got {checks.shown(value)}")
    records = [BAD] * len(value)
    for i, part in enumerate(value):
        with mistakes.noted():
            records[i] = read_record(record, table.inner(f"{key}[{i + 1}]", part), mistakes)
    return tuple(records)


def _mapping(rows: tuple[Any, ...], key: str) -> Any:
    """Return the mapping of rows of a key and a value, `BAD` if a row is; ValueError if none or a key twice."""
    if bad(*rows):
        return BAD
    pairs = [tuple(vars(row).values()) for row in rows]
    if len(mapping := dict(pairs)) < max(1, len(rows)):
        needed = "an array of tables, one at least, each for a place of its own"
        raise ValueError(f"{key} must be {needed}, got {checks.shown([place for place, _ in pairs])}")
    return mapping


def _number(one: Key, key: str, value: Any, typed: bool) -> float:
    if typed:
        if not isinstance(value, str):
            needed = f"a text with a unit like '1 {one.unit}', or {one.key} a number"
            raise ValueError(f"{key} must be {needed}, got {checks.shown(value)}")
        value = quantity(key, value, one.unit, bare=False)
    real = isinstance(value, int | float) and not isinstance(value, bool)
    if not (real and (value == 0 or _SMALLEST <= abs(value) <= _LARGEST)):
        raise ValueError(f"{key} must be {_NUMBER}, got {checks.shown(value)}")
    number = float(value)
    if one.is_number:
        one.check(key, number)
    return number


def _whole(one: Key, key: str, value: Any, _typed: bool) -> int:
    whole = checks.at_least(key, value, 0 if one.default == 0 else 1)
    one.check(key, whole)
    return whole


def _wholes(one: Key, key: str, value: Any, _typed: bool) -> tuple[int, ...]:
    if not (isinstance(value, list) and 0 < len(value) <= one.most):
        raise ValueError(f"{key} must be an array of up to {one.most} whole numbers, got {checks.shown(value)}")
    return tuple(checks.at_least(f"{key}[{i}]", number, 1) for i, number in enumerate(value, start=1))


def _numbers(one: Key, key: str, value: Any, typed: bool) -> tuple[float, ...]:
    if not (isinstance(value, list) and 0 < len(value) <= one.most):
        raise ValueError(f"{key} must be an array of up to {one.most} numbers, got {checks.shown(value)}")
    return tuple(_number(one, f"{key}[{i}]", number, typed) for i, number in enumerate(value, start=1))


def _pair(one: Key, key: str, value: Any, typed: bool) -> tuple[float, float]:
    if not (isinstance(value, list) and len(value) == 2):
        raise ValueError(f"{key} must be an array of two numbers, got {checks.shown(value)}")
    low, high = _numbers(one, key, value, typed)
    one.check(key, (low, high))
    return low, high


_NUMERIC: dict[Any, Callable[[Key, str, Any, bool], Any]] = {
    float: _number, float | None: _number, int: _whole, int | None: _whole, tuple[int, ...]: _wholes,
    tuple[float, float]: _pair, tuple[float, float] | None: _pair,
    tuple[float, ...]: _numbers, Real: _numbers, ArrayLike: _numbers, ArrayLike | None: _numbers,
}  # fmt: skip
_OTHERS: dict[Any, tuple[str, Callable[[Any], bool]]] = {
    bool: ("true or false", lambda value: isinstance(value, bool)),
    str: ("a text", lambda value: isinstance(value, str) and bool(value.strip())),
    tuple[str, ...]: (
        "an array of texts",
        lambda value: isinstance(value, list) and all(isinstance(text, str) for text in value),
    ),
    Mapping[str, Any]: ("a table", lambda value: isinstance(value, dict)),
}


def _without_table(one: Key, key: str, value: Any, typed: bool) -> Any:
    """Return a number, a text, an array of them or a table of any keys; ValueError for another value."""
    form = one.form
    if form == str | tuple[float, ...]:
        form = str if isinstance(value, str) else tuple[float, ...]
    if form in (str | Mapping[str, Any], tuple[str, ...] | Mapping[str, Any]):
        form = Mapping[str, Any] if isinstance(value, dict) else get_args(form)[0]
    return _NUMERIC[form](one, key, value, typed) if form in _NUMERIC else _fitting(form, key, value)


def _fitting(form: Any, key: str, value: Any) -> Any:
    """Return a value of this form, an array as a tuple; ValueError for another value."""
    allowed, fits = _OTHERS[form]
    if not fits(value):
        raise ValueError(f"{key} must be {allowed}, got {checks.shown(value)}")
    return tuple(value) if isinstance(value, list) else value
