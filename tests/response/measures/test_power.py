"""Power of dampers beside the exact value of white road velocity, K_t S/2 for any law, and beside driving."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.linalg import solve_continuous_lyapunov

import suspension_ctrl as sc
from garage import FULL, QUARTER, ROAD, struts_of

SPEED, SPRING, BAND = 20.0, 22e3, (0.1, 20.0)
WHITE = sc.Iso8608Road("C")
INTENSITY = (2 * np.pi) ** 2 * 256e-6 * 0.1**2 * SPEED / 2
"""Of the road's velocity, two-sided [m^2/s]."""
EXACT = 192e3 * INTENSITY / 2
"""K_t S/2 [W]."""

BLOW_OFF = sc.DigressiveDamper(low_speed=4000.0, high_speed=800.0, knee=0.1)
LAWS = [
    BLOW_OFF,
    sc.BilinearDamper(bump=750.0, rebound=2250.0),
    sc.PowerDamper(force=4000.0, exponent=2.0),
    sc.PowerDamper(force=900.0, exponent=0.4),
    sc.TableDamper(velocity=[-1.15, -0.15, 0.0, 0.1, 1.1], force=[-725.0, -225.0, 0.0, 500.0, 1700.0]),
    sc.series(BLOW_OFF, sc.Spring("mount", 250e3)),
]


def on(*laws) -> sc.QuarterCar:
    return replace(QUARTER, strut=sc.parallel(sc.Spring(), *laws))


def at_5_khz(law):
    return sc.linearised(on(law), {"spring": SPRING}, WHITE, SPEED, band=(0.0, 5000.0))


@pytest.mark.parametrize("law", LAWS)
def test_power_by_quadrature_to_5_khz(law):
    """To 1e-8; with the tail, where rates fall as (w_t/w)^2, to 3e-9: the bound of the working point is 1e-8.

    The tail of c s^2 beyond w is 2 c w_t^4/(3 pi K_t w^3) of K_t S/2, of a law behind a mount less than 1e-12.
    """
    (one,) = at_5_khz(law).laws.values()
    power = one.equivalent * one.deviation**2 / EXACT
    assert power == pytest.approx(1.0, abs=1e-8)
    tail = 2 * one.equivalent * (192e3 / 45.4) ** 2 / (3 * np.pi * 192e3 * (2 * np.pi * 5000.0) ** 3)
    tail = 0.0 if law is LAWS[-1] else tail
    assert power + tail == pytest.approx(1.0, abs=3e-9)


@pytest.mark.parametrize("law", LAWS)
def test_power_by_lyapunov_of_the_linearised_car(law):
    """To 1e-9: the mean product of strut force and travel rate, of its state space under white road velocity w.

    Displacements count from the road: x' = A x - e w, where e = -A^-1 B are the states on a road of unit height.
    """
    linear = at_5_khz(law)
    closed = linear.closed(responses=["strut_force", "suspension_travel_rate"])
    e = -np.linalg.solve(closed.A, closed.B)
    covariance = solve_continuous_lyapunov(closed.A, -INTENSITY * e @ e.T)
    outputs = closed.C @ covariance @ closed.C.T
    assert outputs[0, 1] == pytest.approx(EXACT, rel=1e-9)
    if law is not LAWS[-1]:  # the law's own rate is that of the travel
        (one,) = linear.laws.values()
        assert one.equivalent * outputs[1, 1] == pytest.approx(EXACT, rel=1e-9)
        assert one.deviation == pytest.approx(np.sqrt(outputs[1, 1]), rel=1e-8)


@pytest.mark.parametrize("law", LAWS)
def test_power_simulated_has_its_exact_value_in_the_interval(law):
    """Up to 40 Hz, in time by strut force times travel rate; linearised as the cross-spectrum of both has it."""
    measures, bounds = ["SWS", "damper_power"], {"spring": (20e3, 24e3)}
    problem = sc.RideProblem(on(law), WHITE, speed=SPEED, band=(0.1, 40.0), bounds=bounds, measures=measures)
    row = sc.certify(problem, [SPRING], 600.0, range(4)).to_frame().loc[("1", "damper_power")]
    assert row.low < EXACT < row.high
    f = np.linspace(0.1, 40.0, 20_001)
    linear = sc.linearised(on(law), {"spring": SPRING}, WHITE, SPEED, band=(0.1, 40.0))
    closed = linear.closed(responses=["strut_force", "suspension_travel_rate"])
    force, rate = closed(2j * np.pi * f)[:, 0] / (2j * np.pi * f)
    spectrum = 2 * INTENSITY * (force * rate.conj()).real  # one-sided, of 1 m/s of road velocity
    assert row.linearised == pytest.approx(
        np.trapezoid(spectrum, f), rel=1e-5
    )  # the rule errs by its step squared
    assert row.high - row.low < 0.1 * EXACT
    assert row.simulated == pytest.approx(row.equivalent, rel=0.02)  # sampling cancels


def test_power_of_a_plain_damper_is_exact_and_that_of_driving():
    """pi^2 K_t Gd(n0) n0^2 V on a road of waviness 2; a band to 1 kHz is 1.2e-7 short, nodes resolve 1e-6."""
    for spring, damper in ((22e3, 1500.0), (12e3, 4000.0)):
        table = sc.ride(QUARTER, (spring, damper), WHITE, SPEED, band=(0.0, 1000.0), measures=["damper_power"])
        assert table["value"].iloc[0] == pytest.approx(np.pi**2 * 192e3 * 256e-6 * 0.1**2 * SPEED, rel=1e-5)
    bounds = {"spring": (20e3, 24e3), "damper": (1e3, 2e3)}
    problem = sc.RideProblem(
        QUARTER, WHITE, speed=SPEED, band=BAND, bounds=bounds, measures=["SWS", "damper_power"]
    )
    row = sc.certify(problem, [22e3, 1500.0], 2000.0, range(4)).to_frame().loc[("1", "damper_power")]
    assert row.low < row.linearised < row.high


def test_dampers_of_a_network_count_by_their_own_rate():
    """A plain damper by installation ratios, a friction and a law behind a mount: in sum what the tyre gives."""
    plain = sc.parallel(sc.Damper("beside", 500.0, installation_ratio=0.8), sc.Friction(force=60.0))
    car = on(plain, sc.series(BLOW_OFF, sc.Spring("mount", 250e3)))
    linear = sc.linearised(car, {"spring": SPRING}, WHITE, SPEED, band=BAND)
    table = sc.ride(car, {"spring": SPRING}, WHITE, SPEED, band=BAND, measures=["damper_power"])["value"]
    laws = sum(one.equivalent * one.deviation**2 for one in linear.laws.values())
    expected = laws + 500.0 * 0.8**2 * table["suspension_travel_rate"] ** 2
    assert table["damper_power"] == pytest.approx(expected, rel=1e-6)
    whole = sc.ride(car, {"spring": SPRING}, WHITE, SPEED, band=(0.0, 1000.0), measures=["damper_power"])["value"]
    assert whole["damper_power"] == pytest.approx(EXACT, rel=1e-5)


def test_each_wheel_has_the_power_of_its_own_dampers():
    """Laws in front alone: the rear has that of its plain dampers, left and right are alike."""
    car = replace(FULL, front_strut=sc.parallel(sc.Spring(), BLOW_OFF))
    setting = {"front.spring": 19e3, "rear": struts_of(FULL)["rear"]}
    names = [f"damper_power {place}" for place in ("front", "front_left", "rear", "rear_right")]
    table = sc.ride(car, setting, ROAD, SPEED, band=BAND, measures=names)["value"]
    linear = sc.linearised(car, setting, ROAD, SPEED, band=BAND).laws["front.damper"]
    assert table["damper_power front"] == pytest.approx(linear.equivalent * linear.deviation**2, rel=1e-6)
    assert table["damper_power front_left"] == pytest.approx(table["damper_power front"], rel=1e-9)
    rate = table["rear_right_suspension_travel_rate"]
    assert table["damper_power rear_right"] == pytest.approx(struts_of(FULL)["rear"][1] * rate**2, rel=1e-9)


@pytest.mark.parametrize(
    ("part", "name"),
    [
        (sc.series(sc.Damper(), sc.Spring("mount")), "damper"),
        (sc.Rubber("bush", storage=1e5, loss=1e4), "bush"),
        (sc.series(BLOW_OFF, sc.Rubber("bush", storage=1e5, loss=1e4)), "bush"),
    ],
)
def test_losses_without_a_rate_of_their_own_are_named(part, name):
    case = sc.LoadCase(vehicle=on(part), road=ROAD, speed=SPEED)
    with pytest.raises(ValueError, match=rf"^damper_power must be of dampers beside springs.* got {name}$"):
        sc.DamperPower().in_case(case, None)
