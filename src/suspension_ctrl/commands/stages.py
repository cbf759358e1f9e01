"""Stages of a command on standard error: a bar or a spinner in a terminal, and a line with the time at the end."""

import sys
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from time import perf_counter
from typing import TypeVar

from .. import escaping
from . import signals, terminal

T = TypeVar("T")


def counted(items: Iterable[T], total: int, text: str, found: int = 0) -> Iterator[T]:
    """Yield the missing `items` of a total with `terminal.progress`; then say the stage and what was found."""
    start, done = perf_counter(), found
    for item in terminal.progress(items, total - found, text):
        signals.check()
        done += 1
        yield item
    say(f"{text}, {done} of {total} in {duration(perf_counter() - start)}{f', {found} found' if found else ''}")


@contextmanager
def stage(text: str, *, origin: str = "") -> Iterator[None]:
    """Show a spinner during the block, in a terminal only; then say the stage, and where its result was found."""
    start = perf_counter()
    with terminal.waiting(text):
        yield
    say(f"{text} in {duration(perf_counter() - start)}{origin and f', {origin}'}")


def say(text: str) -> None:
    """Print a line on standard error."""
    print(escaping.terminal(text), file=sys.stderr)


def duration(seconds: float) -> str:
    """Return a time in words: ``0.4 s``, ``17 s``, ``6.2 min``."""
    if seconds >= 100:
        return f"{seconds / 60:.1f} min"
    return f"{seconds:.0f} s" if seconds >= 9.95 else f"{seconds:.1f} s"
