"""Does the model fit: a simulated drive is its own model's within the interval, and a wrong damper is seen."""

import re

import numpy as np
import pandas as pd
import pytest

from garage import HALF, QUARTER
from suspension_ctrl import Iso8608Road, Plant, correlate, correlation_figure, response_psds, ride, simulate
from suspension_ctrl.response.estimates import third_octaves

ROAD, SPEED = Iso8608Road("C"), 20.0
SETTING = {"spring": 22e3, "damper": 1500.0}


@pytest.fixture(scope="module")
def profile():
    """Steps of 2.5 ms, which attenuate 20 Hz by sinc^2(0.05), 0.8 %."""
    return ROAD.profile(length=6000.0, step=0.05, seed=5)


@pytest.fixture(scope="module")
def measured(profile):
    return simulate(QUARTER, SETTING, profile, SPEED, periodic=True)


def within(table):
    return ((table.low <= table.computed) & (table.computed <= table.high)).mean()


def test_a_drive_agrees_with_its_own_model_and_not_with_another(measured):
    """54 values of 95 % intervals: fewer than 47 within have a chance of 1 in 200."""
    own, other = (
        correlate(QUARTER, SETTING | {"damper": c}, measured, ROAD, SPEED).table for c in (1500.0, 1900.0)
    )
    assert len(own) == 3 * 18
    assert within(own) > 46 / 54
    assert within(other) < 0.6
    whole = other.groupby("response").tail(1)["ratio [dB]"]
    assert (abs(whole) > 0.3).any()


def test_computed_values_are_those_of_ride(measured):
    """In one band, by other quadrature: r.m.s. to 1e-5 (`ride` resolves 1e-4, the third octaves more)."""
    found = correlate(QUARTER, SETTING, measured, ROAD, SPEED, bands=[0.5, 1.0, 1.6, 4.0, 9.0, 14.0, 20.0]).table
    wanted = ride(QUARTER, SETTING, ROAD, SPEED, band=(0.5, 20.0))["value"]
    for name, part in found.groupby("response"):
        assert part.computed.iloc[-1] == pytest.approx(wanted[name], rel=1e-4)
        assert part.measured.iloc[-1] == pytest.approx(np.sqrt((part.measured.iloc[:-1] ** 2).sum()), rel=1e-12)
        np.testing.assert_allclose(part["ratio [dB]"], 20 * np.log10(part.computed / part.measured), rtol=1e-12)
    assert set(found.unit) == {"m/s^2", "m", "N"}


def test_over_the_measured_profile_there_is_no_chance_left():
    """The same drive, in g from a file's headers: the same numbers but for rounding."""
    profile = ROAD.profile(length=2200.0, step=0.1, seed=5)
    measured = simulate(HALF, {"front": (2e4, 1e3), "rear": (2e4, 2e3)}, profile, SPEED)
    measured = measured[["time [s]", "pitch_acceleration [rad/s^2]", "body_acceleration [m/s^2]"]]
    measured = measured.assign(**{"seat [g]": measured["body_acceleration [m/s^2]"] / 9.80665})
    setting, channels = {"front": (2e4, 1e3), "rear": (2e4, 2e3)}, {"seat": "body_acceleration"}
    found = correlate(HALF, setting, measured, profile, SPEED, channels=channels).table
    np.testing.assert_allclose(found["ratio [dB]"], 0.0, atol=1e-9)
    found = correlate(HALF, setting | {"rear": (2e4, 1e3)}, measured, profile, SPEED, channels=channels).table
    assert abs(found["ratio [dB]"]).max() > 1.0


def test_given_spectra_have_no_interval():
    f = np.geomspace(0.4, 25.0, 2000)
    psd = response_psds(QUARTER.closed(SETTING), f, ROAD.psd(f, SPEED))
    frame = pd.DataFrame(
        {"frequency [Hz]": f, "body_acceleration [(mm/s^2)^2/Hz]": 1e6 * psd["body_acceleration"]}
    )
    found = correlate(QUARTER, SETTING, frame, ROAD, SPEED)
    assert found.table[["low", "high"]].isna().all(axis=None)
    np.testing.assert_allclose(found.table["ratio [dB]"], 0.0, atol=1e-3)  # straight between 2000 lines
    computed, given = found.spectra.iloc[:, 1], found.spectra.iloc[:, 2]
    np.testing.assert_allclose(computed, given, rtol=1e-9)
    with pytest.raises(ValueError, match=r"^spectra must be >= 0 throughout, got -"):
        correlate(QUARTER, SETTING, frame.assign(**{frame.columns[1]: -1.0}), ROAD, SPEED)


def test_a_plant_of_another_program_is_correlated_too(measured):
    here, there = (
        correlate(car, SETTING, measured, ROAD, SPEED).table for car in (Plant(QUARTER.plant()), QUARTER)
    )
    np.testing.assert_allclose(here.computed, there.computed, rtol=1e-10)


def test_the_figure_has_spectra_and_ratios(measured):
    found = correlate(QUARTER, SETTING, measured, ROAD, SPEED, bands=third_octaves((1.0, 10.0)))
    figure = correlation_figure(found)
    assert [one.get_title() for one in figure.axes[:3]] == ["body_acceleration", "suspension_travel", "tyre_load"]
    lines = figure.axes[0].get_lines()
    np.testing.assert_array_equal(lines[1].get_ydata(), found.spectra["body_acceleration measured [(m/s^2)^2/Hz]"])
    np.testing.assert_array_equal(figure.axes[3].get_lines()[0].get_ydata(), found.table["ratio [dB]"][:11])
    bands = found.table[:11]  # of the first response, without that of all together
    ends = 20 * np.log10(bands[["low", "high"]].to_numpy() / bands[["measured"]].to_numpy())
    grey = figure.axes[3].collections[0].get_paths()[0].vertices[:, 1]
    assert (grey.min(), grey.max()) == pytest.approx((ends.min(), ends.max()), rel=1e-12)
    f = found.spectra["frequency [Hz]"]
    assert 10**-0.05 <= f.min() < f.max() <= 10**1.05
    assert repr(found) == "Correlation(table=36 rows, spectra=" + repr(found).partition("spectra=")[2]


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"bands": [1.0]}, "bands must be two edges or more, got [1.0]"),
        ({"bands": [2.0, 1.0]}, "bands must be finite, above zero and ascend, got 1.0 in row 2"),
        ({"channels": {"a": "body_acceleration"}}, "columns must include 'a' once, got none"),
        ({"band": (0.01, 20.0)}, "time must last 5200 s for a band of 0.00231 Hz, got 300 s"),
    ],
)
def test_other_arguments_are_one_line(measured, options, message):
    with pytest.raises(ValueError, match="^" + re.escape(message) + "$"):
        correlate(QUARTER, SETTING, measured, ROAD, SPEED, **options)
