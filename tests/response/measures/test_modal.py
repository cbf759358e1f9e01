"""Measures of modes: closed forms of the quarter car, modes of vehicles, limits."""

from dataclasses import replace
from math import pi, sqrt

import numpy as np
import pytest

from garage import FULL, QUARTER, ROAD, SPEED
from suspension_ctrl import (
    Inerter,
    Limit,
    Measure,
    ModeDamping,
    ModeFrequency,
    RideProblem,
    Spring,
    load_vehicle,
    parallel,
    series,
)
from suspension_ctrl.vehicles.cars import SPRING_AND_DAMPER

BESIDE = parallel(*SPRING_AND_DAMPER.parts, series(Spring("one", 1.0), Spring("two", 1.0)))
SETTING = {"front": (2e4, 1500.0), "rear": (2.2e4, 1600.0)}


def value_of(car, measure, setting):
    """Return a measure of one setting, as of a problem with a narrow box around it."""
    values = car.coefficients(setting)
    first = next(iter(values))
    bounds, struts = {first: (values[first], 1.1 * values[first])}, {n: v for n, v in values.items() if n != first}
    measures = (measure, "DTL")
    problem = RideProblem(
        car, ROAD, speed=SPEED, bounds=bounds, struts=struts, measures=measures, band=(0.3, 20.0)
    )
    return problem.evaluate([[values[first]]])[0, 0]


@pytest.mark.parametrize("inertance", [0.0, 20.0])
def test_frequencies_of_a_quarter_car_are_the_roots_of_its_equation(inertance):
    """det(K - w^2 M) = 0, quadratic in w^2; to rounding."""
    mb, mw, kt, k, b = QUARTER.body_mass, QUARTER.wheel_mass, QUARTER.tyre_stiffness, 2e4, inertance
    car = replace(QUARTER, strut=parallel(*SPRING_AND_DAMPER.parts, Inerter(value=b))) if b else QUARTER
    square, linear, constant = mb * mw + b * (mb + mw), mb * (k + kt) + mw * k + b * kt, k * kt
    root = sqrt(linear**2 - 4 * square * constant)
    slow, fast = (sqrt((linear + sign * root) / (2 * square)) / (2 * pi) for sign in (-1, 1))
    setting = {"spring": k, "damper": 1500.0}
    assert value_of(car, "frequency heave", setting) == pytest.approx(slow, rel=1e-12)
    assert value_of(car, "frequency wheel hop", setting) == pytest.approx(fast, rel=1e-12)


def test_a_light_damper_damps_each_mode_by_its_share():
    """z = c (f_b - f_w)^2/(2 w) of a mode of unit modal mass, but for z^2, some 4e-4."""
    setting, c = {"spring": 2e4, "damper": 100.0}, 100.0
    mass, k = np.diag([QUARTER.wheel_mass, QUARTER.body_mass]), 2e4
    squares, shapes = np.linalg.eig(np.linalg.solve(mass, [[QUARTER.tyre_stiffness + k, -k], [-k, k]]))
    for square, shape in zip(squares, shapes.T, strict=True):
        ratio = c * (shape[1] - shape[0]) ** 2 / (shape @ mass @ shape) / (2 * sqrt(square))
        mode = "heave" if square < 1000 else "wheel hop"
        assert value_of(QUARTER, f"damping_ratio {mode}", setting) == pytest.approx(ratio, rel=2e-3)


def test_ratios_are_those_of_the_table_of_modes():
    table = FULL.modes(SETTING).set_index("name")["damping ratio [-]"]
    for mode in ("heave", "pitch", "roll", "front wheel hop", "rear wheel tramp"):
        assert value_of(FULL, ModeDamping(mode), SETTING) == pytest.approx(table[mode], rel=1e-9)


def test_an_overdamped_mode_has_a_ratio_of_1():
    assert value_of(QUARTER, "damping_ratio heave", {"spring": 2e3, "damper": 2e4}) == 1.0


@pytest.mark.parametrize("name", ["cantero_2022_truck", "trucksim_cab_over"])
def test_modes_of_a_truck_are_known_by_their_names_in_the_table_of_modes(name):
    """Also of bodies that joints move; to 1e-9. One motion of each truck mixes with another in two modes."""
    file = load_vehicle(name)
    table = file.vehicle.modes(file.setting).set_index("name")["frequency [Hz]"]
    first, *others = values = file.vehicle.coefficients(file.setting)
    problem = RideProblem(
        file.vehicle, ROAD, speed=SPEED, bounds={first: (values[first], 1.1 * values[first])},
        struts={other: values[other] for other in others}, measures=(*map(ModeFrequency, table.index), "DTL"),
        band=(0.3, 20.0),
    )  # fmt: skip
    found = problem.evaluate([[values[first]]])[0, : len(table)]
    error = np.abs(found - table.to_numpy()[:, None]).min(axis=0) / found
    np.testing.assert_array_less(error, 1e-9)
    assert np.count_nonzero(np.abs(found / table - 1) > 1e-9) == 1


def test_a_limit_on_a_frequency_may_have_a_unit():
    assert Limit.parse("frequency heave <= 1.4 Hz") == Limit(ModeFrequency("heave"), 1.4)
    assert str(Measure.parse("-damping_ratio front wheel hop")) == "-damping_ratio front wheel hop"


@pytest.mark.parametrize(
    ("car", "measure", "message"),
    [
        (QUARTER, "frequency pitch", "frequency must be one of wheel hop, heave, got 'pitch'"),
        (QUARTER, "damping_ratio", "damping_ratio must be one of wheel hop, heave, got ''"),
        (replace(QUARTER, strut=BESIDE),
         "frequency heave", "frequency must be of struts of springs and dampers in parallel, got one, two"),
    ],
)  # fmt: skip
def test_rejects_motions_that_a_vehicle_does_not_have(car, measure, message):
    with pytest.raises(ValueError, match=f"^{message}$"):
        value_of(car, measure, {"spring": 2e4, "damper": 1500.0})
