"""Property files of suppliers in the TeimOrbit format: dampers ``.dpr``, springs ``.spr``, bump stops ``.bum``.

The force of a spring is a curve over free length minus length, both positive in compression [1]_; that of a stop
likewise over its own compression.

References
----------
.. [1] Altair Engineering, MotionView 2021, online help, "AutoSpring" and "AutoBumpStop"; MSC Software, Adams Car,
   online help, "Property File Editor (spring)".
"""

from dataclasses import dataclass, field
from decimal import Decimal
from os import PathLike
from pathlib import Path
from typing import Any

import numpy as np

from .. import checks
from ..documents import naming
from ..quantities import Checked, Real, unit
from ..tables import write_text
from .dampers import TableDamper
from .stops import BumpStop, TableSpring
from .teimorbit import TeimOrbit

Tabled = TableDamper | TableSpring | BumpStop
KINDS: dict[str, type[Tabled]] = {".dpr": TableDamper, ".spr": TableSpring, ".bum": BumpStop}
_COLUMNS = {
    ".dpr": ("vel", "velocity", "m/s"),
    ".spr": ("disp", "deflection", "m"),
    ".bum": ("disp", "compression", "m"),
}


@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class Mounting(Checked):
    """How the part of a property file is mounted.

    Parameters
    ----------
    installed_length : float
        Of a spring: its length in the static position [m].
    static_load : float
        Of a spring, in place of its length: the force that it carries there [N].
    compression_positive : bool
        Of a damper: whether rates and forces in the file are positive in compression (bump), not in extension.
    """

    installed_length: float | None = field(default=None, metadata=unit("m", 1e-6, 1e6))
    static_load: float | None = field(default=None, metadata=unit("N", 1e-6, 1e9))
    compression_positive: bool = False


def load_property(
    path: str | PathLike[str],
    *,
    installed_length: float | None = None,
    static_load: float | None = None,
    compression_positive: bool = False,
) -> Tabled:
    """Return the element in a property file: `TableDamper`, `TableSpring` or `BumpStop` by the ending of its name.

    Parameters
    ----------
    path : str or path-like
        A file in TeimOrbit format, ``.dpr``, ``.spr`` or ``.bum``, in UTF-8 or Latin-1.
    installed_length, static_load : float, optional
        Of a spring one of them: its length in the static position [m], or the force that it carries there [N].
    compression_positive : bool
        Of a damper: whether rates and forces in the file are positive in compression (bump), not in extension.

    Raises
    ------
    ValueError
        If the file has no such table or no units, about the curve as the element, or about these parameters;
        OSError if it cannot be read.

    Examples
    --------
    >>> import suspension_ctrl as sc
    >>> damper = sc.TableDamper(velocity=[-1.0, -0.1, 0.0, 0.1, 1.0], force=[-900.0, -400.0, 0.0, 600.0, 1500.0])
    >>> sc.save_property("front.dpr", damper)
    >>> sc.load_property("front.dpr") == damper
    True
    """
    mounting = Mounting(
        installed_length=installed_length, static_load=static_load, compression_positive=compression_positive
    )
    kind, columns = KINDS[ending(path)], property_columns(Path(path), mounting)
    with naming(path):
        return kind(**columns)


def ending(path: str | PathLike[str]) -> str:
    """Return the ending of a property file; ValueError for another."""
    suffix = checks.path_of("path", path).suffix.lower()
    checks.one_of("ending of a property file", suffix, KINDS)
    return suffix


def property_columns(path: Path, mounting: Mounting) -> dict[str, Any]:
    """Return the columns (n,) of the element in a property file by name."""
    column, name, unit = _COLUMNS[ending(path)]
    with naming(path):
        file = TeimOrbit.read(path)
        x, force = file.curve(column, unit)
        if name == "deflection":
            static = _static_compression(file, mounting, x, force)
            x, force = (static - x)[::-1], (np.interp(static, x, force) - force)[::-1]
        elif name == "velocity" and mounting.compression_positive:
            x, force = 0.0 - x[::-1], 0.0 - force[::-1]  # no zero with a sign
        return {name: x, "force": force}


def _static_compression(file: TeimOrbit, mounting: Mounting, compression: Real, force: Real) -> float:
    """Return the compression of a spring in the static position [m]."""
    length, load = mounting.installed_length, mounting.static_load
    if (length is None) == (load is None):
        given = "none" if length is None else "both"
        raise ValueError(f"installed_length or static_load must be given, one of them, for a spring, got {given}")
    if length is not None:
        return file.number("SPRING_DATA", "FREE_LENGTH", "m") - length
    return _inverse(load or 0.0, compression, force)


def _inverse(load: float, x: Real, force: Real) -> float:
    """Return where a rising curve has a force, straight beyond its ends."""
    i = int(np.clip(np.searchsorted(force, load), 1, max(force.size - 1, 1)))
    if force.size < 2 or not force[i] > force[i - 1] or not x[i] > x[i - 1]:
        raise ValueError(f"static_load must be where the force rises, got {load:g} N")
    return float(x[i - 1] + (load - force[i - 1]) * ((x[i] - x[i - 1]) / (force[i] - force[i - 1])))


def save_property(
    path: str | PathLike[str],
    element: Tabled,
    *,
    installed_length: float | None = None,
    static_load: float | None = None,
) -> None:
    """Write a property file that `load_property` reads as the element; factors of its force are not applied.

    Parameters
    ----------
    path : str or path-like
        Ends in ``.dpr`` for a `TableDamper`, ``.spr`` for a `TableSpring`, ``.bum`` for a `BumpStop` with a table.
    element : TableDamper, TableSpring or BumpStop
    installed_length, static_load : float, optional
        Of a spring both: its length [m] and the force that it carries [N] in the static position.

    Examples
    --------
    >>> import suspension_ctrl as sc
    >>> spring = sc.TableSpring(deflection=[-0.08, 0.0, 0.08], force=[-3200.0, 0.0, 2000.0])
    >>> sc.save_property("rear.spr", spring, installed_length=0.22, static_load=4000.0)
    >>> sc.load_property("rear.spr", installed_length=0.22).force.round(6).tolist()
    [-3200.0, 0.0, 2000.0]
    """
    kind, (column, name, _) = KINDS[ending(path)], _COLUMNS[ending(path)]
    if not isinstance(element, kind) or element.force is None:
        raise ValueError(f"element must be a {kind.__name__} with a table, got {checks.shown(element)}")
    x, force, data = np.asarray(getattr(element, name)), np.asarray(element.force), ""
    if name == "deflection":
        length, load = installed_length or 0.0, static_load or 0.0
        checks.positive("installed_length", length, "m")
        checks.positive("static_load", load, "N")
        free = _inverse(load, x, force)  # extension at which the spring carries nothing
        x, force = (free - x)[::-1], (load - force)[::-1]
        data = f"[SPRING_DATA]\n FREE_LENGTH = {_in_mm(length + free)}\n"
    rows = "".join(f" {_in_mm(a)} {b!r}\n" for a, b in zip(x.tolist(), force.tolist(), strict=True))
    header = f"[MDI_HEADER]\n FILE_TYPE = '{ending(path)[1:]}'\n FILE_VERSION = 4.0\n FILE_FORMAT = 'ASCII'\n"
    units = "[UNITS]\n LENGTH = 'mm'\n ANGLE = 'degrees'\n FORCE = 'newton'\n MASS = 'kg'\n TIME = 'second'\n"
    write_text(Path(path), f"{header}{units}{data}[CURVE]\n{{ {column} force }}\n{rows}")


def _in_mm(metres: float) -> str:
    """Return a number in mm with all its digits; with an exponent where there were many zeros."""
    number = Decimal(repr(metres)).scaleb(3)
    return f"{number:f}" if 1e-6 <= abs(metres) < 1e6 or not metres else str(number)
