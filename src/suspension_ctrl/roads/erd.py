"""ERD files of profiles, as profilometers and ProVAL write them: a header of lines, then numbers.

The header ends with the line ``END``. Its second line has the numbers of channels and samples, two numbers about
records, the code of the storage and the step; further lines begin with a keyword of eight characters, names and
units are in fields of eight or 32. Numbers follow as text, a line for each sample (code 5), or are in a file
``.bin`` beside it, 32-bit floating point (code 1), in the byte order of the machine that wrote it.

M. W. Sayers and S. M. Karamihas, "ERD file format for storage and analysis of road profiles", University of
Michigan (1997).
"""

import re
from collections.abc import Sequence
from itertools import takewhile
from pathlib import Path
from typing import NamedTuple, Self

import numpy as np

from .. import checks
from ..documents import naming
from ..quantities import Real, quantity
from ..tables import MEGABYTES, reading
from ..tables.layouts import HEAD, LARGEST, Layout
from .columns import UNITS, kind_of

_TEXT, _BINARY = 5, 1
_JUDGED = 100_000  # numbers, at least, by which the byte order is judged
_CODES = "5 for text or 1 for 32-bit binary"


class Header(NamedTuple):
    """The header of an ERD file."""

    lines: int  # to the line END
    channels: int
    samples: int  # -1 if unknown
    code: int
    step: float  # m
    names: list[str]  # of the channels, with units

    @classmethod
    def of(cls, lines: Sequence[str]) -> Self:
        """Parse the first lines of a file; ValueError for another kind."""
        head = list(takewhile(lambda line: line.strip().upper() != "END", lines))
        if not lines or not lines[0].upper().startswith("ERDFILE") or len(head) in (1, len(lines)):
            raise ValueError(
                f"the file must have a header from ERDFILEV2.00 to END in {HEAD} characters, got none"
            )
        numbers = [one for one in re.split(r"[\s,]+", head[1].strip()) if one]
        try:
            channels, samples, _, _, code = map(int, numbers[:5])
            step = float(numbers[5])
        except (ValueError, IndexError):
            needed = "five whole numbers and the step"
            raise ValueError(f"second line must have {needed}, got {checks.shown(head[1].strip())}") from None
        checks.within("number of channels", channels, 1, 1000)
        if code not in (_TEXT, _BINARY):
            raise ValueError(f"fifth number of the second line must be {_CODES}, got {code}")
        given = _keywords(head[2:])
        unit = given.get("XUNITS", "m").strip().lower() or "m"
        checks.one_of("XUNITS", unit, UNITS)
        checks.positive("step", step, UNITS[unit])
        metres = quantity("step", f"{step!r} {UNITS[unit]}", "m")
        return cls(len(head) + 1, channels, samples, code, metres, _names(given, channels))


def read_erd(path: Path) -> tuple[list[str], Real, float]:
    """Return the names of the channels with their units, values (n, c) of the file and the step [m]."""
    with naming(path), reading(path) as file:
        lines = file.readlines(HEAD)
        header = Header.of(lines)
        if header.code == _TEXT:
            layout = Layout.of(lines[header.lines :] or [""])
            if layout.width != header.channels or layout.names:
                got = layout.names or layout.width
                raise ValueError(f"rows must have {header.channels} numbers, got {checks.shown(got)}")
            layout = layout._replace(header=layout.header + header.lines)
            values = layout.values(file, range(header.channels))
        else:
            values = _binary(path, header)
        if header.samples not in (-1, len(values)):
            raise ValueError(f"rows must be {header.samples} as the second line says, got {len(values)}")
        return header.names, values, header.step


def _keywords(lines: Sequence[str]) -> dict[str, str]:
    """Return the texts of the header by keyword; lines that begin with ``&1000`` continue that before."""
    given: dict[str, str] = {}
    key = ""
    for line in (line.rstrip("\r\n") for line in lines):
        if line.startswith("&"):
            given[key] = given.get(key, "") + line[8:]
        else:
            key = line[:8].strip().upper()
            given[key] = line[8:]
    return given


def _names(given: dict[str, str], channels: int) -> list[str]:
    """Return the names of the channels with units; if none is known, of one or two: height, left and right."""
    fields = {"SHORTNAM": 8, "LONGNAME": 32, "UNITSNAM": 8}
    texts = {
        key: [given.get(key, "")[i * width : (i + 1) * width].strip() for i in range(channels)]
        for key, width in fields.items()
    }
    names = [short or long for short, long in zip(texts["SHORTNAM"], texts["LONGNAME"], strict=True)]
    if channels < 3 and not any(map(kind_of, names)):
        names = [["height"], ["left", "right"]][channels - 1]
    units = (f" [{unit}]" if unit else "" for unit in texts["UNITSNAM"])
    return [f"{name}{unit}" for name, unit in zip(names, units, strict=True)]


def _binary(path: Path, header: Header) -> Real:
    """Return values (n, c) of the binary file; in the wrong byte order exponents scatter most."""
    beside = next((p for p in (path.with_suffix(".bin"), path.with_name(f"{path.name}.bin")) if p.exists()), None)
    if beside is None:
        raise ValueError(f"numbers must be in {path.with_suffix('.bin').name!r} beside the file, got no such file")
    checks.regular(beside, MEGABYTES)
    size = beside.stat().st_size // (4 * header.channels)
    count = size if header.samples == -1 else min(header.samples, size)
    with np.errstate(invalid="ignore"):  # signalling NaN
        raw = np.fromfile(beside, "<f4", count * header.channels)
        some = raw[raw != 0]
        some = some[:: max(1, some.size // _JUDGED)]
        kind = min(("<f4", ">f4"), key=lambda kind: _scatter(some.view(kind).astype(float)))
        values = raw.view(kind).astype(float)
    if values.size and not (values.min() >= -LARGEST and values.max() <= LARGEST):
        raise ValueError(f"numbers must be up to {LARGEST:g}, got others in {beside.name!r}")
    return values.reshape(count, header.channels)


def _scatter(values: Real) -> float:
    """Return the standard deviation of the decimal exponents of numbers (k,), infinite if one is not finite."""
    if not np.isfinite(values).all():
        return float("inf")
    sizes = np.abs(values[values != 0])
    return float(np.log10(sizes).std()) if sizes.size else 0.0
