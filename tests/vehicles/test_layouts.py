"""Layouts of struts as texts: every strut is written and read back, every other text is refused."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

import suspension_ctrl as sc
from suspension_ctrl.vehicles.layouts import layout_of, names, strut_of

A, B, C, D = (sc.Spring(name) for name in "abcd")
ELEMENTS = {one.name: one for one in (A, B, C, D)}


@pytest.mark.parametrize(
    ("text", "strut"),
    [
        ("a", A),
        ("((a))", A),
        ("a|b", sc.parallel(A, B)),
        ("a - b - c", sc.series(A, B, C)),
        ("a | b - c | d", sc.parallel(A, sc.series(B, C), D)),
        ("(a | b) - c", sc.series(sc.parallel(A, B), C)),
        ("(a | b) | c", sc.parallel(sc.parallel(A, B), C)),
        ("0.8*(a | b)", sc.parallel(A, B, installation_ratio=0.8)),
        (" 1e-1 * ( a-b )|c ", sc.parallel(sc.series(A, B, installation_ratio=0.1), C)),
        ("0.5*(0.5*(a - b))", sc.series(A, B, installation_ratio=0.25)),
    ],
)
def test_signs_join_parts_and_a_number_is_an_installation_ratio(text, strut):
    assert strut_of(text, ELEMENTS) == strut
    assert names(text) == [one.name for one in strut.elements]


@st.composite
def struts(draw, parts=(A, B, C, D)):
    if len(parts) == 1:
        return parts[0]
    cut = draw(st.integers(1, len(parts) - 1))
    join = draw(st.sampled_from([sc.parallel, sc.series]))
    ratio = draw(st.just(1.0) | st.floats(1e-3, 1e3))
    return join(draw(struts(parts[:cut])), draw(struts(parts[cut:])), installation_ratio=ratio)


@given(struts())
def test_a_strut_is_read_from_the_layout_that_is_written(strut):
    assert strut_of(layout_of(strut), ELEMENTS) == strut


@pytest.mark.parametrize(
    "text",
    ["", " ", "a b", "a |", "| a", "a || b", "(a", "a)", "()", "a | e", "a & b", "0.8*a", "0.8(a | b)", "-1*(a|b)",
     "0.8*0.9*(a | b)", "1e400*(a | b)", "a\x00b", "(" * 200, "(" * 10**6, "a - " * 60],
)  # fmt: skip
def test_every_other_text_is_refused_in_one_line(text):
    with pytest.raises(
        ValueError, match=r"^layout must be a text of elements joined by [^\n]*, got '[^\n]*$"
    ) as error:
        strut_of(text, ELEMENTS)
    assert len(str(error.value)) < 200


@given(st.text(st.sampled_from("ab|-() *.0e1")))
def test_any_text_is_a_strut_or_refused(text):
    subject = "layout"
    try:
        strut_of(text, ELEMENTS)
    except ValueError as error:
        subject = str(error).split()[0]
    assert subject in ("layout", "elements", "installation_ratio")


def test_a_ratio_of_zero_is_refused():
    with pytest.raises(ValueError, match=r"^installation_ratio must be finite and > 0, got 0.0$"):
        strut_of("0*(a | b)", ELEMENTS)
