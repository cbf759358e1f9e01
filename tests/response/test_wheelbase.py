"""Wheelbase filtering: on one track the rear wheel repeats the front one L/V later, and some waves cancel out.

A car that is alike at both ends does not bounce to what front and rear meet with opposite signs, at
f = (2 k + 1) V / (2 L), nor pitch to what they meet alike, at f = k V / L.
"""

import numpy as np
import pytest

import garage
from suspension_ctrl import HalfCar
from suspension_ctrl.response import responses

BASE, SPEED, HIGHEST = 2.7, 20.0, 20.0
CAR = HalfCar(
    body_mass=650.0,
    pitch_inertia=1200.0,
    front_wheel_mass=40.0,
    rear_wheel_mass=40.0,
    front_tyre_stiffness=192e3,
    rear_tyre_stiffness=192e3,
    front_tyre_damping=100.0,
    rear_tyre_damping=100.0,
    cg_to_front=BASE / 2,
    cg_to_rear=BASE / 2,
)
STRUTS = {"front": (21e3, 1500.0), "rear": (21e3, 1500.0)}

BOUNCE = (2 * np.arange(3) + 1) * SPEED / (2 * BASE)
PITCH = np.arange(1, 3) * SPEED / BASE
"""All nulls up to 20 Hz: 3.7, 11.1, 18.5 and 7.4, 14.8 Hz."""

NULLS = {"body_acceleration": BOUNCE, "pitch_acceleration": PITCH}
NONE = 1e-20
"""Of a null over its neighbouring maxima: rounding leaves some 1e-16 of either wheel's part, 1e-32 of its square,
and the model's two halves, which differ by rounding through its matrices, some 1e-28."""

ROUNDED = 1e-14
"""Likewise where squares are added up that cancel out, which leaves some 1e-16 of them."""


def test_these_are_all_nulls_up_to_the_end_of_the_band():
    for nulls in NULLS.values():
        assert nulls[-1] <= HIGHEST < nulls[-1] + SPEED / BASE


def around(null: float) -> np.ndarray:
    """Return frequencies from the null before to the null after, itself in the middle."""
    return null + np.linspace(-1, 1, 401)[1:-1] * min(SPEED / BASE, 0.99 * null)


def over_neighbours(spectrum: np.ndarray) -> float:
    """Return the value in the middle over the lower one of the maxima on either side."""
    middle = spectrum.size // 2
    return float(spectrum[middle] / min(spectrum[:middle].max(), spectrum[middle + 1 :].max()))


@pytest.mark.parametrize(("name", "null"), [(name, null) for name, nulls in NULLS.items() for null in nulls])
def test_spectra_have_nulls(name, null):
    """By python-control's closed model and the road's cross-spectra, which are of rank one."""
    f = around(null)
    road = garage.ROAD.cross_spectrum(f, SPEED, CAR.contact_points)
    wheels = road[:, :, 0] / np.sqrt(road[:, :1, 0].real)
    np.testing.assert_allclose(wheels[:, :, None] * wheels[:, None, :].conj(), road, rtol=1e-12)
    h = garage.from_roads(CAR, STRUTS, [name], f)[:, 0]
    assert over_neighbours(np.abs((h * wheels).sum(axis=1)) ** 2) < NONE
    spectrum = responses.response_psds(CAR.closed(STRUTS, responses=[name]), f, road)[name]
    assert abs(over_neighbours(spectrum)) < ROUNDED


@pytest.mark.parametrize(("name", "null"), [(name, null) for name, nulls in NULLS.items() for null in nulls])
def test_frequency_responses_with_delays_have_nulls(name, null):
    f = around(null)
    h = responses.frequency_responses(CAR.closed(STRUTS, responses=[name]), f, (0.0, BASE / SPEED))[name]
    assert over_neighbours(np.abs(h) ** 2) < NONE


@pytest.mark.parametrize(("name", "other"), [("body_acceleration", PITCH), ("pitch_acceleration", BOUNCE)])
def test_each_response_is_full_where_the_other_has_its_nulls(name, other):
    """Front and rear then add up: twice what either wheel alone makes, to rounding."""
    h = garage.from_roads(CAR, STRUTS, [name], other)[:, 0]
    both = responses.frequency_responses(CAR.closed(STRUTS, responses=[name]), other, (0.0, BASE / SPEED))[name]
    np.testing.assert_allclose(np.abs(both), 2 * np.abs(h[:, 0]), rtol=1e-10)


def test_a_car_of_unlike_ends_has_no_nulls():
    struts = STRUTS | {"rear": (26e3, 1500.0)}
    for name, nulls in NULLS.items():
        h = responses.frequency_responses(CAR.closed(struts, responses=[name]), nulls, (0.0, BASE / SPEED))[name]
        either = garage.from_roads(CAR, struts, [name], nulls)[:, 0, 0]
        assert (np.abs(h) > 1e-3 * np.abs(either)).all()
