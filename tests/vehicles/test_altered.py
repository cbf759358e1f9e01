"""Vehicles with other values of parameters: an optimum in print, and settings that do not fit."""

from dataclasses import replace

import numpy as np
import pytest

from garage import FULL, QUARTER
from suspension_ctrl import QuarterCar
from suspension_ctrl.vehicles.altered import plain_values

CAR = QuarterCar(body_mass=475.0, wheel_mass=53.0, tyre_stiffness=135e3, tyre_damping=1200.0)
OMEGA = 18.0555556  # rad/s


def test_spring_and_tyre_together_lower_comfort_at_equal_grip():
    """Of a published reanalysis of this quarter car: the body 0.71 of before, the tyre's deflection as before."""
    names = ["body_displacement", "tyre_deflection"]
    by_road = []
    for values in ({"spring": 5400.0}, {"spring": 691.5829, "tyre_stiffness": 182116.4403}):
        closed = CAR.closed({**values, "damper": 310.0}, responses=names)
        h = closed(1j * OMEGA)
        by_road.append(np.abs(h[:, 0] + 1j * OMEGA * h[:, 1]))
    np.testing.assert_allclose(by_road[1] / by_road[0], [0.71, 1.0], rtol=1e-6)  # digits of the values


def test_modes_are_those_of_a_vehicle_built_anew():
    setting = {"spring": 2e4, "damper": 1500.0}
    table = QUARTER.modes({**setting, "body_mass": 280.0})
    anew = replace(QUARTER, body_mass=280.0).modes(setting)
    np.testing.assert_array_equal(table["frequency [Hz]"], anew["frequency [Hz]"])


def test_values_without_frequencies_stay():
    values = {"spring": 2e4, "tyre_stiffness": 1.8e5}
    assert plain_values(QUARTER, values) == values


@pytest.mark.parametrize(
    ("setting", "message"),
    [
        ({"body_mass": 0.0}, "body_mass must be finite and > 0 kg, got 0.0"),
        ({"body_mass": "heavy"}, "body_mass must be finite and > 0 kg, got 'heavy'"),
        ({"front_tyre_damping": -1.0}, "front_tyre_damping must be finite and >= 0 N s/m, got -1.0"),
        (
            {"front.ride_frequency": 1.2},
            "setting must have front.spring or front.ride_frequency in its place, got both",
        ),
    ],
)
def test_rejects_values_out_of_range(setting, message):
    with pytest.raises(ValueError, match=f"^{message}$"):
        FULL.closed({"front": (2e4, 1500.0), "rear": (2e4, 1500.0), **setting})
