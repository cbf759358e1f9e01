"""Blocks of rows on threads: results in order, errors, interrupts, and how many threads there are."""

import _thread
import signal
import threading
import time
import weakref

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from suspension_ctrl.threads import in_blocks, limited, number, numbers_in

MUCH = 1 << 31
"""Work for more blocks than there are rows here."""


@settings(max_examples=30)
@given(st.integers(0, 50), st.integers(0, 1 << 26), st.integers(1, 4))
def test_blocks_are_all_rows_in_order(rows, work, threads):
    parts = in_blocks(lambda part: list(range(part.start, part.stop)), rows, work, threads)
    assert [row for part in parts for row in part] == list(range(rows))
    assert len(parts) <= max(1, min(rows, work // 2**21))
    first, *others = map(len, parts)
    late = rows * 2**20 / work if threads > 1 and others else 0  # the caller's thread begins with the first
    assert max(others, default=0) - min(others, default=0) <= 1
    assert all(abs(first - late - other) < 2 for other in others)  # two whole parts of numbers


def test_blocks_run_at_the_same_time_on_as_many_threads_as_asked_for():
    meeting, seen = threading.Barrier(3), set()

    def meet(part):
        meeting.wait(timeout=10)
        seen.add(threading.get_ident())

    in_blocks(meet, 3, MUCH, 3)
    assert len(seen) == 3
    assert threading.get_ident() in seen  # the caller's works too


@pytest.mark.parametrize(("work", "threads", "parts"), [(MUCH, 1, 100), (1 << 21, 4, 1)])
def test_little_work_and_one_thread_stay_on_the_caller_s(work, threads, parts):
    found = in_blocks(lambda part: (part.stop - part.start, threading.get_ident()), 100, work, threads)
    assert found == [(100 // parts, threading.get_ident())] * parts


def test_a_block_may_have_blocks_of_its_own():
    inner = in_blocks(lambda _: in_blocks(lambda part: part.start, 4, MUCH, 2), 4, MUCH, 2)
    assert inner == [[0, 1, 2, 3]] * 4


def test_the_first_error_is_raised_and_what_waits_is_not_begun():
    begun = []

    def fail(part):
        begun.append(part.start)
        if part.start in (1, 2):
            raise ValueError(f"row {part.start}")
        time.sleep(0.02)

    with pytest.raises(ValueError, match="row 1"):
        in_blocks(fail, 100, MUCH, 2)
    assert len(begun) < 100
    assert in_blocks(lambda part: part.start, 2, MUCH, 2) == [0, 1]  # the threads live on


def test_nothing_is_kept_of_what_was_worked_on():
    def work():
        given = np.ones(3)
        in_blocks(lambda part: given[part].sum(), 3, MUCH, 2)
        return weakref.ref(given)

    found = work()
    until = time.monotonic() + 10
    while found() is not None and time.monotonic() < until:  # the other thread may be about to forget it
        time.sleep(0.001)
    assert found() is None


def test_an_interrupt_ends_it_soon():
    """In whatever process: a shell starts those in the background without."""
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    begun = []

    def interrupt(part):
        begun.append(part.start)
        if part.start == 1:
            _thread.interrupt_main()
        time.sleep(0.02)

    try:
        with pytest.raises(KeyboardInterrupt):
            in_blocks(interrupt, 100, MUCH, 2)
    finally:
        signal.signal(signal.SIGINT, before)
    assert len(begun) < 100


def test_a_limit_holds_in_its_block_where_no_number_is_given():
    free = number(None)
    assert free >= 1
    with limited(1):
        assert (number(None), number(3)) == (1, 3)
        with limited(2):
            assert number(None) == 2
        assert number(None) == 1
    assert number(None) == free


@pytest.mark.parametrize("threads", [0, -1, 1.5, "2", True])
def test_other_numbers_of_threads_are_refused(threads):
    with pytest.raises(ValueError, match="threads must be a whole number >= 1, got"):
        number(threads)


def test_numbers_are_counted_in_nested_tuples():
    assert numbers_in((np.ones((2, 3)), (np.ones(4), 5), 6.0)) == 12
