"""Sets of whole numbers as bits of words: the members beside a number are found in a few steps, in compiled loops.

A bit of the next depth stands for each word that is not 0, so that three depths are enough for 262,144 numbers.
P. van Emde Boas, "Preserving order in a forest in less than logarithmic time", FOCS 1975.
"""

from typing import Any

import numpy as np
from numba.cpython.unsafe import numbers
from numba.extending import overload
from numpy.typing import NDArray

from ..compiled import uncounted
from ..quantities import Integer

_numbers: Any = numbers  # numba's functions of compiled code take one argument less than their definitions
Words = NDArray[np.uint64]
_WORD = 6  # binary logarithm of the bits of a word
_ONE = np.uint64(1)


def empty_set(size: int) -> tuple[Words, Integer]:
    """Return the words of an empty set of numbers below a size, and where those of each depth start."""
    counts = [(size >> _WORD) + 1]
    while counts[-1] > 1:
        counts.append((counts[-1] - 1 >> _WORD) + 1)
    return np.zeros(sum(counts), dtype=np.uint64), np.cumsum([0, *counts[:-1]])


@uncounted()
def put(words: Words, starts: Integer, number: int) -> None:
    """Put a number into a set."""
    for start in starts:
        words[start + (number >> _WORD)] |= _ONE << np.uint64(number & 63)
        number >>= _WORD


@uncounted()
def take(words: Words, starts: Integer, number: int) -> None:
    """Take a number out of a set."""
    for start in starts:
        words[start + (number >> _WORD)] &= ~(_ONE << np.uint64(number & 63))
        number >>= _WORD
        if words[start + number]:
            return


@uncounted()
def below(words: Words, starts: Integer, number: int) -> int:
    """Return the largest member of a set below a number, -1 if there is none."""
    for depth in range(starts.size):
        word = words[starts[depth] + (number >> _WORD)] & ((_ONE << np.uint64(number & 63)) - _ONE)
        number >>= _WORD
        if word:
            number = (number << _WORD) + highest(word)
            for under in range(depth - 1, -1, -1):
                number = (number << _WORD) + highest(words[starts[under] + number])
            return number
    return -1


@uncounted()
def above(words: Words, starts: Integer, number: int) -> int:
    """Return the least member of a set above a number, -1 if there is none."""
    for depth in range(starts.size):
        word = words[starts[depth] + (number >> _WORD)] >> np.uint64(number & 63) >> _ONE
        if word:
            number += 1 + lowest(word)
            for under in range(depth - 1, -1, -1):
                number = (number << _WORD) + lowest(words[starts[under] + number])
            return number
        number >>= _WORD
    return -1


def highest(word: Any) -> int:
    """Return the place of the highest bit of a word that is not 0."""
    return int(word).bit_length() - 1


def lowest(word: Any) -> int:
    """Return the place of the lowest bit of a word that is not 0."""
    return (int(word) & -int(word)).bit_length() - 1


@overload(highest, strict=False)
def _highest(_word: Any) -> Any:
    return lambda _word: 63 - np.int64(_numbers.leading_zeros(_word))


@overload(lowest, strict=False)
def _lowest(_word: Any) -> Any:
    return lambda _word: np.int64(_numbers.trailing_zeros(_word))
