"""Recordings as tables: CSV files, and RPC III files (.rpc, .rsp, .tim) of test rigs through rpc3-file.

Headers have a unit in square or round brackets, ``z [g]``, ``speed (m/s)``.
"""

import warnings
from collections.abc import Callable, Sequence
from os import PathLike
from pathlib import Path

import numpy as np

from .. import checks
from ..documents import naming
from ..quantities import Real
from ..tables import MEGABYTES, read_table
from ..tables.layouts import LARGEST

ENDINGS = (".rpc", ".rsp", ".tim")
_UNEVEN = 0.4  # of a step: times may be rounded, no sample may lack
_KIND = "an RPC III time history, binary with the least byte first"


def read_recording(
    path: str | PathLike[str],
    columns: Callable[[Sequence[str]], Sequence[int]] | None = None,
    names: Sequence[str] | None = None,
) -> tuple[list[str], Real]:
    """Return headers (c,) such as ``z [g]`` and values (n, c) of a recording, time included.

    Only the given `columns` are returned, by a function from all headers to indices. `names` of all columns take
    the place of the headers of a CSV file. A ValueError names the file.
    """
    if Path(path).suffix.lower() not in ENDINGS:
        return read_table(path, columns, names=names)
    with naming(path):
        if names is not None:
            raise ValueError(f"columns must be those of the file itself, got {checks.shown(list(names))}")
        headers, channels = _read_rpc(Path(path))
        wanted = range(len(headers)) if columns is None else columns(headers)
        with np.errstate(invalid="ignore"):  # NaN, refused below
            values = np.stack([channels[i] for i in wanted], axis=1, dtype=float)
        if len(values) < 2:
            raise ValueError(f"samples must be 2 or more, got {len(values)}")
        if not (values.min() >= -LARGEST and values.max() <= LARGEST):  # no array of magnitudes: memory
            raise ValueError(f"samples must be numbers up to {LARGEST:g}, got others")
    return [headers[i] for i in wanted], values


def check_ascending(name: str, values: Real, unit: str) -> None:
    """Raise ValueError unless values (n,) ascend."""
    wrong = ~(np.diff(values) > 0)
    if wrong.any():
        before, after = values[wrong.argmax() :][:2]
        raise ValueError(f"{name} must ascend, got {after:.6g} {unit} after {before:.6g} {unit}")


def even_step(time: Real) -> float:
    """Return the step of times (n,) [s], the mean one; ValueError unless they are even."""
    check_ascending("time", time, "s")
    step = float(time[-1] - time[0]) / (time.size - 1)
    off = np.abs(time - time[0] - step * np.arange(time.size)) / step
    if off.max() > _UNEVEN:
        got = f"{off.max():.3g} steps at {time[off.argmax()]:g} s"
        raise ValueError(f"time must be even, each within {_UNEVEN} of a step of {step:.6g} s, got {got}")
    return step


def _read_rpc(path: Path) -> tuple[list[str], list[Real]]:
    """Return headers, of time first, and samples (n,) of each, without the filling of the last group."""
    with checks.installed("rpc"):
        from rpc3 import rpc3
    checks.regular(path, MEGABYTES)
    rpc3.progressbar = False
    with checks.readable(_KIND), warnings.catch_warnings():
        warnings.simplefilter("ignore")  # of a last group that is not full, as is common
        channels, _ = rpc3.read(str(path))
        time = channels[0].time()
    return ["time [s]", *(f"{one.name} [{one.unit}]" for one in channels)], [time, *(one.data for one in channels)]
