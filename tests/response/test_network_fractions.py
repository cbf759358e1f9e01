"""Networks as fractions of polynomials, in plain Python, beside those of struts by numpy."""

import numpy as np
import pytest

import suspension_ctrl as sc
from suspension_ctrl.response.network_fractions import (
    DEGREE,
    PARTS,
    at_port,
    degrees,
    fill_fractions,
    mirrored,
    whole,
)
from suspension_ctrl.response.network_rows import DIRECT, fill_direct
from suspension_ctrl.response.strut_data import networks_of, nominal_state

MOUNTED = sc.series(sc.Damper("d", 1500.0), sc.Spring("k", 2e5))
CHAINS = sc.parallel(
    sc.series(sc.Damper("a", 900.0), sc.Spring("b", 3e5), installation_ratio=0.8),
    sc.series(sc.Spring("c", 1e5), sc.parallel(sc.Damper("e", 400.0), sc.Spring("f", 5e4))),
    installation_ratio=0.9,
)
BUSH = sc.series(sc.Inerter("g", 60.0), sc.parallel(sc.Spring("h", 1e5), sc.Damper("i", 300.0)))


@pytest.mark.parametrize(
    ("strut", "expected"),
    [(MOUNTED, (1, 1)), (CHAINS, (2, 2)), (BUSH, (3, 2)), (sc.series(sc.Damper("d"), sc.Inerter("b")), (3, 2))],
)
def test_degrees_are_those_of_the_polynomials(strut, expected):
    """The last could be divided by s."""
    fraction = strut.fraction({one.name: one.default or 1.0 for one in strut.coefficients})
    assert tuple(len(part) - 1 for part in fraction) == degrees(strut) == expected


@pytest.mark.parametrize("part", [sc.Friction(force=50.0), sc.Rubber("r", storage=2e5, loss=2e4)])
def test_laws_and_rubber_are_no_fractions(part):
    assert not degrees(sc.series(sc.Damper("d"), sc.parallel(sc.Spring("k"), part))).few


@pytest.mark.parametrize(
    ("beside", "expected"),
    [((sc.Spring(),), (1, 1)), ((sc.Spring(), sc.Damper()), (2, 1)), ((sc.Spring(), sc.Inerter()), (3, 1))],
)
def test_a_port_has_the_elements_beside_its_network(beside, expected):
    car = sc.QuarterCar(body_mass=300.0, wheel_mass=30.0, tyre_stiffness=2e5, strut=sc.parallel(*beside, MOUNTED))
    assert at_port(car) == expected
    assert at_port(car).few == (max(expected) <= DEGREE)


@pytest.mark.parametrize("strut", [MOUNTED, CHAINS])
def test_the_fraction_of_a_network_is_its_dynamic_stiffness(strut):
    car = sc.QuarterCar(
        body_mass=300.0, wheel_mass=30.0, tyre_stiffness=2e5, strut=sc.parallel(sc.Spring("own", 2e4), strut)
    )
    networks = networks_of(car, car.coefficients({}), [], np.array([1.0]), np.eye(1) > 0)
    direct, rows = np.empty((networks.row.size, DIRECT)), np.empty((1 + networks.row.max(), PARTS))
    root = networks.root[0]
    fill_direct(networks, networks.setting, nominal_state(networks)[0], direct)
    fill_fractions(networks, direct, rows)
    s = 2j * np.pi * np.linspace(0.3, 20.0, 7)
    found, expected = whole(direct, root, rows, networks.row[root]), strut.fraction(car.coefficients({}))
    n, d = (np.polynomial.polynomial.polyval(s, part) for part in found)
    upper, lower = (np.polynomial.polynomial.polyval(s, part) for part in expected)
    np.testing.assert_allclose(n / d, upper / lower, rtol=1e-13)  # some thirty roundings


def test_products_at_minus_s():
    rng = np.random.default_rng(0)
    a, b = rng.normal(size=(2, DEGREE + 1))
    expected = np.polynomial.polynomial.polymul(a * [1, -1, 1], b)
    np.testing.assert_allclose(mirrored(a, b), expected, rtol=1e-14, atol=1e-15)
