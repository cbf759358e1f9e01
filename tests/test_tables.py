"""CSV files in and out: read strictly, written whole, under names that every system takes."""

import json
import os
import re

import numpy as np
import pandas as pd
import pytest
from hypothesis import given
from hypothesis import strategies as st

from suspension_ctrl import escaping, tables


def written(folder, text: str, encoding: str = "utf-8"):
    path = folder / "table.csv"
    path.write_text(text, encoding=encoding)
    return path


def test_a_table_is_read_without_comments_and_empty_lines(tmp_path):
    names, values = tables.read_table(written(tmp_path, "# source: a book\n\nx [m], y\n1, 2e3\n# more\n-3.5,0\n"))
    assert names == ["x [m]", "y"]
    assert values.tolist() == [[1.0, 2000.0], [-3.5, 0.0]]


@pytest.mark.parametrize(
    ("text", "key", "value"),
    [
        ("", "the file must begin with the names of its columns", "got nothing"),
        ("x\n1\n", "rows of numbers must be 2 or more", "got 1"),
        ("x,y\n1,2\n3\n", "row 2 must have 2 cells", "got 1"),
        ("x,y\n1,2\n3,no\n", "'y' must be a number up to 1e+09", "got 'no' in row 2"),
        ("x\n1\nnan\n", "'x' must be a number", "got 'nan' in row 2"),
        ("x\n1\n1e10\n", "'x' must be a number", "got '1e10' in row 2"),
        ('x\n1\n"2\n', "the file must be CSV in UTF-8", "got quotes that do not end"),
    ],
)
def test_a_table_with_a_mistake_is_told_by_file_place_and_value(tmp_path, text, key, value):
    path = written(tmp_path, text)
    with pytest.raises(ValueError, match=r"^[^\n]*$") as raised:
        tables.read_table(path)
    message = str(raised.value)
    assert message.startswith(f"{path}: {key}")
    assert message.endswith(value)


def test_another_encoding_is_told(tmp_path):
    with pytest.raises(ValueError, match=r": the file must be CSV in UTF-8, got another encoding$"):
        tables.read_table(written(tmp_path, "Höhe\n1\n2\n", "cp1252"))


SPECIAL = "must be a regular one of at most 100 MB, got another kind"


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="pipes and devices are those of Unix")
@pytest.mark.parametrize("name", ["pipe", "zero", "folder"])
def test_what_is_no_regular_file_is_refused_unread(tmp_path, name):
    path = tmp_path / name
    {"pipe": os.mkfifo, "zero": lambda path: path.symlink_to("/dev/zero"), "folder": os.mkdir}[name](path)
    with pytest.raises(ValueError, match=f"^{re.escape(str(path))}: the file {SPECIAL}$"):
        tables.read_table(path)


def test_a_file_beyond_the_limit_is_refused_unread(tmp_path):
    path = tmp_path / "large.csv"
    with path.open("wb") as file:
        file.truncate(200_000_000)
    with pytest.raises(ValueError, match=r"the file must be a regular one of at most 100 MB, got 200 MB$"):
        tables.read_table(path)


def test_chosen_columns_and_the_least_number_of_rows(tmp_path):
    path = written(tmp_path, "name;b;a\nfirst;0,5;2\n")
    names, values = tables.read_table(path, ["a", "b"], rows=1)
    assert names == ["a", "b"]
    assert values.tolist() == [[2.0, 0.5]]
    with pytest.raises(ValueError, match=r"rows of numbers must be 2 or more, got 1$"):
        tables.read_table(path, ["a", "b"])


def test_texts_are_utf_8(tmp_path):
    tables.write_text(tmp_path / "verdict.md", "µs, ACC [m/s²]\n")
    assert (tmp_path / "verdict.md").read_bytes().decode("utf-8").rstrip() == "µs, ACC [m/s²]"
    tables.write_json(tmp_path / "plan.json", {"seeds": [1, 2]})
    assert json.loads((tmp_path / "plan.json").read_text(encoding="utf-8")) == {"seeds": [1, 2]}


@pytest.mark.parametrize(
    ("text", "name"),
    [
        ("zdt1_n20", "zdt1_n20"),
        ("a/b\\c: d?", "a_b_c__d_"),
        ("../..", "_"),
        ("", "_"),
        ("NUL", "_NUL"),
        ("com1.csv", "_com1.csv"),
        ("console", "console"),
        ("Škoda 1.6+", "Škoda_1.6+"),
    ],
)
def test_names_are_made_fit_for_files(text, name):
    assert tables.file_name(text) == name


@given(st.text(max_size=20))
def test_any_text_makes_a_name_that_stays_in_its_folder(text):
    name = tables.file_name(text)
    assert name
    assert not set(name) & set('/\\:*?"<>|\0\n ')
    assert name == tables.file_name(name)
    assert not name.endswith(".")
    assert not name.startswith(".")


def test_a_hostile_name_is_harmless_in_every_table_and_comes_back(tmp_path):
    """A spreadsheet, a Markdown reader and LaTeX get a text; `from_csv` makes the name of it again."""
    name = "=cmd|'/C calc'!A0 <b>_x_</b> $\x1b[31m"
    frame = pd.DataFrame({name: [name, "plain"], "n": [-1.5, 2.0]})
    tables.write_table(tmp_path / "table", frame)
    back = escaping.frame(pd.read_csv(tmp_path / "table.csv"), escaping.from_csv)
    pd.testing.assert_frame_equal(back, frame)
    text, markdown, latex = ((tmp_path / f"table.{ending}").read_text() for ending in ("csv", "md", "tex"))
    assert text.splitlines()[0] == "'" + name.replace("\x1b", r"\x1b") + ",n"
    assert r"=cmd\|'/C calc'!A0 &lt;b&gt;\_x\_&lt;/b&gt; \$\\x1b[31m" in markdown
    assert len({line.replace(r"\|", "").count("|") for line in markdown.splitlines()}) == 1
    assert r"=cmd\textbar{}'/C calc'!A0 \textless{}b\textgreater{}\_x\_" in latex


def test_tables_are_written_as_csv_markdown_and_latex(tmp_path):
    frame = pd.DataFrame({"algorithm": ["a_b"], "time [s]": [0.123456789], "runs": [31], "HV [%]": [np.nan]})
    tables.write_table(tmp_path / "table", frame)
    pd.testing.assert_frame_equal(pd.read_csv(tmp_path / "table.csv"), frame)
    assert "| a_b         |     0.1235 |     31 |          |" in (tmp_path / "table.md").read_text()
    latex = (tmp_path / "table.tex").read_text()
    assert r"\toprule" in latex
    assert r"a\_b & 0.1235 & 31" in latex
    assert r"HV [\%]" in latex


def test_latex_is_that_of_pandas(tmp_path):
    frame = pd.DataFrame({"name": ["a", "b"], "runs": ["1", "20"]})
    tables.write_table(tmp_path / "table", frame)
    expected = frame.style.hide(axis="index").to_latex(hrules=True, column_format="ll")
    assert (tmp_path / "table.tex").read_text() == expected


def test_a_table_wider_than_a_page_stands_in_blocks_with_its_keys(tmp_path):
    frame = pd.DataFrame(
        {"algorithm": ["a", "b"]} | {f"a long header {n} [m/s^2]": [1.0 + n, 2.5] for n in range(7)}
    )
    tables.write_table(tmp_path / "table", frame)
    markdown, latex = ((tmp_path / f"table.{ending}").read_text() for ending in ("md", "tex"))
    assert max(map(len, markdown.splitlines())) <= 100
    for text, title in ((markdown, "| algorithm"), (latex, "algorithm &")):
        assert text.count(title) == 3
        assert all(f"a long header {n} [m/s" in text for n in range(7))
    assert latex.count(r"\bottomrule") == 3
    assert "| a           |                       1.0 |" in markdown


@given(
    st.lists(st.tuples(st.floats(), st.integers(-(2**62), 2**62), st.sampled_from(["", "a,b", "=1", 'say "x"']))),
    st.sampled_from([["x"], ["x", "n"], ["x", "text"], ["n", "x", "x"]]),
)
def test_a_table_is_the_text_that_pandas_writes(rows, columns):
    """In parts of two rows; of real numbers alone, and beside whole numbers and texts."""
    frame = pd.DataFrame(rows, columns=["x", "n", "text"]).astype({"x": float})[columns]
    frame = frame.rename(columns={"x": 'x, "half" [m]'})
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(tables, "ROWS", 2)
        found = "".join(tables.csv_parts(frame))
    assert found == escaping.frame(frame, escaping.csv).to_csv(index=False, lineterminator="\n")


def test_texts_of_a_column_are_read_as_they_were_written(tmp_path):
    names = ["=1+1", "knee, \x1b", "µ"]
    tables.write_csv(tmp_path / "t.csv", pd.DataFrame({"design": names, "x": [1.0, 2.0, 3.0]}))
    assert tables.read_texts(tmp_path / "t.csv", "design") == names
    assert tables.read_texts(tmp_path / "t.csv", "name") == []
