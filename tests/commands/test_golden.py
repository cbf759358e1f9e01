"""Terminal output of every command at 80 columns in a pipe, as files; numbers that depend on times are masked.

``GOLDEN=renew python -m pytest tests/commands/test_golden.py`` writes the files anew: look at what changed.
"""

import json
import os
import re
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

import suspension_ctrl as sc
from suspension_ctrl.commands import terminal

GOLDEN = Path(__file__).parent / "golden"
TINY = ("--populations", 20, "--iterations", 2, "--repeats", 1)
COMMANDS = {
    "bode_of_a_full_car": ("bode", "--vehicle", "volvo_xc90_full", "--road", "C", "--points", 20),
    "bode_of_many_designs": ("bode", "--designs", "designs.csv", "--points", 20),
    "compare": ("compare", "--vehicle", "minaker_half", "--road", "C", *TINY),
    "exposure": ("exposure", "seat.csv", "--duration", "4h"),
    "new": ("new", "quarter-car"),
    "optimum": ("optimum", "--vehicle", "minaker_half", "--road", "B", "--sws-limit", 0.006,
                "--population", 40, "--iterations", 2),
    "optimum_of_a_full_car": ("optimum", "--vehicle", "bmw_320i_full", "--road", "C", "--population", 20,
                              "--iterations", 1),
    "optimum_of_the_paper": ("optimum", "--band", "0.1,20", "--population", 40, "--iterations", 2),
    "report": ("report", "--study", "half_car", "--population", 40, "--iterations", 2),
    "ride": ("ride", "--vehicle", "volvo_xc90_full", "--road", "C", "--band", "0.5,20"),
    "ride_driven_in_time": ("ride", "--road", "C", "--certify", "400m"),
    "ride_of_the_paper": ("ride",),
    "road": ("road", "survey.csv", "--segments", "20,100"),
    "weighting": ("weighting",),
}  # fmt: skip
NUMBER = re.compile(r"-?\d+\.?\d*(?:e[+-]\d+)?")


@pytest.fixture(scope="module")
def files(tmp_path_factory) -> Path:
    """Files that the commands read."""
    path = tmp_path_factory.mktemp("golden")
    sc.save_profile(path / "survey.csv", sc.Iso8608Road("B").profile(200.0, 0.1, 1))
    wave = np.sin(np.arange(2000) / 7)
    rows = [f"{0.005 * n:.3f},{0.2 * x:.4f},{1 + 0.1 * x:.4f}" for n, x in enumerate(wave)]
    (path / "seat.csv").write_text("time [s],x [m/s^2],z [g]\n" + "\n".join(rows), encoding="utf-8")
    designs = [f"soft {n},{8000 + 2000 * n},{1000 + 150 * n}" for n in range(10)]
    (path / "designs.csv").write_text("design,spring [N/m],damper [N s/m]\n" + "\n".join(designs))
    return path


@pytest.fixture
def printed(called, files, tmp_path):
    """Run a command in a folder with the files; return its output without what depends on times."""

    def run(name: str, *arguments: object, folder: str = "out") -> str:
        for file in files.iterdir():
            (tmp_path / file.name).write_bytes(file.read_bytes())
        done = called(name, *arguments, "--out", folder)
        assert done.returncode == 0, done.stderr
        return masked(done.stdout)

    return run


def masked(text: str) -> str:
    """Return the output with ``#`` for the numbers in columns of times."""
    lines, spans = [], []
    for line in text.splitlines():
        found = [match.span() for match in re.finditer(r"time \[s\]|(?:u|µ)s/eval|ratio \[%\]|here \[.\]", line)]
        if found or not line:
            spans = found
            lines.append(line)
            continue
        for start, end in reversed(spans):
            line = (
                line[:start] + re.sub(r"[\d.]+", lambda one: "#".rjust(len(one[0])), line[start:end]) + line[end:]
            )
        lines.append(line)
    return "\n".join(lines) + "\n"


CHANGE = re.compile(r"^ *\d+  .*(?:[+-]\d+\.\d\d %|none) *$", re.MULTILINE)
"""A row of what changes measures most: of two wheels that are the worst at an optimum rounding decides."""


def without_numbers(text: str) -> str:
    return NUMBER.sub("#", re.sub(r"-{3,}", "---", re.sub(r" +", " ", text)))


@pytest.mark.parametrize("name", COMMANDS)
def test_the_output_is_that_of_the_file(printed, name):
    """Its words to the letter, its numbers within a unit of the last digit: another processor rounds otherwise."""
    found, path = printed(*COMMANDS[name]), GOLDEN / f"{name}.txt"
    if os.environ.get("GOLDEN") == "renew":
        path.write_text(found, encoding="utf-8")
    assert found.isascii()
    assert max(map(len, found.splitlines())) <= terminal.PIPE
    found, wanted = (CHANGE.sub("", text) for text in (found, path.read_text(encoding="utf-8")))
    assert without_numbers(found) == without_numbers(wanted)
    numbers = [[float(number) for number in NUMBER.findall(text)] for text in (found, wanted)]
    np.testing.assert_allclose(*numbers, rtol=2e-3, atol=1e-9)  # residuals of exact optima are rounding


def test_every_command_has_a_file():
    from suspension_ctrl.commands.app import app

    names = {command.callback.__name__ for command in app.registered_commands}
    assert names == {arguments[0] for arguments in COMMANDS.values()}
    assert {path.stem for path in GOLDEN.iterdir()} == set(COMMANDS)


@pytest.mark.parametrize("name", ["exposure", "ride_of_the_paper"])
def test_no_number_and_no_name_is_cut_at_any_width(printed, monkeypatch, name):
    """A terminal of 40 columns prints every number that one of 200 columns prints."""
    words = {}
    for width in (40, 200):
        monkeypatch.setattr(terminal.console, "width", width)
        words[width] = set(NUMBER.findall(printed(*COMMANDS[name], folder="narrow" if width == 40 else "wide")))
    assert words[200] <= words[40]


def test_json_holds_what_is_printed_and_quiet_the_folder(called):
    done = called("ride", "--json", "--out", "out")
    assert done.returncode == 0, done.stderr
    content = json.loads(done.stdout)
    assert content["folder"] == "out"
    assert [table["title"].split(":")[0] for table in content["tables"]] == [
        "Ride",
        "Modes",
        "Springs",
        "Static loads",
    ]
    (sws,) = [row for row in content["tables"][0]["records"] if row["name"] == "SWS"]
    assert sws == {"name": "SWS", "value": pytest.approx(0.0287, abs=5e-5), "unit": "m", "note": ""}
    done = called("ride", "--quiet", "--out", "quiet")
    assert (done.returncode, done.stdout, done.stderr) == (0, "quiet\n", "")
    both = called("ride", "--quiet", "--json")
    assert (both.returncode, both.stdout, both.stderr) == (
        2,
        "",
        "error: quiet must stand without json, got both\n",
    )


def test_a_closed_pipe_leaves_all_files(checkout, tmp_path):
    """As ``scripts/ride.py | head -1`` closes it."""
    name, *arguments = map(str, COMMANDS["ride"])
    command = [sys.executable, str(checkout / "scripts" / f"{name}.py"), *arguments, "--out", "out"]
    with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, cwd=tmp_path) as process:
        assert process.stdout.readline()
        process.stdout.close()
        errors = process.stderr.read()
        assert process.wait() == 0, errors
    assert b"Traceback" not in errors
    assert any((tmp_path / "out").glob("*.csv"))
