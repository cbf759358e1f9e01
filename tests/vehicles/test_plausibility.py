"""Figures of vehicles: closed forms of a quarter and a half car, and bands that all shipped vehicles keep."""

import numpy as np
import pytest

import suspension_ctrl as sc
from suspension_ctrl.datafiles import stems
from suspension_ctrl.vehicles.plausibility import figures_of

CAR = sc.QuarterCar(body_mass=300.0, wheel_mass=40.0, tyre_stiffness=2e5, tyre_damping=100.0)
HALF = sc.HalfCar(
    body_mass=600.0, pitch_inertia=1000.0, front_wheel_mass=40.0, rear_wheel_mass=50.0, front_tyre_stiffness=2e5,
    rear_tyre_stiffness=2e5, cg_to_front=1.2, cg_to_rear=1.5,
)  # fmt: skip


def values_of(vehicle, values=None):
    return {one.name: one.value for one in figures_of(vehicle, values)}


def test_frequencies_are_the_roots_of_the_quarter_cars_equation():
    """M m w^4 - (M (k + kt) + m k) w^2 + k kt = 0, to rounding."""
    found = values_of(CAR, {"spring": 2e4, "damper": 1500.0})
    squares = np.roots([300.0 * 40.0, -(300.0 * 2.2e5 + 40.0 * 2e4), 2e4 * 2e5])
    low, high = np.sort(np.sqrt(squares) / (2 * np.pi))
    assert found["a lowest natural frequency"] == pytest.approx(low, rel=1e-12)
    assert found["a highest natural frequency"] == pytest.approx(high, rel=1e-12)


def test_ratios_are_quotients_of_the_parameters():
    found = values_of(CAR, {"spring": 2e4, "damper": 1500.0})
    assert found["wheels over body in mass"] == 40.0 / 300.0
    assert found["a damper over its spring"] == 1500.0 / 2e4
    assert found["damping over stiffness of a tyre"] == 100.0 / 2e5
    found = values_of(HALF)
    assert found["a wheelbase"] == pytest.approx(2.7, rel=1e-15)
    assert found["a radius of gyration in pitch over the wheelbase"] == pytest.approx((1000 / 600) ** 0.5 / 2.7)
    assert not any("frequency" in name or "spring" in name for name in found)


def test_axles_and_trailers_are_judged_too():
    """Masses of six axles over that of tractor and trailer; a trailer's radius over the whole wheelbase."""
    found = values_of(sc.load_vehicle("kraz_semitrailer").vehicle)
    axles = 991.41 + 2 * 1226.41 + 3 * 728.01
    assert found["wheels over body in mass"] == pytest.approx(axles / 30e3, rel=1e-12)
    name = "a radius of gyration of trailer in pitch over the wheelbase"
    assert found[name] == pytest.approx((322240 / 20e3) ** 0.5 / 13.54, rel=1e-12)


def test_elastic_modes_are_not_judged():
    shapes = {(1.2, 0.0): (0.03,), (-1.5, 0.0): (-0.03,)}
    body = sc.FlexibleBody(frequencies=[90.0], damping_ratios=[0.02], shapes=shapes)
    setting = {"front": (2e4, 1500.0), "rear": (2e4, 1500.0)}
    rigid, bent = (values_of(car, car.coefficients(setting)) for car in (HALF, body.on(HALF)))
    assert bent == pytest.approx(rigid, rel=1e-12)


@pytest.mark.parametrize("stem", stems("vehicles"))
def test_vehicles_of_the_package_are_plausible(stem):
    file = sc.load_vehicle(stem)
    figures = figures_of(file.vehicle, file.vehicle.coefficients(file.setting))
    assert len(figures) >= 3
    assert [str(one) for one in figures if not one.plausible] == []


def test_a_figure_tells_its_band():
    heavy = sc.QuarterCar(body_mass=0.3, wheel_mass=40.0, tyre_stiffness=2e5)
    (figure,) = [one for one in figures_of(heavy) if not one.plausible]
    assert str(figure) == "wheels over body in mass of 133, usual are 0.003 to 3"
    assert figure.distance == pytest.approx(np.log(40 / 0.3 / 0.13) ** 2)
