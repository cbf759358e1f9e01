"""Daily exposure and doses beside python-control's responses, and beside Gaussian noise and driving in time."""

from dataclasses import replace

import numpy as np
import pytest

import suspension_ctrl as sc
from garage import DRIVER, FULL, HALF, QUARTER, ROAD, SPEED, mean_squares, struts_of
from suspension_ctrl import A8, MSDV, VDV, LoadCase, Measure, RideProblem, exposure
from suspension_ctrl.response.certifying import certify

BAND, NODES, HOUR = (0.1, 20.0), 512, 3600.0
SEATED = DRIVER.on(FULL)
BOUNDS = {"spring": (15e3, 25e3), "damper": (1e3, 2e3)}


def value(vehicle, *measures) -> list[float]:
    table = sc.ride(vehicle, struts_of(vehicle), ROAD, SPEED, band=BAND, measures=measures)
    return table["value"].iloc[: len(measures)].to_list()


def rms(vehicle, response, weighting) -> float:
    return float(np.sqrt(mean_squares(vehicle, struts_of(vehicle), [(response, weighting)], BAND, NODES)[0]))


def test_the_worst_axis_counts_over_two_hours():
    """Far above or below the centre of gravity pitch or roll outweighs the vertical axis."""
    vertical = rms(SEATED, "driver_acceleration", "Wk")
    turning = 1.4 * max(rms(SEATED, f"{name}_acceleration", "Wd") for name in ("pitch", "roll"))
    heights = [0.0, 0.1, -2.0, 5.0]
    texts = ["driver 2h", *(f"driver 2h at {height}" for height in heights)]
    worst = np.array([vertical, *(max(vertical, abs(height) * turning) for height in heights)])
    assert (worst > vertical).tolist() == [False, False, False, True, True]
    found = value(SEATED, *(f"{word} {text}" for word in ("A8", "VDV") for text in texts))
    np.testing.assert_allclose(found[:5], 0.5 * worst, rtol=1e-7)
    np.testing.assert_allclose(found[5:], (3 * 2 * HOUR) ** 0.25 * worst, rtol=1e-7)


@pytest.mark.parametrize("vehicle", [QUARTER, HALF])
def test_axes_that_a_vehicle_lacks_are_left_out(vehicle):
    turns = [name for name in ("pitch", "roll") if f"{name}_acceleration" in vehicle.meanings]
    axes = [1.4 * 3.0 * rms(vehicle, f"{name}_acceleration", "Wd") for name in turns]
    axes.append(rms(vehicle, "body_acceleration", "Wk"))
    assert value(vehicle, "A8 at 3") == pytest.approx([max(axes)], rel=1e-7)


def test_motion_sickness_dose_grows_with_the_root_of_time():
    expected = rms(HALF, ("acceleration", 1.0, 0.0), "Wf")
    found = value(HALF, "MSDV (1, 0) 30min", "MSDV (1, 0)")
    assert found == pytest.approx([expected * np.sqrt(1800.0), expected * 60.0], rel=1e-7)


def test_the_dose_of_gaussian_noise_is_that_of_its_root_mean_square():
    """32 parts of 500 s of noise: the mean of VDV^4 over 3 T sigma^4 is 1 within three standard errors."""
    noise = np.random.default_rng(8).normal(size=(32, 100_000))
    found = np.array([exposure(one, 0.005).vdv ** 4 / (3 * 500.0) for one in noise])
    assert abs(found.mean() - 1) < 3 * found.std(ddof=1) / np.sqrt(32)
    assert found.std(ddof=1) / np.sqrt(32) < 2e-3


def test_doses_over_load_cases_add_up_by_time():
    """VDV by the fourth power, A(8) and MSDV by the second, each with its share of the time."""
    cases = [
        LoadCase(vehicle=QUARTER, road=sc.Iso8608Road(name), speed=20.0, share=share)
        for name, share in (("B", 3.0), ("D", 1.0))
    ]
    problem = RideProblem(cases=cases, bounds=BOUNDS, band=BAND, measures=["A8", "VDV", "MSDV"])
    apart = np.array([replace(problem, cases=[case]).evaluate([[2e4, 1500.0]])[0] for case in cases])
    for column, power in enumerate((2, 4, 2)):
        expected = (0.75 * apart[0, column] ** power + 0.25 * apart[1, column] ** power) ** (1 / power)
        assert problem.evaluate([[2e4, 1500.0]])[0, column] == pytest.approx(expected, rel=1e-9)
    worst = replace(problem, worst_case=True).evaluate([[2e4, 1500.0]])[0]
    np.testing.assert_allclose(worst, apart.max(axis=0), rtol=1e-9)


def test_driving_in_time_confirms_the_doses():
    """Over 4 roads of 2 km A(8) and VDV lie within their intervals; MSDV has few waves at 0.2 Hz."""
    problem = RideProblem(
        QUARTER,
        sc.Iso8608Road("C"),
        speed=20.0,
        bounds=BOUNDS,
        band=(0.1, 20.0),
        measures=["A8 1h", "VDV 1h", "MSDV"],
    )
    table = certify(problem, [2e4, 1500.0], length=2000.0, seeds=range(4)).to_frame().loc["1"]
    for name in ("A8 1h", "VDV 1h"):
        assert table["linearised"][name] == pytest.approx(table["simulated"][name], rel=0.02)
        assert table["low"][name] <= table["linearised"][name] <= table["high"][name]
    assert table["linearised"]["MSDV"] == pytest.approx(
        table["simulated"]["MSDV"], rel=0.15
    )  # few waves at 0.2 Hz


def test_limits_of_the_directive_are_constraints():
    problem = RideProblem(
        QUARTER, sc.Iso8608Road("C"), speed=20.0, bounds=BOUNDS, measures=["ACC", "DTL"],
        constraints=["A8 4h <= 0.5", "VDV 4h <= 9.1", sc.Limit(VDV("", 4 * HOUR), 21.0)],
    )  # fmt: skip
    acc, _, a8, vdv, vdv_limit = problem.evaluate([[2e4, 1500.0]])[0]
    assert a8 == pytest.approx(acc * np.sqrt(0.5) / 0.5 - 1, rel=1e-7)
    assert vdv == pytest.approx(acc * (12 * HOUR) ** 0.25 / 9.1 - 1, rel=1e-7)
    assert (vdv_limit + 1) * 21.0 == pytest.approx((vdv + 1) * 9.1, rel=1e-12)


@pytest.mark.parametrize(
    ("text", "measure"),
    [
        ("A8", A8()),
        ("A8 driver 4h", A8("driver", 4 * HOUR)),
        ("VDV (1, -2) 30 min at 40cm", VDV((1.0, -2.0), 1800.0, 0.4)),
        ("VDV at -0.3", VDV(height=-0.3)),
        ("MSDV driver 90s", MSDV("driver", 90.0)),
        ("MSDV 8h", MSDV(duration=8 * HOUR)),
        ("dose = VDV 4.5h", VDV(duration=4.5 * HOUR, name="dose")),
    ],
)
def test_texts_and_objects_are_the_same(text, measure):
    found = Measure.parse(text)
    assert replace(found, name=measure.name) == measure
    assert Measure.parse(str(measure)) == measure
    assert Measure.parse(str(found)) == found


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("A8 4", "A8 must be followed by a place, a time and a height, as in 'A8 driver 4h at 0.6m', got '4'"),
        ("VDV driver at", "VDV must be followed by a place, a time and a height"),
        ("MSDV at 0.3", "MSDV must be followed by a place and a time, as in 'MSDV driver 2h', got 'at 0.3'"),
        ("A8 4m", "duration must be in s or a unit like it, got '4m' in m"),
        ("A8 0.1s", "duration must be a number from 1.0 to 1000000000.0, got 0.1"),
        ("VDV at 4e3", "height must be a number from -1000.0 to 1000.0, got 4000.0"),
    ],
)
def test_other_texts_are_refused_in_one_line(text, message):
    with pytest.raises(ValueError, match=rf"^{message}[^\n]*$"):
        Measure.parse(text)


def test_wrong_types_are_refused_in_one_line():
    for make in (lambda: A8("driver", "4h"), lambda: VDV(height="high"), lambda: MSDV(duration=None)):
        with pytest.raises(ValueError, match=r"^(duration|height) must be a number from [^\n]*$"):
            make()
    with pytest.raises(ValueError, match=r"^A8 must be of one of body, driver or a point"):
        value(SEATED, "A8 guest")
