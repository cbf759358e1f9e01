"""What is printed: tables that fit the width, any encoding, progress and compiling in a terminal alone."""

import io
import re

import numpy as np
import pandas as pd
import pytest
from rich.console import Console

from suspension_ctrl.commands import terminal

TABLE = pd.DataFrame(
    {"design": ["first", "second"], "a long column [N/m]": [1.5, np.nan], "another column [m/s²]": [2.25, 3e6]}
)


@pytest.fixture
def printed(monkeypatch):
    """A console of some width and encoding in place of the terminal's."""

    def make(width: int, encoding: str = "utf-8", **settings) -> tuple[Console, io.BytesIO]:
        raw = io.BytesIO()
        console = Console(
            file=io.TextIOWrapper(raw, encoding=encoding, write_through=True), width=width, **settings
        )
        monkeypatch.setattr(terminal, "console", console)
        return raw

    return make


def test_a_table_that_fits_stands_in_one_block(printed):
    raw = printed(80)
    terminal.show("Title", TABLE, {"a long column [N/m]": 3})
    lines = [line.rstrip() for line in raw.getvalue().decode().splitlines()]
    assert lines[0] == "Title"
    assert lines[1].split("   ") == ["design", "a long column [N/m]", "another column [m/s²]"]
    assert re.fullmatch(r"first +1\.500 +2\.25", lines[3])
    assert re.fullmatch(r"second +3e\+06", lines[4])


@pytest.mark.parametrize("width", [30, 40, 60])
def test_a_wide_table_stands_in_blocks_with_its_keys(printed, width):
    raw = printed(width)
    terminal.show("Title", TABLE)
    lines = raw.getvalue().decode().splitlines()
    assert max(map(len, lines)) <= width
    assert sum("design" in line for line in lines) == 2 if width < 60 else 1
    text = raw.getvalue().decode()
    assert "a long column [N/m]" in text
    assert "another column [m/s²]" in text
    assert "…" not in text


@pytest.mark.parametrize("legacy", [False, True])
def test_a_legacy_console_in_cp1252_is_printed_to(printed, legacy):
    raw = printed(80, "cp1252", legacy_windows=legacy)
    terminal.show("µs", TABLE)
    terminal.note("[N/m] of a road :car:")
    text = raw.getvalue().decode("cp1252")
    assert "[m/s²]" in text
    assert "[N/m] of a road :car:" in text


def test_hostile_names_are_printed_as_text(printed, capsys):
    """Escape sequences and marks of writing direction by their escapes, markup of rich as it is."""
    name = "\x1b[31m[bold]x[/bold]\u202e\n"
    raw = printed(130)
    terminal.note(name)
    terminal.show(name, pd.DataFrame({name: [name], "n": [1.5]}))
    assert raw.getvalue().decode().count(r"\x1b[31m[bold]x[/bold]\u202e\n") == 4
    assert "\x1b" not in raw.getvalue().decode()
    terminal.complain(f"{name} is none")
    assert capsys.readouterr().err == "error: \\x1b[31m[bold]x[/bold]\\u202e is none\n"


def test_a_terminal_gets_the_text_of_a_progress_bar_without_markup(monkeypatch):
    stream = io.StringIO()
    monkeypatch.setattr(terminal, "stderr", Console(file=stream, force_terminal=True, width=80))
    list(terminal.progress("a", 1, "[bold]runs"))
    assert "[bold]runs" in stream.getvalue()


def test_in_a_pipe_nothing_is_said_of_progress(capfd):
    assert list(terminal.progress("abc", 3, "runs")) == ["a", "b", "c"]
    with terminal.waiting("drawing"):
        pass
    assert capfd.readouterr() == ("", "")


def test_a_terminal_shows_the_time_left(monkeypatch):
    stream = io.StringIO()
    monkeypatch.setattr(terminal, "stderr", Console(file=stream, force_terminal=True, width=80))
    assert list(terminal.progress("abc", 3, "runs")) == ["a", "b", "c"]
    assert "runs" in stream.getvalue()
    assert "3/3" in stream.getvalue()
    assert "left" in stream.getvalue()


def test_compiling_is_said_once_and_only_where_something_is_compiled(monkeypatch):
    from numba import njit

    stream = io.StringIO()
    monkeypatch.setattr(terminal, "stderr", Console(file=stream, force_terminal=True, width=80))
    twice = njit(lambda x: 2 * x)
    with terminal.compiling():
        assert stream.getvalue() == ""
        twice(1)
        twice(1.0)
    assert stream.getvalue().count("compiling") == 1
    with terminal.compiling():
        twice(2)
    assert stream.getvalue().count("compiling") == 1
