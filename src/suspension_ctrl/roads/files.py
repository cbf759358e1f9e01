"""Roads by a text, for command lines: a class of ISO 8608, a CSV file of a measured road or a TOML file.

Keys of a TOML file end in their units; ``kind`` determines the others:

- ``power-law``: roughness_m3, the density at 1 cycle/m, and exponent;
- ``two-slope``: roughness_m3, reference_cycle_per_m, lower_exponent, upper_exponent, corner_cycle_per_m;
- ``iso-8608``: class; level and waviness if they are not ``"geometric mean"`` and 2;
- ``measured``: file, a CSV file by its path from this one, in its folder or below unless others are allowed;
  optional track_width_m of a profile, and segment_m.

Each may have a table ``[coherence]``, whose ``kind`` is ``isotropic`` (exponent optional), ``exponential``
(decay), ``constant`` (value) or ``tabulated`` (file, likewise, and distance_m).
"""

import re
from os import PathLike
from os.path import realpath
from pathlib import Path
from typing import Any, NamedTuple

from .. import checks
from ..documents import Table, keyed, made, naming, read_toml
from .coherence import Coherence, Constant, Exponential, Isotropic, Tabulated
from .measured import COHERENCE, MeasuredRoad, read_curve
from .road import Road
from .spectra import Iso8608Road, PowerLawRoad, TwoSlopeRoad

_CLASS = re.compile(r"([A-Z])(?:-(lower|upper))?")
_ROADS: dict[str, type[Road]] = {
    "power-law": PowerLawRoad, "two-slope": TwoSlopeRoad, "iso-8608": Iso8608Road, "measured": MeasuredRoad,
}  # fmt: skip
_COHERENCES: dict[str, type[Any]] = {
    "isotropic": Isotropic, "exponential": Exponential, "constant": Constant, "tabulated": Tabulated,
}  # fmt: skip
_MEASURED = {"kind": "kind", "file": "file", "coherence": "coherence"}
_OPTIONS = {"track_width_m": "track_width", "segment_m": "segment"}
_TABULATED = {"kind": "kind", "file": "file", "distance_m": "distance"}


def load_road(source: str | PathLike[str], *, allow_outside: bool = False) -> Road:
    """Return the road of a class or a file.

    Parameters
    ----------
    source : str or path-like
        A class of ISO 8608 at its geometric mean, ``"C"``, or at a limit, ``"C-lower"`` or ``"C-upper"``; or the
        path of a CSV file (see `MeasuredRoad.from_csv`) or of a TOML file.
    allow_outside : bool
        Whether a TOML file may name CSV files that are neither beside it nor below, links resolved.

    Raises
    ------
    ValueError
        If it is none of these, or about a key or column of the file; OSError if it cannot be read.

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
    path = Path(source)
    if named := _CLASS.fullmatch(str(source)):
        return Iso8608Road(named[1], level=named[2] or "geometric mean")
    if path.suffix == ".csv":
        return MeasuredRoad.from_csv(path)
    if path.suffix != ".toml":
        known = "a class of ISO 8608 such as C, C-lower or C-upper, or the path of a .csv or .toml file"
        raise ValueError(f"road must be {known}, got {checks.shown(str(source))}")
    with naming(path):
        return _road(read_toml(path), _Beside(path.parent, allow_outside))


class _Beside(NamedTuple):
    """Where the files are that a road's file names."""

    folder: Path
    allow_outside: bool

    def file(self, table: Table) -> Path:
        """Return the path under the key ``file``; ValueError if it is outside and must not."""
        path = self.folder / table.text("file")
        if not (self.allow_outside or Path(realpath(path)).is_relative_to(realpath(self.folder))):
            needed = "beside this file or below it, unless outside is allowed"
            raise ValueError(f"{table.name}file must be {needed}, got {checks.shown(table.text('file'))}")
        return path


def _road(table: Table, beside: _Beside) -> Road:
    kind = table.choice("kind", _ROADS)
    given: dict[str, Any] = {}
    if "coherence" in table.content:
        given["coherence"] = _coherence(table.table("coherence"), beside)
    if kind is not MeasuredRoad:
        return made(table, kind, beside=("kind", "coherence"), **given)
    table.check_keys(_MEASURED | _OPTIONS, ["file"])
    options: dict[str, Any] = {name: table.number(key) for key, name in _OPTIONS.items() if key in table.content}
    with keyed("", _OPTIONS):
        return MeasuredRoad.from_csv(beside.file(table), **options, **given)


def _coherence(table: Table, beside: _Beside) -> Coherence:
    kind = table.choice("kind", _COHERENCES)
    if kind is not Tabulated:
        return made(table, kind, beside=("kind",))
    table.check_keys(_TABULATED, ["file", "distance_m"])
    n, coherence = read_curve(beside.file(table), COHERENCE)
    with keyed(table.name, _TABULATED):
        return Tabulated(tuple(n.tolist()), tuple(coherence.tolist()), table.number("distance_m"))
