"""Terms of measures."""

import re

import numpy as np
import pytest

from suspension_ctrl import Term, weighting


def test_a_term_has_a_text():
    texts = [str(term) for term in (
        Term("tyre_load"), Term("body_acceleration", "Wk", 2), Term("travel", None, 0.5),
        Term(("acceleration", 1, -0.5), weighting("Wd")),
    )]  # fmt: skip
    assert texts == ["tyre_load", "2 Wk body_acceleration", "0.5 travel", "Wd acceleration (1, -0.5)"]


def test_the_integral_of_a_term_is_without_factors():
    term = Term("tyre_load", factor=2.0, moment=2, relative=True)
    assert term.integral == Term("tyre_load", moment=2)


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (("tyre_load", "Wk"), "weighting must be of an acceleration, got Wk of tyre_load"),
        (("body_acceleration", "Wz"), "weighting must be one of Wk, Wd, "),
        (("tyre_load", None, 0.0), "factor of a response must be above 0 and up to 1e+06, got 0"),
        (("tyre_load", None, 2e6), "factor of a response must be above 0 and up to 1e+06, got 2e+06"),
        (("tyre_load", None, np.nan), "factor of a response must be above 0 and up to 1e+06, got nan"),
        (
            (("acceleration", 0.0, 2e6),),
            "y of a point must be a number from -1000000.0 to 1000000.0, got 2000000.0",
        ),
        (("tyre_load", None, 1.0, -1), "moment must be a whole number >= 0, got -1"),
    ],
)
def test_terms_that_mean_nothing_are_one_line(arguments, message):
    with pytest.raises(ValueError, match="^" + re.escape(message)):
        Term(*arguments)
