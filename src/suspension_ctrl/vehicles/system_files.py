"""Systems in files of other programs, by the ending of the path."""

from collections.abc import Callable
from os import PathLike
from pathlib import Path

import control
import numpy as np
from numpy.typing import ArrayLike

from .. import checks
from ..documents import naming
from ..tables import write_csv
from .feedback import System, system_of
from .matlab_files import read_mat, write_mat
from .matlab_scripts import write_script
from .matrices import read_npy, read_npz, read_texts, write_npz, write_texts
from .plant_tables import read_responses, response_table
from .uff_files import read_uff

_READERS: dict[str, Callable[[Path], System]] = {
    ".mat": read_mat, ".npz": read_npz, ".npy": read_npy, ".a": read_texts, ".b": read_texts, ".c": read_texts,
    ".d": read_texts, ".csv": read_responses, ".uff": read_uff, ".unv": read_uff,
}  # fmt: skip
_WRITERS: dict[str, Callable[[Path, System], None]] = {
    ".mat": write_mat, ".m": write_script, ".npz": write_npz, ".a": write_texts,
}  # fmt: skip


def load_system(path: str | PathLike[str]) -> System:
    """Return the system in a file of another program, with the names and units that it has there.

    Parameters
    ----------
    path : str or path-like
        Matrices A, B, C and D: ``.mat`` of MATLAB (up to version 7) or Dymola; ``.a`` beside ``.b``, ``.c`` and
        ``.d`` of MotionSolve; ``.npz``, or ``A.npy`` beside ``B.npy``, ``C.npy`` and ``D.npy``, of NumPy.
        Frequency responses: ``.csv`` with columns such as ``body_acceleration/road real [m/s^2/m]``; ``.uff`` or
        ``.unv``, Universal Files with datasets 58, whose signals are called ``12:+Z`` (needs pyuff, the extra
        ``uff``).

    Returns
    -------
    control.StateSpace or control.FrequencyResponseData
        `Plant.named` makes a vehicle of it. A dot in a name is replaced by an underscore.

    Raises
    ------
    ValueError
        Naming the file: if it is damaged, no system in continuous time, or a descriptor system; OSError if it
        cannot be read.

    Examples
    --------
    Four matrices without names, as other programs write them:

    >>> import numpy as np
    >>> import suspension_ctrl as sc
    >>> np.savez("car.npz", A=[[0, 1], [-100, 0]], B=[[0, 0], [100, 0.01]], C=[[1, 0]], D=[[-1, 0]])
    >>> system = sc.load_system("car.npz")
    >>> system.nstates, system.input_labels, system.output_labels
    (2, ['u[0]', 'u[1]'], ['y[0]'])
    """
    with naming(path):
        checks.one_of("ending of the file", Path(path).suffix.lower(), _READERS)
        return _READERS[Path(path).suffix.lower()](Path(path))


def save_system(path: str | PathLike[str], system: System, frequency: ArrayLike | None = None) -> None:
    """Write a plant or a closed vehicle for another program, and for `load_system`.

    Parameters
    ----------
    path : str or path-like
        With the ending ``.mat`` of MATLAB; ``.m``, a script that MATLAB and Octave run without a toolbox, which
        `load_system` does not read; ``.a``, beside which ``.b``, ``.c`` and ``.d`` are written, without
        names; ``.npz`` of NumPy; ``.csv`` for a table of frequency responses.
    system : control.StateSpace or control.FrequencyResponseData
        ``vehicle.plant()`` or ``vehicle.closed(...)``.
    frequency : (n,) array_like, optional
        Lines of a table [Hz]; those of a frequency response if not given.

    Raises
    ------
    ValueError
        If the ending is another one, a frequency response is to be written as matrices, lines are missing, or
        MATLAB can run no script of this name.

    Examples
    --------
    >>> import suspension_ctrl as sc
    >>> file = sc.load_vehicle("yuen_ramli_2010")
    >>> sc.save_system("closed.mat", file.vehicle.closed(file.setting))
    >>> sc.load_system("closed.mat").output_labels
    ['body_acceleration', 'suspension_travel', 'tyre_load']
    """
    path, ending = Path(path), Path(path).suffix.lower()
    if not isinstance(system, control.StateSpace | control.FrequencyResponseData):
        got = type(system).__name__
        raise ValueError(f"system must be a control.StateSpace or FrequencyResponseData, got {got}")
    checks.one_of("ending of the file", ending, (*_WRITERS, ".csv"))
    if ending == ".csv":
        write_csv(path, response_table(_at_lines(system, frequency)))
    else:
        _WRITERS[ending](path, system)


def _at_lines(system: System, frequency: ArrayLike | None) -> control.FrequencyResponseData:
    """Return the frequency response at lines (n,) [Hz]."""
    if frequency is None:
        if isinstance(system, control.StateSpace):
            raise ValueError("frequency must be given for a table of a control.StateSpace, got none")
        return system
    f = checks.reals("frequency must be", frequency)
    checks.ascending("frequency", f)
    h = system.frequency_response(2 * np.pi * f, squeeze=False).frdata
    return system_of((h, 2 * np.pi * f), inputs=system.input_labels, outputs=system.output_labels)
