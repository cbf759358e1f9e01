"""Struts in vehicle files: a table with the layout as a text, and a table for each element that needs one.

An element called after a kind, ``spring`` or ``bump_stop``, is of this kind without a table. Tables of force or
stiffness stand in the file, in a CSV file with units in its header, or in a property file of the supplier.
"""

from collections.abc import Mapping
from dataclasses import fields
from pathlib import Path
from typing import Any

from ..documents import Mistakes, Table, keyed
from ..quantities import Real
from ..schema.keys import BAD, KIND, Form, Key, bad, keys_of
from ..schema.reading import kind_of, read
from ..schema.writing import content
from ..tables import read_columns
from .dampers import BilinearDamper, DigressiveDamper, Friction, PowerDamper, TableDamper
from .elements import Damper, Inerter, LinearElement, MeasuredStiffness, Rubber, Spring
from .layouts import layout_of, names, strut_of
from .property_files import KINDS as PROPERTIES
from .property_files import Mounting, ending, property_columns
from .stops import BumpStop, ReboundStop, TableSpring
from .struts import ROWS, Element, Strut

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


def file_keys(kind: type[Element], file: object) -> dict[str, Key]:
    """Return the keys of an element with its table in a file."""
    keys = {key: one for key, one in element_keys(kind).items() if one.name not in columns_of(kind)}
    mounting = keys_of(Mounting) if _is_property(file) else {}
    return {**keys, "file": FILE, **mounting}


def _is_property(file: object) -> bool:
    return isinstance(file, str) and Path(file).suffix.lower() in PROPERTIES


def _usual_kind(name: str, file: object = None) -> str | None:
    """Return the kind of an element of this name or with this file if its table does not say."""
    if _is_property(file):
        of_file = PROPERTIES[Path(str(file)).suffix.lower()]
        return next(kind for kind, record in KINDS.items() if record is of_file)
    kind = name.replace("_", "-")
    return kind if kind in KINDS and keys_of(KINDS[kind])["name"].default == name else None


def _element(name: str, table: Table, mistakes: Mistakes) -> Element:
    """Return the element in a table, `BAD` after a mistake."""
    before, file = len(mistakes), table.content.get("file")
    table = table._replace(content={"kind": _usual_kind(name, file), **table.content})
    kind = kind_of(KINDS, table, mistakes)
    if bad(kind):
        return BAD
    from_file = file is not None and columns_of(kind)
    keys = file_keys(kind, file) if from_file else element_keys(kind)
    values = read(table, {**KIND, **keys}, mistakes)
    if len(mistakes) > before:
        return BAD
    named = {one.name: one.key for one in keys.values()}
    named |= {name: named["value"]} if issubclass(kind, LinearElement) else {}
    if from_file:
        values |= _columns(kind, values, table, mistakes)
        named |= {column: f"file: {column}" for column in columns_of(kind)}
    own = {key: value for key, value in values.items() if key in {one.name for one in fields(kind)}}
    if len(mistakes) == before:
        with mistakes.noted(), keyed(table.name, named):
            return kind(name, **own)
    return BAD


def _columns(
    kind: type[Element], values: Mapping[str, Any], table: Table, mistakes: Mistakes
) -> Mapping[str, Real]:
    """Return the columns of a file by name, none after a mistake."""
    with mistakes.noted(), keyed(table.name, {"file": "file"}):
        path = table.folder.file(values["file"])
        with mistakes.noted(f"{table.name}file: "):
            if not _is_property(values["file"]):
                return read_columns(path, columns_of(kind), ROWS)
            needed = PROPERTIES[ending(path)]
            if not issubclass(kind, needed):
                raise ValueError(f"{path}: the file must be of a {kind.__name__}, got one of a {needed.__name__}")
            given = {one.name: values[one.name] for one in fields(Mounting) if one.name in values}
            return property_columns(path, Mounting(**given))
    return {}
