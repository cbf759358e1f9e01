"""Numbers without units that are of no usual size, and the unit that they may be in."""

import pytest

from suspension_ctrl.schema.usual import check_bare, is_usual


@pytest.mark.parametrize(
    ("value", "unit", "message"),
    [
        (12.0, "m", "x must be 0.0001 to 1 m, or typed with its unit, got 12: 12 mm?"),
        (100.0, "m/s", "x must be 0.05 to 99 m/s, or typed with its unit, got 100: 100 km/h?"),
        (1.3, "N", "x must be 5 to 1e+06 N, or typed with its unit, got 1.3: 1.3 kN?"),
        (800.0, "m/s^2", "x must be 0.001 to 100 m/s^2, or typed with its unit, got 800: 800 mm/s^2?"),
        (1200.0, "Hz", "x must be 0.05 to 1000 Hz, or typed with its unit, got 1200: 1200 1/min?"),
        (1e9, "m", "x must be 0.0001 to 1 m, or typed with its unit, got 1e+09"),
    ],
)
def test_an_unusual_size_is_told_with_the_likely_unit(value, unit, message):
    assert not is_usual(value, unit)
    with pytest.raises(ValueError, match="must") as error:
        check_bare("x", value, unit)
    assert str(error.value) == message


@pytest.mark.parametrize(
    ("value", "unit"), [(0.012, "m"), (27.78, "m/s"), (-1.0, "m"), (0.0, "Hz"), (3.0, ""), (1e9, "kg")]
)
def test_usual_sizes_and_other_units_pass(value, unit):
    assert is_usual(value, unit)
    check_bare("x", value, unit)
