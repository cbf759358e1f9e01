"""Sets of whole numbers as bits, beside Python's sets, in Python and compiled."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from suspension_ctrl.compiled import compiled
from suspension_ctrl.search.bits import above, below, empty_set, highest, lowest, put, take


def neighbours(members: set[int], number: int) -> tuple[int, int]:
    """The next members below and above a number, -1 where there is none, by looking at all."""
    return max((m for m in members if m < number), default=-1), min((m for m in members if m > number), default=-1)


@settings(max_examples=50)
@given(st.sampled_from([1, 64, 65, 4096, 4097, 300_000]), st.data())
def test_members_beside_a_number(size, data):
    """Of one, two, three and four depths; numbers are put in twice and taken out that are not in."""
    numbers, members, kept = st.integers(0, size - 1), set(), empty_set(size)
    for number in data.draw(st.lists(numbers, max_size=30)):
        put(*kept, number)
        members.add(number)
    for number in data.draw(st.lists(st.sampled_from(sorted(members)), max_size=10)) if members else []:
        take(*kept, number)
        members.discard(number)
    for number in [0, size - 1, *data.draw(st.lists(numbers, max_size=5)), *members]:
        assert (below(*kept, number), above(*kept, number)) == neighbours(members, number)


@compiled()
def ends(word: np.uint64) -> tuple[int, int]:
    return lowest(word), highest(word)


@pytest.mark.parametrize("places", [{0}, {63}, {0, 63}, {17, 40}])
def test_ends_of_a_word_in_python_and_compiled(places):
    word = np.uint64(sum(1 << place for place in places))
    assert (lowest(word), highest(word)) == (min(places), max(places))
    assert ends(word) == (min(places), max(places))
