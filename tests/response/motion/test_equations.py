"""Equations of motion beside closed vehicles; static loads and the sag by a payload."""

from dataclasses import replace

import numpy as np
import pytest

import suspension_ctrl as sc
from garage import DAMPED_FULL, FULL, HALF, QUARTER, VEHICLES, struts_of
from suspension_ctrl.response.motion.drivable import motion_of
from suspension_ctrl.response.motion.equations import loads_of, static_loads

TRUSS = sc.parallel(sc.Spring(), sc.TableSpring("helper", deflection=[-1.0, 0.0, 1.0], force=[-5e3, 0.0, 5e3]))


@pytest.mark.parametrize("name", VEHICLES)
def test_a_linear_vehicle_is_the_closed_one(name):
    vehicle = VEHICLES[name]
    values = vehicle.coefficients(struts_of(vehicle))
    found, closed = motion_of(vehicle, values), vehicle.closed(struts_of(vehicle))
    r = len(vehicle.contact_points)
    e, y = found.equations, found.responses
    inputs = [(e.b, closed.B[:, :r]), (y.d, closed.D[:, :r])]
    if closed.ninputs > r:
        inputs += [(e.g, closed.B[:, r:]), (y.e, closed.D[:, r:])]
    for one, other in [(e.a, closed.A), (y.c, closed.C), *inputs]:
        np.testing.assert_allclose(one, other, rtol=1e-12, atol=1e-9)


@pytest.mark.parametrize("vehicle", [QUARTER, HALF, FULL, DAMPED_FULL])
def test_static_loads_are_the_weight(vehicle):
    loads = static_loads(vehicle, vehicle.coefficients(struts_of(vehicle)), laden=True)
    assert loads.sum() == pytest.approx(9.80665 * vehicle.assembly.weights.sum(), rel=1e-12)
    assert len(loads) == len(loads_of(vehicle)) == len(vehicle.tyres)


def test_on_lift_off_a_tyre_acts_on_its_wheel_alone():
    found = motion_of(FULL, FULL.coefficients(struts_of(FULL)), lift_off=True)
    by_tension = found.equations.push
    wheels = [FULL.assembly.coordinates.index(f"{tyre}_wheel") for tyre in FULL.tyres]
    masses = np.diag(FULL.assembly.mass_matrix)[wheels]
    expected = np.zeros_like(by_tension)
    expected[[2 * wheel + 1 for wheel in wheels], range(4)] = -1 / masses
    np.testing.assert_allclose(by_tension, expected, rtol=1e-12, atol=1e-15)


def test_a_payload_sinks_by_its_weight_over_the_springs():
    """A helper spring of 5 kN/m beside 20 kN/m; travel counts from the position without payload."""
    laden = sc.Payload(mass=50.0).on(replace(QUARTER, strut=TRUSS))
    level = sc.Profile([0.0, 1.0, 2.0], np.zeros((3, 1)))
    history = sc.simulate(laden, {"spring": 20e3}, level, 1.0)
    weight = 50.0 * 9.80665
    assert history["suspension_travel [m]"].to_numpy() == pytest.approx(-weight / 25e3, rel=1e-9)
    assert history["tyre_load [N]"].to_numpy() == pytest.approx(-weight, rel=1e-9)
