"""Tables and texts of files written from dataclasses; each text is read back as a check."""

import tomllib
from collections.abc import Callable, Mapping
from dataclasses import is_dataclass
from typing import Any, TypeVar

import numpy as np

from .. import checks
from ..documents import Folder, Table
from ..quantities import same
from .keys import keys_of

T = TypeVar("T")

HERE = Folder()


def content(record: Any, kinds: Mapping[str, type] | None = None) -> dict[str, Any]:
    """Return the table from which `read_record` reads the dataclass: its kind if any, no default values."""
    table: dict[str, Any] = {}
    if kinds:
        named = [kind for kind, dataclass in kinds.items() if dataclass is type(record)]
        if not named:
            raise ValueError(f"a file must hold one of {', '.join(kinds)}, got {checks.shown(record)}")
        table["kind"] = named[0]
    for one in keys_of(type(record)).values():
        value = getattr(record, one.name)
        if not same(value, one.default):
            rows = value if one.rows is None else [one.rows(*row) for row in value.items()]
            table[one.key] = one.own.write(value) if one.own else _plain(rows, one.kinds)
    return table


def _plain(value: Any, kinds: Mapping[str, type] | None = None) -> Any:
    """Return a value in the types of TOML."""
    if is_dataclass(value):
        return content(value, kinds)
    if isinstance(value, tuple | list | np.ndarray):
        return [_plain(part) for part in value]
    if not isinstance(value, str | int | float | dict):
        raise ValueError(f"a file must hold numbers, texts and tables, got {checks.shown(value)}")
    return float(value) if isinstance(value, float) else value


def toml(table: Mapping[str, Any], record: T, reader: Callable[[Table], T], folder: Folder = HERE) -> str:
    """Return the text of a file in a folder; ValueError unless its `reader` reads an equal record from it."""
    import tomlkit

    text = tomlkit.dumps(_arrays(table))
    if reader(Table("", tomllib.loads(text), folder)) != record:
        raise ValueError(f"a file must hold all of what is written, got {checks.shown(record)}")
    return text


def _arrays(value: Any) -> Any:
    """Return a value with lists of numbers as arrays of tomlkit, which makes them of lists in quadratic time."""
    import tomlkit

    if isinstance(value, Mapping):
        return {key: _arrays(part) for key, part in value.items()}
    if not isinstance(value, list) or not value:
        return value
    numbers = all(type(part) in (int, float) for part in value)
    return tomlkit.value(repr(value)) if numbers else [_arrays(part) for part in value]
