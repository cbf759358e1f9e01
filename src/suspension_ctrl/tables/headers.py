"""Headers of columns: a name, and a unit in brackets."""

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import pandas as pd

_SHOWN = {
    "m": ("mm", 1e3), "N": ("kN", 1e-3), "N/m": ("kN/m", 1e-3), "N s/m": ("kN s/m", 1e-3),
    "N m/rad": ("kN m/rad", 1e-3),
}  # fmt: skip


def name_and_unit(header: str) -> tuple[str, str]:
    """Return name and unit of a header such as ``z [m/s^2]`` or ``z (m/s²)``, no unit where there is none.

    ``²`` and ``**`` of a unit become powers. Runs in linear time in the length of a header.
    """
    text = header.strip()
    for opening, closing in ("[]", "()"):
        name, found, unit = text[:-1].rpartition(opening)
        if found and text.endswith(closing):
            return name.strip(), " ".join(unit.split()).replace("²", "^2").replace("**", "^")
    return text, ""


def own_name_and_unit(header: str) -> tuple[str, str]:
    """Return name and unit of a header with its unit in square brackets: no unit in ``Volvo (2015)``."""
    return name_and_unit(header) if header.endswith("]") else (header, "")


def shown_unit(unit: str) -> tuple[str, float]:
    """Return the unit in which an engineer reads a quantity, and the factor to it: mm, kN, kN/m, kN per mm."""
    own, per, of = unit.partition(" per ")
    if per:
        (shown, factor), (below, divisor) = shown_unit(own), shown_unit(of)
        return f"{shown} per {below}", factor / divisor
    return _SHOWN.get(unit, (unit, 1.0))


def shown_value(value: float, unit: str, digits: int = 4) -> str:
    """Return a value with its unit as an engineer reads it: ``12.5 mm``."""
    shown, factor = shown_unit("" if unit == "-" else unit)
    return f"{value * factor:.{digits}g} {shown}".rstrip()


def shown_range(low: float, high: float, unit: str, digits: int = 4) -> str:
    """Return an interval with its unit as an engineer reads it: ``4 to 12.5 mm``."""
    return f"{shown_value(low, unit, digits).split(' ')[0]} to {shown_value(high, unit, digits)}"


def shown_header(header: str) -> tuple[str, float]:
    """Return a header in the unit in which an engineer reads its column, and the factor to it."""
    name, unit = own_name_and_unit(header)
    shown, factor = shown_unit(unit)
    return (f"{name} [{shown}]", factor) if factor != 1 else (header, 1.0)


def readable(table: "pd.DataFrame") -> "pd.DataFrame":
    """Return a table in mm, kN, kN/m and kN s/m: columns by their headers, numbers by a column ``unit``."""
    import pandas as pd

    rows = [shown_unit(unit) for unit in table.get("unit", ())]
    columns = {}
    for header, column in table.items():
        shown, factor = shown_header(str(header))
        of_rows = rows and not own_name_and_unit(shown)[1]
        if column.dtype.kind == "f":
            columns[shown] = column * ([one for _, one in rows] if of_rows else factor)
        else:
            columns[str(header)] = column
    if rows:
        columns["unit"] = pd.Series([unit for unit, _ in rows], index=table.index)
    return pd.DataFrame(columns)
