"""Columns of a table that make a profile: distance and heights, by the headers that people write, in any unit.

The words of a header name the quantity, ``Distance (ft)``, ``elevation [mm]``, ``LWP``. A column whose header
names no quantity, or whose unit is no length, does not belong to the profile.
"""

import re
from collections.abc import Sequence
from typing import NamedTuple

from .. import checks
from ..quantities import Real, quantity
from ..tables.headers import name_and_unit

DISTANCE, HEIGHT, LEFT, RIGHT = "distance [m]", "height [m]", "left [m]", "right [m]"
TRACK_COLUMN = "height at y = {} m [m]"
TRACK_WIDTH = 1.5
"""Distance of left and right if none is given [m]."""

_PLACE = re.compile(r"height at y = (-?\d+(?:\.\d+)?(?:e-?\d+)?) m", re.ASCII)
UNITS = {  # of lengths, as people write them
    **dict.fromkeys(("m", "metre", "metres", "meter", "meters"), "m"),
    **dict.fromkeys(("km", "kilometre", "kilometres", "kilometer", "kilometers"), "km"),
    **dict.fromkeys(("cm", "centimetre", "centimetres", "centimeter", "centimeters"), "cm"),
    **dict.fromkeys(("mm", "millimetre", "millimetres", "millimeter", "millimeters"), "mm"),
    **dict.fromkeys(("in", "inch", "inches"), "in"),
    **dict.fromkeys(("ft", "foot", "feet"), "ft"),
}
_WORDS = {  # the first kind with a word of the header is that of the column; left and right begin longer words too
    "left": {"lwp", "lhs", "lft", "lt", "l", "lelev", "lprof"},
    "right": {"rwp", "rhs", "rgt", "rt", "r", "relev", "rprof"},
    "distance": {"distance", "dist", "station", "stationing", "chainage", "position", "odometer", "x", "s"},
    "height": {"height", "heights", "elevation", "elev", "elevations", "profile", "level", "z", "h"},
}


class Column(NamedTuple):
    """What the header of a column of a profile says."""

    kind: str  # "distance", "left", "right", "height" or "place"
    factor: float  # of its unit [m]
    unit: bool  # whether the header gives one
    place: float = 0.0  # of the track [m]


def column(header: str) -> Column | None:
    """Return what a header says, None if it belongs to no profile."""
    place = _PLACE.match(header.strip())
    text = f"height{header.strip()[place.end() :]}" if place else header
    name, unit = name_and_unit(text)
    *words, last = re.split(r"[\s,_]+", name)
    if not unit and words and last.lower() in UNITS:  # as in "elevation, mm"
        name, unit = " ".join(words), last
    known = UNITS.get(unit.lower())
    if unit and not known:
        return None
    factor, words = quantity(name, f"1 {known or 'm'}", "m"), re.findall("[a-z]+", name.lower())
    if place:
        return Column("place", factor, bool(unit), float(place[1]))
    for kind, known_words in _WORDS.items():
        if any(word in known_words or word.startswith(kind) for word in words):
            return Column(kind, factor, bool(unit))
    return None


def kind_of(header: str) -> str:
    """Return the kind of a column, empty if it belongs to no profile."""
    found = column(header)
    return found.kind if found else ""


def belonging(names: Sequence[str]) -> list[int]:
    """Return the indices of the columns of a profile: the first distance, then heights; all of another table."""
    kinds = list(enumerate(map(kind_of, names)))
    distance = [i for i, kind in kinds if kind == "distance"][:1]
    sided = [i for i, kind in kinds if kind in ("left", "right", "place")]
    heights = sided or [i for i, kind in kinds if kind == "height"]
    return distance + heights if heights else list(range(len(names)))


def unitless(names: Sequence[str]) -> list[str]:
    """Return the names of those columns of a profile that have no unit."""
    return [name for name in names if (one := column(name)) and not one.unit]


def tracks_of(names: Sequence[str], width: float) -> tuple[float, ...]:
    """Return the places (t,) [m] of height columns of these names; ValueError if they do not tell."""
    columns = [one for name in names if (one := column(name))]
    kinds = [one.kind for one in columns]
    if len(kinds) == 1 and kinds != ["place"]:
        return (0.0,)
    if sorted(kinds) == ["left", "right"]:
        return tuple(width / 2 if kind == "left" else -width / 2 for kind in kinds)
    if not kinds or set(kinds) != {"place"}:
        allowed = f"one of height, or left and right, or all like {TRACK_COLUMN.format(0.75)!r}"
        raise ValueError(f"columns of heights must be {allowed}, got {checks.shown(list(names))}")
    return tuple(one.place for one in columns)


def scaled(names: Sequence[str], values: Real) -> Real:
    """Return the values (n, c) in metres, changed in place."""
    for i, one in enumerate(map(column, names)):
        if one and one.factor != 1:
            values[:, i] *= one.factor
    return values
