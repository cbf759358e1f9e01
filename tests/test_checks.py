"""Checks of input: one line with the parameter, what is allowed and the value."""

import re

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from suspension_ctrl import checks

MILLIS = st.floats(-3e5, 4e5).map(lambda x: round(x, 3))  # farther from a bound than rounding may be
LOWER, UPPER = (0.0, -2.0, 1e5), (1.0, 2.0, 3e5)

SENTENCES = [
    (checks.positive, ("mass", 0.0, "kg"), "mass must be finite and > 0 kg, got 0.0"),
    (checks.positive, ("mass", float("inf"), "kg"), "mass must be finite and > 0 kg, got inf"),
    (checks.positive, ("mass", 10**400), f"mass must be finite and > 0, got 1{'0' * 17}...{'0' * 19}"),
    (checks.positive, ("mass", True), "mass must be finite and > 0, got True"),
    (checks.positive, ("mass", "1"), "mass must be finite and > 0, got '1'"),
    (checks.not_negative, ("damper", -1, "N s/m"), "damper must be finite and >= 0 N s/m, got -1"),
    (checks.at_least, ("seeds", 1.0, 1), "seeds must be a whole number >= 1, got 1.0"),
    (checks.at_least, ("seeds", 0, 1), "seeds must be a whole number >= 1, got 0"),
    (checks.within, ("target", np.nan, 0, 1), "target must be a number from 0 to 1, got nan"),
    (
        checks.interval,
        ("band", (2.0, 1.0), "Hz"),
        "band must be finite with 0 <= lower < upper [Hz], got (2.0, 1.0)",
    ),
    (checks.interval, ("band", 3.0, "Hz"), "band must be finite with 0 <= lower < upper [Hz], got 3.0"),
    (checks.position, ("place", "12"), "place must be two finite numbers, x and y [m], got '12'"),
    (checks.listed, ("measures", "ACC"), "measures must be a list, got 'ACC'"),
    (checks.listed, ("measures", 3), "measures must be a list, got 3"),
    (checks.one_of, ("road", "E", ("A", "B")), "road must be one of A, B, got 'E'"),
    (
        checks.ordered,
        ("lower", "upper", [0, 3], [1, 2]),
        "lower must be finite, <= upper in every variable and < upper in one, got [0.0, 3.0] and [1.0, 2.0]",
    ),
    (
        checks.ordered,
        ("lower", "upper", [0, 2], [0, 2]),
        "lower must be finite, <= upper in every variable and < upper in one, got [0.0, 2.0] and [0.0, 2.0]",
    ),
    (
        checks.ordered,
        ("lower", "upper", [0], [1, 2]),
        "lower and upper must be one-dimensional and of one length, got [0] and [1, 2]",
    ),
    (checks.designs, ([1.0, 2.0], 2), "designs must have shape (n, 2), got (2,)"),
]


@pytest.mark.parametrize(("check", "arguments", "sentence"), SENTENCES)
def test_sentences(check, arguments, sentence):
    with pytest.raises(ValueError, match=f"^{re.escape(sentence)}$"):
        check(*arguments)


@pytest.mark.parametrize(
    ("value", "text"),
    [
        (-1.5, "-1.5"),
        ("x" * 50, f"'{'x' * 17}...{'x' * 18}'"),
        ("\x1b[31m\u202e", r"'\x1b[31m\u202e'"),
        (np.zeros((9, 9)), "array([[0., 0., 0...., 0., 0., 0., 0.]])"),
        (list(range(99)), "[0, 1, 2, 3, 4, 5, ...]"),
    ],
)
def test_a_value_is_shown_in_40_printable_characters(value, text):
    shown = checks.shown(value)
    assert shown.isprintable()
    assert len(shown) <= 40
    assert shown == text


def test_a_number_that_python_does_not_spell_is_shown_in_words():
    assert checks.shown(16**9999) == "a number of thousands of digits"


@given(st.text(max_size=99))
def test_any_text_is_shown_in_40_printable_characters(text):
    shown = checks.shown(text)
    assert shown.isprintable()
    assert len(shown) <= 40
    assert shown == repr(text) or len(repr(text)) > 40


def test_a_regular_file_has_a_size(tmp_path):
    path = tmp_path / "a"
    path.write_bytes(bytes(2000))
    checks.regular(path, 0.002)
    with pytest.raises(ValueError, match=r"^the file must be a regular one of at most 0.001 MB, got 0.002 MB$"):
        checks.regular(path, 0.001)
    with pytest.raises(ValueError, match=r"^the file must be a regular one of at most 1 MB, got another kind$"):
        checks.regular(tmp_path, 1)
    with pytest.raises(FileNotFoundError):
        checks.regular(tmp_path / "b", 1)


def test_whatever_is_allowed_passes():
    checks.positive("mass", np.float64(1e-300))
    checks.not_negative("damper", 0)
    checks.at_least("seeds", np.int64(1), 1)
    checks.within("target", 1, 0, 1)
    checks.interval("band", np.array([0.0, 1.0]), "Hz")
    assert checks.position("place", [0, -1.5]) == (0.0, -1.5)
    for names in ([], ("ACC", "DTL"), {"ACC": 1}.keys(), np.array(["ACC"])):
        checks.listed("measures", names)
    checks.interval("bounds", (1.0, 1.0), "N/m", equal=True)
    checks.ordered("lower", "upper", LOWER, UPPER)
    checks.ordered("lower", "upper", [0, 2], [1, 2])
    assert checks.designs([[1, 2]], 2).dtype == float


@given(arrays(float, st.tuples(st.integers(0, 5), st.just(3)), elements=MILLIS))
def test_rows_are_within_the_bounds_or_the_first_that_is_not_is_named(rows):
    inside = ((rows >= LOWER) & (rows <= UPPER)).all(axis=1)
    if inside.all():
        checks.rows_within("designs", rows, LOWER, UPPER)
    else:
        got = rows[inside.argmin()].tolist()
        with pytest.raises(ValueError, match=f"^designs must lie within .* got {re.escape(str(got))}$"):
            checks.rows_within("designs", rows, LOWER, UPPER)


@pytest.mark.parametrize("value", [np.nan, np.inf, -np.inf])
def test_a_number_that_is_not_finite_is_outside(value):
    with pytest.raises(ValueError, match=f"got \\[0.5, {value}, 200000.0\\]$"):
        checks.rows_within("designs", np.array([[0.5, 0.0, 2e5], [0.5, value, 2e5]]), LOWER, UPPER)


@pytest.mark.parametrize("count", [1, 63, 64, 65, 200])
def test_one_row_outside_is_found_among_many(count):
    for place in {0, count // 2, count - 1}:
        for value in (-3.0, 1e9, np.nan):
            rows = np.full((count, 3), [0.5, 0.0, 2e5])
            rows[place, 1] = value
            with pytest.raises(ValueError, match=r"^designs must lie within"):
                checks.rows_within("designs", rows, LOWER, UPPER)


def test_rounding_may_pass_a_bound():
    """By 1e-9 of the range, here 4; by twice as much not."""
    checks.rows_within("designs", np.array([[0.5, 2 + 3.9e-9, 2e5]]), LOWER, UPPER)
    with pytest.raises(ValueError, match=r"^designs must lie within"):
        checks.rows_within("designs", np.array([[0.5, 2 + 8e-9, 2e5]]), LOWER, UPPER)


def test_a_held_variable_has_its_value_alone():
    bounds = (0.0, 18e3), (1.0, 18e3)
    checks.rows_within("designs", np.array([[0.5, 18e3]]), *bounds)
    for value in (np.nextafter(18e3, 0), np.nextafter(18e3, 2e4)):
        with pytest.raises(ValueError, match=r"^designs must lie within"):
            checks.rows_within("designs", np.array([[0.5, value]]), *bounds)


def test_a_missing_package_names_its_extra():
    with pytest.raises(ImportError) as raised, checks.installed("study"):
        import suspension_ctrl_absent  # noqa: F401
    message = 'suspension_ctrl_absent must be installed, by: pip install "suspension-ctrl[study]"'
    assert (str(raised.value), raised.value.name) == (message, "suspension_ctrl_absent")


def test_a_reader_may_fail_in_any_way():
    with (
        pytest.raises(ValueError, match=r"^the file must be fine, got one that cannot .*$"),
        checks.readable("fine"),
    ):
        raise RuntimeError("two\nlines")


def test_of_many_names_those_alike_are_told_first():
    names = [f"{axle}.{what}" for axle in ("front", "middle", "rear") for what in "abcdefgh"] + ["front.spring"]
    for value, told in (
        ("front.sprng", "front.spring, front.g, front.h, front.a"),
        ("?", "front.a, front.b, front.c"),
    ):
        message = rf"^setting must be one of {told}, .*, ... and 17 more, got '{re.escape(value)}'$"
        with pytest.raises(ValueError, match=message) as caught:
            checks.one_of("setting", value, names)
        assert str(caught.value).count(", ") == 9
