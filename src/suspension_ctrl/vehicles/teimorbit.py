"""The TeimOrbit format of property files, in blocks of text.

A block ``[NAME]`` or ``(NAME)`` holds values ``KEY = 'text'`` and tables, ``{ names }`` with rows below; ``$`` and
``!`` begin comments [1]_. The units of all numbers stand in the block ``[UNITS]``.

References
----------
.. [1] MSC Software, Adams Tire, online help, "About Adams Tire", on the TeimOrbit format.
"""

import re
from collections.abc import Mapping
from pathlib import Path
from typing import NamedTuple

import numpy as np

from .. import checks
from ..quantities import Real, quantity
from .struts import ROWS

_MEGABYTES, _LARGEST = 1.0, 1e9  # of a file; of a number in SI units
_BLOCK = re.compile(r"[\[(]\s*(\w[\w -]{0,80})[\])]")
_VALUE = re.compile(r"(\w{1,80})\s*=\s*(?:'([^']{0,200})'|([^\s$!']{1,200}))")
_WORDS = {
    "LENGTH": {
        "m": "m meter meters", "mm": "mm millimeter millimeters", "cm": "cm centimeter centimeters", "km": "km",
        "in": "in inch inches", "ft": "ft foot feet",
    },
    "FORCE": {
        "N": "n newton newtons", "kN": "kn knewton kilonewton", "lbf": "lbf pound_force",
        "kg g": "kgf kilogram_force",
    },
    "TIME": {"s": "s sec second seconds", "ms": "ms msec millisecond", "min": "min minute", "h": "h hour"},
}  # fmt: skip
_PARTS = {"m": ["LENGTH"], "N": ["FORCE"], "m/s": ["LENGTH", "TIME"]}  # of units


class Rows(NamedTuple):
    """A table of a file."""

    names: list[str]
    cells: list[list[str]]


class TeimOrbit(NamedTuple):
    """The content of a file: values by block and key, both in capitals, and tables."""

    values: Mapping[tuple[str, str], str]
    tables: list[Rows]

    @classmethod
    def read(cls, path: Path) -> "TeimOrbit":
        """Read a file in UTF-8 or Latin-1; ValueError if it is too large."""
        checks.regular(path, _MEGABYTES)
        content = path.read_bytes()
        try:
            text = content.decode("utf-8-sig")
        except UnicodeDecodeError:
            text = content.decode("latin-1")
        values, tables, block = dict[tuple[str, str], str](), list[Rows](), ""
        for line in map(str.strip, re.split(r"[\r\n]+", text)):
            if not line or line[0] in "$!":
                continue
            if found := _BLOCK.match(line):
                block = found[1].strip().upper()
                tables.append(Rows([], []))  # rows without names belong to no table
            elif line[0] == "{":
                tables.append(Rows(line[1:].partition("}")[0].lower().split(), []))
            elif found := _VALUE.match(line):
                values[block, found[1].upper()] = (found[2] or found[3] or "").strip()
            elif tables:
                tables[-1].cells.append(re.split("[$!]", line)[0].split())
        return cls(values, tables)

    def number(self, block: str, key: str, unit: str) -> float:
        """Return a value in this unit."""
        if (block, key) not in self.values:
            raise ValueError(f"the file must have {key} in [{block}], got none")
        return _number(key, self.values[block, key], self._given(unit), unit)

    def curve(self, column: str, unit: str) -> tuple[Real, Real]:
        """Return the table with a column, called so at its beginning, in this unit and forces [N]."""
        found = next((rows for rows in self.tables if "".join(rows.names[:1]).startswith(column)), None)
        if not found or found.names[1:] != ["force"]:
            got = checks.shown(" ".join(found.names)) if found else "none"
            raise ValueError(f"the file must have a table {{ {column} force }}, got {got}")
        if len(found.cells) > ROWS:
            raise ValueError(f"rows of {column} and force must be {ROWS} or less, got {len(found.cells)}")
        if wrong := [row for row in found.cells if len(row) != 2]:
            raise ValueError(
                f"rows must be two numbers, {column} and force, got {checks.shown(' '.join(wrong[0]))}"
            )
        units = zip((column, "force"), map(self._given, (unit, "N")), (unit, "N"), strict=True)
        x, force = (
            np.array([_number(name, row[i], given, needed) for row in found.cells])
            for i, (name, given, needed) in enumerate(units)
        )
        return x, force

    def _given(self, unit: str) -> str:
        """Return the unit in the file for one of metre, second and newton."""
        return "/".join(map(self._unit, _PARTS[unit]))

    def _unit(self, what: str) -> str:
        """Return the unit of lengths, forces or times in the file."""
        given = self.values.get(("UNITS", what), "none")
        for rows in self.tables:  # of the block (BASE), texts below { length force angle mass time }
            if {"mass", what.lower()} <= set(rows.names) and rows.cells:
                given = dict(zip(rows.names, rows.cells[0], strict=False)).get(what.lower(), "none").strip("'")
        known = {word: unit for unit, words in _WORDS[what].items() for word in words.split()}
        checks.one_of(f"{what} in [UNITS]", given.lower(), known)
        return known[given.lower()]


def _number(name: str, text: str, given: str, unit: str) -> float:
    """Return the number in a text in `unit`, from a `given` unit."""
    value = quantity(name, f"{text} {given}", unit)
    checks.within(name, value, -_LARGEST, _LARGEST)
    return value
