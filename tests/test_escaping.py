"""Hostile names through every medium: each is read back as the medium's own reader shows it."""

import csv
import html
import io
import re

import pandas as pd
import pytest
from hypothesis import example, given
from hypothesis import strategies as st
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.cbook import is_math_text
from matplotlib.figure import Figure
from rich.text import Text

from suspension_ctrl import escaping

HOSTILE = [
    "\x1b[31mred\x1b[0m", "\x1b]0;title\x07", "line\nbreak\r", "\u202egnp.exe", "\u2066x\u2069", "a\x00b",
    "\ud800", "[bold]x[/bold]", "$x^2$", "$\\frac{", "a$", "_hidden", "a|b", "<b>x</b>",
    "<script>alert(1)</script>", '"quoted"', "[x](javascript:y)", "*x* _y_ `z`", "=1+1", "+1+1", "-1+1",
    "@SUM(A1)", "=cmd|' /C calc'!A0", "'=1", "\t=1", " =1", "\uff1d1", "\\", "\\input{x}", "50 % & #1 ~ ^", "",
    "C:\\new\\x41",
]  # fmt: skip
TEXTS = st.one_of(st.sampled_from(HOSTILE), st.text(max_size=12), st.text("=+-@'\\$_|<>*`[]()\x1b\n", max_size=8))


def shown(text: str) -> str:
    """The text as every medium shows it, by Python's own escapes."""
    return "".join(c if c.isprintable() else repr(c)[1:-1] for c in text)


@given(TEXTS)
def test_a_terminal_gets_printable_text_alone(text):
    found = escaping.terminal(text)
    assert found.isprintable()
    assert found == shown(text)
    assert Text(found).plain == found


@pytest.mark.parametrize("text", [text for text in HOSTILE if text not in ("", "\uff1d1")])  # of no glyph
def test_a_figure_shows_no_formula_and_every_label(text):
    figure = Figure(figsize=(8, 1))
    ax = figure.subplots()
    ax.plot([1, 2], label=escaping.figure(text))
    legend = ax.legend()
    FigureCanvasAgg(figure).draw()  # a formula with a mistake raises here
    (label,) = [one.get_text() for one in legend.get_texts()]
    assert not is_math_text(label)
    assert label.replace(r"\$", "$").removeprefix(" ") == shown(text).removeprefix(" ")


@given(TEXTS, TEXTS)
def test_a_label_of_two_names_is_no_formula_either(first, second):
    assert not is_math_text(f"{escaping.figure(first)} less {escaping.figure(second)}")


@given(TEXTS)
@example("-5")
@example("1e5")
def test_a_cell_of_csv_is_no_formula_and_comes_back(text):
    found = escaping.csv(text)
    assert found.isprintable()
    formula = found.lstrip()[:1] in {*"=+-@\uff0b\uff0d\uff1d\uff20"} - {""}
    assert not formula or float(found) is not None  # a number is none
    assert escaping.from_csv(found) == text


@pytest.mark.parametrize("text", ["nsga2", "a_b", "SWS [m]", "-0.5", "+3e4", "C:\\new\\x41", "3 - 2", "Škoda"])
def test_texts_that_do_no_harm_are_cells_as_they_are(text):
    assert escaping.csv(text) == text


@given(TEXTS)
def test_html_shows_the_text_in_content_and_attributes(text):
    found = escaping.html(text)
    assert not set(found) & set("<>\"'")
    assert html.unescape(found) == shown(text)


@given(TEXTS)
def test_markdown_has_neither_tags_nor_cells_nor_emphasis_in_it(text):
    found = escaping.markdown(text)
    assert html.unescape(re.sub(r"\\([!-/:-@\[-`{-~])", r"\1", found)) == shown(text)
    bare = re.sub(r"\\.", "", found)
    assert not set(bare) & set("<>|*`$~\\")
    assert not re.search(r"(?<!\w)_|_(?!\w)", re.sub(r"\\.", "x", found))
    assert not re.search(r"\[[^\]]*\][(\[:]", bare)


@pytest.mark.parametrize(
    ("text", "written"),
    [
        ("a_b [m/s^2]", "a_b [m/s^2]"),
        ("a|b", r"a\|b"),
        ("<b>", "&lt;b&gt;"),
        ("_x_ *y* $z$", r"\_x\_ \*y\* \$z\$"),
        ("[x](y)", r"\[x](y)"),
        ("p < 0.05", "p &lt; 0.05"),
    ],
)
def test_markdown_is_read_by_people_too(text, written):
    assert escaping.markdown(text) == written


@given(TEXTS)
def test_latex_gets_what_pandas_gives_it(text):
    """Its escape of the ten special characters, by `Styler`; bars and angles are of this package."""
    plain = re.sub(r"[<>|]", "x", shown(text))
    styled = pd.DataFrame({"a": [plain]}).style.hide(axis="index").format(escape="latex").to_latex()
    cell = re.search(r"^a \\\\\n(.*) \\\\$", styled, re.MULTILINE | re.DOTALL)[1]
    ours = re.sub(r"(\\text\w+)\{\}", r"\1", escaping.latex(plain))
    assert re.sub(r"\s", "", ours) == re.sub(r"\\space\b|\s", "", cell)
    assert not set(re.sub(r"\\text\w+\{\}", "", escaping.latex(text))) & set("<>|~^")


def test_a_table_is_escaped_in_cells_and_headers():
    table = pd.DataFrame({"=a": ["=b", "c"], "n": [-1.5, 2.0]}, index=[3, 4])
    found = escaping.frame(table, escaping.csv)
    wanted = pd.DataFrame({"'=a": ["'=b", "c"], "n": [-1.5, 2.0]}, index=[3, 4])
    pd.testing.assert_frame_equal(found, wanted)
    pd.testing.assert_frame_equal(escaping.frame(found, escaping.from_csv), table)


@given(st.lists(TEXTS.filter(lambda text: "\ud800" not in text), min_size=1, max_size=3))
def test_rows_of_csv_stay_rows(cells):
    file = io.StringIO()
    pd.DataFrame([list(map(escaping.csv, cells))]).to_csv(file, index=False, header=False)
    (row,) = csv.reader(io.StringIO(file.getvalue()))
    assert [escaping.from_csv(cell) for cell in row] == cells
