"""What is printed: the report in each of its forms, after the command, in any encoding and to a closed pipe."""

import io
import json
import os
import subprocess
import sys

import numpy as np
import pandas as pd
import pytest
from rich.console import Console

from suspension_ctrl.commands import terminal
from suspension_ctrl.commands.report import Form

TABLE = pd.DataFrame(
    {"design": ["first", "second"], "a long column [N/m]": [1.5, np.nan], "another column [m/s²]": [2.25, 3e6]}
)


@pytest.fixture
def printed(monkeypatch):
    """A console of some width and encoding in place of the terminal's, and an empty report."""

    def make(width: int, encoding: str = "utf-8", form: Form = Form.TEXT, **settings) -> io.BytesIO:
        raw = io.BytesIO()
        console = terminal.Output(
            file=io.TextIOWrapper(raw, encoding=encoding, write_through=True), width=width, **settings
        )
        monkeypatch.setattr(terminal, "console", console)
        monkeypatch.setattr(terminal, "report", terminal.report)  # put back in the end
        terminal.begin(form)
        return raw

    return make


def reported(folder) -> None:
    terminal.note("A note.")
    terminal.show("Title", TABLE)
    terminal.end(folder)


def test_nothing_is_printed_before_it_is_said(printed, tmp_path):
    raw = printed(80)
    reported(tmp_path)
    assert raw.getvalue() == b""
    terminal.say()
    first = raw.getvalue().decode()
    assert first.startswith("A note.\n\nTitle\n")
    assert str(tmp_path) not in first
    terminal.note("Another.")
    terminal.say(ended=True)
    assert raw.getvalue().decode() == f"{first}\nAnother.\n{tmp_path}\n"


def test_a_quiet_command_prints_its_folder_alone(printed, tmp_path):
    raw = printed(80, form=Form.QUIET)
    reported(tmp_path)
    terminal.say()
    terminal.say(ended=True)
    assert raw.getvalue().decode() == f"{tmp_path}\n"


def test_json_is_one_document_at_the_end(printed, tmp_path):
    raw = printed(40, form=Form.JSON)
    reported(tmp_path)
    terminal.say()
    assert raw.getvalue() == b""
    terminal.say(ended=True)
    content = json.loads(raw.getvalue())
    assert content["folder"] == str(tmp_path)
    assert content["paragraphs"] == ["A note."]
    assert content["tables"] == [{
        "title": "Title",
        "units": {"a long column": "N/m", "another column": "m/s^2"},
        "records": [
            {"design": "first", "a long column": 1.5, "another column": 2.25},
            {"design": "second", "a long column": None, "another column": 3e6},
        ],
    }]  # fmt: skip


def test_a_closed_pipe_ends_the_printing_alone(tmp_path):
    """The command carries on, and ends with status 0 without a word on standard error."""
    program = (
        "import sys, pathlib\nfrom suspension_ctrl.commands import terminal\n"
        "def main():\n"
        "    for n in range(3000): terminal.note(f'line {n}')\n"
        "    terminal.say()\n"
        "    pathlib.Path('end').touch()\n"
        "    terminal.end(pathlib.Path('end'))\n"
        "terminal.run_script(main)"
    )
    command = [sys.executable, "-c", program]
    with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, cwd=tmp_path) as process:
        assert process.stdout.readline().rstrip() == b"line 0"
        process.stdout.close()
        assert process.stderr.read() == b""
        assert process.wait() == 0
    assert (tmp_path / "end").exists()


@pytest.mark.skipif(not os.path.exists("/dev/full"), reason="a device of Linux")
def test_a_full_disk_is_an_error_in_one_line(tmp_path):
    program = "from suspension_ctrl.commands import terminal; terminal.run_script(lambda: terminal.note('a'))"
    with open("/dev/full", "w") as full:
        done = subprocess.run([sys.executable, "-c", program], stdout=full, stderr=subprocess.PIPE, text=True)
    assert (done.returncode, done.stderr.count("\n")) == (1, 1)
    assert done.stderr.startswith("error: ")


@pytest.mark.parametrize("legacy", [False, True])
def test_a_legacy_console_in_cp1252_is_printed_to(printed, legacy):
    raw = printed(80, "cp1252", legacy_windows=legacy)
    terminal.show("µs", TABLE)
    terminal.note("[N/m] of a road :car:")
    terminal.say()
    text = raw.getvalue().decode("cp1252")
    assert "[m/s^2]" in text
    assert "[N/m] of a road :car:" in text


def test_hostile_names_are_printed_as_text(printed, capsys):
    """Escape sequences and marks of writing direction by their escapes, markup of rich as it is."""
    name = "\x1b[31m[bold]x[/bold]\u202e\n"
    raw = printed(130)
    terminal.note(name)
    terminal.show(name, pd.DataFrame({name: [name], "n": [1.5]}))
    terminal.say()
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
