"""Frozen records: equal by value, hashable, picklable, read-only, and shown with their units."""

import pickle
import re
from dataclasses import dataclass, field, replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from suspension_ctrl.quantities import Checked, FrozenMapping, Record, frozen, frozen_array, kept, quantity, unit


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


@pytest.mark.parametrize(
    ("text", "unit", "value"),
    [
        ("100km/h", "m/s", 100 / 3.6),
        ("60 mph", "m/s", 60 * 1609.344 / 3600),  # the international mile
        ("1500mm", "m", 1.5),
        ("-1.2e1 cm", "m", -0.12),
        ("1.2 t", "kg", 1200.0),
        ("20 kN/m", "N/m", 20e3),
        ("100 lbf/in", "N/m", 100 * 0.45359237 * 9.80665 / 0.0254),
        ("1.5 N s/mm", "N s/m", 1500.0),
        ("1.5 kN*s/m", "N s/m", 1500.0),
        ("400 N m/deg", "N m/rad", 400 * 180 / np.pi),
        ("4 deg/g", "rad s^2/m", 4 * np.pi / 180 / 9.80665),
        ("5 cm^3", "m^3", 5e-6),
        ("0.1 cycle/m", "cycle/m", 0.1),
        ("120 min^-1", "Hz", 2.0),
        ("30%", "", 0.3),
        ("0.3", "", 0.3),
        (" 7 ", "m", 7.0),
        ("20", "min", 20.0),
        ("1 h", "min", 60.0),
        ("2 /km", "1/km", 2.0),
        ("2/km", "1/m", 0.002),
        ("6 deg/g", "deg/g", 6.0),
        ("3 mm", "km", 3e-6),
    ],
)
def test_values_with_units_are_numbers_in_the_unit_of_the_field(text, unit, value):
    """By definitions of the units, to a rounding of either side."""
    assert quantity("x", text, unit) == pytest.approx(value, rel=2e-15)


@given(st.floats(-1e12, 1e12).filter(lambda x: x == 0 or abs(x) > 1e-12))
def test_a_bare_number_is_read_as_python_writes_it(value):
    assert quantity("x", repr(value), "N/m") == value


@given(st.integers(0, 10**9))
def test_decimal_factors_are_exact(millimetres):
    assert quantity("x", f"{millimetres}mm", "m") == millimetres / 1000


@pytest.mark.parametrize(
    ("text", "unit", "message"),
    [
        ("60kg", "m/s", "speed must be in m/s or a unit like it, got '60kg' in kg"),
        ("60 m", "", "speed must be a number without unit, got '60 m' in m"),
        ("60 furlong/h", "m/s", "speed must be in units of kg, m, s, .*, got 'furlong/h'"),
        ("60 km//h", "m/s", "speed must be in units of .*, got 'km//h'"),
        ("fast", "m/s", "speed must be a number with a unit like m/s, got 'fast'"),
        ("nan", "m/s", "speed must be a number with a unit like m/s, got 'nan'"),
        ("1e999", "m/s", "speed must be of moderate size, got '1e999'"),
        ("1\n2", "m/s", "speed must be in units of .*, got '2'"),
        ("", "m/s", "speed must be a number with a unit like m/s, got ''"),
        (3.0, "m/s", "speed must be a number with a unit like m/s, got 3.0"),
    ],
)
def test_a_unit_that_does_not_fit_is_one_line(text, unit, message):
    with pytest.raises(ValueError, match=f"^{message}$"):
        quantity("speed", text, unit)


@given(st.text(max_size=40))
def test_any_text_is_a_number_or_refused_in_one_line(text):
    try:
        said = str(quantity("x", text, "m/s"))
    except ValueError as error:
        said = str(error)
    assert said.isprintable()
    assert said not in ("inf", "nan")


def test_a_bare_number_is_refused_where_a_unit_is_needed():
    with pytest.raises(ValueError, match=r"^x must be a number with a unit like m, got '3'$"):
        quantity("x", "3", "m", bare=False)


def test_a_read_only_array_is_copied_too():
    """Its owner may make it writable again."""
    given = np.zeros(3)
    given.flags.writeable = False
    kept = frozen_array(given)
    given.flags.writeable = True
    given[0] = 1.0
    assert kept[0] == 0.0


def test_arrays_that_are_read_only_for_good_are_kept_and_others_copied():
    own = frozen(np.array([[0.0, 1.0, 2.0], [3.0, 4.0, 5.0]]))
    assert kept(own) is own
    assert np.shares_memory(kept(own[:, :3]), own)
    open_ = np.arange(3.0)
    looked_at = open_[:]
    looked_at.flags.writeable = False
    for values in (open_, looked_at, own[:, :2]):  # the owner may change it; numba takes it for another type
        copy = kept(values)
        assert not np.shares_memory(copy, values)
        assert copy.flags.c_contiguous
        assert not copy.flags.writeable
        np.testing.assert_array_equal(copy, values)
