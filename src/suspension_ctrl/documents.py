"""TOML files whose keys end in their units; an error names the file and the key in one line.

A quantity called ``body_mass`` in kg has the key ``body_mass_kg``; of units, ``^`` is left out and ``/`` spelt
``per``: ``pitch_inertia_kg_m2``, ``spring_N_per_m``.
"""

import re
import tomllib
from collections.abc import Callable, Collection, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import MISSING, dataclass, fields
from os import PathLike
from pathlib import Path
from typing import Any, TypeVar

from . import checks, escaping
from .quantities import key_of

T = TypeVar("T")

_SMALLEST, _LARGEST = 1e-12, 1e12  # beyond any vehicle; their squares, products and quotients are finite
_NUMBER = f"a number from {_SMALLEST:g} to {_LARGEST:g} in size or 0"
_MOST = 100  # numbers or tables in an array: equations of motion of more take gigabytes
_MEGABYTES, _DOTS = 0.25, 500  # of a file, in a line: tomllib takes quadratic time for a key a.b.c. ...
_QUOTED = re.compile(r"(character|declare|namespace|key) ['\"(].*(?=\(at )")  # of the file, by tomllib


@contextmanager
def naming(path: str | PathLike[str]) -> Iterator[None]:
    """Name the file in a ValueError about its content, in one line; likewise if tables or numbers go too far."""
    try:
        yield
    except (ValueError, RecursionError, ArithmeticError, MemoryError) as error:
        far = "the file must have tables of moderate depth and numbers of moderate size, got a"
        said = str(error) if isinstance(error, ValueError) else f"{far} {type(error).__name__}"
        raise ValueError(escaping.terminal(f"{path}: {' '.join(said.split())}")) from None


@contextmanager
def keyed(prefix: str, names: Mapping[str, str]) -> Iterator[None]:
    """Name the file's key in a ValueError: "mass must be > 0 kg" becomes "seats[1].mass_kg must be > 0 kg"."""
    try:
        yield
    except ValueError as error:
        keys = {name: prefix + key for key, name in names.items()}
        name, space, rest = str(error).partition(" ")
        raise ValueError(keys.get(name, name) + space + rest) from None


@contextmanager
def under(key: str) -> Iterator[None]:
    """Put the key before a ValueError about its value."""
    try:
        yield
    except ValueError as error:
        raise ValueError(f"{key}: {error}") from None


def read_toml(path: Path) -> "Table":
    """Read a TOML file in UTF-8; ValueError if it is none, which quotes nothing of it."""
    checks.regular(path, _MEGABYTES)
    try:
        text = path.read_bytes().decode("utf-8-sig")
        if (dots := max(line.count(".") for line in text.split("\n"))) > _DOTS:
            raise ValueError(f"a line of {dots} dots, {_DOTS} are the most")
        return Table("", tomllib.loads(text))
    except ValueError as error:
        encoded = isinstance(error, UnicodeDecodeError)
        got = "another encoding" if encoded else _QUOTED.sub(r"\1 ", str(error))
        raise ValueError(f"the file must be TOML in UTF-8, got {got}") from None


@dataclass(frozen=True)
class Table:
    """A table of a file."""

    name: str  # before its keys in errors: "struts.front."
    content: Mapping[str, object]

    def check_keys(self, allowed: Mapping[str, str], needed: Collection[str] = ()) -> None:
        """Raise ValueError unless all `needed` keys are present and all keys are `allowed` (names by key)."""
        for key, value in self.content.items():
            if key not in allowed:
                got = checks.shown(value)
                named = self.name + escaping.terminal(key)[:40]
                raise ValueError(f"{named} must be {_meant(key, allowed)}, got {got}")
        for key in needed:
            if key not in self.content:
                raise ValueError(f"{self.name}{key} must be given, got none: keys are {', '.join(allowed)}")

    def value(self, key: str, fits: Callable[[Any], bool], words: str, default: object = None) -> Any:
        """Return the value of a key; ValueError with the allowed `words` unless it `fits`."""
        value = self.content.get(key, default)
        if not fits(value):
            raise ValueError(f"{self.name}{key} must be {words}, got {checks.shown(value)}")
        return value

    def text(self, key: str) -> str:
        """Return a text that is not empty."""
        return str(self.value(key, lambda value: isinstance(value, str) and bool(value.strip()), "a text"))

    def texts(self, key: str) -> tuple[str, ...]:
        """Return an array of texts, empty if there is none."""
        return tuple(self.value(key, _are_texts, "an array of texts", []))

    def choice(self, key: str, choices: Mapping[str, T]) -> T:
        """Return the choice that the key names."""
        checks.one_of(f"{self.name}{key}", self.content.get(key), tuple(choices))
        return choices[self.text(key)]

    def boolean(self, key: str) -> bool:
        """Return true or false."""
        return bool(self.value(key, lambda value: isinstance(value, bool), "true or false"))

    def number(self, key: str) -> float:
        """Return a finite number."""
        return float(self.value(key, _is_number, _NUMBER))

    def numbers(self, key: str) -> tuple[float, ...]:
        """Return an array of finite numbers, one or more."""
        return tuple(map(float, self.value(key, _are_numbers, f"an array of up to {_MOST}, each {_NUMBER}")))

    def pair(self, key: str) -> tuple[float, float]:
        """Return an array of two finite numbers."""
        value = self.numbers(key)
        if len(value) != 2:
            raise ValueError(f"{self.name}{key} must be an array of two numbers, got {checks.shown(list(value))}")
        return value[0], value[1]

    def table(self, key: str) -> "Table":
        """Return a table in this one, empty if there is none."""
        return Table(f"{self.name}{key}.", self.value(key, lambda value: isinstance(value, dict), "a table", {}))

    def tables(self, key: str, most: int = _MOST) -> "list[Table]":
        """Return an array of tables, numbered from 1 in errors, empty if there is none."""
        words = f"an array of up to {most} tables"
        array = self.value(key, lambda value: isinstance(value, list) and len(value) <= most, words, [])
        numbered = Table(self.name, {f"{key}[{i}]": one for i, one in enumerate(array, start=1)})
        return [numbered.table(one) for one in numbered.content]

    def flat(self) -> "Table":
        """Return the table with the values of its tables under dotted keys."""
        flat: dict[str, object] = {}
        for key, value in self.content.items():
            nested = isinstance(value, dict) and value
            flat |= {f"{key}.{inner}": one for inner, one in nested.items()} if nested else {key: value}
        return Table(self.name, flat)


def made(table: Table, kind: type[T], beside: Collection[str] = (), **given: object) -> T:
    """Return a dataclass by a table of its numbers and texts; other keys may be `beside` them.

    A key is a field's metadata ``key``, or its name and unit.
    """
    read: dict[Any, Callable[[str], object]] = dict.fromkeys([float, float | None], table.number)
    read |= {str: table.text, tuple[float, float]: table.pair, tuple[float, ...]: table.numbers}
    found = [one for one in fields(kind) if one.type in read and one.name not in given]  # type: ignore[arg-type]
    own = {one.metadata.get("key", key_of(one.name, one.metadata.get("unit", ""))): one for one in found}
    names = {key: one.name for key, one in own.items()}
    needed = [key for key, one in own.items() if one.default is MISSING]
    table.check_keys(names | {key: key for key in beside}, needed)
    with keyed(table.name, names):
        return kind(**given, **{one.name: read[one.type](key) for key, one in own.items() if key in table.content})


def _is_number(value: Any) -> bool:
    real = isinstance(value, int | float) and not isinstance(value, bool)
    return real and (value == 0 or _SMALLEST <= abs(value) <= _LARGEST)


def _are_texts(value: Any) -> bool:
    return isinstance(value, list) and all(isinstance(text, str) for text in value)


def _are_numbers(value: Any) -> bool:
    return isinstance(value, list) and 0 < len(value) <= _MOST and all(map(_is_number, value))


def _meant(key: str, allowed: Mapping[str, str]) -> str:
    """Return the allowed key of the same name in another unit, or all allowed keys."""
    meant = [(len(name), right) for right, name in allowed.items() if f"{key}_".startswith(f"{name}_")]
    return max(meant)[1] if meant else f"one of the keys {', '.join(allowed)}"
