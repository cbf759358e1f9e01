"""Struts in vehicle files: a table with the layout as a text, and a table for each element that needs one.

An element called after a kind, ``spring`` or ``bump_stop``, is of this kind without a table. Tables of force or
stiffness stand in the file or in a CSV file with units in its header.
"""

from collections.abc import Mapping
from dataclasses import fields
from typing import Any

from ..documents import Mistakes, Table, keyed
from ..quantities import Real
from ..schema.keys import BAD, KIND, Form, Key, bad, keys_of
from ..schema.reading import kind_of, read
from ..schema.writing import content
from ..tables import read_columns
from .force_laws import (
    BilinearDamper,
    BumpStop,
    DigressiveDamper,
    Friction,
    PowerDamper,
    ReboundStop,
    TableDamper,
    TableSpring,
)
from .layouts import layout_of, names, strut_of
from .struts import ROWS, Damper, Element, Inerter, LinearElement, MeasuredStiffness, Rubber, Spring, Strut

KINDS: dict[str, type[Element]] = {
    "spring": Spring, "damper": Damper, "inerter": Inerter, "rubber": Rubber, "bump-stop": BumpStop,
    "rebound-stop": ReboundStop, "friction": Friction, "measured-stiffness": MeasuredStiffness,
    "table-damper": TableDamper, "table-spring": TableSpring, "digressive-damper": DigressiveDamper,
    "bilinear-damper": BilinearDamper, "power-damper": PowerDamper,
}  # fmt: skip
LAYOUT = Key("layout", "layout", str)
FILE = Key("file", "file", str)
_OF_LAYOUT = {"layout": "layout"} | {name: f"layout: {name}" for name in ("elements", "installation_ratio")}
UNREAD = Friction("unread", force=1.0)
"""In place of a strut with mistakes: its coefficients need no values."""


def read_strut(table: Table, mistakes: Mistakes) -> Strut:
    """Return the strut in a table, `BAD` after a mistake."""
    before, layout = len(mistakes), table.content.get("layout")
    known = list(dict.fromkeys(names(layout))) if isinstance(layout, str) else []
    keys = {name: Key(name, name, Mapping[str, Any], default=None) for name in known}
    values = read(table, {**keys, "layout": LAYOUT}, mistakes, others=not known)
    if not bad(values["layout"]):
        with mistakes.noted(), keyed(table.name, _OF_LAYOUT):
            strut_of(values["layout"], {name: Spring(name) for name in known})
    elements = {name: _element(name, table.inner(name, values.get(name, {})), mistakes) for name in known}
    return BAD if len(mistakes) > before else strut_of(values["layout"], elements)


def write_strut(strut: Strut) -> dict[str, Any]:
    """Return the table from which `read_strut` reads the strut."""
    tables: dict[str, Any] = {}
    for element in strut.elements:
        inner = content(element, KINDS)
        if inner["kind"] == _usual_kind(element.name):
            del inner["kind"]
        inner.pop("name", None)
        tables |= {element.name: inner} if inner else {}
    return {"layout": layout_of(strut), **tables}


STRUT = {"form": Form(read_strut, write_strut)}
"""Metadata of a field with a strut."""


def element_keys(kind: type[Element]) -> dict[str, Key]:
    """Return the keys of an element in a file."""
    return {key: one for key, one in keys_of(kind).items() if one.name != "name"}


def columns_of(kind: type[Element]) -> dict[str, str]:
    """Return the columns of the table of an element, with their units."""
    return {one.name: one.metadata["unit"] for one in fields(kind) if one.metadata.get("most") == ROWS}


def _usual_kind(name: str) -> str | None:
    """Return the kind of an element of this name without a table."""
    kind = name.replace("_", "-")
    return kind if kind in KINDS and keys_of(KINDS[kind])["name"].default == name else None


def _element(name: str, table: Table, mistakes: Mistakes) -> Element:
    """Return the element in a table, `BAD` after a mistake."""
    before = len(mistakes)
    table = table._replace(content={"kind": _usual_kind(name), **table.content})
    kind = kind_of(KINDS, table, mistakes)
    if bad(kind):
        return BAD
    keys, columns = element_keys(kind), columns_of(kind)
    from_file = "file" in table.content and columns
    if from_file:
        keys = {key: one for key, one in keys.items() if one.name not in columns} | {"file": FILE}
    values = read(table, {**KIND, **keys}, mistakes)
    if len(mistakes) > before:
        return BAD
    given = {one.name: one.key for one in keys.values()}
    given |= {name: given["value"]} if issubclass(kind, LinearElement) else {}
    if from_file:
        values |= _columns(columns, values.pop("file"), table, mistakes)
        given |= {column: f"file: {column}" for column in columns}
    del values["kind"]
    if len(mistakes) == before:
        with mistakes.noted(), keyed(table.name, given):
            return kind(name, **values)
    return BAD


def _columns(columns: Mapping[str, str], file: str, table: Table, mistakes: Mistakes) -> dict[str, Real]:
    """Return the columns of a file by name, none after a mistake."""
    with mistakes.noted(), keyed(table.name, {"file": "file"}):
        path = table.folder.file(file)
        with mistakes.noted(f"{table.name}file: "):
            return read_columns(path, columns, ROWS)
    return {}
