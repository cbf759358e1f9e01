"""OpenCRG files of road surfaces: tracks of a regular grid along a reference line, from text or binary.

A header of sections ends with a line of ``$$``; data follow in records of 80 bytes (ASAM OpenCRG 1.2: data file
structure, road parameters, data definition, road data). The elevation at u along the reference line and v to its
left is that of the grid, of the line and of its banking: z(u, v) = grid(u, v) + z_line(u) + banking(u) v. The
distance of a track is u; curvature of the line and modifiers of the data are not used.
"""

import re
from collections.abc import Mapping, Sequence
from io import BytesIO
from pathlib import Path
from typing import Any, NamedTuple, Self

import numpy as np
from numpy.typing import NDArray

from .. import checks
from ..documents import naming
from ..quantities import Real
from ..tables import MEGABYTES

Cells = NDArray[Any]  # numbers as texts or big-endian

_FORMATS = {"LRFI": "S10", "LDFI": "S20", "KRBI": ">f4", "KDBI": ">f8"}  # type of a number, as text or binary
_RECORD = 80  # bytes
_MOST = 1_000_000  # bytes of the header
_SHORT = 2  # a mean line has at least a cell over this
_SECTION = re.compile(r"\$([A-Z]\w*)", re.ASCII)
_SETTING = re.compile(r"\s*(\w+)\s*=\s*(\S+)\s*", re.ASCII)
_AT = re.compile(r"long section at v\s*=\s*(\S+)", re.IGNORECASE)
_NUMBERED = re.compile(r"long section\s+(\d{1,6})", re.IGNORECASE)


class Grid(NamedTuple):
    """What the header of a file says of its grid."""

    form: str  # of the numbers
    channels: list[str]
    sections: list[int]  # channels of long sections
    v: Real  # their places to the left of the reference line (s,), ascending [m]
    start: float  # u of the first row [m]
    step: float  # between rows [m]
    rows: int | None  # if the header gives the end
    slope: float  # of the reference line, and its banking, without channels of them
    banking: float
    modifiers: list[str]

    @classmethod
    def of(cls, header: str) -> Self:
        """Parse the header; ValueError for another kind of file."""
        sections = _sections(header)
        values = {key: _real(key, text) for key, text in _settings(sections.get("ROAD_CRG", [])).items()}
        checks.within("REFERENCE_LINE_INCREMENT", values.get("REFERENCE_LINE_INCREMENT", 0.0), 1e-6, 1e3)
        definition = sections.get("KD_DEFINITION", [])
        form = next((line[2:].strip().upper() for line in definition if line.startswith("#:")), "KRBI")
        checks.one_of("data format", form, _FORMATS)
        channels = [line[2:].rpartition(",")[0].strip().lower() for line in definition if line.startswith("D:")]
        places = {i: name for i, name in enumerate(channels) if name.startswith("long section")}
        step, start = values["REFERENCE_LINE_INCREMENT"], values.get("REFERENCE_LINE_START_U", 0.0)
        end = values.get("REFERENCE_LINE_END_U")
        return cls(
            form,
            channels,
            list(places),
            _across(list(places.values()), values),
            start,
            step,
            None if end is None else round((end - start) / step) + 1,
            values.get("REFERENCE_LINE_START_S", 0.0),
            values.get("REFERENCE_LINE_START_B", 0.0),
            sorted(_settings(sections.get("ROAD_CRG_MODS", []))),
        )


def read_opencrg(path: Path, tracks: Sequence[float]) -> tuple[Real, Real, list[str]]:
    """Return distances (n,), elevation (n, t) at places across the road [m] and modifiers that are not used."""
    with naming(path):
        checks.regular(path, MEGABYTES)
        content = path.read_bytes()
        mark = re.search(rb"^\$\$[^\n]*\n", content[:_MOST], re.MULTILINE)
        if not mark:
            got = "a reference to another file" if b"$ROAD_CRG_FILE" in content[:_MOST].upper() else "none"
            raise ValueError(f"the file must have a header that ends with $$ in {_MOST} bytes, got {got}")
        grid = Grid.of(content[: mark.start()].decode("ascii", errors="replace").replace("\r", ""))
        data = memoryview(content)[mark.end() :]
        numbers = _texts(data, grid) if grid.form.endswith("FI") else _binary(data, grid)
        count = _rows(numbers, grid)
        height = np.stack([_track(numbers, grid, count, y) for y in tracks], axis=1)
        height += _line(numbers, grid, count)[:, None]
        height += _channel(numbers, grid, count, "reference line banking", grid.banking)[:, None] * np.array(
            tracks
        )
        return grid.start + grid.step * np.arange(count, dtype=float), height, grid.modifiers


def _sections(header: str) -> dict[str, list[str]]:
    """Return the lines of each section without comments, by its keyword."""
    found: dict[str, list[str]] = {}
    name = ""
    for line in header.split("\n"):
        if line.startswith("$"):
            match = _SECTION.match(line.upper())
            name = match[1] if match else ""
        elif name and not line.startswith("*") and (text := line.partition("!")[0].strip()):
            found.setdefault(name, []).append(text)
    return found


def _settings(lines: Sequence[str]) -> dict[str, str]:
    return {match[1].upper(): match[2] for line in lines if (match := _SETTING.fullmatch(line))}


def _real(name: str, text: str) -> float:
    """Return the number of a text; ValueError if it is none of moderate size."""
    try:
        number = float(text)
    except ValueError:
        number = np.nan
    if not abs(number) <= 1e9:
        raise ValueError(f"{name} must be a number up to 1e9, got {checks.shown(text)}")
    return number


def _across(names: Sequence[str], values: Mapping[str, float]) -> Real:
    """Return the places (s,) of long sections [m], by their names or from right to left by the increment."""
    if not names:
        raise ValueError("data definition must have long sections, got none")
    given = [_real("v of a long section", match[1]) for name in names if (match := _AT.fullmatch(name))]
    orders = [int(match[1]) for name in names if (match := _NUMBERED.fullmatch(name))]
    count, right, left = len(names), values.get("LONG_SECTION_V_RIGHT"), values.get("LONG_SECTION_V_LEFT")
    step = values.get("LONG_SECTION_V_INCREMENT")
    if orders == list(range(1, count + 1)) and step is None and left is not None and right is not None:
        step = (left - right) / max(count - 1, 1)
    if orders == list(range(1, count + 1)) and step is not None:
        given = [(-step * (count - 1) / 2 if right is None else right) + i * step for i in range(count)]
    if len(given) != count or not (np.diff(given) > 0).all():
        needed = "all at a v, ascending, or numbered from 1 with an increment above 0"
        raise ValueError(f"long sections must be {needed}, got {checks.shown(names)}")
    return np.array(given)


def _texts(data: memoryview, grid: Grid) -> Cells:
    """Return numbers (n, c) as bytes, from lines of fixed width; each row begins a line."""
    kind = np.dtype(_FORMATS[grid.form])
    text, width = bytes(data).rstrip(), len(grid.channels) * kind.itemsize
    count, per_row = text.count(b"\n") + bool(text), -(-width // _RECORD)
    if not text or count % per_row or count * kind.itemsize > _SHORT * len(text):
        needed = f"a multiple of {per_row} lines of {_RECORD} characters at most"
        raise ValueError(f"road data must be {needed}, got {count} lines of {len(text) // max(count, 1)}")
    rows = bytearray()  # no list of lines: memory
    for i, line in enumerate(BytesIO(text)):
        bare = line.rstrip(b"\r\n")
        if len(bare) > _RECORD:
            raise ValueError(f"road data must be lines of {_RECORD} characters at most, got {len(bare)}")
        rows += bare.ljust(_RECORD)[: width - i % per_row * _RECORD]
    return np.frombuffer(rows, dtype=kind).reshape(-1, len(grid.channels))


def _binary(data: memoryview, grid: Grid) -> Cells:
    """Return numbers (n, c) from records without ends, with the last padded."""
    kind = np.dtype(_FORMATS[grid.form])
    rows = len(data) // (kind.itemsize * len(grid.channels))
    if grid.rows is not None:
        rows = min(rows, grid.rows)
    if not rows:
        raise ValueError("road data must have a row or more, got none")
    flat = np.frombuffer(data, dtype=kind, count=rows * len(grid.channels))
    return flat.reshape(rows, len(grid.channels))


def _rows(numbers: Cells, grid: Grid) -> int:
    """Return the number of rows, that of the header or without rows of padding; ValueError if rows are missing."""
    if grid.rows is not None:
        if grid.rows != len(numbers):
            raise ValueError(f"road data must have {grid.rows} rows as u says, got {len(numbers)}")
        return grid.rows
    count = len(numbers)
    while count and numbers.dtype.kind == "f" and np.isnan(numbers[count - 1, grid.sections]).all():
        count -= 1
    return count


def _column(numbers: Cells, index: int, count: int) -> Real:
    """Return the numbers (count,) of a channel, NaN where there is none."""
    cells = numbers[:count, index]
    if cells.dtype.kind == "f":
        with np.errstate(invalid="ignore"):  # signalling NaN
            return cells.astype(float)
    texts = [bytes(cell).strip() for cell in cells]
    try:
        return np.array([np.nan if text.startswith(b"*") else float(text) for text in texts])
    except ValueError:
        raise ValueError(f"channel {index + 1} must be numbers or *missing*, got others") from None


def _track(numbers: Cells, grid: Grid, count: int, y: float) -> Real:
    """Return the grid's elevation (n,) at a place [m], linear between long sections."""
    low, high = float(grid.v[0]), float(grid.v[-1])
    if not low <= y <= high:
        raise ValueError(f"tracks must lie from {low:g} to {high:g} m, got {checks.shown(y)}")
    right = max(int(np.searchsorted(grid.v, y, side="right")) - 1, 0)
    left = right if grid.v[right] == y else right + 1
    share = 0.0 if left == right else (y - grid.v[right]) / (grid.v[left] - grid.v[right])
    height = (1 - share) * _column(numbers, grid.sections[right], count)
    if left != right:
        height += share * _column(numbers, grid.sections[left], count)
    if not (np.abs(height) <= 1e9).all():
        place = grid.start + grid.step * int(np.argmax(~(np.abs(height) <= 1e9)))
        raise ValueError(f"track at {y:g} m must have an elevation everywhere, got none at u = {place:g} m")
    return height


def _channel(numbers: Cells, grid: Grid, count: int, name: str, constant: float) -> Real:
    """Return a channel (n,) of the reference line, or the constant of the header."""
    if name not in grid.channels:
        return np.full(count, constant)
    values = _column(numbers, grid.channels.index(name), count)
    if not (np.abs(values[1:]) <= 1e3).all():
        raise ValueError(f"{name} must be numbers up to 1000 from the second row on, got others")
    return np.where(np.isnan(values), 0.0, values)


def _line(numbers: Cells, grid: Grid, count: int) -> Real:
    """Return the elevation (n,) of the reference line from its first point on; a slope leads to its point."""
    slope = _channel(numbers, grid, count, "reference line slope", grid.slope)
    slope[0] = 0.0
    return grid.step * np.cumsum(slope)
