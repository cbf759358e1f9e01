"""Random numbers in compiled loops beside numpy's."""

import numpy as np
from numba import njit

from suspension_ctrl.search.stream import Stream, put_back, stream_of


@njit
def drawn(rng, count):
    return [rng.random() for _ in range(count)]


def test_a_stream_gives_the_numbers_of_its_generator_and_leaves_it_where_it_ends():
    """Half of a draw of 64 bits, which numpy keeps for the next of 32, stays."""
    ours, numpys = np.random.default_rng(7), np.random.default_rng(7)
    for rng in (ours, numpys):
        rng.integers(0, 9, dtype=np.int32)
    stream = stream_of(ours)
    assert isinstance(stream, Stream)
    assert drawn(stream, 1000) == numpys.random(1000).tolist()
    put_back(stream, ours)
    assert ours.bit_generator.state == numpys.bit_generator.state
    assert ours.bit_generator.state["has_uint32"] == 1
    assert ours.integers(0, 9, 5, dtype=np.int32).tolist() == numpys.integers(0, 9, 5, dtype=np.int32).tolist()


def test_another_generator_stays_as_it_is():
    rng = np.random.Generator(np.random.MT19937(7))
    stream = stream_of(rng)
    assert stream is rng
    before = rng.bit_generator.state["state"]["pos"]
    put_back(stream, rng)
    assert rng.bit_generator.state["state"]["pos"] == before
