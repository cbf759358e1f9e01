"""Keys of files by the fields of frozen dataclasses: reading, all mistakes at once, and writing.

A field ``body_mass`` in kg has the key ``body_mass_kg`` of a number, or ``body_mass`` of a text, ``"1.2 t"``. In
a key ``^`` is left out of the unit and ``/`` is ``per``: ``pitch_inertia_kg_m2``, ``spring_N_per_m``. The type of
the field says how the value is written: a number, a text, an array, a table (a dataclass) or an array of tables (a
tuple of them); with ``kinds`` in its metadata, the key ``kind`` of the table names the dataclass.
"""

import difflib
import tomllib
from collections.abc import Callable, Mapping
from contextlib import AbstractContextManager
from dataclasses import MISSING, Field, fields, is_dataclass
from typing import Any, NamedTuple, TypeVar, get_args

import numpy as np

from . import checks, escaping
from .documents import Mistakes, Table, keyed
from .quantities import Real, check_limits, default_of, key_of, quantity, same

T = TypeVar("T")

BAD: Any = object()
"""In place of a value that cannot be read; its mistake is noted."""

_SMALLEST, _LARGEST = 1e-12, 1e12  # beyond any vehicle; their squares, products and quotients are finite
_NUMBER = f"a number from {_SMALLEST:g} to {_LARGEST:g} in size or 0"
_MOST = 100  # numbers or tables in an array: equations of motion of more take gigabytes


def bad(*values: object) -> bool:
    """Whether one of the values is `BAD`, or a tuple with it."""
    return any(value is BAD or (isinstance(value, tuple) and bad(*value)) for value in values)


class Key(NamedTuple):
    """A key of a table: name, form and unit of its value, and a check of the value under a name."""

    key: str
    name: str
    form: Any  # type of the value
    unit: str = ""
    default: Any = MISSING
    check: Callable[[str, Any], object] = lambda _name, _value: None
    kinds: Mapping[str, type] | None = None  # dataclasses that the table may be
    rows: Any = None  # dataclass of a key and its value, of which a mapping is an array of tables
    most: int = _MOST

    @property
    def required(self) -> bool:
        """Whether a table must have the key."""
        return self.default is MISSING

    @property
    def is_number(self) -> bool:
        """Whether the value is a number."""
        return self.form in (float, float | None)


KIND = {"kind": Key("kind", "kind", str)}
"""The key that says which dataclass a table is."""


def keys_of(record: Any) -> Mapping[str, Key]:
    """Return the keys of a table with the fields of a dataclass."""
    return {one.key: one for one in map(_key, fields(record))}


def _key(one: Field[Any]) -> Key:
    unit = one.metadata.get("unit", "")
    return Key(
        key=one.metadata.get("key", key_of(one.name, unit)),
        name=one.name,
        form=one.type,
        unit=unit,
        default=default_of(one),
        check=lambda name, value: check_limits(name, value, one),
        kinds=one.metadata.get("kinds"),
        rows=one.metadata.get("rows"),
        most=one.metadata.get("most", _MOST),
    )


def read(table: Table, keys: Mapping[str, Key], mistakes: Mistakes, others: bool = False) -> dict[str, Any]:
    """Return the values of a table by name, of a wrong or absent number 1, of another wrong value `BAD`.

    With 1 in place of a wrong number the tables that depend on it are read and checked as well. Keys that are not
    known are mistakes, unless `others` are allowed.
    """
    with_unit = {one.name: one for one in keys.values() if one.unit}
    values: dict[str, Any] = {}
    meant: set[str | None] = set()
    for key, value in table.content.items():
        one = keys.get(key) or with_unit.get(key)
        if one is None and not others:
            meant.add(near := _nearest(key, keys))
            allowed = "a known key" if near else f"one of the keys {', '.join(keys)}"
            hint = f": did you mean {near}?" if near else ""
            named = table.name + escaping.terminal(key)[:40]
            mistakes.note(f"{named} must be {allowed}, got {checks.shown(value)}{hint}")
        elif one and one.name in values:
            mistakes.note(f"{table.name}{key} must be given once, got {one.name} and {one.key}")
        elif one:
            values[one.name] = 1.0 if one.is_number else BAD
            with mistakes.noted():
                values[one.name] = _value(one, table.name + key, value, mistakes, typed=key != one.key)
    for one in keys.values():
        if one.required and one.name not in values:
            values[one.name] = 1.0 if one.is_number else BAD
            if one.key not in meant:
                mistakes.note(f"{table.name}{one.key} must be given, got none")
    return values


def _nearest(key: str, keys: Mapping[str, Key]) -> str | None:
    """Return the key of the same name in another unit, or one that is spelt alike."""
    named = [(len(one.name), one.key) for one in keys.values() if f"{key}_".startswith(f"{one.name}_")]
    alike = difflib.get_close_matches(key[:100], keys, 1, 0.7)
    heads = [text.partition(".")[0] for text in (key[:100], *alike)]
    if len(set(heads)) == 2 and difflib.SequenceMatcher(None, *heads).ratio() < 0.6:  # another strut's coefficient
        alike = []
    return max(named)[1] if named else next(iter(alike), None)


def made(record: type[T], table: Table, mistakes: Mistakes, beside: Mapping[str, Key] | None = None) -> T:
    """Return a dataclass by a table that may have keys `beside` its fields, `BAD` if it cannot be made."""
    before = len(mistakes)
    values = read(table, {**keys_of(record), **(beside or {})}, mistakes)
    return constructed(record, values, table.name, mistakes if len(mistakes) == before else Mistakes())


def constructed(record: type[T], values: Mapping[str, Any], name: str, mistakes: Mistakes) -> T:
    """Return a dataclass of the values that are its fields, in the table `name`, `BAD` if it cannot be made."""
    own = {one.name: values[one.name] for one in keys_of(record).values() if one.name in values}
    if bad(*own.values()):
        return BAD
    with mistakes.noted(), fields_named(record, name):
        return record(**own)
    return BAD


def fields_named(record: Any, name: str) -> AbstractContextManager[None]:
    """Return a context that names the keys of the table `name` in errors about the fields of a dataclass."""
    return keyed(name, {one.name: key for key, one in keys_of(record).items()})


def kind_of(kinds: Mapping[str, type[T]], table: Table, mistakes: Mistakes) -> type[T]:
    """Return the dataclass that the key ``kind`` of a table names, `BAD` if it names none."""
    with mistakes.noted():
        checks.one_of(f"{table.name}kind", table.content.get("kind"), tuple(kinds))
        return kinds[table.content["kind"]]
    return BAD


def table_of(key: str, value: Any) -> Table:
    """Return the table under a key; ValueError for another value."""
    if not isinstance(value, dict):
        raise ValueError(f"{key} must be a table, got {checks.shown(value)}")
    return Table(f"{key}.", value)


def _value(one: Key, key: str, value: Any, mistakes: Mistakes, typed: bool) -> Any:
    """Return the value of a key, `typed` with its unit; ValueError, or mistakes noted, if it does not fit."""
    if one.kinds:
        table = table_of(key, value)
        record: Any = kind_of(one.kinds, table, mistakes)
        return BAD if bad(record) else made(record, table, mistakes, KIND)
    if one.rows:
        return _mapping(_tables(one.rows, one.most, key, value, mistakes), key)
    records: list[Any] = [part for part in (one.form, *get_args(one.form)) if is_dataclass(part)]
    if not records:
        return _READERS[one.form](one, key, value, typed)
    if ... in get_args(one.form):
        return _tables(records[0], one.most, key, value, mistakes)
    return made(records[0], table_of(key, value), mistakes)


def _tables(record: type[T], most: int, key: str, value: Any, mistakes: Mistakes) -> tuple[T, ...]:
    """Return dataclasses by an array of tables, `BAD` in place of those that cannot be made."""
    if not (isinstance(value, list) and len(value) <= most):
        raise ValueError(f"{key} must be an array of up to {most} tables, got {checks.shown(value)}")
    found = [BAD] * len(value)
    for i, part in enumerate(value):
        with mistakes.noted():
            found[i] = made(record, table_of(f"{key}[{i + 1}]", part), mistakes)
    return tuple(found)


def _mapping(rows: tuple[Any, ...], key: str) -> Any:
    """Return a mapping by its rows, `BAD` if one is; ValueError if there are none or two have the same key."""
    if bad(*rows):
        return BAD
    pairs = [tuple(vars(row).values()) for row in rows]
    if len(found := dict(pairs)) < max(1, len(rows)):
        needed = "an array of tables, one at least, each for a place of its own"
        raise ValueError(f"{key} must be {needed}, got {checks.shown([place for place, _ in pairs])}")
    return found


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
    whole = checks.at_least(key, value, 1)
    one.check(key, whole)
    return whole


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


def _fitting(fits: Callable[[Any], bool], words: str) -> Callable[[Key, str, Any, bool], Any]:
    """Return a reader of values that fit as they are."""

    def reader(_one: Key, key: str, value: Any, _typed: bool) -> Any:
        if not fits(value):
            raise ValueError(f"{key} must be {words}, got {checks.shown(value)}")
        return tuple(value) if isinstance(value, list) else value

    return reader


def _is_texts(value: Any) -> bool:
    return isinstance(value, list) and all(isinstance(text, str) for text in value)


_TEXT = _fitting(lambda value: isinstance(value, str) and bool(value.strip()), "a text")
_TABLE = _fitting(lambda value: isinstance(value, dict), "a table")
_READERS: dict[Any, Callable[[Key, str, Any, bool], Any]] = {
    float: _number,
    float | None: _number,
    int | None: _whole,
    bool: _fitting(lambda value: isinstance(value, bool), "true or false"),
    str: _TEXT,
    tuple[str, ...]: _fitting(_is_texts, "an array of texts"),
    tuple[float, float]: _pair,
    tuple[float, ...]: _numbers,
    Real: _numbers,
    str | tuple[float, ...]: lambda *given: (_TEXT if isinstance(given[2], str) else _numbers)(*given),
    Mapping[str, Any]: _TABLE,
    str | Mapping[str, Any]: lambda *given: (_TABLE if isinstance(given[2], dict) else _TEXT)(*given),
}


def content(record: Any, kinds: Mapping[str, type] | None = None) -> dict[str, Any]:
    """Return the table that `made` makes this dataclass of, without defaults; with its ``kind`` if it has one."""
    found: dict[str, Any] = {}
    if kinds:
        named = [kind for kind, known in kinds.items() if known is type(record)]
        if not named:
            raise ValueError(f"a file must hold one of {', '.join(kinds)}, got {checks.shown(record)}")
        found["kind"] = named[0]
    for one in keys_of(type(record)).values():
        value = getattr(record, one.name)
        if not same(value, one.default):
            rows = value if one.rows is None else [one.rows(*row) for row in value.items()]
            found[one.key] = _plain(rows, one.kinds)
    return found


def _plain(value: Any, kinds: Mapping[str, type] | None = None) -> Any:
    """Return a value as TOML has it."""
    if is_dataclass(value):
        return content(value, kinds)
    if isinstance(value, tuple | list | np.ndarray):
        return [_plain(part) for part in value]
    if not isinstance(value, str | int | float | dict):
        raise ValueError(f"a file must hold numbers, texts and tables, got {checks.shown(value)}")
    return float(value) if isinstance(value, float) else value


def toml(table: Mapping[str, Any], record: T, reader: Callable[[Table], T]) -> str:
    """Return the text of a file; ValueError unless its `reader` makes an equal record of it."""
    import tomlkit

    text = tomlkit.dumps(table)
    if reader(Table("", tomllib.loads(text))) != record:
        raise ValueError(f"a file must hold all of what is written, got {checks.shown(record)}")
    return text
