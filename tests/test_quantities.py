"""Frozen records: equal by value, hashable, picklable, read-only, and shown with their units."""

import pickle
import re
from dataclasses import dataclass, field, replace

import numpy as np
import pytest

from suspension_ctrl.quantities import Checked, FrozenMapping, Record, frozen_array, unit


@dataclass(frozen=True, eq=False, repr=False)
class Rod(Record):
    length: float = field(metadata=unit("m"))
    shape: np.ndarray = field(metadata=unit("mm"))
    names: FrozenMapping = field(default_factory=lambda: FrozenMapping({}))
    colour: str = "grey"

    def __post_init__(self) -> None:
        object.__setattr__(self, "shape", frozen_array(self.shape))
        object.__setattr__(self, "names", FrozenMapping(self.names))


def test_records_are_equal_by_value_and_hashable():
    one, same = Rod(2.0, [1, 2, 3], {"a": 1}), Rod(2.0, [1.0, 2.0, 3.0], {"a": 1})
    assert one == same
    assert hash(one) == hash(same)
    for other in (replace(one, length=3.0), replace(one, shape=[1, 2, 4]), replace(one, names={"a": 2})):
        assert one != other
    assert one != (2.0, [1, 2, 3])


def test_what_goes_into_a_record_is_copied_and_stays_as_it_is():
    shape, names = np.array([1.0, 2.0]), {"a": 1}
    rod = Rod(2.0, shape, names)
    shape[0], names["a"] = 7.0, 7
    assert rod == Rod(2.0, [1, 2], {"a": 1})
    for again in (rod, pickle.loads(pickle.dumps(rod))):
        assert again == rod
        with pytest.raises(ValueError, match="read-only"):
            again.shape[0] = 7.0
        with pytest.raises(TypeError, match="item assignment"):
            again.names["a"] = 7


def test_a_record_is_shown_with_units_and_without_defaults():
    assert repr(Rod(2.5, [1, 2, 3])) == "Rod(length=2.5 m, shape=(3,) from 1 to 3 mm)"
    long = repr(Rod(2.5, [1, 2, 3], {f"name{i}": i for i in range(200)}))
    assert len(long.splitlines()) == 6
    assert max(map(len, long.splitlines())) <= 88


@dataclass(frozen=True, eq=False, repr=False)
class Spring(Checked):
    rate: float = field(metadata=unit("N/m"))
    damping: float = field(default=0.0, metadata=unit("N s/m"))
    offset: float = field(default=0.0, metadata=unit("m", -1, 1))
    count: float = 3.0


@pytest.mark.parametrize(
    ("values", "message"),
    [
        ({"rate": 0.0}, "rate must be finite and > 0 N/m, got 0.0"),
        ({"rate": "1"}, "rate must be finite and > 0 N/m, got '1'"),
        ({"rate": 1.0, "damping": -0.1}, "damping must be finite and >= 0 N s/m, got -0.1"),
        ({"rate": 1.0, "offset": 1.5}, "offset must be a number from -1 to 1, got 1.5"),
    ],
)
def test_numbers_with_units_are_checked_at_birth(values, message):
    assert Spring(rate=1.0, offset=-1.0, count=-3.0).damping == 0.0
    with pytest.raises(ValueError, match="^" + re.escape(message) + "$"):
        Spring(**values)
