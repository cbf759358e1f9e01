"""Parts of a vehicle of rigid bodies: names, places, and what does not fit."""

import re

import pytest

from suspension_ctrl.vehicles.body_parts import AntiRollBar, RigidBody, Suspension, Wheel


def test_names_of_angles_and_coefficients():
    body = RigidBody(mass=1.0, pitch_inertia=2.0, roll_inertia=3.0)
    assert body.inertias == {"roll": 3.0, "pitch": 2.0}
    assert RigidBody(name="cab", mass=1.0, pitch_inertia=0.0).inertias == {"cab_pitch": 0.0}
    assert RigidBody(name="axle", mass=1.0).inertias == {}
    assert [Suspension(name="left", coefficients=c).prefix for c in ("", "front")] == ["left", "front"]
    assert Wheel(name="left", mass=1.0, tyre_stiffness=1.0).upper == "left_wheel"
    assert Wheel(name="left", carrier="axle", tyre_stiffness=1.0).upper == "axle"


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda: AntiRollBar(name="bar", struts=("a",)), "struts must be two, left and right, got ('a',)"),
        (lambda: RigidBody(name="cab_pitch", mass=1.0),
         "name must not end like an angle, _pitch or _roll, got 'cab_pitch'"),
        (lambda: Wheel(name="a", mass=3.0), "tyre_stiffness must stand with a mass or a carrier, or neither, got "
         "None with mass 3.0 and carrier ''"),
        (lambda: Wheel(name="a", mass=3.0, carrier="axle", tyre_stiffness=1e5),
         "mass must be part of the carrier if there is one, got 3.0"),
        (lambda: Wheel(name="a", mass=-3.0, tyre_stiffness=1e5), "mass must be finite and > 0 kg, got -3.0"),
    ],
)  # fmt: skip
def test_rejects_parts_that_do_not_fit(make, message):
    with pytest.raises(ValueError, match="^" + re.escape(message) + "$"):
        make()
