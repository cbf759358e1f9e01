"""Histories from CSV files: units, names, times, and what is refused."""

import numpy as np
import pytest

from suspension_ctrl.response.history_files import read_accelerations

TIME = 0.005 * np.arange(400)
SIGNAL = np.sin(7 * TIME)


def file(tmp_path, header: str, *columns, separator: str = ",", decimal: str = "."):
    rows = [
        separator.join(x if isinstance(x, str) else f"{x:.9g}" for x in row) for row in zip(*columns, strict=True)
    ]
    path = tmp_path / "history.csv"
    path.write_text("\n".join([header, *(row.replace(".", decimal) for row in rows)]) + "\n", encoding="utf-8")
    return path


@pytest.mark.parametrize(
    ("header", "factor", "axis"),
    [
        ("time [s],z [m/s^2]", 1.0, "seat z"),
        ("Time [s],Z [g]", 9.80665, "seat z"),
        ("t (s),seat_z (m/s²)", 1.0, "seat z"),
        ("time [s],back x [mm/s^2]", 1e-3, "back x"),
        ("time [s],hand y [m/s2]", 1.0, "hand y"),
        ("time [s],roll [deg/s^2]", np.pi / 180, "seat roll"),
        ("time [s],FEET Z [m/s**2]", 1.0, "feet z"),
    ],
)
def test_columns_have_their_units_and_names_in_any_case(tmp_path, header, factor, axis):
    histories, step = read_accelerations(file(tmp_path, header, TIME, SIGNAL))
    assert step == pytest.approx(0.005, rel=1e-9)
    assert list(histories) == [axis]
    np.testing.assert_allclose(histories[axis], factor * SIGNAL, rtol=1e-8, atol=1e-9)


def test_other_columns_do_not_count_and_may_hold_texts(tmp_path):
    path = file(tmp_path, "note,time [ms],x [g],z [g],speed", ["ok"] * 400, 1e3 * TIME, SIGNAL, 2 * SIGNAL, TIME)
    histories, step = read_accelerations(path)
    assert step == pytest.approx(0.005, rel=1e-9)
    np.testing.assert_allclose(histories["seat z"], 2 * histories["seat x"], rtol=1e-8)


def test_columns_of_a_simulation_are_named_by_axes(tmp_path):
    path = file(tmp_path, "time [s],distance [m],body_acceleration [m/s^2]", TIME, TIME, SIGNAL)
    for name in ("body_acceleration", "Body acceleration"):
        histories, _ = read_accelerations(path, {name: "z"})
        np.testing.assert_allclose(histories["seat z"], SIGNAL, rtol=1e-8, atol=1e-9)


def test_a_step_stands_in_place_of_times(tmp_path):
    histories, step = read_accelerations(
        file(tmp_path, "x [g];z [g]", SIGNAL, SIGNAL, separator=";", decimal=","), {}, 0.01
    )
    assert (list(histories), step) == (["seat x", "seat z"], 0.01)


def test_names_of_all_columns_stand_in_place_of_a_header(tmp_path):
    path = file(tmp_path, "0,0,0", TIME[1:], SIGNAL[1:], TIME[1:])
    with pytest.raises(
        ValueError, match=r"history.csv: columns must have names, in a header or given .*, got none$"
    ):
        read_accelerations(path)
    histories, step = read_accelerations(path, columns=["time [s]", "z [g]", "speed"])
    assert step == pytest.approx(0.005, rel=1e-9)
    np.testing.assert_allclose(histories["seat z"], 9.80665 * SIGNAL, rtol=1e-8, atol=1e-9)
    with pytest.raises(ValueError, match=r"history.csv: columns must be names of 3 columns, got \['z \[g\]'\]$"):
        read_accelerations(path, columns=["z [g]"])


def test_times_may_be_rounded_but_no_sample_may_lack(tmp_path):
    time = np.arange(400) / 512
    _, step = read_accelerations(file(tmp_path, "time [s],z [g]", time.round(3), SIGNAL))
    assert step == pytest.approx(1 / 512, rel=1e-3)
    for gap in (1, 200, 398):
        gone = np.delete(time, gap)
        with pytest.raises(ValueError, match=r"time must be even, each within 0.4 of a step of 0.00195[78]"):
            read_accelerations(file(tmp_path, "time [s],z [g]", gone, SIGNAL[1:]))


@pytest.mark.parametrize(
    ("header", "arguments", "message"),
    [
        ("time [s],z", {}, "columns must have their units, as in 'z \\[m/s\\^2\\]', got 'z'"),
        ("time,z [g]", {}, "columns must have their units, as in 'time \\[s\\]', got 'time'"),
        ("time [s],z [m]", {}, "unit of 'z \\[m\\]' must be in m/s\\^2 or a unit like it, got '1 m' in m"),
        ("time [s],z [furlong]", {}, "unit of .* must be in units of kg, .*, got 'furlong'"),
        ("time [kg],z [g]", {}, "unit of 'time \\[kg\\]' must be in s or a unit like it"),
        ("time [s],pitch [g]", {}, "unit of 'pitch \\[g\\]' must be in rad/s\\^2 or a unit like it"),
        (
            "time [s],head [g]",
            {},
            "columns must include an axis such as 'z \\[m/s\\^2\\]' or .*, got \\['time \\[s\\]'",
        ),
        ("z [g],seat z [g]", {"time_step": 0.01}, "columns must have each axis once, got seat z twice"),
        ("z [g],z [g]", {"time_step": 0.01}, "columns must have each axis once, got seat z twice"),
        (
            "x [g],z [g]",
            {},
            "columns must include a time such as 'time \\[s\\]', or time_step must be given, got none",
        ),
        (
            "time [s],z [g]",
            {"time_step": 0.01},
            "time must be one column, or time_step without one, got 'time \\[s\\]'",
        ),
        (
            "time [s],z [g]",
            {"axes": {"a": "z"}},
            "columns must include 'a', got \\['time \\[s\\]', 'z \\[g\\]'\\]",
        ),
        ("time [s],a [g]", {"axes": {"a": "up"}}, "axis must be one of seat x, .*, got 'up'"),
        ("time [s],t [s]", {"axes": {"time": "x"}}, "unit of 'time \\[s\\]' must be in m/s\\^2 or a unit like it"),
        ("time [s],t [s],z [g]", {}, "row 1 must have 3 cells as in .*, got 2"),
    ],
)
def test_other_headers_are_refused_in_one_line(tmp_path, header, arguments, message):
    with pytest.raises(ValueError, match=rf"(^|: ){message}[^\n]*$"):
        read_accelerations(file(tmp_path, header, TIME, SIGNAL), **arguments)


@pytest.mark.parametrize("time", [TIME[::-1], np.zeros(400), np.minimum(TIME, 1.0)])
def test_times_that_do_not_ascend_are_refused(tmp_path, time):
    with pytest.raises(ValueError, match=r"history.csv: time must ascend, got [\d.]+ s after [\d.]+ s$"):
        read_accelerations(file(tmp_path, "time [s],z [g]", time, SIGNAL))


def test_a_device_without_end_is_refused_at_once():
    with pytest.raises(ValueError, match=r"^/dev/zero: the file must be a regular one of at most 100 MB"):
        read_accelerations("/dev/zero")
