"""Measured channels: histories over time or spectra over frequency, with units in their headers.

Columns are called ``time [s]`` and ``body_acceleration [g]``, or ``frequency [Hz]`` and ``body_acceleration
[g^2/Hz]`` (also ``[(m/s^2)^2/Hz]``).
"""

import re
from collections.abc import Mapping, Sequence
from os import PathLike
from typing import TYPE_CHECKING, NamedTuple, TypeAlias, Union

import numpy as np

from .. import checks
from ..documents import naming
from ..quantities import Real, quantity, signal_unit
from ..tables.headers import name_and_unit
from ..vehicles.assembly import ResponseName, label
from .recordings import check_ascending, even_step, read_recording

if TYPE_CHECKING:
    import pandas as pd

Source: TypeAlias = Union[str, PathLike[str], "pd.DataFrame"]

_DENSITY = re.compile(r"\(?\s*(.+?)\s*\)?\^2\s*/\s*Hz")
_AXES = {"time": "s", "frequency": "Hz"}
_PASSED_OVER = "distance"


class Channels(NamedTuple):
    """Numbers (n, m) by response in SI units over an axis (n,), time [s] or frequency [Hz]."""

    axis: Real
    responses: tuple[ResponseName, ...]
    numbers: Real
    are_spectra: bool


def channels_of(source: Source, names: Mapping[str, ResponseName] | None) -> Channels:
    """Return the channels of a file or a DataFrame; `names` are responses by header without unit."""
    if isinstance(source, str | PathLike):
        headers, values = read_recording(source, lambda headers: _needed(headers, names))
        with naming(source):
            return _channels(headers, values, names)
    if not hasattr(source, "columns"):
        raise ValueError(f"measured must be a path of a file or a DataFrame, got {checks.shown(source)}")
    headers = [str(name) for name in source.columns]
    needed = _needed(headers, names)
    values = checks.reals("measured must be", source.iloc[:, needed].to_numpy())
    if not np.isfinite(values).all():
        raise ValueError("measured must hold finite values throughout, got others")
    return _channels([headers[i] for i in needed], values, names)


def _needed(headers: Sequence[str], names: Mapping[str, ResponseName] | None) -> list[int]:
    """Return the indices of the axis and of the responses."""
    return [i for i, header in enumerate(headers) if i == 0 or names is None or name_and_unit(header)[0] in names]


def _channels(headers: list[str], values: Real, names: Mapping[str, ResponseName] | None) -> Channels:
    texts = [name_and_unit(header) for header in headers]
    for header, (name, unit) in zip(headers, texts, strict=True):
        if not (name and unit) and (names is None or name in names):
            raise ValueError(f"columns must be like 'body_acceleration [m/s^2]', got {checks.shown(header)}")
    if not texts or texts[0][0] not in _AXES or not texts[0][1] or len(values) < 2:
        got = checks.shown(headers[0]) if headers else "no names"
        raise ValueError(f"first column must be 'time [s]' or 'frequency [Hz]', got {got}")
    kind, unit = texts[0]
    axis = values[:, 0] * quantity(kind, f"1 {unit}", _AXES[kind])
    _check_axis(kind, axis)
    wanted = _wanted([name for name, _ in texts[1:]], names)
    factors = [_factor(label(wanted[name]), unit, kind) for name, unit in texts[1:] if name in wanted]
    columns = [i for i, (name, _) in enumerate(texts[1:], start=1) if name in wanted]
    responses = tuple(wanted[texts[i][0]] for i in columns)
    return Channels(axis, responses, values[:, columns] * factors, kind == "frequency")


def _wanted(texts: list[str], names: Mapping[str, ResponseName] | None) -> Mapping[str, ResponseName]:
    """Return the responses by the names of their columns."""
    wanted = {name: name for name in texts if name != _PASSED_OVER} if names is None else names
    for name in wanted:
        if texts.count(name) != 1:
            got = "none" if name not in texts else f"{texts.count(name)}"
            raise ValueError(f"columns must include {name!r} once, got {got}")
    if not wanted:
        raise ValueError("columns must include a response, got none")
    return wanted


def _factor(response: str, unit: str, kind: str) -> float:
    """Return the SI value of one unit of a channel; ValueError for a unit of another dimension."""
    needed = signal_unit(response)
    if kind == "time":
        return quantity(response, f"1 {unit}", needed)
    squared = _DENSITY.fullmatch(unit)
    if not squared:
        raise ValueError(f"{response} must be in ({needed})^2/Hz or a unit like it, got {checks.shown(unit)}")
    return quantity(response, f"1 {squared[1]}", needed) ** 2


def _check_axis(kind: str, axis: Real) -> None:
    if kind == "time":
        even_step(axis)
    else:
        checks.not_negative(kind, float(axis[0]), "Hz")
        check_ascending(kind, axis, "Hz")
