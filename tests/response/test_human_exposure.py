"""Exposure of several axes beside closed forms of sines, worked examples of ISO 5349, and another library."""

import numpy as np
import pytest

from suspension_ctrl import exposure, exposure_by_axis, weighting
from suspension_ctrl.response.axes import AXES
from suspension_ctrl.response.human_exposure import ExposureByAxis

STEP, HOUR = 0.002, 3600.0
TIME = STEP * np.arange(30_000)


def sine(amplitude: float, f: float = 8.0) -> np.ndarray:
    return amplitude * np.sin(2 * np.pi * f * TIME)


def factor(name: str, f: float = 8.0) -> float:
    """Factor of a digital filter: that of the analogue one at the moved frequency."""
    return abs(weighting(AXES[name].weighting)(2j * np.tan(np.pi * f * STEP) / STEP))


@pytest.fixture(scope="module")
def person() -> ExposureByAxis:
    """A sine of its own amplitude in each axis of seat, backrest and feet, without the start of the filters."""
    names = [name for name in AXES if name.split()[0] in ("seat", "back", "feet")]
    return exposure_by_axis({name: sine(i + 1) for i, name in enumerate(names)}, STEP, settling=10.0)


def test_total_values_are_root_sums_of_squares(person):
    """Sines of 8 Hz weighted, times k; overall over all three points (8.2.3)."""
    squares = dict.fromkeys(("seat", "back", "feet"), 0.0)
    for i, name in enumerate(person.axes):
        squares[name.split()[0]] += (AXES[name].factor * factor(name) * (i + 1)) ** 2 / 2
    for point, square in squares.items():
        assert person.total_values[point] == pytest.approx(np.sqrt(square), rel=1e-6)
    assert person.total_values["overall"] == pytest.approx(np.sqrt(sum(squares.values())), rel=1e-6)


def test_a_hand_stands_beside_the_points_of_the_body():
    """It has no part in the overall value, and one point of the body has none."""
    step, one = 0.0005, np.sin(2 * np.pi * 8.0 * 0.0005 * np.arange(4000))  # as fine as Wh needs
    assert set(exposure_by_axis({"z": one, "hand x": 9 * one}, step).total_values) == {"seat", "hand"}
    found = exposure_by_axis({"z": one, "hand x": 9 * one, "feet z": 2 * one}, step).total_values
    assert found["overall"] == pytest.approx(np.hypot(found["seat"], found["feet"]), rel=1e-12)


def test_daily_exposure_is_that_of_each_axis(person):
    """A(8) over eight hours is k a_w; VDV of a sine is a (3 T/8)^(1/4); We, backrest and feet have none."""
    daily = person.daily().set_index("measure", append=True)
    assert set(daily.index) == {(f"seat {axis}", measure) for axis in "xyz" for measure in ("A(8)", "VDV")}
    for i, (name, k) in enumerate({"seat x": 1.4, "seat y": 1.4, "seat z": 1.0}.items()):
        amplitude = k * (i + 1) * factor(name)
        a8, vdv = daily.loc[(name, "A(8)")], daily.loc[(name, "VDV")]
        assert a8["value"] == pytest.approx(amplitude / np.sqrt(2), rel=1e-6)
        assert vdv["value"] == pytest.approx(amplitude * (3 * 8 * HOUR / 8) ** 0.25, rel=1e-6)
        assert (a8["k"], a8["action"], a8["limit"], a8["unit"]) == (k, 0.5, 1.15, "m/s^2")
        assert (vdv["action"], vdv["limit"], vdv["unit"]) == (9.1, 21.0, "m/s^1.75")


@pytest.mark.parametrize(("axis", "amplitude"), [("x", 6.0), ("z", 1.2)])
def test_after_the_printed_hours_the_exposure_has_its_values(axis, amplitude):
    """Exposed so long, A(8) and VDV are the action value, the limit value; nothing stands beyond a day."""
    one = exposure_by_axis({axis: sine(amplitude)}, STEP)
    assert one.daily()["action after [h]"].notna().all()
    for measure, row in one.daily().set_index("measure").iterrows():
        for name in ("action", "limit"):
            hours = row[f"{name} after [h]"]
            if hours == hours:
                longer = exposure_by_axis({axis: sine(amplitude)}, STEP, duration=hours * HOUR)
                again = longer.daily().set_index("measure")
                assert again["value"][measure] == pytest.approx(row[name], rel=1e-9)
    weak = exposure_by_axis({"z": sine(0.3)}, STEP).daily()
    assert weak[["action after [h]", "limit after [h]"]].isna().all(axis=None)


def test_an_exposure_of_0_4_reaches_the_action_value_after_12_5_hours():
    """8 h (0.5/0.4)^2; the limit of 1.15 m/s^2 not within a day."""
    unit = exposure_by_axis({"z": sine(1.0)}, STEP).total_values["seat"]
    row = exposure_by_axis({"z": sine(0.4 / unit)}, STEP).daily().set_index("measure").loc["A(8)"]
    assert row["action after [h]"] == pytest.approx(12.5, rel=1e-9)
    assert np.isnan(row["limit after [h]"])


@pytest.mark.parametrize(("total", "seconds", "a8"), [(7.4, 2.5 * HOUR, 4.1), (14.6, 4000.0, 5.4)])
def test_hands_of_the_worked_examples_of_iso_5349_2(total, seconds, a8):
    """Annex E, examples E.2.1 and E.2.4, as printed in github.com/jmrplens/phonometry, tests of exposure."""
    share = total / np.sqrt(3) * np.sqrt(2)  # three equal sines behind the filter, at 16 Hz and 0.5 ms
    time, f = 0.0005 * np.arange(40_000), 16.0
    gain = abs(weighting("Wh")(2j * np.tan(np.pi * f * 0.0005) / 0.0005))
    history = share / gain * np.sin(2 * np.pi * f * time)
    found = exposure_by_axis(
        dict.fromkeys(("hand x", "hand y", "hand z"), history), 0.0005, duration=seconds, settling=5.0
    )
    assert found.total_values["hand"] == pytest.approx(total, rel=1e-6)
    assert "overall" not in found.total_values
    row = found.daily().loc["hand"]
    assert round(row["value"], 1) == a8
    assert (row["action"], row["limit"]) == (2.5, 5.0)


def test_the_worst_axis_of_another_library_s_example():
    """github.com/jmrplens/phonometry, tests of exposure: a_w of 0.35, 0.28 and 0.62 m/s^2 make 0.62, not 0.882."""
    amplitudes = {"x": 0.35, "y": 0.28, "z": 0.62}
    histories = {axis: np.sqrt(2) * sine(a) / factor(f"seat {axis}") for axis, a in amplitudes.items()}
    daily = exposure_by_axis(histories, STEP, settling=10.0).daily()
    a8 = daily[daily["measure"] == "A(8)"]["value"]
    assert a8.round(6).to_list() == [0.49, 0.392, 0.62]
    assert a8.pow(2).sum() ** 0.5 == pytest.approx(0.882, abs=5e-4)


def test_the_table_has_the_measures_of_each_axis():
    histories = {"Seat_Z": 9.81 + sine(1.0), "roll": sine(0.2)}
    found = exposure_by_axis(histories, STEP)
    table, one = found.to_frame(), exposure(9.81 + sine(1.0), STEP, "Wk")
    assert list(table.index) == ["seat z", "seat roll"]
    assert table.loc["seat z"].to_list() == [
        "Wk", 1.0, one.offset, one.rms, one.peak, one.crest_factor, one.mtvv, one.vdv,
    ]  # fmt: skip
    assert table["offset [m/s^2]"]["seat z"] == pytest.approx(9.81, abs=1e-3)
    assert repr(found).startswith("<ExposureByAxis of seat z, seat roll; total values [m/s^2]: seat 0.7")


@pytest.mark.parametrize(
    ("arguments", "options", "message"),
    [
        (({}, STEP), {}, "accelerations must be a mapping by axis, got \\{\\}"),
        (([1.0], STEP), {}, "accelerations must be a mapping by axis, got \\[1.0\\]"),
        (({"head z": sine(1.0)}, STEP), {}, "axis must be one of hand z, seat z, .*, got 'head z'"),
        (({3: sine(1.0)}, STEP), {}, "axis must be one of seat x, .*, got 3"),
        (
            ({"z": sine(1.0), "seat z": sine(1.0)}, STEP),
            {},
            "accelerations must have each axis once, got seat z twice",
        ),
        (({"z": [1.0]}, STEP), {}, "seat z: acceleration must last 1 s at least and not be constant throughout"),
        (({"z": sine(1.0)}, 0.02), {}, "seat z: time_step must be at most 0.01 s for Wk, got 0.02"),
        (
            ({"z": sine(1.0), "x": sine(1.0)[1:]}, STEP),
            {},
            "accelerations must be of one length, got 60 s of seat z, ",
        ),
        (({"z": sine(1.0)}, STEP), {"duration": 0.0}, "duration must be finite and > 0 s, got 0.0"),
        (({"z": sine(1.0)}, STEP), {"duration": "8h"}, "duration must be finite and > 0 s, got '8h'"),
    ],
)
def test_other_histories_are_refused_in_one_line(arguments, options, message):
    with pytest.raises(ValueError, match=rf"^{message}[^\n]*$"):
        exposure_by_axis(*arguments, **options)
