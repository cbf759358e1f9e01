"""Responses of single designs: spectra integrate to the objectives, phases and natural frequencies by hand."""

import numpy as np
import pytest

from suspension_ctrl import QuarterCar
from suspension_ctrl.paper import experiment as paper
from suspension_ctrl.response import responses
from suspension_ctrl.response.quadrature import frequency_nodes

DESIGN = (22e3, 1500.0)


def test_spectra_integrate_to_the_objectives():
    """Equations (3), (9), (10), (12), (13) by python-control's closed model; 256 nodes give 1e-9."""
    p = paper.ride_problem(weighting=None)
    f, w = frequency_nodes(p.band, 256)
    spectra = responses.response_psds(p.vehicle.closed(*DESIGN), f, p.road.psd(f, p.speed))
    found = [np.sqrt((spectra[name] * w).sum()) for name in p.vehicle.responses]
    np.testing.assert_allclose(found, p.evaluate([DESIGN])[0], rtol=1e-9)


def test_phases_begin_as_the_signs_say_and_go_on_without_jumps():
    """At low frequency body acceleration is -w^2 times the road, so opposite; both deflections begin with it.

    The body's inertia makes it overshoot: z2 - z1 = w^2 m_b/k z2, and likewise z1 - x0 for both masses.
    """
    f = np.geomspace(0.01, 20, 2000)
    h = responses.frequency_responses(paper.ride_problem().vehicle.closed(*DESIGN), f)
    phases = {name: responses.phase_degrees(response) for name, response in h.items()}
    assert phases["body_acceleration"][0] == pytest.approx(180, abs=1)
    assert phases["suspension_travel"][0] == pytest.approx(0, abs=1)
    assert phases["tyre_load"][0] == pytest.approx(0, abs=1)
    for phase in phases.values():
        assert np.abs(np.diff(phase)).max() < 10
        assert phase[-1] < phase[0] - 150  # it lags more and more
    np.testing.assert_allclose(responses.phase_degrees(np.array([-1 - 1e-9j, -1 + 1e-9j])), [180, 180], atol=1e-6)


def test_natural_frequencies_of_a_stiff_tyre():
    """With the tyre near rigid the body alone swings on its spring, at sqrt(k/m)."""
    car = QuarterCar(body_mass=317.5, wheel_mass=45.4, tyre_stiffness=1e12)
    natural = responses.natural_frequencies(car.closed(22e3, 10.0))
    assert natural[0] == pytest.approx(np.sqrt(22e3 / 317.5) / (2 * np.pi), rel=1e-6)
    assert natural[1] == pytest.approx(np.sqrt(1e12 / 45.4) / (2 * np.pi), rel=1e-6)


def test_overdamped_modes_have_no_natural_frequency():
    car = paper.ride_problem().vehicle
    assert len(responses.natural_frequencies(car.closed(2e3, 5e3))) < 2
