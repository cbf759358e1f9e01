"""Struts of elements in parallel and in series, against models that python-control joins."""

import re

import control
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import suspension_ctrl as sc

CAR = {"body_mass": 317.5, "wheel_mass": 45.4, "tyre_stiffness": 192e3}
OMEGA = 2 * np.pi * np.array([0.3, 1.2, 4.0, 11.0, 19.0])
SETTING = {"spring": 22e3, "damper": 1500.0, "mount": 250e3, "inerter": 40.0}

SPRING, DAMPER, MOUNT, INERTER = sc.Spring(), sc.Damper(), sc.Spring("mount"), sc.Inerter()
LAYOUTS = {
    "zener": sc.parallel(SPRING, sc.series(DAMPER, MOUNT)),
    "mount below all": sc.series(sc.parallel(SPRING, DAMPER), MOUNT),
    "inerter in parallel": sc.parallel(SPRING, DAMPER, INERTER),
    "inerter in series": sc.parallel(SPRING, sc.series(INERTER, DAMPER)),
    "inerter on a mount": sc.parallel(SPRING, DAMPER, sc.series(INERTER, MOUNT)),
    "three in series": sc.parallel(SPRING, sc.series(INERTER, DAMPER, MOUNT)),
}


def impedance(strut, values, s):
    """Dynamic stiffness, element by element in complex numbers."""
    power = {sc.Spring: 0, sc.Damper: 1, sc.Inerter: 2}
    if type(strut) in power:
        own = values[strut.name] * s ** power[type(strut)]
    else:
        parts = [impedance(part, values, s) for part in strut.parts]
        own = 1 / sum(1 / part for part in parts) if type(strut).__name__ == "Series" else sum(parts)
    return own * strut.installation_ratio**2


def joined_by_control(strut, values):
    """The quarter car by python-control's feedback of transfer functions around the plant."""
    s = control.tf("s")
    tension = impedance(strut, values, s)
    plant = sc.QuarterCar(**CAR).plant(["body_acceleration"])
    fed = control.feedback(control.tf(plant["deflection", "strut"]), -tension)
    return lambda w: (
        plant["body_acceleration", "road"](1j * w)
        + plant["body_acceleration", "strut"](1j * w) * tension(1j * w) * fed(1j * w)
        / plant["deflection", "strut"](1j * w) * plant["deflection", "road"](1j * w)
    )  # fmt: skip


@pytest.mark.parametrize("layout", LAYOUTS)
def test_a_closed_network_is_the_model_of_python_control(layout):
    strut = LAYOUTS[layout]
    car = sc.QuarterCar(**CAR, strut=strut)
    own = {name: SETTING[name] for name in (one.name for one in car.strut_coefficients)}
    found = car.closed(own).frequency_response(OMEGA).frdata[0, 0]
    joined = joined_by_control(strut, own)
    np.testing.assert_allclose(found, [joined(w) for w in OMEGA], rtol=1e-9)


@settings(max_examples=40, deadline=None)
@given(
    layout=st.sampled_from(sorted(LAYOUTS)),
    scale=st.lists(st.floats(0.1, 10.0), min_size=4, max_size=4),
    ratio=st.floats(0.5, 1.0),
)
def test_a_fraction_is_the_dynamic_stiffness_of_the_elements(layout, scale, ratio):
    strut = sc.parallel(LAYOUTS[layout], sc.Damper("guide", 50.0), installation_ratio=ratio)
    values = {name: value * x for (name, value), x in zip(SETTING.items(), scale, strict=True)} | {"guide": 50.0}
    numerator, denominator = strut.fraction(values)
    s = 1j * OMEGA
    found = np.polynomial.Polynomial(numerator)(s) / np.polynomial.Polynomial(denominator)(s)
    np.testing.assert_allclose(found, impedance(strut, values, s), rtol=1e-9)


@settings(max_examples=40, deadline=None)
@given(layout=st.sampled_from(sorted(LAYOUTS)), ratio=st.floats(0.5, 1.0), factor=st.floats(0.5, 2.0))
def test_the_static_stiffness_is_the_dynamic_one_at_0_hz(layout, ratio, factor):
    strut = sc.parallel(LAYOUTS[layout], sc.Damper("guide", 50.0), installation_ratio=ratio)
    values = {name: factor * value for name, value in SETTING.items()} | {"guide": 50.0}
    numerator, denominator = strut.fraction(values)
    lowest = int(np.flatnonzero(denominator)[0])  # a series of dampers and inerters has a factor s in both
    assert strut.static_stiffness(values) == pytest.approx(numerator[lowest] / denominator[lowest], rel=1e-12)


def test_the_default_strut_is_a_spring_beside_a_damper():
    plain, given_one = sc.QuarterCar(**CAR), sc.QuarterCar(**CAR, strut=sc.parallel(sc.Spring(), sc.Damper()))
    assert plain == given_one
    np.testing.assert_array_equal(plain.closed(22e3, 1500.0).A, given_one.closed(22e3, 1500.0).A)


def test_axles_and_seats_have_struts_of_their_own():
    full = sc.load_vehicle("jian_2022_full").vehicle
    car = sc.FullCar(
        **{name: getattr(full, name) for name in full.__dataclass_fields__ if "strut" not in name},
        front_strut=LAYOUTS["zener"],
    )
    seat = sc.Seat(mass=75.0, name="driver", strut=sc.series(sc.Spring("foam"), LAYOUTS["zener"])).on(car)
    names = [one.name for one in seat.strut_coefficients]
    assert names[:5] == ["front.spring", "front.damper", "front.mount", "rear.spring", "rear.damper"]
    assert names[-4:] == ["driver.foam", "driver.spring", "driver.damper", "driver.mount"]


@pytest.mark.parametrize(
    ("make", "error"),
    [
        (lambda: sc.parallel(sc.Spring()), "parallel must be of two elements or more"),
        (lambda: sc.series(sc.Spring(), 3.0), "series must be of two elements or more"),
        (lambda: sc.parallel(sc.Spring(), sc.Spring()), "names of their own, got spring twice"),
        (lambda: sc.Seat(mass=75.0, spring=1e4), "damper must be finite and > 0 N s/m, got None"),
    ],
)
def test_errors(make, error):
    with pytest.raises(ValueError, match=re.escape(error)):
        make()
