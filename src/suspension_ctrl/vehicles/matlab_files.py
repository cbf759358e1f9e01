"""State space models in MATLAB files of versions 4 to 7.

The variables are A, B, C and D, and perhaps ``InputName``, ``OutputName`` and ``StateName`` as in MATLAB's models,
and their units ``InputUnit`` and so on in files of this library; or ``ABCD``, ``nx`` and ``xuyName`` as Dymola
writes them (dslin.mat, Modelica_LinearSystems2).
"""

from collections.abc import Mapping
from io import BytesIO
from pathlib import Path
from typing import Any

import control
import numpy as np

from .. import checks
from ..tables import write_bytes
from .feedback import System
from .mat_variables import variables
from .matrices import LETTERS, MEGABYTES, labels_of, matrices_of, state_space
from .signals import SIGNALS, units_of

_NAMES = {kind: f"{signal}Name" for kind, signal in SIGNALS.items()}
_HEAD, _TEXT = b"MATLAB 5.0 MAT-file, written by suspension_ctrl", 116  # without the time, and its length
_DYMOLA = {"ABCD", "nx"}
_READ = {*LETTERS, *LETTERS.lower(), *("E", "Ts", "dt", "xuyName"), *_DYMOLA, *_NAMES.values()}


def read_mat(path: Path) -> control.StateSpace:
    """Return the system of a MATLAB file."""
    checks.regular(path, MEGABYTES)
    content = path.read_bytes()
    if content.startswith(b"MATLAB 7.3"):
        raise ValueError("the file must be of MATLAB version 7 or less, as by save('-v7'), got version 7.3")
    with checks.readable(f"a MATLAB file of version 4 to 7 with real matrices of at most {MEGABYTES:g} MB"):
        known = variables(content, _READ, int(MEGABYTES * 1e6))
        values = {name: value for name, value in known.items() if value is not None}
        names = {kind: list[str](values.pop(name, [])) for kind, name in _NAMES.items()}
        if values.keys() >= _DYMOLA:
            values, names = _parts(values)
    if not {name.upper() for name in values} >= {*LETTERS}:
        raise ValueError(f"the file must have the variables A, B, C and D, got {checks.shown(list(known))}")
    return state_space(values, **names)


def _parts(values: Mapping[str, Any]) -> tuple[dict[str, Any], dict[str, list[str]]]:
    """Return matrices and names of Dymola's variables."""
    whole, n = values["ABCD"], int(np.ravel(values["nx"])[0])
    names, (rows, columns) = values.get("xuyName", []), whole.shape
    if not (0 < n < min(rows, columns)):
        raise ValueError("nx")
    m = columns - n
    texts = {"states": names[:n], "inputs": names[n : n + m], "outputs": names[n + m :]}
    return {"A": whole[:n, :n], "B": whole[:n, n:], "C": whole[n:, :n], "D": whole[n:, n:]}, texts


def write_mat(path: Path, system: System) -> None:
    """Write a MATLAB file, with the names and units of the signals."""
    from scipy import io

    content: Any = BytesIO()
    variables = dict[str, Any](zip(LETTERS, matrices_of(system), strict=True))
    for kind, names in labels_of(system).items():
        for what, texts in (("Name", names), ("Unit", units_of(system)[kind])):
            variables[SIGNALS[kind] + what] = np.array(texts, dtype=object)[:, None]
    io.savemat(content, variables)
    write_bytes(path, _HEAD.ljust(_TEXT) + content.getvalue()[_TEXT:])
