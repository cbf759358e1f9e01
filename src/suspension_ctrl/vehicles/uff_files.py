"""Measured frequency responses in Universal Files (UFF), dataset 58, through pyuff.

A signal is called after its node and direction, ``12:+Z``: responses are outputs, references inputs.
"""

from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from typing import Any

import control
import numpy as np

from .. import checks
from ..quantities import Real

_MEGABYTES = 20.0  # a file is held in memory several times while it is read
_FREQUENCY_RESPONSE = 4  # function type of dataset 58
_AXES = ("X", "Y", "Z", "RX", "RY", "RZ")
_KIND = "a Universal File with datasets 58"


def read_uff(path: Path) -> control.FrequencyResponseData:
    """Return the frequency responses of a file above 0 Hz; a pair of signals without one has NaN."""
    with checks.installed("uff"):
        import pyuff
    checks.regular(path, _MEGABYTES)
    with checks.readable(_KIND):
        file = pyuff.UFF(str(path))
        found = [file.read_sets(int(i)) for i in np.flatnonzero(file.get_set_types() == 58)]
        sets = [one for one in found if one["func_type"] == _FREQUENCY_RESPONSE]
        pairs = [(_signal(one, "rsp"), _signal(one, "ref")) for one in sets]
        lines = [np.array(one["x"], dtype=float) for one in sets]
        values = [np.array(one["data"], dtype=complex) for one in sets]
    if not sets:
        got = f"{len(found)} other functions"
        raise ValueError(f"the file must hold frequency responses of function type 4, got {got}")
    return _system(pairs, lines, values)


def _signal(one: Mapping[str, Any], kind: str) -> str:
    """Return the name of the response or the reference of a dataset."""
    node, direction = int(one[f"{kind}_node"]), int(one[f"{kind}_dir"])
    sign = "-" if direction < 0 else "+"
    return f"{node}:{sign}{_AXES[abs(direction) - 1]}" if direction else f"{node}:scalar"


def _system(
    pairs: Sequence[tuple[str, str]], lines: Sequence[Real], values: Iterable[Any]
) -> control.FrequencyResponseData:
    if len(set(pairs)) < len(pairs):
        twice = max(pairs, key=pairs.count)
        raise ValueError(f"responses must differ, got {twice[0]} to {twice[1]} twice")
    f = lines[0]
    for pair, own in zip(pairs, lines, strict=True):
        if own.shape != f.shape or not np.allclose(own, f, rtol=1e-6, atol=0.0):
            raise ValueError(f"responses must have the same frequencies, got others of {pair[0]} to {pair[1]}")
    outputs, inputs = (list(dict.fromkeys(pair[i] for pair in pairs)) for i in (0, 1))
    known = f > 0
    h = np.full((len(outputs), len(inputs), int(known.sum())), np.nan, dtype=complex)
    for (output, given), one in zip(pairs, values, strict=True):
        if one.shape != f.shape:
            raise ValueError(f"{output} to {given} must have {f.size} values, got {one.size}")
        h[outputs.index(output), inputs.index(given)] = one[known]
    if not known.any():
        raise ValueError("frequencies must be above 0 Hz, got none")
    return control.frd(h, 2 * np.pi * f[known], inputs=inputs, outputs=outputs)
