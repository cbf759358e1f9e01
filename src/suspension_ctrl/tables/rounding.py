"""Numbers of tables for readers: rounded to the digits that matter, without exponents where people write none."""

from collections.abc import Sequence
from math import floor, isfinite, log10
from typing import Any

DIGITS = 4
_SMALLEST, _LARGEST = 1e-5, 1e9  # beyond these a number has an exponent
_ALIKE = 10  # ratio of the largest to the least number of a column with equal decimals


def rounded(
    cells: Sequence[Any], decimals: int | None = None, digits: int = DIGITS, *, alike: bool = True
) -> list[str]:
    """Return the texts of a column's cells; NaN and None are blank.

    Numbers of one column have the same decimals, by default as many as the largest needs for its significant
    digits. If they differ by more than a factor of 10, or are not of one kind (`alike`), each has its own.
    """
    sizes = [abs(x) for x in cells if isinstance(x, float) and isfinite(x) and x]
    if decimals is not None:
        return [_text(x, decimals) for x in cells]
    if not alike or not sizes or max(sizes) > _ALIKE * min(sizes) or not _SMALLEST <= max(sizes) < _LARGEST:
        return [_own(x, digits) for x in cells]
    texts = [_text(x, _decimals(max(sizes), digits)) for x in cells]
    while all(text.endswith("0") for text in texts if "." in text) and any("." in text for text in texts):
        texts = [text[:-1].removesuffix(".") if "." in text else text for text in texts]
    return texts


def _text(x: Any, decimals: int) -> str:
    """Return a cell with this number of decimals."""
    if x is None or x != x:
        return ""
    return f"{x:z.{decimals}f}" if isinstance(x, float) else str(x)


def _own(x: Any, digits: int) -> str:
    """Return a cell with its own significant digits: 1.5 as it is, 2.9999 as 3.000."""
    if not isinstance(x, float) or not isfinite(x) or not x:
        return _text(x, 0)
    if not _SMALLEST <= abs(x) < _LARGEST:
        return f"{x:.{digits - 1}e}"
    text = _text(x, _decimals(abs(x), digits))
    return text.rstrip("0").removesuffix(".") if "." in text and float(text) == x else text


def _decimals(size: float, digits: int) -> int:
    return max(0, digits - 1 - floor(log10(size)))
