"""Force laws as curves: knots, slopes and jumps by their coefficients."""

import re

import numpy as np
import pytest

import suspension_ctrl as sc
from suspension_ctrl.vehicles.networks import Program, fill_curve

NAN = float("nan")


def curve(law, **values):
    """Knots, slopes and jumps of a law in a quarter car with these coefficients beside the defaults."""
    strut = sc.parallel(sc.Spring("held"), law)
    car = sc.QuarterCar(body_mass=300.0, wheel_mass=30.0, tyre_stiffness=2e5, strut=strut)
    coefficients = car.coefficients({"held": 2e4} | {f"{law.name}.{name}": x for name, x in values.items()})
    laws = Program.of(car.networks, list(coefficients)).laws
    found, k = np.empty(laws.number.shape[1:3]), laws.most[0]
    fill_curve(laws.number[0], laws.by[0], np.array(list(coefficients.values())), found)
    return found[0, :k], found[1, : k + 1], found[2, :k]


@pytest.mark.parametrize(
    ("law", "values", "expected"),
    [
        (sc.TableDamper(velocity=[-1, 0, 2], force=[-500, 0, 3000]), {"scale": 2.0}, ([0], [1000, 3000], [0])),
        (sc.TableDamper(velocity=[0, 1, 2], force=[0, 3, 5]), {}, ([-1, 0, 1], [2, 3, 3, 2], [0, 0, 0])),
        (sc.BumpStop(gap=0.02, stiffness=2e5), {}, ([-0.02], [2e5, 0], [0])),
        (sc.ReboundStop(gap=0.02, stiffness=2e5), {"gap": 0.03}, ([0.03], [0, 2e5], [0])),
        (
            sc.BumpStop(gap=0.02, compression=[0, 0.01, 0.02], force=[0, 1000, 4000]),
            {"scale": 2.0},
            ([-0.03, -0.02], [6e5, 2e5, 0], [0, 0]),
        ),
        (sc.Friction(force=40.0), {}, ([0], [0, 0], [80])),
        (
            sc.DigressiveDamper(low_speed=4000, high_speed=800, knee=0.1),
            {"rebound_over_bump": 3.0},
            ([-0.1, 0, 0.1], [800, 4000, 12000, 2400], [0, 0, 0]),
        ),
        (sc.BilinearDamper(bump=750, rebound=2250), {}, ([0], [750, 2250], [0])),
    ],
)
def test_curves(law, values, expected):
    for found, numbers in zip(curve(law, **values), expected, strict=True):
        np.testing.assert_allclose(found, numbers, rtol=1e-12)


@pytest.mark.parametrize(
    ("make", "error"),
    [
        (
            lambda: sc.TableDamper(velocity=[0, 1], force=[5, 9]),
            "force must be 0 N at velocity 0, got 5 N",
        ),
        (lambda: sc.TableDamper(velocity=[-1, 0, 1], force=[-1, 0, -1]), "force must not fall over velocity"),
        (lambda: sc.TableDamper(velocity=[0, 1, 1], force=[0, 1, 2]), "velocity must ascend, got 1, then 1"),
        (lambda: sc.TableDamper(velocity=[0, 1], force=[0, NAN]), "velocity and force must be finite"),
        (lambda: sc.TableSpring(deflection=[0, 1, 2], force=[0, 1]), "deflection and force must be of one length"),
        (lambda: sc.TableSpring(deflection=[0.1, 1], force=[0.1, 1]), "got deflection from 0.1 to 1"),
        (lambda: sc.BumpStop(gap=-0.1), "gap must be finite and > 0 m, got -0.1"),
        (lambda: sc.BumpStop(gap=0.1, compression=[0, 1]), "stop must have a stiffness, or compression and force"),
        (lambda: sc.BumpStop(compression=[1, 2], force=[0, 1]), "must begin with 0 m and 0 N, got 1 m and 0 N"),
        (lambda: sc.DigressiveDamper(knee=0.0), "knee must be finite and > 0 m/s, got 0.0"),
    ],
)
def test_bad_laws_are_one_line(make, error):
    with pytest.raises(ValueError, match=re.escape(error)):
        make()


def test_a_force_law_is_not_closed_without_a_road():
    strut = sc.parallel(sc.Spring(), sc.Friction(force=40.0), sc.Damper())
    car = sc.QuarterCar(body_mass=300.0, wheel_mass=30.0, tyre_stiffness=2e5, strut=strut)
    with pytest.raises(ValueError, match=r"^strut must be of springs.*got friction$"):
        car.closed(spring=2e4, damper=1e3)


@pytest.mark.parametrize(
    ("law", "values"),
    [
        (sc.TableDamper(velocity=[-1, -0.3, 0.2, 2], force=[-500, -30, 20, 3000]), {"scale": 1.5}),
        (sc.TableSpring(deflection=[-0.5, 0, 0.5], force=[-3000, 0, 2000]), {}),
        (sc.BumpStop(gap=0.2, compression=[0, 0.1, 0.2], force=[0, 1000, 4000]), {"gap": 0.3}),
        (sc.ReboundStop(gap=0.2, stiffness=2e5), {}),
        (sc.Friction(force=40.0), {"force": 50.0}),
        (sc.DigressiveDamper(low_speed=4000, high_speed=800, knee=0.1), {"rebound_over_bump": 3.0}),
        (sc.BilinearDamper(bump=750, rebound=2250), {}),
    ],
)
def test_the_tension_is_the_integral_of_the_slopes_and_the_jumps_between(law, values):
    knot, slope, jump = curve(law, **values)
    x = np.linspace(-1.5, 2.5, 160_001)  # knots are on the grid
    middle = (x[1:] + x[:-1]) / 2
    rises = slope[np.searchsorted(knot, middle)] * np.diff(x)
    force = np.concatenate([[0.0], np.cumsum(rises)]) + sum(
        height * np.heaviside(x - place, 0.5) for place, height in zip(knot, jump, strict=True)
    )
    np.testing.assert_allclose(law.tension(x, **values), force - np.interp(0.0, x, force), rtol=0, atol=1e-6)
    assert law.tension(0.0, **values) == 0.0


def test_the_tension_of_a_fluid_damper_is_its_power_law():
    found = sc.PowerDamper(force=5000.0, exponent=2.0).tension([-0.5, 0.0, 0.1], exponent=1.5)
    np.testing.assert_allclose(found, [-5000 * 0.5**1.5, 0.0, 5000 * 0.1**1.5], rtol=1e-15)


@pytest.mark.parametrize(
    ("values", "message"),
    [
        ({"bump": 1.0}, "damper.rebound must be finite and > 0 N s/m, got nan"),
        ({"bump": 1.0, "rebound": -1.0}, "damper.rebound must be finite and > 0 N s/m, got -1.0"),
        ({"scale": 1.0}, "coefficient of damper must be one of bump, rebound, got 'scale'"),
    ],
)
def test_a_tension_needs_the_coefficients(values, message):
    with pytest.raises(ValueError, match=f"^{message}$"):
        sc.BilinearDamper().tension(0.1, **values)


@pytest.mark.parametrize(
    ("law", "expected"),
    [
        (sc.TableSpring(deflection=[-0.1, 0.0, 0.1], force=[-3000.0, 0.0, 1000.0]), [20e3, 40e3]),
        (sc.TableSpring(deflection=[-0.1, -0.05, 0.1], force=[-2000.0, -500.0, 1000.0]), [10e3, 20e3]),
        (sc.BumpStop(gap=0.02, stiffness=1e5), [0.0, 0.0]),
        (sc.Friction(force=50.0), [0.0, 0.0]),
    ],
)
def test_the_static_stiffness_of_a_law_is_its_slope_at_the_origin(law, expected):
    values = {one.name: np.array([1.0, 2.0]) * (one.default or 1.0) for one in law.coefficients}
    np.testing.assert_allclose(np.broadcast_to(law.static_stiffness(values), 2), expected, rtol=1e-12)
