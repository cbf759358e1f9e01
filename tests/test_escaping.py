"""Hostile names through every medium: each is read back as the medium's own reader shows it."""

import csv
import html
import io
import re

import pandas as pd
import pytest
from hypothesis import example, given
from hypothesis import strategies as st
from matplotlib.cbook import is_math_text
from rich.text import Text

from soak import names
from soak.names import HOSTILE, shown
from suspension_ctrl import escaping

TEXTS = st.one_of(st.sampled_from(HOSTILE), st.text(max_size=12), st.text("=+-@'\\$_|<>*`[]()\x1b\n", max_size=8))


@given(TEXTS)
def test_a_terminal_gets_printable_text_alone(text):
    found = escaping.terminal(text)
    assert found.isprintable()
    assert found == shown(text)
    assert Text(found).plain == found


def test_every_medium_shows_every_hostile_name_as_text_alone():
    counts = names.hostile()
    assert counts.failures == []
    assert counts.tried == 6 * len(HOSTILE) - 1


@pytest.mark.parametrize("medium", ["terminal", "figure", "csv", "markdown", "latex", "html"])
def test_a_medium_without_its_escapes_is_found_out(monkeypatch, medium):
    monkeypatch.setattr(escaping, medium, lambda text: text)
    assert names.hostile().differing > 0


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
