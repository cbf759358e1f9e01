"""Variables in MATLAB files of versions 4 to 7: real matrices, and texts.

`scipy.io.loadmat` ends the process on some damaged files. The formats are those of "MAT-File Format", MathWorks.
"""

import struct
import zlib
from collections.abc import Collection, Iterator
from typing import NamedTuple, TypeAlias

import numpy as np

from ..quantities import Real

Value: TypeAlias = Real | list[str]

_HEADER, _NAMED = 128, 512  # bytes before the first element, and of an element that hold the name of a variable
_NUMBERS = {1: "i1", 2: "u1", 3: "i2", 4: "u2", 5: "i4", 6: "u4", 7: "f4", 9: "f8", 12: "i8", 13: "u8"}
_TEXTS = {1: "ascii", 2: "ascii", 4: "utf-16", 16: "utf-8", 17: "utf-16"}  # encodings
_COMPRESSED = 15
_CELL, _CHARACTERS, _SPARSE, _DENSE, _COMPLEX = 1, 4, 5, range(6, 16), 0x0800  # classes of arrays, and a flag
_LARGEST = 1000  # rows and columns of a sparse matrix
_VERSION_4 = ("f8", "f4", "i4", "i2", "u2", "u1")


def variables(content: bytes, wanted: Collection[str], most: int) -> dict[str, Value | None]:
    """Return the wanted variables, and None for all others, by name; any error if the file is damaged.

    All that is compressed may have `most` bytes when unpacked.
    """
    if content[126:128] in (b"IM", b"MI"):
        return dict(_version_5(content, wanted, most, "<" if content[126:128] == b"IM" else ">"))
    return dict(_version_4(content, wanted))


def _version_5(
    content: bytes, wanted: Collection[str], most: int, order: str
) -> Iterator[tuple[str, Value | None]]:
    for kind, data in _elements(memoryview(content)[_HEADER:], order):
        packed = kind == _COMPRESSED
        name = _Array.of(_unpacked(data, _NAMED) if packed else data, order).name
        if name not in wanted:
            yield name, None
            continue
        whole = _unpacked(data, most + 9) if packed else data
        most -= len(whole) if packed else 0
        if most < 0:
            raise ValueError("more than allowed when unpacked")
        yield name, _Array.of(whole, order).value(order)


def _unpacked(data: memoryview, most: int) -> memoryview:
    """Return the content of a compressed element, cut off after some bytes, without its type and size."""
    return memoryview(zlib.decompressobj().decompress(data, most))[8:]


def _elements(data: memoryview, order: str) -> Iterator[tuple[int, memoryview]]:
    """Yield type and content of each element; ValueError if one is cut off."""
    at = 0
    while at + 8 <= len(data):
        kind, size = struct.unpack_from(f"{order}2I", data, at)
        start, end = at + 8, at + 8 + size + (-size % 8 if kind != _COMPRESSED else 0)
        if kind >> 16:  # up to four bytes, beside the type
            kind, size, start, end = kind & 0xFFFF, kind >> 16, at + 4, at + 8
        if start + size > min(end, len(data)):
            raise ValueError(f"element of {size} bytes")
        yield kind, data[start : start + size]
        at = end


class _Array(NamedTuple):
    """An array of version 5: class and flags, shape, name, and the elements with its values."""

    flags: int
    shape: list[int]
    name: str
    elements: Iterator[tuple[int, memoryview]]

    @classmethod
    def of(cls, data: memoryview, order: str) -> "_Array":
        elements = _elements(data, order)
        (_, flags), (_, shape), (_, name) = (next(elements) for _ in range(3))
        sizes = np.frombuffer(shape, f"{order}i4").tolist()
        return cls(int(np.frombuffer(flags, f"{order}u4")[0]), sizes, bytes(name).decode("ascii"), elements)

    def value(self, order: str) -> Value:
        """Return a matrix, or the texts of rows of characters or of cells; ValueError for other arrays."""
        kind = self.flags & 0xFF
        if kind == _CELL:
            return [" ".join(self._texts_of(cell, order)) for _, cell in self.elements]
        if kind == _CHARACTERS:
            return self.texts(order)
        if self.flags & _COMPLEX or (kind != _SPARSE and kind not in _DENSE):
            raise ValueError(f"array of class {kind}")
        return self._sparse(order) if kind == _SPARSE else self._numbers(order).reshape(self.shape, order="F")

    @staticmethod
    def _texts_of(cell: memoryview, order: str) -> list[str]:
        inner = _Array.of(cell, order)
        if inner.flags & 0xFF != _CHARACTERS and 0 not in inner.shape:
            raise ValueError(f"cell of class {inner.flags & 0xFF}")
        return inner.texts(order) if 0 not in inner.shape else []

    def texts(self, order: str) -> list[str]:
        kind, data = next(self.elements)
        encoding = _TEXTS[kind] + ({"<": "-le", ">": "-be"}[order] if _TEXTS[kind] == "utf-16" else "")
        return _rows(list(bytes(data).decode(encoding)), self.shape)

    def _numbers(self, order: str) -> Real:
        kind, data = next(self.elements)
        return np.frombuffer(data, order + _NUMBERS[kind]).astype(float)

    def _sparse(self, order: str) -> Real:
        rows, starts, values = (self._numbers(order) for _ in range(3))
        if max(self.shape) > _LARGEST:
            raise ValueError(f"sparse matrix of shape {self.shape}")
        matrix, counts = np.zeros(self.shape), np.diff(starts).astype(int)
        columns = np.repeat(np.arange(counts.size), counts)
        matrix[rows[: columns.size].astype(int), columns] = values[: columns.size]
        return matrix


def _version_4(content: bytes, wanted: Collection[str]) -> Iterator[tuple[str, Value | None]]:
    order, at = "<" if 0 <= struct.unpack_from("<i", content)[0] < 5000 else ">", 0
    while at < len(content):
        kind, rows, columns, is_complex, length = struct.unpack_from(f"{order}5i", content, at)
        name, start = content[at + 20 : at + 19 + length].decode("ascii"), at + 20 + length
        form = np.dtype(order + _VERSION_4[kind // 10 % 10])
        at = start + rows * columns * form.itemsize * (2 if is_complex else 1)
        if min(rows, columns, length) < 0 or at > len(content):
            raise ValueError(f"variable of {rows} by {columns}")
        if name not in wanted:
            yield name, None
            continue
        if is_complex or kind % 10 > 1:
            raise ValueError("complex or sparse matrix")
        values, shape = np.frombuffer(content, form, rows * columns, start).astype(float), [rows, columns]
        texts = kind % 10 == 1
        yield name, _rows([chr(int(c)) for c in values], shape) if texts else values.reshape(shape, order="F")


def _rows(characters: list[str], shape: list[int]) -> list[str]:
    """Return the texts in the rows of a matrix of characters, by columns."""
    return ["".join(row).strip() for row in np.array(characters, dtype=str).reshape(shape, order="F").tolist()]
