"""Records of a page: named tuples and arrays as JSON."""

import json
from base64 import b64decode
from typing import NamedTuple

import numpy as np
import pytest

from suspension_ctrl.desk.explorer.packing import packed


class Pair(NamedTuple):
    one: int
    other: tuple[str, ...]


def test_named_tuples_have_their_class():
    assert packed(Pair(1, ("a", "b"))) == {"class": "Pair", "one": 1, "other": ["a", "b"]}
    assert packed({"pair": Pair(2, ()), "nothing": None}) == {
        "pair": {"class": "Pair", "one": 2, "other": []},
        "nothing": None,
    }


@pytest.mark.parametrize(
    ("given", "stored"),
    [
        (np.array([[1.5, -2.0], [0.0, np.pi]]), "<f8"),
        (np.array([1 + 2j, 3 - 4j]), "<f8"),
        (np.array([3, -1, 70_000]), "<i4"),
        (np.array([True, False]), "u1"),
        (np.empty((0, 3)), "<f8"),
        (np.arange(6.0).reshape(2, 3).T, "<f8"),
    ],
)
def test_arrays_come_back_bit_for_bit(given, stored):
    found = json.loads(json.dumps(packed(given)))
    content = np.frombuffer(b64decode(found["base64"]), stored)
    if given.dtype.kind == "c":
        content = content.view("<c16")
    np.testing.assert_array_equal(content.reshape(found["shape"]), given)
