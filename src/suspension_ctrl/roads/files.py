"""Roads by a text, for command lines: a class of ISO 8608, a CSV file that was measured or a TOML file.

Keys of a TOML file end in their units. ``kind`` says which others there are:

- ``power-law``: roughness_m3, the density at 1 cycle/m, and exponent;
- ``two-slope``: roughness_m3, reference_cycle_per_m, lower_exponent, upper_exponent, corner_cycle_per_m;
- ``iso-8608``: class; level and waviness if they are not ``"geometric mean"`` and 2;
- ``measured``: file, a CSV file by its path from this one; for a profile track_width_m and segment_m if wanted.

Each may have a table ``[coherence]``, whose ``kind`` is ``isotropic`` (exponent if wanted), ``exponential``
(decay), ``constant`` (value) or ``tabulated`` (file, a CSV file by its path from this one, and distance_m).
"""

import re
import tomllib
from collections.abc import Callable
from pathlib import Path
from typing import Any, NamedTuple

from .. import checks
from .coherence import Constant, Exponential, Isotropic, Tabulated
from .curves import COHERENCE, read_curve
from .measured import MeasuredRoad
from .road import RandomRoad
from .spectra import Iso8608Road, PowerLawRoad, TwoSlopeRoad

_CLASS = re.compile(r"([A-Z])(?:-(lower|upper))?")
_TEXTS = ("file", "class", "level")
_LARGEST = 1e9


class _Kind(NamedTuple):
    """What is made of a table, and the parameters by the keys it must and may have."""

    make: Callable[..., Any]
    needed: dict[str, str]
    wanted: dict[str, str]


def load_road(text: str) -> RandomRoad:
    """Return the road that a text names.

    Parameters
    ----------
    text : str
        A class of ISO 8608 at its geometric mean, ``"C"``, or at a limit, ``"C-lower"`` or ``"C-upper"``; or the
        path of a CSV file (see `road_tables`) or of a TOML file (see `road_files`).

    Returns
    -------
    RandomRoad
        The road.

    Raises
    ------
    ValueError
        If it is none of these, or naming the file and the key or column if the file does not hold a road.
    OSError
        If the file cannot be read.
    """
    if named := _CLASS.fullmatch(text):
        return Iso8608Road(named[1], level=named[2] or "geometric mean")
    path = Path(text)
    if path.suffix == ".csv":
        return MeasuredRoad.from_csv(path)
    if path.suffix == ".toml":
        return _from_toml(path)
    raise ValueError(
        "road must be a class of ISO 8608 such as C, C-lower or C-upper, or the path of a .csv or .toml file, "
        f"got {text!r}"
    )


def _from_toml(path: Path) -> RandomRoad:
    try:
        with path.open("rb") as file:
            content = tomllib.load(file)
        table = content.pop("coherence", None)
        coherence = {} if table is None else {"coherence": _made(path, "coherence.", table, _COHERENCES)}
        return _made(path, "", content, _ROADS, **coherence)
    except (ValueError, RecursionError) as error:
        raise ValueError(f"{path}: {' '.join(str(error).split())}") from None


def _made(path: Path, prefix: str, table: object, kinds: dict[str, _Kind], **more: Any) -> Any:
    """Make what a table of the file says; `prefix` goes before its keys in errors."""
    if not isinstance(table, dict):
        raise ValueError(f"{prefix.rstrip('.')} must be a table, got {table!r}")
    checks.one_of(f"{prefix}kind", table.get("kind"), tuple(kinds))
    make, needed, wanted = kinds[table["kind"]]
    allowed = needed | wanted
    keys = {key: value for key, value in table.items() if key != "kind"}
    for key in [*(key for key in keys if key not in allowed), *(key for key in needed if key not in keys)]:
        said = "has no key" if key in keys else "needs the key"
        may = f", and may have {', '.join(wanted)}" if wanted else ""
        raise ValueError(
            f"{table['kind']} {said} {prefix + key!r}: it must have {', '.join(needed) or 'none'}{may}"
        )
    return make(**{allowed[key]: _value(path, prefix, key, value) for key, value in keys.items()}, **more)


def _value(path: Path, prefix: str, key: str, value: object) -> str | float | Path:
    """Return the value of a key: a text, the path of a file or a number."""
    if key in _TEXTS:
        if not isinstance(value, str):
            raise ValueError(f"{prefix}{key} must be a text, got {value!r}")
        return path.parent / value if key == "file" else value
    if isinstance(value, bool) or not (isinstance(value, int | float) and 0 <= value <= _LARGEST):
        raise ValueError(f"{prefix}{key} must be a number from 0 to {_LARGEST:g}, got {value!r}")
    return float(value)


def _tabulated(path: Path, distance: float) -> Tabulated:
    n, coherence = read_curve(path, COHERENCE)
    try:
        return Tabulated(tuple(n.tolist()), tuple(coherence.tolist()), distance)
    except ValueError as error:
        raise ValueError(f"{path}: {error}") from None


def _same(*names: str) -> dict[str, str]:
    return dict(zip(names, names, strict=True))


_ROADS = {
    "power-law": _Kind(PowerLawRoad, {"roughness_m3": "roughness", "exponent": "exponent"}, {}),
    "two-slope": _Kind(
        TwoSlopeRoad,
        {"roughness_m3": "roughness", "reference_cycle_per_m": "reference", "corner_cycle_per_m": "corner"}
        | _same("lower_exponent", "upper_exponent"),
        {},
    ),
    "iso-8608": _Kind(Iso8608Road, {"class": "road_class"}, _same("level", "waviness")),
    "measured": _Kind(
        MeasuredRoad.from_csv, {"file": "path"}, {"track_width_m": "track_width", "segment_m": "segment"}
    ),
}
_COHERENCES = {
    "isotropic": _Kind(Isotropic, {}, _same("exponent")),
    "exponential": _Kind(Exponential, _same("decay"), {}),
    "constant": _Kind(Constant, _same("value"), {}),
    "tabulated": _Kind(_tabulated, {"file": "path", "distance_m": "distance"}, {}),
}
