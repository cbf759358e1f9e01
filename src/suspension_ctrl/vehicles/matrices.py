"""State space models as matrices A, B, C and D: checked, and read from and written to texts and NumPy files.

Texts are four files as MotionSolve writes them for MATLAB, ``car.a``, ``car.b``, ``car.c`` and ``car.d``: rows of
numbers, with comments after ``%`` or ``#``. NumPy files are ``car.npz`` with arrays A, B, C and D, and perhaps
texts ``inputs`` and ``outputs``, or four files ``car_A.npy`` to ``car_D.npy``.
"""

import zipfile
from collections.abc import Mapping, Sequence
from io import BytesIO
from pathlib import Path
from typing import Any

import control
import numpy as np

from .. import checks
from ..quantities import Real
from ..tables import write_bytes
from .feedback import System
from .signals import own_label

LETTERS = "ABCD"
MEGABYTES = 50.0
"""Largest file, and largest content of a compressed one."""

_MOST = {"states": 1000, "inputs": 200, "outputs": 1000}
_STEPS, _DESCRIPTOR = ("TS", "DT"), "E"


def state_space(
    arrays: Mapping[str, Any], inputs: Sequence[str] = (), outputs: Sequence[str] = (), states: Sequence[str] = ()
) -> control.StateSpace:
    """Return the system of arrays by letter, in either case; ValueError unless they are one in continuous time.

    Names that are blank are replaced by those of python-control, ``u[0]``.
    """
    by_name = {name.upper(): array for name, array in arrays.items()}
    if missing := [letter for letter in LETTERS if letter not in by_name]:
        raise ValueError(f"the file must hold A, B, C and D, got no {', '.join(missing)}")
    a, b, c, d = (_matrix(letter, by_name[letter]) for letter in LETTERS)
    (n, m), p = b.shape, len(c)
    for letter, matrix, shape in (("A", a, (n, n)), ("C", c, (p, n)), ("D", d, (p, m))):
        if matrix.shape != shape:
            raise ValueError(f"{letter} must be of shape {shape} beside B of {b.shape}, got {matrix.shape}")
    if _DESCRIPTOR in by_name and np.shape(by_name[_DESCRIPTOR]) == a.shape and n > 1:
        raise ValueError("system must be of the form x' = A x + B u, got a descriptor system with E")
    for step in _STEPS:
        if np.any(by_name.get(step, 0)):
            raise ValueError(f"system must be in continuous time, got {step} = {checks.shown(by_name[step])}")
    names = {}
    kinds = (("inputs", inputs, m, "u"), ("outputs", outputs, p, "y"), ("states", states, n, "x"))
    for kind, given, count, letter in kinds:
        checks.within(f"number of {kind}", count, 1, _MOST[kind])
        names[kind] = _labels(kind, given, count, letter)
    return control.ss(a, b, c, d, **names)


def _matrix(letter: str, values: Any) -> Real:
    array = checks.reals(f"{letter} must be", values)
    if array.ndim != 2 or not np.isfinite(array).all():
        got = f"shape {array.shape}" if array.ndim != 2 else "others"
        raise ValueError(f"{letter} must be a matrix of finite numbers, got {got}")
    return array


def _labels(kind: str, given: Sequence[str], count: int, letter: str) -> list[str]:
    if len(given) not in (0, count):
        raise ValueError(f"{kind} must be {count} names, got {len(given)}")
    labels = [own_label(name) or f"{letter}[{i}]" for i, name in enumerate(given or [""] * count)]
    if len(set(labels)) < count:
        raise ValueError(f"names of {kind} must differ, got {checks.shown(max(labels, key=labels.count))} twice")
    return labels


def parts_of(path: Path) -> tuple[Path, ...]:
    """Return the files that make up the system of which `path` is one: four of matrices, or itself."""
    if path.suffix.lower() in (".a", ".b", ".c", ".d"):
        lower = path.suffix.islower()
        return tuple(path.with_suffix(f".{letter.lower() if lower else letter}") for letter in LETTERS)
    if path.suffix.lower() == ".npy":
        return tuple(path.with_stem(f"{path.stem[:-1]}{letter}") for letter in LETTERS)
    return (path,)


def read_texts(path: Path) -> control.StateSpace:
    """Return the system of four files of matrices as text."""
    return state_space({letter: _text(part) for letter, part in zip(LETTERS, parts_of(path), strict=True)})


def _text(path: Path) -> Real:
    checks.regular(path, MEGABYTES)
    with checks.readable(f"rows of numbers, {path.name}"):
        lines = path.read_text(encoding="utf-8-sig").translate(str.maketrans(",;", "  ")).splitlines()
        numbers = [line for line in lines if line.strip() and line.lstrip()[0] not in "%#"]
        return np.loadtxt(numbers, comments=["%", "#"], ndmin=2)


def write_texts(path: Path, system: System) -> None:
    """Write four files of matrices as text, every number exactly."""
    for part, matrix in zip(parts_of(path), matrices_of(system), strict=True):
        rows = [" ".join(map(repr, row)) for row in matrix.tolist()]
        write_bytes(part, ("\n".join(rows) + "\n").encode())


def matrices_of(system: System) -> tuple[Real, Real, Real, Real]:
    """Return A, B, C and D; ValueError for a frequency response."""
    if not isinstance(system, control.StateSpace):
        raise ValueError(f"system must be a control.StateSpace for matrices, got {type(system).__name__}")
    return system.A, system.B, system.C, system.D


def read_npz(path: Path) -> control.StateSpace:
    """Return the system of one file of NumPy arrays."""
    checks.regular(path, MEGABYTES)
    with checks.readable("a NumPy file of arrays"), zipfile.ZipFile(path) as archive:
        size = sum(one.file_size for one in archive.infolist()) / 1e6
    if size > MEGABYTES:
        raise ValueError(f"the file must hold at most {MEGABYTES:g} MB, got {size:g} MB")
    with checks.readable("a NumPy file of arrays"), np.load(path) as file:
        arrays = {name: file[name] for name in file.files}
        names = {kind: [str(name) for name in np.ravel(arrays.pop(kind, []))] for kind in _MOST}
    return state_space(arrays, **names)


def read_npy(path: Path) -> control.StateSpace:
    """Return the system of four files of a NumPy array each."""
    arrays = {}
    for letter, part in zip(LETTERS, parts_of(path), strict=True):
        checks.regular(part, MEGABYTES)
        with checks.readable(f"a NumPy array, {part.name}"):
            arrays[letter] = np.load(part)
    return state_space(arrays)


def write_npz(path: Path, system: System) -> None:
    """Write one file of NumPy arrays, with the names of the signals."""
    content, arrays = BytesIO(), dict[str, Any](zip(LETTERS, matrices_of(system), strict=True))
    np.savez(content, **arrays | labels_of(system))
    write_bytes(path, content.getvalue())


def labels_of(system: System) -> dict[str, list[str]]:
    """Return the names of inputs, outputs and states."""
    return {"inputs": system.input_labels, "outputs": system.output_labels, "states": system.state_labels}
