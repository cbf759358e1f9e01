"""Tyres that lift off: what is said, and what is left of the load."""

import warnings

import numpy as np
import pytest

import suspension_ctrl as sc

CAR = sc.HalfCar(
    body_mass=500.0, pitch_inertia=600.0, front_wheel_mass=20.0, rear_wheel_mass=20.0,
    front_tyre_stiffness=140e3, rear_tyre_stiffness=140e3, cg_to_front=1.25, cg_to_rear=1.4,
)  # fmt: skip
SETTING = {"front": (20e3, 900.0), "rear": (20e3, 900.0)}
X = 0.05 * np.arange(800)
HUMP = sc.Profile(X, np.where(abs(X - 15) < 5, (1 + np.cos(np.pi * (X - 15) / 5)) / 2, 0.0)[:, None])


def test_a_hump_of_1_m_in_10_m_lets_the_wheels_fly():
    """A coursework, github jubjamie/Half-Car-Model-Dynamics @5962518a; loads by numpy and scipy."""
    with pytest.warns(sc.LiftOffWarning) as said:
        history = sc.simulate(CAR, SETTING, HUMP, 10.0)
    assert str(said[0].message).startswith(
        "the linear front tyre would pull 7.97 kN where 2.79 kN stand on it, 9.6 % of the time, first at distance "
    )
    front = history.attrs["lift_off"]["front"]
    off = history["front_tyre_load [N]"] >= 1.4 / 2.65 * 500.0 * 9.80665 + 20.0 * 9.80665
    assert front.share == pytest.approx(off.mean(), rel=1e-12)
    assert front.first == history["distance [m]"][off].iloc[0]


def test_a_tyre_that_may_lift_off_holds_its_static_load_at_most():
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        history = sc.simulate(CAR, SETTING, HUMP, 10.0, lift_off=True)
    assert history["front_tyre_load [N]"].max() == pytest.approx(2786.57, abs=0.01)
    assert history.attrs["lift_off"]["front"].share > 0.1


@pytest.mark.filterwarnings("ignore::suspension_ctrl.LiftOffWarning")
@pytest.mark.parametrize("mounted", [False, True])
def test_a_payload_presses_on_the_tyres(mounted):
    """As force beside dampers, or in the static position: a tyre pulls beyond the weight of all that is on it."""
    damper = sc.series(sc.Damper(), sc.Spring("mount", 1e6)) if mounted else sc.Damper()
    strut = sc.parallel(sc.Spring(), damper)
    car = sc.QuarterCar(body_mass=250.0, wheel_mass=20.0, tyre_stiffness=140e3, strut=strut)
    laden = sc.Payload(mass=100.0).on(car)
    history = sc.simulate(laden, {"spring": 20e3, "damper": 900.0}, HUMP, 10.0)
    pulls = history["tyre_load [N]"] >= 370.0 * 9.80665
    assert history.attrs["lift_off"][""].share == pytest.approx(pulls.mean(), rel=1e-12)
    assert pulls.any()


def test_nothing_is_said_on_a_smooth_road_or_of_an_unknown_load():
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        smooth = sc.simulate(CAR, SETTING, sc.Profile(X, 0.01 * HUMP.height), 10.0)
        sc.simulate(CAR, SETTING, HUMP, 10.0, responses=["body_acceleration"])
        sc.simulate(CAR.closed(SETTING), HUMP, 10.0, CAR.contact_points)
    assert "lift_off" not in smooth.attrs


def test_lift_off_needs_masses():
    plant = sc.Plant(CAR.plant(), contacts=CAR.contacts, struts=CAR.struts)
    with pytest.raises(ValueError, match=r"^lift_off must be of a vehicle with masses and loads of all tyres"):
        sc.simulate(plant, SETTING, HUMP, 10.0, lift_off=True)
