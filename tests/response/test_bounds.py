"""Bounds of coefficients by name, or one after the other."""

import re

import pytest

from garage import FULL, QUARTER
from suspension_ctrl.response.bounds import checked_bounds

PAIRS = {"spring": (1e4, 2e4), "damper": (1e3, 2e3)}


def test_bounds_one_after_the_other_are_those_of_the_coefficients_without_default():
    found = checked_bounds(FULL, None, [1e4, 1e3, 2e4, 2e3], [2e4, 2e3, 3e4, 3e3], {})
    assert found == {
        "front.spring": (1e4, 2e4), "front.damper": (1e3, 2e3),
        "rear.spring": (2e4, 3e4), "rear.damper": (2e3, 3e3),
    }  # fmt: skip


def test_bounds_by_name_keep_their_order_and_one_side_may_be_replaced():
    turned = dict(reversed(PAIRS.items()))
    assert list(checked_bounds(QUARTER, turned, (), (), {})) == ["damper", "spring"]
    assert checked_bounds(QUARTER, turned, (), (5e3, 5e4), {}) == {"damper": (1e3, 5e3), "spring": (1e4, 5e4)}


@pytest.mark.parametrize(
    ("bounds", "lower", "upper", "fixed", "message"),
    [
        ({}, (), (), {}, "bounds must hold one coefficient at least, got none"),
        (
            {"tyre": (1, 2)},
            (),
            (),
            {},
            "bounds must be one of spring, damper, tyre_stiffness, ",
        ),
        (
            {"damper": (2e3, 1e3)},
            (),
            (),
            {},
            "bounds of damper must be finite with 0 <= lower <= upper [N s/m]",
        ),
        ({"damper": (0.0, 1e3)}, (), (), {}, "lower bound of damper must be finite and > 0 N s/m, got 0.0"),
        (PAIRS, (1e4,), (), {}, "lower and upper must be one-dimensional and of one length, got "),
        (None, (1e4,), (2e4,), {}, "lower and upper must bound spring, damper, got (10000.0,)"),
        (
            None,
            (2e4, 1e3),
            (1e4, 2e3),
            {},
            "lower must be finite, <= upper in every variable and < upper in one, got ",
        ),
        (PAIRS, (), (), {"spring": 1e4}, "struts must be those that do not vary, got spring with bounds"),
    ],
)
def test_rejects_bad_bounds(bounds, lower, upper, fixed, message):
    with pytest.raises(ValueError, match="^" + re.escape(message)) as caught:
        checked_bounds(QUARTER, bounds, lower, upper, fixed)
    assert "\n" not in str(caught.value)
