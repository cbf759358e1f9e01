"""Roads of the criterion against the cross-spectra of the roads as they are."""

import numpy as np
import pytest

from garage import DAMPED_QUARTER, FULL, HALF, QUARTER
from suspension_ctrl import Constant, Iso8608Road, LoadCase, PowerLawRoad, load_vehicle
from suspension_ctrl.response.controllers.delays import ERROR
from suspension_ctrl.response.controllers.road_model import FALLOFF, RoadModel

SPEED, BAND = 20.0, (0.3, 20.0)
F = np.geomspace(0.3, 20.0, 30)
S = 2j * np.pi * F


def _case(vehicle, road=None):
    return LoadCase(vehicle=vehicle, road=road or Iso8608Road("C"), speed=SPEED)


def _model(case, *, falls=False, displaced=False):
    return RoadModel.of(case, BAND, falls=falls, displaced=displaced)


def _rates(model, s=S):
    """Return the rates of the roads by the noises (k, r, t)."""
    states = np.linalg.solve(s[:, None, None] * np.eye(len(model.a)) - model.a, model.b)
    return model.rate @ states + model.direct


@pytest.mark.parametrize("road", [Iso8608Road("C"), PowerLawRoad(roughness=5e-6, exponent=2.5)])
@pytest.mark.parametrize("name", ["quarter", "half", "jian"])
def test_the_cross_spectra_are_those_of_the_roads(name, road):
    vehicles = {"quarter": QUARTER, "half": HALF, "jian": load_vehicle("jian_2022_full").vehicle}
    case = _case(vehicles[name], road)
    model = _model(case)
    h = _rates(model) / S[:, None, None]
    found, expected = 2 * h @ h.conj().transpose(0, 2, 1), case.cross_spectrum(F)
    off = abs(found - expected).max(axis=(1, 2)) / case.psd(F)
    largest = 1e-12 + sum(one.largest for one in model.shapings)
    assert off.max() <= largest + model.delay_error
    spectra = np.repeat(case.psd(F)[:, None], len(case.vehicle.tyres), axis=1)
    np.testing.assert_allclose(found.diagonal(axis1=1, axis2=2).real, spectra, rtol=largest)
    assert model.delay_error <= ERROR
    assert len(model.orders) == (name != "quarter")


def test_a_car_on_white_velocity_has_no_states():
    model = _model(_case(QUARTER))
    assert model.a.shape == (0, 0)
    assert model.direct.shape == (1, 1)
    assert model.states(S).shape == (F.size, 0, 1)


def test_the_noises_are_known_from_the_first_axle():
    """Inverse filters from the front roads and the model from there give the rates of all roads."""
    case = _case(load_vehicle("jian_2022_full").vehicle, PowerLawRoad(roughness=5e-6, exponent=2.5))
    model = _model(case)
    noise = np.array([one.filter.response(S) for one in model.shapings]) ** -1.0
    by_road = (noise * S).T[:, :, None] * model.source
    expected = model.rate @ model.states(S) + model.direct @ by_road
    np.testing.assert_allclose(_rates(model) @ by_road, expected, rtol=1e-9, atol=1e-9)
    front = (_rates(model) @ by_road)[:, :2, :2]  # of the front wheels by their roads: s
    np.testing.assert_allclose(front, S[:, None, None] * np.eye(2), rtol=1e-9, atol=1e-9 * abs(S[0]))


def test_displacements_are_integrals_of_rates():
    model = _model(_case(FULL), displaced=True)
    states = np.linalg.solve(S[:, None, None] * np.eye(len(model.a)) - model.a, model.b)
    by_rate = (model.rate @ states + model.direct) / S[:, None, None]
    # A leak at a tenth of the least frequency, which is off by 10 % there, by phase, and less above.
    np.testing.assert_allclose(model.displacement @ states, by_rate, rtol=0.1)
    np.testing.assert_allclose((model.displacement @ states)[-1], by_rate[-1], rtol=2e-3)


def test_a_road_that_acts_by_its_rate_falls_beyond_the_band():
    model = _model(_case(DAMPED_QUARTER), falls=True)
    assert not model.direct.any()
    far = 2j * np.pi * FALLOFF * BAND[1] * np.array([1.0, 100.0])
    gain = abs(_rates(model, far))[:, 0, 0]
    assert gain[1] / gain[0] == pytest.approx(np.sqrt(2) / 100, rel=0.01)


def test_identical_tracks_have_one_noise():
    model = _model(_case(load_vehicle("jian_2022_full").vehicle, Iso8608Road("C", coherence=Constant(1.0))))
    assert model.b.shape[1] == 1


def test_tracks_need_a_wheel_on_each_axle():
    wheels = {"front": (1.2, 0.0), "left": (-1.0, 0.7), "right": (-1.0, -0.7)}

    class Three:
        contact_points = np.array(list(wheels.values()))

    case = _case(FULL)
    object.__setattr__(case, "vehicle", Three())
    with pytest.raises(ValueError, match=r"^contacts must be on one or two tracks with a wheel on each axle, got"):
        _model(case)
