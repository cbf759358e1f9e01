"""One strut of springs, dampers and inerters beside its loop closed by numpy at every frequency."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import suspension_ctrl as sc
from suspension_ctrl.response.mean_squares import case_of
from suspension_ctrl.response.measures.terms import Term
from suspension_ctrl.response.one_fraction import OneFraction
from suspension_ctrl.response.one_port import OnePort
from suspension_ctrl.response.ports import Ports
from suspension_ctrl.response.quadrature import frequency_nodes

ROAD, BAND, NODES = sc.PowerLawRoad(roughness=5e-6, exponent=2.5), (0.1, 20.0), 72
TERMS = [Term("body_acceleration"), Term("suspension_travel"), Term("tyre_load"), Term("body_velocity")]
MOUNTED = sc.series(sc.Damper("damper"), sc.Spring("mount"), installation_ratio=0.8)
BESIDE = sc.parallel(sc.Spring(), MOUNTED)  # of degree 1, six rows below
RELAY = sc.series(sc.Damper("relay"), sc.parallel(sc.Spring("a"), sc.Spring("b")))
CHAINS = sc.parallel(sc.Spring(), MOUNTED, RELAY)


def case_around(strut, tyre_damping: float) -> tuple[sc.LoadCase, OneFraction]:
    car = sc.QuarterCar(
        body_mass=317.5, wheel_mass=45.4, tyre_stiffness=192e3, tyre_damping=tyre_damping, strut=strut
    )
    case, setting = sc.LoadCase(vehicle=car, road=ROAD, speed=20.0), dict.fromkeys(names_of(car), 1.0)
    found = case_of(case, TERMS, setting, list(setting), BAND, NODES)
    assert isinstance(found, OneFraction)
    return case, found


def names_of(car: sc.QuarterCar) -> list[str]:
    return [one.name for one in car.strut_coefficients]


def by_numpy(case: sc.LoadCase, design: np.ndarray) -> np.ndarray:
    """Return the mean squares (k,) of one design by complex numbers."""
    f, w = frequency_nodes(BAND, NODES, case.breakpoints)
    s, values = 2j * np.pi * f, dict(zip(names_of(case.vehicle), design.tolist(), strict=True))
    upper, lower = (np.polynomial.polynomial.polyval(s, one) for one in case.vehicle.strut.fraction(values))
    ports = Ports.of(case.vehicle, f, [term.response for term in TERMS]).around((upper / lower)[:, None, None])
    return np.asarray((w * case.psd(f) * np.abs(ports.h[:, : ports.m, 0].T) ** 2).sum(axis=1))


CASES = {(rows, damping): case_around(strut, damping) for rows, strut, damping in (
    (6, BESIDE, 0.0), (12, BESIDE, 120.0), (12, CHAINS, 0.0))}  # fmt: skip
coefficients = st.lists(st.floats(0.2, 5.0), min_size=6, max_size=6)
USUAL = {"spring": 22e3, "damper": 1500.0, "mount": 2e5, "relay": 500.0, "a": 3e4, "b": 5e4}


def design_of(case: sc.LoadCase, factors: list[float]) -> np.ndarray:
    return np.array([USUAL[name] * x for name, x in zip(names_of(case.vehicle), factors, strict=False)])


@pytest.mark.parametrize("rows", CASES)
@settings(max_examples=20)
@given(factors=coefficients)
def test_mean_squares_are_those_of_the_closed_loop(rows, factors):
    """Near a resonance of a light damper three digits cancel out: 3e-13 in 9,000 designs of these boxes."""
    case, squares = CASES[rows]
    assert len(squares.denominator) == len(squares.below) == rows[0]
    design = design_of(case, factors)
    np.testing.assert_allclose(squares(design[None])[0], by_numpy(case, design), rtol=1e-12)


@pytest.mark.parametrize("rows", CASES)
def test_designs_are_worked_out_each_for_itself(rows):
    case, squares = CASES[rows]
    designs = np.array([design_of(case, list(row)) for row in np.random.default_rng(1).uniform(0.5, 2.0, (9, 6))])
    alone = np.vstack([squares(design[None]) for design in designs])
    for count in (9, 6):
        np.testing.assert_array_equal(squares(designs[:count]), alone[:count])


def test_no_size_of_coefficients_overflows():
    """The square of a denominator of two stiffnesses holds the eighth power of one."""
    _, squares = CASES[6, 0.0]
    found = squares(np.array([[1e35, 1e35, 1e35], [1e-20, 1e-20, 1e-20]]))
    assert np.isfinite(found).all()
    assert (found > 0).all()


def test_other_struts_have_another_way():
    """An inerter beside a damper on a mount is of degree 3; rubber and laws are no fractions."""
    for part in (sc.Inerter(value=10.0), sc.Rubber(storage=2e5, loss=2e4), sc.Friction(force=50.0)):
        car = sc.QuarterCar(
            body_mass=317.5, wheel_mass=45.4, tyre_stiffness=192e3, strut=sc.parallel(BESIDE, part)
        )
        case = sc.LoadCase(vehicle=car, road=ROAD, speed=20.0)
        setting = {name: USUAL.get(name, 10.0) for name in names_of(car)}
        assert isinstance(case_of(case, TERMS, setting, list(setting), BAND, NODES), OnePort)
