"""Parameters of vehicles by name: their values, and vehicles with other ones, against those built anew."""

from dataclasses import replace

import numpy as np
import pytest

from garage import DRIVER, FULL, HALF, QUARTER
from suspension_ctrl import Damper, Payload, Spring, parallel
from suspension_ctrl.vehicles.parameters import alike, parameters_of


def test_names_are_those_of_the_car():
    fields = vars(QUARTER)
    for name in ("body_mass", "wheel_mass", "tyre_stiffness", "tyre_damping"):
        assert parameters_of(QUARTER.assembly)[name].default == fields[name]
    fields, own = vars(FULL), parameters_of(FULL.assembly)
    of_car = [name for name in own if "ratio" not in name]
    assert {name: own[name].default for name in of_car} == {name: fields[name] for name in of_car}
    assert len(of_car) == 9


def test_a_seat_and_a_load_have_parameters_of_their_own():
    laden = Payload(mass=100.0, position=(-1.0, 0.0)).on(Payload(mass=50.0).on(DRIVER.on(HALF)))
    own = {name: (one.default, one.unit) for name, one in parameters_of(laden.assembly).items()}
    assert own["driver.mass"] == (80.0, "kg")
    assert own["driver.x"] == (0.3, "m")
    assert "driver.y" not in own  # no roll
    assert (own["payload.mass"], own["payload_2.mass"]) == ((50.0, "kg"), (100.0, "kg"))


def test_left_and_right_are_one_while_they_are_equal():
    groups = alike({"front_left": 1.0, "front_right": 1.0, "rear_left": 1.0, "rear_right": 2.0})
    assert groups == {
        "front": ["front_left", "front_right"],
        "rear_left": ["rear_left"],
        "rear_right": ["rear_right"],
    }


STRUT = parallel(Spring(), Damper(installation_ratio=0.9), installation_ratio=0.8)


@pytest.mark.parametrize(
    ("car", "name", "value", "anew"),
    [
        (FULL, "front_tyre_stiffness", 150e3, replace(FULL, front_tyre_stiffness=150e3)),
        (FULL, "rear_tyre_damping", 90.0, replace(FULL, rear_tyre_damping=90.0)),
        (FULL, "rear_wheel_mass", 60.0, replace(FULL, rear_wheel_mass=60.0)),
        (FULL, "roll_inertia", 600.0, replace(FULL, roll_inertia=600.0)),
        (DRIVER.on(FULL), "driver.mass", 110.0, replace(DRIVER, mass=110.0).on(FULL)),
        (DRIVER.on(FULL), "driver.y", -0.2, replace(DRIVER, position=(0.3, -0.2)).on(FULL)),
        (Payload(mass=50.0).on(FULL), "payload.mass", 90.0, Payload(mass=90.0).on(FULL)),
        (replace(QUARTER, strut=STRUT), "installation_ratio", 0.7,
         replace(QUARTER, strut=replace(STRUT, installation_ratio=0.7))),
    ],
)  # fmt: skip
def test_a_vehicle_with_another_value_is_one_built_anew(car, name, value, anew):
    """Equal matrices: rounding of a ratio of ratios alone."""
    values = dict.fromkeys((one.name for one in car.strut_coefficients if one.default is None), 15e3)
    changed, coefficients = car.at({**values, name: value})
    for one, other in zip(
        (changed.closed(coefficients), changed.plant()), (anew.closed(values), anew.plant()), strict=True
    ):
        for matrix in "ABCD":
            np.testing.assert_allclose(getattr(one, matrix), getattr(other, matrix), rtol=1e-12, atol=1e-9)
    assert changed.variables[name].default == value
