"""Roads by a text: a class of ISO 8608, a CSV file of a measured road, or a TOML file, see `schema`.

The file of a measured road or a tabulated coherence holds the numbers, or under ``file`` the path of a CSV file
with them, in the folder of this file or below unless others are allowed.
"""

import re
from dataclasses import dataclass, field
from os import PathLike

from .. import checks
from ..documents import Folder, Mistakes, Table, document, keyed
from ..quantities import unit
from ..schema.keys import KIND, keys_of
from ..schema.reading import fields_named, kind_of, read
from ..schema.writing import content, toml
from ..tables import write_text
from .coherence import COHERENCES, Tabulated
from .measured import COHERENCE, MeasuredRoad, read_curve
from .profile_files import ENDINGS
from .road import Road
from .spectra import Iso8608Road, PowerLawRoad, TwoSlopeRoad

KINDS: dict[str, type[Road]] = {
    "power-law": PowerLawRoad, "two-slope": TwoSlopeRoad, "iso-8608": Iso8608Road, "measured": MeasuredRoad,
}  # fmt: skip
_NUMBERS = "wavenumber_cycle_per_m"  # this key instead of ``file``
_CLASS = re.compile(r"([A-Z])(?:-(lower|upper))?")


@dataclass(frozen=True, kw_only=True)
class MeasuredFile:
    """Keys of a measured road in a file of a profile, or of a spectrum as CSV.

    Parameters
    ----------
    file : str
        Path of the file from this one.
    columns : sequence of str
        Names of the columns in place of the header.
    step : float
        Distance of the rows of a profile without distances [m].
    track_width : float
        Distance of ``left`` and ``right`` of a profile [m].
    tracks : sequence of float
        Places across the surface of an OpenCRG file, positive to the left [m].
    segment : float
        Length of a segment of a profile for Welch's method [m].
    contact_length : float
        Length over which a tyre averages the elevation, 0 for contact in a point [m].
    """

    file: str
    columns: tuple[str, ...] = ()
    step: float | None = field(default=None, metadata=unit("m"))
    track_width: float | None = field(default=None, metadata=unit("m"))
    tracks: tuple[float, ...] = field(default=(), metadata=unit("m"))
    segment: float | None = field(default=None, metadata=unit("m"))
    contact_length: float = field(default=0.0, metadata=unit("m"))


@dataclass(frozen=True, kw_only=True)
class TabulatedFile:
    """Keys of a tabulated coherence in a CSV file.

    Parameters
    ----------
    file : str
        Path of the CSV file from this one.
    distance : float
        Distance of the measured tracks [m].
    """

    file: str
    distance: float = field(metadata=unit("m"))


def load_road(source: str | PathLike[str], *, allow_outside: bool = False) -> Road:
    """Return the road of a class or a file.

    Parameters
    ----------
    source : str or path-like
        A class of ISO 8608 at its geometric mean, ``"C"``, or at a limit, ``"C-lower"`` or ``"C-upper"``; or the
        path of a file of a profile (``.csv``, ``.txt``, ``.erd``, ``.crg``, see `load_profile`), of a spectrum
        (``.csv``) or of a TOML file.
    allow_outside : bool
        Whether a TOML file may name CSV files that are neither beside it nor below, links resolved.

    Raises
    ------
    ValueError
        If it is none of these, or about keys or columns of the file, a line each; OSError if it cannot be read.

    Examples
    --------
    >>> import suspension_ctrl as sc
    >>> print(sc.load_road("C-upper").describe())
    ISO 8608 class C, upper: Gd(0.1 cycle/m) = 512e-6 m^3, waviness 2

    The same class in a file, with identical tracks:

    >>> from pathlib import Path
    >>> text = '''
    ... kind = "iso-8608"
    ... class = "C"
    ... level = "upper"
    ... [coherence]
    ... kind = "constant"
    ... value = 1.0
    ... '''
    >>> _ = Path("road.toml").write_text(text)
    >>> sc.load_road("road.toml") == sc.Iso8608Road("C", level="upper", coherence=sc.Constant(1.0))
    True
    """
    path = checks.path_of("road", source)
    if named := _CLASS.fullmatch(str(source)):
        return Iso8608Road(named[1], level=named[2] or "geometric mean")
    ending = path.suffix.lower()
    if ending in ENDINGS:
        return MeasuredRoad.from_csv(path)
    if ending != ".toml":
        file = f"the path of a {', '.join(ENDINGS)} or .toml file"
        known = f"a class of ISO 8608 such as C, C-lower or C-upper, or {file}"
        raise ValueError(f"road must be {known}, got {checks.shown(str(source))}")
    with document(path, allow_outside) as table:
        return read_road(table)


def save_road(path: str | PathLike[str], road: Road) -> None:
    """Write a TOML file that `load_road` reads as `road`; ValueError if a file cannot hold it.

    Examples
    --------
    >>> import suspension_ctrl as sc
    >>> sc.save_road("country.toml", sc.Iso8608Road("D", coherence=sc.Exponential(decay=3.0)))
    >>> sc.load_road("country.toml")
    Iso8608Road(coherence=Exponential(decay=3), road_class='D')
    """
    write_text(checks.path_of("path", path), toml(content(road, KINDS), road, read_road))


def read_road(table: Table) -> Road:
    """Return the road in a table."""
    mistakes = Mistakes()
    kind = kind_of(KINDS, table, mistakes)
    mistakes.settle()
    from_csv = kind is MeasuredRoad and _NUMBERS not in table.content
    record, coherence = MeasuredFile if from_csv else kind, keys_of(Road)["coherence"]
    if isinstance(inner := table.content.get("coherence"), dict) and _NUMBERS not in inner:
        coherence = coherence._replace(kinds=COHERENCES | {"tabulated": TabulatedFile})
    values = read(table, {**KIND, **keys_of(record), "coherence": coherence}, mistakes)
    mistakes.settle()
    with fields_named(record, table.name):
        del values["kind"]
        if isinstance(tabulated := values.get("coherence"), TabulatedFile):
            values["coherence"] = _read_tabulated(tabulated, f"{table.name}coherence.", table.folder)
        if from_csv:
            return MeasuredRoad.from_csv(table.folder.file(values.pop("file")), **values)
        return kind(**values)


def _read_tabulated(given: TabulatedFile, name: str, folder: Folder) -> Tabulated:
    with keyed(name, dict.fromkeys(["file", "coherence", "wavenumber"], "file")):
        n, coherence = read_curve(folder.file(given.file), COHERENCE)
        return Tabulated(tuple(n.tolist()), tuple(coherence.tolist()), given.distance)
