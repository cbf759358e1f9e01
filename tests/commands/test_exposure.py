"""Exposure of a history from the command line."""

import numpy as np
import pandas as pd
import pytest

from suspension_ctrl import exposure

STEP = 0.005


@pytest.fixture
def history(tmp_path):
    """A file of noise with gravity in z, written by pandas, and its histories [m/s^2]."""
    x, z = np.random.default_rng(2).normal(size=(2, 4000))
    table = pd.DataFrame({"time [s]": STEP * np.arange(4000), "x [m/s^2]": x, "z [g]": 1 + z / 9.80665})
    table.to_csv(tmp_path / "seat.csv", index=False)
    return x, z


def test_it_prints_and_writes_the_tables(called, tmp_path, history):
    done = called("exposure", "seat.csv", "--duration", "4h", "--out", "out")
    assert done.returncode == 0, done.stderr
    assert done.stdout.splitlines()[0] == "seat.csv: 20 s in steps of 5 ms."
    assert done.stdout.splitlines()[-1] == "out"
    assert "Daily exposure, 4 h a day, and values of 2002/44/EC" in done.stdout
    tables = {path.stem: pd.read_csv(path) for path in (tmp_path / "out").iterdir()}
    assert set(tables) == {"exposure", "total_values", "daily"}
    found = tables["exposure"].set_index("axis")
    for name, values, filter_ in (("seat x", history[0], "Wd"), ("seat z", history[1], "Wk")):
        expected = exposure(values, STEP, filter_)
        assert found["a_w [m/s^2]"][name] == pytest.approx(expected.rms, rel=1e-9)
        assert found["VDV [m/s^1.75]"][name] == pytest.approx(expected.vdv, rel=1e-9)
    assert found["offset [m/s^2]"]["seat z"] == pytest.approx(9.80665 + history[1].mean(), rel=1e-9)
    total = np.hypot(*found["a_w [m/s^2]"])
    assert tables["total_values"].to_numpy().tolist() == [["seat", pytest.approx(total, rel=1e-9)]]
    a8 = tables["daily"].set_index(["axis", "measure"])["value"]["seat z", "A(8)"]
    assert a8 == pytest.approx(found["a_w [m/s^2]"]["seat z"] * np.sqrt(0.5), rel=1e-9)


def test_columns_of_a_file_without_header_are_named(called, tmp_path, history):
    text = (tmp_path / "seat.csv").read_text(encoding="utf-8").partition("\n")[2]
    (tmp_path / "bare.csv").write_text(text, encoding="utf-8")
    done = called("exposure", "bare.csv", "--columns", "time [s], x [m/s^2], z [g]", "--out", "bare")
    assert done.returncode == 0, done.stderr
    assert called("exposure", "seat.csv", "--out", "out").returncode == 0
    for name in ("exposure", "daily"):
        pd.testing.assert_frame_equal(*(pd.read_csv(tmp_path / one / f"{name}.csv") for one in ("bare", "out")))


@pytest.mark.usefixtures("history")
@pytest.mark.parametrize("width", [40, 80])
def test_tables_fit_a_terminal(called, monkeypatch, width):
    from suspension_ctrl.commands import terminal

    monkeypatch.setattr(terminal.console, "width", width)
    done = called("exposure", "seat.csv", "--settling", "2s")
    assert done.returncode == 0, done.stderr
    widest = max(map(len, done.stdout.splitlines()))
    assert widest <= max(width, 60)
    assert "18 s in steps" in done.stdout


BAD = [
    (["no.csv"], "No such file or directory: 'no.csv'", 1),
    ([], "Missing argument 'FILE'", 2),
    (["."], ".: the file must be a regular one of at most 100 MB, got another kind", 2),
    (["bad.csv"], "bad.csv: columns must include an axis such as 'z [m/s^2]' or 'seat x [g]', or one must be", 2),
    (
        ["seat.csv", "--step", "5ms"],
        "seat.csv: time must be one column, or time_step without one, got 'time [s]'",
        2,
    ),
    (["seat.csv", "--axes", "z"], "axes must be like body_acceleration=z,roll_acceleration=seat roll, got 'z'", 2),
    (["seat.csv", "--axes", "z=up"], "axis must be one of seat x, ", 2),
    (
        ["seat.csv", "--axes", "q=z"],
        "seat.csv: columns must include 'q', got ['time [s]', 'x [m/s^2]', 'z [g]']",
        2,
    ),
    (["seat.csv", "--columns", "z [g]"], "seat.csv: columns must be names of 3 columns, got ['z [g]']", 2),
    (["seat.csv", "--duration", "0"], "duration must be finite and > 0 s, got 0.0", 2),
    (["seat.csv", "--duration", "long"], "must be a number with a unit like s, got 'long'", 2),
    (["seat.csv", "--settling", "1h"], "seat x: acceleration must last 1 s at least and not be constant", 2),
    (["seat.csv", "--settling", "-1"], "seat x: settling must be finite and >= 0 s, got -1.0", 2),
    (["slow.csv", "--step", "20ms"], "seat z: time_step must be at most 0.01 s for Wk, got 0.02", 2),
    (["seat.csv", "--out", "."], "out must be a folder that is absent or empty, got '.', which is not empty", 2),
]


@pytest.mark.usefixtures("history")
@pytest.mark.parametrize(("arguments", "message", "status"), BAD)
def test_bad_input_is_one_line(refused, tmp_path, arguments, message, status):
    (tmp_path / "bad.csv").write_text("a,b\n1,2\n", encoding="utf-8")
    (tmp_path / "slow.csv").write_text("z [g]\n" + "1.0\n1.1\n" * 100, encoding="utf-8")
    refused("exposure", arguments, message, status)
