"""The command line: help without the library, units in it, bad input in one line, streams of any encoding."""

import gc
import importlib.metadata
import os
import re
import subprocess
import sys
import tomllib

import pytest

from suspension_ctrl import commands
from suspension_ctrl.commands import main, options
from suspension_ctrl.study.comparison import ALGORITHMS

COMMANDS = ("compare", "optimum", "report", "new", "bode", "weighting", "ride", "exposure", "road")
MEASURED = "wavenumber [cycle/m],psd [m^3]\n0.02,1e-3\n0.1,1e-4\n1,1e-6\n2,2e-7\n"
HEAVY = ("control", "matplotlib", "numba", "pandas", "scipy", "moocore", "deap", "distributed")


@pytest.mark.parametrize("arguments", [("--help",), *((name, "--help") for name in COMMANDS)])
def test_help_needs_none_of_the_library(arguments, tmp_path):
    program = (
        "import sys; from suspension_ctrl.commands import main\n"
        "try: main()\n"
        "finally: print('loaded:', *(name for name in sys.modules if '.' not in name))"
    )
    done = subprocess.run(
        [sys.executable, "-c", program, *arguments], capture_output=True, text=True, cwd=tmp_path
    )
    assert done.returncode == 0, done.stderr
    loaded = done.stdout.split("loaded:")[1].split()
    assert "typer" in loaded
    assert not set(loaded) & set(HEAVY)


@pytest.mark.parametrize("name", COMMANDS)
def test_help_fits_80_columns_and_has_units_and_an_example(called, monkeypatch, name):
    monkeypatch.setenv("COLUMNS", "80")
    done = called(name, "--help")
    assert done.returncode == 0
    assert max(map(len, done.stdout.splitlines())) <= 80
    assert f"  suspension-ctrl {name}" in done.stdout.split("Examples:")[1]


def test_a_command_seldom_looks_for_garbage(called):
    before = gc.get_threshold()
    try:
        assert called("ride", "--help").returncode == 0
        assert gc.get_threshold() == (commands.NEW_OBJECTS, *before[1:])
    finally:
        gc.set_threshold(*before)


def test_every_unit_of_every_help_text_is_printed(called):
    """Brackets are not taken for markup."""
    aliases = [alias for alias in vars(options).values() if hasattr(alias, "__metadata__")]
    wanted = {unit for alias in aliases for unit in re.findall(r"\[[^]:]+\]", alias.__metadata__[0].help)}
    assert {"[m/s]", "[m]", "[Hz]", "[kg]", "[N/m]", "[N s/m]"} <= wanted
    printed = " ".join(" ".join(called(name, "--help").stdout.split()) for name in COMMANDS)
    assert {unit for unit in wanted if unit not in printed} == set()


def test_help_of_algorithms_names_them_all():
    assert options.ALGORITHMS.split(", ") == list(ALGORITHMS)


def test_without_a_command_it_shows_its_commands(called):
    done = called(None)
    assert done.returncode == 0
    listed = done.stdout.split("Commands:")[1]
    assert tuple(line.split()[0] for line in listed.splitlines() if line) == COMMANDS
    assert "..." not in listed


def test_the_console_command_is_the_app(checkout):
    project = tomllib.loads((checkout / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    point = importlib.metadata.EntryPoint(
        "suspension-ctrl", project["scripts"]["suspension-ctrl"], "console_scripts"
    )
    assert point.load() is main


def test_a_missing_extra_is_named_in_one_line(tmp_path):
    program = "import sys; sys.modules['typer'] = None; from suspension_ctrl.commands import main; main()"
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, cwd=tmp_path)
    assert done.returncode == 1
    assert done.stderr == 'error: typer must be installed, by: pip install "suspension-ctrl[cli]"\n'


@pytest.mark.parametrize(("encoding", "count"), [("cp1252", 4), ("ascii", 1)])
def test_a_pipe_of_any_encoding_is_written(tmp_path, encoding, count):
    """By the first commands; files that the package opens without an encoding are errors."""
    program = (
        "import sys, warnings; from suspension_ctrl.commands import main\n"
        "warnings.filterwarnings('error', category=EncodingWarning, module='suspension_ctrl')\n"
        "for line in sys.argv[1].splitlines():\n"
        "    name, *sys.argv[1:] = line.split()\n"
        "    try: main(name)\n"
        "    except SystemExit as ended: print('status', ended.code or 0)"
    )
    lines = (
        "compare --populations 20 --iterations 1 --repeats 1 --vehicle minaker_half\n"
        "ride --road C\nexposure seat.csv --step 8ms\nweighting"
    )
    lines = "\n".join(lines.splitlines()[:count])
    (tmp_path / "seat.csv").write_text("z [g]\n" + "1.0\n1.1\n" * 100, encoding="utf-8")
    environment = os.environ | {"PYTHONIOENCODING": encoding, "PYTHONWARNDEFAULTENCODING": "1", "PYTHONUTF8": "0"}
    done = subprocess.run(
        [sys.executable, "-c", program, lines], capture_output=True, cwd=tmp_path, env=environment
    )
    assert done.returncode == 0, done.stderr
    printed = done.stdout.decode(encoding)
    assert printed.count("status 0") == count, done.stderr
    assert "s/eval" in printed


BAD = [
    (["--vehicle", "car"], "vehicle must be one of bmw_320i_full, cantero_2022_half, ", 2),
    (["--vehicle", ""], "vehicle must be one of bmw_320i_full, cantero_2022_half, ", 2),
    (["--vehicle", "no.toml"], "No such file or directory: 'no.toml'", 1),
    (
        ["--vehicle", "bad.toml"],
        "bad.toml:1: kind must be one of quarter-car, half-car, full-car, plant, rigid-bodies, got 'sledge'",
        2,
    ),
    (["--road", "c"], "road must be a class of ISO 8608 such as C, C-lower or C-upper, or the path of a ", 2),
    (["--road", ""], "road must be a class of ISO 8608 such as C, C-lower or C-upper, or the path of a ", 2),
    (["--road", "Z"], "road_class must be one of A, B, C, D, E, F, G, H, got 'Z'", 2),
    (["--road", "no.csv"], "No such file or directory: 'no.csv'", 1),
    (["--road", "bad.csv"], "bad.csv: ", 2),
    (
        ["--road", "road.csv", "--band", "0,20"],
        "f must lie from 0.4 to 40 Hz at 20 m/s, as the road is known from ",
        2,
    ),
    (["--speed", "0"], "speed must be finite and > 0 m/s, got 0.0", 2),
    (["--speed", "nan"], "Invalid value for '--speed': must be a number with a unit like m/s, got 'nan'", 2),
    (["--speed", "fast"], "Invalid value for '--speed': must be a number with a unit like m/s, got 'fast'", 2),
    (["--band", "20"], "band must be 2 numbers separated by commas, got '20'", 2),
    (["--band", "20,1"], "band must be finite with 0 <= lower < upper [Hz], got (20.0, 1.0)", 2),
    (["--band", "0.5,inf"], "band must be a number with a unit like Hz, got 'inf'", 2),
    (["--out", "."], "out must be a folder that is absent or empty, got '.', which is not empty", 2),
    (["--out", "/proc/results"], "out must be a folder that can be written, got '/proc/results'", 2),
    (["--fast", "3"], "No such option: --fast", 2),
    (["--road", "steep.toml"], "steep.toml:3: exponent must be a number from 0.01 to 20.0, got 2500000.0", 2),
    (
        ["--road", "outside.toml"],
        "file must be beside this file or below it, unless outside is allowed, got '../no",
        2,
    ),
    (["--road", "outside.toml", "--allow-outside"], "No such file or directory: ", 1),
]
BOUNDS = (["--vehicle", "cantero_2022_half"], "vehicle must be a file with bounds, got 'cantero_2022_half'", 2)
OF = {
    "compare": [
        BOUNDS,
        (["--study", "no.toml"], "No such file or directory: 'no.toml'", 1),
        (["--study", "mine"], "study must be one of damper_curve, full_car, half_car, ", 2),
        (["--weighting", ""], "weighting must be one of Wk, ", 2),
        (["--weighting", "Wz"], "weighting must be one of Wk, ", 2),
        (["--populations", "3"], "population must be a whole number >= 4, got 3", 2),
        (["--populations", "12"], "population must be >= 15 for 3 objectives", 2),
        (["--populations", "500,x"], "populations must be whole numbers separated by commas, got '500,x'", 2),
        (["--iterations", "0"], "iterations must be a whole number >= 1, got 0", 2),
        (["--repeats", "0"], "repeats must be a whole number >= 1, got 0", 2),
        (["--repeats", "two"], "Invalid value for '--repeats': must be a whole number, got 'two'", 2),
        (["--algorithms", "nsga3"], "algorithms must be one of nsga2, ", 2),
        (["--seed", "-1"], "seed must be a whole number >= 0, got -1", 2),
        (["--quick", "--repeats", "3"], "quick must stand without populations, iterations, repeats and seeds", 2),
        (["--quick", "--seeds", "5"], "quick must stand without populations, iterations, repeats and seeds", 2),
        (["--jobs", "2"], "jobs and scheduler must stand with quality, got 2 without it", 2),
        (["--quality", "--jobs", "0"], "jobs must be a whole number >= 1, got 0", 2),
        (["--quality", "--jobs", "2", "--scheduler", "tcp://h:1"], "jobs must stand without scheduler, got 2", 2),
        (["--quality", "--scheduler", "h:1"], "scheduler must be tcp://host:port or tls://host:port, got 'h", 2),
        (["--quality", "--seeds", "0"], "seeds must be a whole number >= 1, got 0", 2),
        (["--quality", "--target", "1.5"], "target must be a number from 0 to 1, got 1.5", 2),
    ],
    "optimum": [
        BOUNDS,
        (["--sws-limit", "0"], "sws_limit must be finite and > 0 m, got 0.0", 2),
        (["--sws-limit", "soft"], "must be a number with a unit like m, got 'soft'", 2),
        (["--population", "3"], "population must be a whole number >= 4, got 3", 2),
        (["--iterations", "0"], "iterations must be a whole number >= 1, got 0", 2),
        (["--seed", "-1"], "seed must be a whole number >= 0, got -1", 2),
        (["--vehicle", "minaker_half", "--sws-limit", "1e-4", "--population", "20", "--iterations", "1"],
         "limits must be possible within the bounds: the nearest design has SWS of ", 2),
    ],
    "bode": [
        BOUNDS,
        (["--design", "22000"], "design must be 2 numbers separated by commas, got '22000'", 2),
        (["--design", "22000,-1"], "damper must be finite and > 0 N s/m, got -1.0", 2),
        (["--designs", "columns.csv"], "columns.csv: columns must include 'spring [N/m]', got ['spring'", 2),
        (["--designs", "text.csv"], "'damper [N s/m]' must be a number up to 1e+09, got 'soft' in row 1", 2),
        (["--designs", "header.csv"], "header.csv: rows of numbers must be 1 or more, got 0", 2),
        (["--designs", "empty.csv"], "empty.csv: the file must begin with the names of its columns", 2),
        (["--designs", "binary.csv"], "binary.csv: the file must be CSV in UTF-8, got another encoding", 2),
        (["--designs", "absent.csv"], "No such file or directory: 'absent.csv'", 1),
        (["--designs", "."], ".: the file must be a regular one of at most 100 MB, got another kind", 2),
        (["--designs", "nan.csv"], "nan.csv: 'damper [N s/m]' must be a number up to 1e+09, got '' in row 1", 2),
        (["--points", "1"], "points must be a whole number >= 2, got 1", 2),
        (["--weighting", "Wz"], "weighting must be one of Wk, ", 2),
        (["--response", "pitch_acceleration"], "response must be one of body_acceleration, ", 2),
        (["--vehicle", "minaker_half", "--design", "1,2"], "design must be 4 numbers separated by commas, got", 2),
        (["--vehicle", "minaker_half", "--designs", "road.csv"], "columns must include 'front.spring [N/m]'", 2),
    ],
    "ride": [
        (["--speed", "1e300 m/s"], "numbers must be of moderate size, got Numerical result out of range", 2),
        (["--band", "0,1e300 Hz"], "numbers must be of moderate size, got overflow encountered in multiply", 2),
        (["--speed", "100"], "must be 0.05 to 99 m/s, or typed with its unit, got 100: 100 km/h?", 2),
        (["--band", "0,1500"], "band must be 0.05 to 1000 Hz, or typed with its unit, got 1500: 1500 1/min?", 2),
        (["--vehicle", "\x1b[31m.toml"], r"No such file or directory: '\x1b[31m.toml'", 1),
        (["--setting", "spring"], "setting must be like front.spring=10kN/m,front.damper=2000, got 'spring'", 2),
        (["--setting", "spring=soft"], "setting spring must be a number with a unit like N/m, got 'soft'", 2),
        (["--setting", "front.spring=1e4"], "setting must be one of spring, damper, tyre_stiffness", 2),
        (["--spring", "-1"], "spring must be finite and > 0 N/m, got -1.0", 2),
        (["--body-mass", "400"], "body_mass, wheel_mass, tyre_stiffness must stand together, got no t", 2),
        (["--vehicle", "minaker_half", "--body-mass", "400"],
         "vehicle must stand without body_mass, wheel_mass, tyre_stiffness, got 'minaker_half' with one", 2),
        (["--spring", "22", "--damper", "1500"], "spring must be in N/m, got 22 as if in N/mm: a lowest ", 2),
        (["--body-mass", "0.4", "--wheel-mass", "45", "--tyre-stiffness", "2e5", "--spring", "2e4",
          "--damper", "2e3"],
         "body_mass must be in kg, got 0.4 as if in t: wheels over body in mass of 112, usual are ", 2),
        (["--body-mass", "400", "--wheel-mass", "45", "--tyre-stiffness", "2e5", "--spring", "2e4"],
         "must have spring, damper, got none for damper", 2),
    ],
}  # fmt: skip
CASES = [(name, *one) for name, of in OF.items() for one in BAD + of]


@pytest.mark.parametrize(("name", "arguments", "message", "status"), CASES)
def test_bad_input_is_one_line(refused, tmp_path, name, arguments, message, status):
    """Status 2; of files that cannot be read, 1."""
    if arguments == ["--out", "/proc/results"] and not sys.platform.startswith("linux"):
        pytest.skip("/proc is Linux's")
    header = "spring [N/m],damper [N s/m]\n"
    texts = {
        "road.csv": MEASURED, "bad.csv": "a,b\n1,2\n", "bad.toml": 'kind = "sledge"',
        "columns.csv": "spring,damper\n1,2\n", "text.csv": f"{header}22000,soft\n", "nan.csv": f"{header}22000,\n",
        "header.csv": header, "empty.csv": "", "outside.toml": 'kind = "measured"\nfile = "../no.csv"',
        "steep.toml": 'kind = "power-law"\nroughness_m3 = 5e-6\nexponent = 2.5e6',
    }  # fmt: skip
    for file, text in texts.items():
        (tmp_path / file).write_text(text, encoding="utf-8")
    (tmp_path / "binary.csv").write_bytes(bytes(range(256)))
    refused(name, arguments, message, status)


def test_every_mistake_of_a_file_is_a_line(called, tmp_path):
    (tmp_path / "bad.toml").write_text('kind = "sledge"\nmeasures = ["ACC"]\nband = "0.5 Hz"')
    done = called("compare", "--study", "bad.toml")
    assert (done.returncode, done.stdout) == (2, "")
    assert done.stderr.splitlines() == [
        "error: bad.toml:1: kind must be a known key, got 'sledge': did you mean kinds?",
        "error: bad.toml:3: band must be an array of two numbers, got '0.5 Hz'",
        "error: bad.toml: cases must be given, got none",
    ]


def test_options_take_units(called):
    """The paper's car at 72 km/h, which is the default 20 m/s, and the same band."""
    plain, typed = (
        called("ride", "--speed", speed, "--band", band, "--setting", setting).stdout.splitlines()[:-1]
        for speed, band, setting in (
            ("20", "0.5,20", "spring=2e4"),
            ("72 km/h", "0.5Hz..", "spring=20kN/m"),
        )
    )
    assert plain == typed
    assert len(plain) > 5


def test_a_script_itself_ends_so(script, tmp_path):
    """As a process of its own."""
    path = tmp_path / "study.toml"
    case = '[[cases]]\nvehicle = "minaker_half"\nroad = "C"\nspeed_m_per_s = 15\n'
    path.write_text(f'measures = ["ACC", "SWS"]\nconstraints = ["SWS"]\n{case}', encoding="utf-8")
    done = script("compare", "--study", path)
    assert done.returncode == 2
    assert done.stdout == ""
    assert done.stderr.count("\n") == 1
    assert "study.toml:2: constraints[1]: constraint must be like" in done.stderr
