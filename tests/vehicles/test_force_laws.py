"""Force laws as curves: knots, slopes and jumps by their coefficients."""

import numpy as np
import pytest

import suspension_ctrl as sc
from suspension_ctrl.vehicles.networks import Program, fill_curve


def curve(law, **values):
    """Knots, slopes and jumps of a law in a quarter car with these coefficients beside the defaults."""
    strut = sc.parallel(sc.Spring("held"), law)
    car = sc.QuarterCar(body_mass=300.0, wheel_mass=30.0, tyre_stiffness=2e5, strut=strut)
    coefficients = car.coefficients({"held": 2e4} | {f"{law.name}.{name}": x for name, x in values.items()})
    laws = Program.of(car.networks, list(coefficients)).laws
    found, k = np.empty(laws.number.shape[1:3]), laws.most[0]
    fill_curve(laws, 0, np.array(list(coefficients.values())), found)
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
