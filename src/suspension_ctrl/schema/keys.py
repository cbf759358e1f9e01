"""Keys of a table in a file, by the fields of the dataclass that it holds.

A field ``body_mass`` in kg has the key ``body_mass_kg`` of a number, or ``body_mass`` of a text, ``"1.2 t"``. In
a key ``^`` is left out of the unit and ``/`` is ``per``: ``pitch_inertia_kg_m2``, ``spring_N_per_m``. The type of
the field says how the value is written: a number, a text, an array, a table (a dataclass) or an array of tables (a
tuple of them); with ``kinds`` in its metadata, the key ``kind`` of the table names the dataclass. A field with a
`Form` in its metadata is read and written by that.
"""

from collections.abc import Callable, Mapping
from dataclasses import MISSING, Field, fields
from typing import Any, NamedTuple

from ..documents import Mistakes, Table
from ..quantities import check_limits, default_of, key_of

BAD: Any = object()
"""Marks a value that cannot be read; its mistake is noted."""

_MOST = 100  # equations of motion of more parts take gigabytes


def bad(*values: object) -> bool:
    """Whether one of the values is `BAD`, or a tuple that contains it."""
    return any(value is BAD or (isinstance(value, tuple) and bad(*value)) for value in values)


class Form(NamedTuple):
    """Functions that read a value from a table, `BAD` after a mistake, and write it."""

    read: Callable[[Table, Mistakes], Any]
    write: Callable[[Any], dict[str, Any]]


class Key(NamedTuple):
    """A key of a table, with the name, type and unit of its value."""

    key: str
    name: str
    form: Any  # type of the value
    unit: str = ""
    default: Any = MISSING
    check: Callable[[str, Any], object] = lambda _name, _value: None  # of a value, named as in errors
    kinds: Mapping[str, type] | None = None  # dataclasses by the key ``kind`` of the table
    rows: Any = None  # dataclass of a key and a value: a mapping is an array of such tables
    most: int = _MOST  # numbers or tables in an array
    own: Form | None = None
    instead: str = ""  # a key without which this one is required

    @property
    def required(self) -> bool:
        """Whether every table must have the key."""
        return self.default is MISSING

    @property
    def is_number(self) -> bool:
        """Whether the value is a number."""
        return self.form in (float, float | None)

    @property
    def stand_in(self) -> Any:
        """Value used for a wrong or missing one, 1 for a number: its table is then read and checked further."""
        return 1.0 if self.is_number else BAD


KIND = {"kind": Key("kind", "kind", str)}
"""The key that names the dataclass of a table."""


def keys_of(record: Any) -> Mapping[str, Key]:
    """Return the keys of the fields of a dataclass, without fields that are not in files."""
    written = (one for one in fields(record) if one.metadata.get("key", "") is not None)
    return {one.key: one for one in map(_key, written)}


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
        own=one.metadata.get("form"),
        instead=one.metadata.get("instead", ""),
    )
