"""Blocks of rows worked on by several threads: compiled loops and numpy leave Python to the others meanwhile.

Each row has its result by itself, so that the bits do not depend on the number of threads.
"""

import os
from collections import deque
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from functools import cache
from queue import SimpleQueue
from threading import Lock, Thread
from typing import Any, TypeVar

from . import checks

T = TypeVar("T")

_BLOCK, _LEAST, _LATE = 1 << 24, 1 << 21, 1 << 20
"""Numbers that a block passes through, some milliseconds' work; the least that are worth a thread; and those that
the caller's thread passes through before another one has begun: its first block is so much larger."""

_most: ContextVar[int | None] = ContextVar("most", default=None)


@contextmanager
def limited(threads: int) -> Iterator[None]:
    """Use so many threads in the block where no number is given."""
    token = _most.set(checks.at_least("threads", threads, 1))
    try:
        yield
    finally:
        _most.reset(token)


def number(threads: int | None) -> int:
    """Return a number of threads as given; without one the limit, or the processors that this process may use."""
    if threads is not None:
        return checks.at_least("threads", threads, 1)
    return _most.get() or _processors()


def _processors() -> int:
    if hasattr(os, "sched_getaffinity"):  # Linux
        return len(os.sched_getaffinity(0))
    return os.cpu_count() or 1


def in_blocks(function: Callable[[slice], T], rows: int, work: int, threads: int) -> list[T]:
    """Return the results of a function of parts of so many rows, in order: of the whole if the work is little.

    The work is the count of numbers that are passed through. Every thread, the caller's too, takes the next part
    when it is done with one. An exception is that of the first part that has one.
    """
    blocks = max(1, min(rows, work // _LEAST, -(-(work // _BLOCK + 1) // threads) * threads))
    if blocks == 1:
        return [function(slice(0, rows))]
    alone = rows * _LATE // work if threads > 1 < blocks else 0
    edges = [0, *(alone + (rows - alone) * i // blocks for i in range(1, blocks + 1))]
    waiting = deque(enumerate(map(slice, edges, edges[1:])))
    results: list[Any] = [None] * blocks
    errors: dict[int, Exception] = {}

    def work_on() -> None:
        while waiting:
            try:
                place, part = waiting.popleft()
            except IndexError:  # another thread took the last
                return
            try:
                results[place] = function(part)
            except Exception as error:  # which the caller's thread raises
                errors[place] = error
                waiting.clear()

    helpers = [_Help(work_on) for _ in range(min(threads, blocks) - 1)]
    try:
        for helper in helpers:
            _asked(os.getpid(), threads - 1).put(helper)
        work_on()
        for helper in helpers:
            helper.end()
    finally:  # an interrupt too
        waiting.clear()
    if errors:
        raise errors[min(errors)]
    return results


class _Help:
    """Work that another thread may take up, until it is not needed any more.

    Futures of a pool take a tenth of a millisecond to begin and to end.
    """

    def __init__(self, work: Callable[[], None]) -> None:
        self._work, self._begun, self._running = work, Lock(), Lock()
        self._running.acquire()

    def __call__(self) -> None:
        if self._begun.acquire(blocking=False):
            try:
                self._work()
            finally:
                self._running.release()

    def end(self) -> None:
        """Wait for the end of work that has begun; leave out work that has not."""
        if not self._begun.acquire(blocking=False):
            self._running.acquire()


@cache
def _asked(_process: int, threads: int) -> "SimpleQueue[_Help]":
    """Return where help is asked for, with so many threads of a process, which a fork does not take along."""
    asked: SimpleQueue[_Help] = SimpleQueue()
    for _ in range(threads):
        Thread(target=_help, args=(asked,), name="suspension_ctrl", daemon=True).start()
    return asked


def _help(asked: "SimpleQueue[_Help]") -> None:
    """Take up work for ever."""
    while True:
        help_ = asked.get()
        help_()
        del help_  # with arrays that it holds


def numbers_in(part: Any) -> int:
    """Return the count of numbers in the arrays of nested tuples, by which work on them is measured."""
    return sum(map(numbers_in, part)) if isinstance(part, tuple) else int(getattr(part, "size", 1))
