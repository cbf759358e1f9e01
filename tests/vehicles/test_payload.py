"""A load fixed to the body against the car that has it in its masses and inertias."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from suspension_ctrl import HalfCar, Payload, QuarterCar

CAR = {
    "body_mass": 690.0, "pitch_inertia": 1220.0, "front_wheel_mass": 40.5, "rear_wheel_mass": 45.4,
    "front_tyre_stiffness": 192e3, "rear_tyre_stiffness": 192e3, "cg_to_front": 1.25, "cg_to_rear": 1.51,
}  # fmt: skip
STRUTS = {"front": (17e3, 1500.0), "rear": (22e3, 1500.0)}


@settings(max_examples=25)
@given(st.floats(1, 500), st.floats(-1.5, 1.2), st.floats(0.2, 20))
def test_a_loaded_half_car_is_the_one_with_its_centre_of_gravity_moved(mass, x, f):
    """By Steiner's theorem: inertia about the common centre of gravity, at m x / (m + M) from the old one."""
    total = CAR["body_mass"] + mass
    moved = mass * x / total
    inertia = CAR["pitch_inertia"] + CAR["body_mass"] * moved**2 + mass * (x - moved) ** 2
    equal = HalfCar(**CAR | {
        "body_mass": total, "pitch_inertia": inertia,
        "cg_to_front": CAR["cg_to_front"] - moved, "cg_to_rear": CAR["cg_to_rear"] + moved,
    })  # fmt: skip
    loaded = Payload(mass=mass, position=(x, 0.0)).on(HalfCar(**CAR))
    responses = ["pitch_acceleration", "front_suspension_travel", "rear_tyre_load"]
    found = loaded.closed(STRUTS, responses=[*responses, ("acceleration", 0.7, 0.0)])(2j * np.pi * f)
    expected = equal.closed(STRUTS, responses=[*responses, ("acceleration", 0.7 - moved, 0.0)])(2j * np.pi * f)
    np.testing.assert_allclose(found, expected, rtol=1e-9, atol=1e-12 * np.abs(expected).max())


def test_it_weighs_on_the_tyres_by_the_lever_rule():
    loaded = Payload(mass=100.0, position=(-1.51, 0.0)).on(HalfCar(**CAR))
    empty = HalfCar(**CAR)
    coefficients = np.array([[17e3, 1500.0, 22e3, 1500.0]])
    more = loaded.statics.static_loads(coefficients) - empty.statics.static_loads(coefficients)
    np.testing.assert_allclose(more, [[0.0, 980.665]], atol=1e-9)


def test_on_a_quarter_car_it_is_body_mass():
    car = {"body_mass": 317.5, "wheel_mass": 45.4, "tyre_stiffness": 192e3}
    loaded = Payload(mass=75.0).on(QuarterCar(**car)).closed({"spring": 22e3, "damper": 1500.0})
    heavier = QuarterCar(**car | {"body_mass": 392.5}).closed(22e3, 1500.0)
    np.testing.assert_allclose(loaded(20j), heavier(20j), rtol=1e-12)


@pytest.mark.parametrize(
    ("mass", "position"), [(0.0, (0.0, 0.0)), (1.0, (0.0,)), (1.0, (np.nan, 0.0)), (1.0, "ab")]
)
def test_rejects_bad_loads(mass, position):
    with pytest.raises(ValueError, match=r"^(mass|position) must be .*, got "):
        Payload(mass=mass, position=position)
