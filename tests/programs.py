"""Files of other programs, written here byte by byte from the descriptions of their formats."""

import struct
import zlib
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path

import numpy as np


def texts(folder: Path, matrices: Sequence[np.ndarray], stem: str = "car", number: str = "%24.16E") -> Path:
    """Four files of matrices as text, the numbers as Fortran writes them."""
    for letter, matrix in zip("abcd", matrices, strict=True):
        rows = ["".join(number % value for value in row) for row in matrix.tolist()]
        (folder / f"{stem}.{letter}").write_text("% " + letter + "\n" + "\n".join(rows) + "\n\n")
    return folder / f"{stem}.a"


def matlab_4(variables: Mapping[str, np.ndarray | Sequence[str]]) -> bytes:
    """MATLAB's version 4, little-endian: 20 bytes of header, the name, values by columns."""
    content = b""
    for name, value in variables.items():
        is_text = not isinstance(value, np.ndarray)
        width = max(map(len, value)) if is_text else 0
        array = np.array([[ord(c) for c in text.ljust(width)] for text in value]) if is_text else value
        content += struct.pack("<5i", int(is_text), *array.shape, 0, len(name) + 1) + name.encode() + b"\0"
        content += np.asfortranarray(array, dtype="<f8").tobytes(order="F")
    return content


def matlab_5(variables: Mapping[str, np.ndarray | Sequence[str]], packed: bool = True) -> bytes:
    """MATLAB's version 5, as version 7 by default: every variable an element packed by zlib."""
    content = b"MATLAB 5.0 MAT-file".ljust(124) + struct.pack("<H", 0x0100) + b"IM"
    for name, value in variables.items():
        element = _cells(name, value) if not isinstance(value, np.ndarray) else _numbers(name, value)
        shrunk = zlib.compress(element)
        content += struct.pack("<2I", 15, len(shrunk)) + shrunk if packed else element
    return content


def _element(kind: int, content: bytes) -> bytes:
    return struct.pack("<2I", kind, len(content)) + content + bytes(-len(content) % 8)


def _array(kind: int, shape: Sequence[int], name: str, content: bytes) -> bytes:
    flags, dimensions = struct.pack("<2I", kind, 0), struct.pack(f"<{len(shape)}i", *shape)
    return _element(14, _element(6, flags) + _element(5, dimensions) + _element(1, name.encode()) + content)


def _numbers(name: str, value: np.ndarray) -> bytes:
    return _array(6, value.shape, name, _element(9, np.asarray(value, dtype="<f8").tobytes(order="F")))


def _cells(name: str, value: Sequence[str]) -> bytes:
    cells = [_array(4, (1, len(text)), "", _element(4, text.encode("utf-16-le"))) for text in value]
    return _array(1, (len(value), 1), name, b"".join(cells))


def universal(pairs: Iterable[tuple[tuple[int, int], tuple[int, int], np.ndarray]], f: np.ndarray) -> bytes:
    """Datasets 58 of complex responses in double precision at even lines, after the tables of SDRL (UC).

    A pair is node and direction of the response, of the reference, and the values.
    """
    content = ""
    for (node, direction), (reference, toward), values in pairs:
        content += f"{-1:6d}\n{58:6d}\nA rig\nNONE\n27-Nov-26 12:00:00\nNONE\nNONE\n"
        entity = f" {'NONE':10s}{node:10d}{direction:4d} {'NONE':10s}{reference:10d}{toward:4d}\n"
        content += f"{4:5d}{1:10d}{0:5d}{0:10d}{entity}"
        content += f"{6:10d}{f.size:10d}{1:10d}{f[0]:13.5E}{f[1] - f[0]:13.5E}{0.0:13.5E}\n"
        for kind, label in ((18, "Frequency"), (12, "Response"), (13, "Force"), (0, "NONE")):
            content += f"{kind:10d}{0:5d}{0:5d}{0:5d} {label:20s} {'NONE':20s}\n"
        flat = np.column_stack([values.real, values.imag]).ravel()
        for row in np.split(flat, range(4, flat.size, 4)):
            content += "".join(f"{value:20.12E}" for value in row) + "\n"
        content += f"{-1:6d}\n"
    return content.encode()
