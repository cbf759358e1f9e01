import pickle
import re
from dataclasses import replace

import numpy as np
import pytest

from suspension_ctrl import Problem
from suspension_ctrl.quantities import column_headers

GOOD = {"evaluate": lambda x: x, "lower": (0.0, 0.0), "upper": (1.0, 1.0), "objectives": ("a", "b")}


def test_variables_get_names():
    assert Problem(**GOOD).variables == ("x1", "x2")
    assert Problem(**GOOD, variables=("k", "c")).variables == ("k", "c")


def test_headers_carry_units():
    assert column_headers(["SWS", "f1"], {"SWS": "m"}) == ["SWS [m]", "f1"]


@pytest.mark.parametrize(
    ("change", "message"),
    [
        (
            {"lower": (2.0, 0.0)},
            "lower must be finite, <= upper in every variable and < upper in one, got [2.0, 0.0] and [1.0, 1.0]",
        ),
        ({"lower": (0.0,)}, "lower and upper must be one-dimensional and of one length"),
        ({"upper": (1.0, float("inf"))}, "lower must be finite, <= upper"),
        ({"lower": (), "upper": ()}, "lower and upper must be one-dimensional and of one length"),
        ({"objectives": ("a",)}, "objectives must be 2 or more different names, got ('a',)"),
        ({"objectives": ("a", "a")}, "objectives must be 2 or more different names, got ('a', 'a')"),
        ({"objectives": "ab"}, "objectives must be a list, got 'ab'"),
        (
            {"kernel": (len, ())},
            "kernel must be a function compiled by numba and a tuple, got (<built-in",
        ),
        ({"kernel": len}, "kernel must be a function compiled by numba and a tuple, got <built-in"),
        ({"constraints": ("c", "c")}, "constraints must be names different from all others, got ('c', 'c')"),
        ({"constraints": ("a",)}, "constraints must be names different from all others, got ('a',)"),
        ({"constraints": "c"}, "constraints must be a list, got 'c'"),
        ({"variables": ("x", "x", "y")}, "variables must be 2 different names, got ('x', 'x', 'y')"),
        ({"variables": "kc"}, "variables must be a list, got 'kc'"),
        ({"variables": ("k",)}, "variables must be 2 different names, got ('k',)"),
    ],
)
def test_rejects_bad_problems(change, message):
    with pytest.raises(ValueError, match="^" + re.escape(message)):
        Problem(**GOOD | change)


def doubled(x: np.ndarray) -> np.ndarray:
    """Return an evaluation that can be pickled: objectives twice the variables."""
    return 2 * x


def test_problems_are_changed_compared_hashed_and_pickled():
    one = Problem(**GOOD | {"evaluate": doubled}, units={"a": "m"})
    for other in (one.replace(upper=(2.0, 2.0)), replace(one, upper=[2, 2])):
        assert other != one
        assert other.upper == (2.0, 2.0)
        assert other.replace(upper=(1.0, 1.0)) == one
    assert hash(one) == hash(replace(one))
    assert pickle.loads(pickle.dumps(one)) == one


def test_a_problem_stays_as_it_was_made():
    lower, units = np.zeros(2), {"a": "m"}
    one = Problem(**GOOD | {"lower": lower}, units=units)
    lower[0], units["a"] = 0.5, "s"
    assert one.lower == (0.0, 0.0)
    assert dict(one.units) == {"a": "m"}
