"""State space models as scripts of MATLAB and Octave that need no toolbox.

A script sets A, B, C and D, and cells with the names and SI units of inputs, outputs and states, called as in
MATLAB's models: ``InputName``, ``InputUnit`` and so on.
"""

import re
from collections.abc import Iterable, Sequence
from pathlib import Path

from ..quantities import Real
from ..tables import write_text
from .feedback import System
from .matrices import LETTERS, labels_of, matrices_of
from .signals import SIGNALS, units_of

_NAME = re.compile(r"[A-Za-z]\w{0,62}", re.ASCII)  # namelengthmax of MATLAB
_HEAD = """\
% State space model x' = A x + B u, y = C x + D u in SI units, written by suspension_ctrl.
% With a control toolbox: sys = ss(A, B, C, D, 'StateName', StateName, 'InputName', InputName, ...
%     'OutputName', OutputName);
"""


def write_script(path: Path, system: System) -> None:
    """Write a script; ValueError unless MATLAB can run one of this name."""
    if not _NAME.fullmatch(path.stem):
        needed = "letters, digits and underscores, 63 at most, a letter first, for MATLAB to run it"
        raise ValueError(f"name of the script must be of {needed}, got {path.stem[:80]!r}")
    matrices = zip(LETTERS, matrices_of(system), strict=True)
    parts = [_HEAD, *(f"{letter} = {_matrix(matrix)};\n" for letter, matrix in matrices)]
    for kind, names in labels_of(system).items():
        parts += [f"{SIGNALS[kind]}{what} = {_cells(texts)};\n" for what, texts in
                  (("Name", names), ("Unit", units_of(system)[kind]))]  # fmt: skip
    write_text(path, "".join(parts))


def _matrix(matrix: Real) -> str:
    """Return a matrix with every number exactly, a row a line."""
    if not matrix.size:
        return "zeros({}, {})".format(*matrix.shape)
    return _lines("[", (" ".join(map(repr, row)) for row in matrix.tolist()), "]")


def _cells(texts: Sequence[str]) -> str:
    """Return a column of texts."""
    if not texts:
        return "cell(0, 1)"
    return _lines("{", ("'{}'".format(text.replace("'", "''")) for text in texts), "}")


def _lines(first: str, rows: Iterable[str], last: str) -> str:
    return "\n".join([first, *(f"  {row}" for row in rows), last])
