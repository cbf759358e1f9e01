"""Linearised vehicles: plants, closed vehicles, modes and tables."""

import pickle

import numpy as np
import pytest

import suspension_ctrl as sc

ROAD = sc.Iso8608Road("C")
STRUT = sc.parallel(
    sc.Spring(), sc.series(sc.BilinearDamper(bump=900.0, rebound=2100.0), sc.Spring("mount", 250e3))
)
CAR = sc.QuarterCar(body_mass=317.5, wheel_mass=45.4, tyre_stiffness=192e3, strut=STRUT)


def test_a_linearised_vehicle_is_a_vehicle_with_values():
    linear = CAR.linearised({"spring": 22e3}, ROAD, 20.0, band=(0.1, 20.0))
    assert linear == sc.linearised(CAR, {"spring": 22e3}, ROAD, 20.0, band=(0.1, 20.0))
    assert linear.coefficients() == pytest.approx({"spring": 22e3, "damper": 1500.0, "mount": 250e3})
    assert linear.plant().input_labels == CAR.plant().input_labels
    zener = sc.parallel(sc.Spring(), sc.series(sc.Damper(), sc.Spring("mount")))
    by_hand = sc.QuarterCar(body_mass=317.5, wheel_mass=45.4, tyre_stiffness=192e3, strut=zener)
    setting = {"spring": 22e3, "damper": 1500.0, "mount": 250e3}
    np.testing.assert_allclose(linear.closed().poles(), by_hand.closed(setting).poles(), rtol=1e-9)
    np.testing.assert_allclose(
        linear.modes()["frequency [Hz]"], by_hand.modes(setting)["frequency [Hz]"], rtol=1e-9
    )
    assert pickle.loads(pickle.dumps(linear)) == linear


def test_the_table_of_laws():
    table = CAR.linearised({"spring": 22e3}, ROAD, 20.0).table()
    assert table.index.to_list() == ["damper"]
    assert table.loc["damper", "equivalent"] == pytest.approx(1500.0)
    assert table.loc["damper", "force"] > 0  # more in rebound


def test_the_mean_force_of_an_odd_law_is_0_in_the_table():
    """Sums of normal probabilities leave 1e-13 N, which would be printed."""
    law = sc.TableDamper(velocity=[0.0, 0.05, 0.1, 0.3, 0.5, 1.0], force=[0.0, 600, 850, 1250, 1450, 1750])
    car = sc.QuarterCar(body_mass=250, wheel_mass=20, tyre_stiffness=140e3, strut=sc.parallel(sc.Spring(), law))
    linear = car.linearised({"spring": 20e3}, ROAD, 20.0, band=(0.1, 20.0))
    assert linear.table()["force"].to_list() == [0.0]


def test_a_vehicle_without_laws_keeps_its_struts():
    plain = sc.QuarterCar(body_mass=317.5, wheel_mass=45.4, tyre_stiffness=192e3)
    linear = plain.linearised((22e3, 1500.0), ROAD, 20.0)
    assert not linear.laws
    assert linear.iterations == 0
    np.testing.assert_array_equal(linear.closed().A, plain.closed(22e3, 1500.0).A)


def test_a_measure_of_ones_own_gets_the_spectra_of_each_working_point():
    def rate(frequency, spectra):
        omega = 2 * np.pi * frequency
        return float(np.sqrt(np.trapezoid(omega**2 * spectra["suspension_travel"], frequency)))

    problem = sc.RideProblem(
        CAR,
        ROAD,
        speed=20.0,
        bounds={"spring": (1e4, 3e4), "damper.rebound": (1e3, 3e3)},
        measures=["ACC", "SWS", sc.Measure("rate", "m/s", rate)],
        band=(0.1, 20.0),
    )
    for spring, rebound in ((12e3, 1200.0), (25e3, 2800.0)):
        found = problem.evaluate([[spring, rebound]])[0, 2]
        linear = CAR.linearised({"spring": spring, "damper.rebound": rebound}, ROAD, 20.0, band=(0.1, 20.0))
        expected = sc.ride(linear, {}, ROAD, 20.0, band=(0.1, 20.0))["value"]["suspension_travel_rate"]
        assert found == pytest.approx(expected, rel=1e-3)  # 1000 parts of the band, by trapezoids


def test_a_stop_is_struck_from_the_mean_travel():
    """A car that its damper pulls down strikes as the linear car does whose gap is shorter by the mean travel."""
    linear = CAR.linearised({"spring": 22e3}, ROAD, 20.0, band=(0.1, 20.0))
    mean = linear.mean_travel[""]
    assert mean < -1e-3

    def strikes(car, setting, measure):
        return sc.ride(car, setting, ROAD, 20.0, band=(0.1, 20.0), measures=["ACC", measure])["value"].iloc[1]

    for kind, gap in ((sc.Bottoming, 0.03 + mean), (sc.Topping, 0.03 - mean)):
        found = strikes(CAR, {"spring": 22e3}, kind(gap=0.03))
        assert found == pytest.approx(strikes(linear, {}, kind(gap=gap)), rel=1e-6)


@pytest.mark.parametrize(
    "strut",
    [
        sc.series(sc.Damper(value=1e3), sc.Spring(value=2e4)),
        sc.parallel(sc.Damper(value=1e3), sc.PowerDamper("other", force=1e3, exponent=2.0)),
    ],
)
def test_a_strut_without_a_spring_carries_nothing(strut):
    car = sc.QuarterCar(body_mass=317.5, wheel_mass=45.4, tyre_stiffness=192e3, strut=strut)
    with pytest.raises(ValueError, match=r"^struts must have a spring that carries the vehicle, got none"):
        sc.ride(car, {}, ROAD, 20.0)


def test_the_damping_of_roll_is_refused_with_other_struts():
    car = sc.load_vehicle("volvo_xc90_full")
    with pytest.raises(ValueError, match=r"^roll_damping must be of struts of a spring beside a damper"):
        sc.ride(car.vehicle, car.setting, ROAD, 20.0, measures=["ACC", "roll_damping"])
