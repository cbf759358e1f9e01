"""Elements by themselves: stiffness at 0 Hz and over frequency at the wheel, and what they refuse."""

import re

import numpy as np
import pytest

import suspension_ctrl as sc


@pytest.mark.parametrize(
    ("element", "order"), [(sc.Spring("one"), 0), (sc.Damper("one"), 1), (sc.Inerter("one"), 2)]
)
def test_an_element_inboard_of_the_wheel_acts_by_the_square_of_its_ratio(element, order):
    """A wheel moved by 1 m moves the element by r, whose force has the lever r: r^2 c s^order."""
    inboard, s = type(element)("one", installation_ratio=0.8), 2j
    numerator, denominator = inboard.fraction({"one": 50.0})
    stiffness = np.polyval(numerator[::-1], s) / np.polyval(denominator[::-1], s)
    assert stiffness == pytest.approx(0.64 * 50.0 * s**order, rel=1e-12)
    assert inboard.static_stiffness({"one": 50.0}) == pytest.approx(32.0 if order == 0 else 0.0, rel=1e-12)
    assert inboard.static_tension({"one": 50.0}, -0.1) == pytest.approx(-3.2 if order == 0 else 0.0, rel=1e-12)


def test_rubber_and_a_measured_mount_hold_a_load_by_their_storage_stiffness():
    rubber = sc.Rubber(storage=250e3, loss=25e3, installation_ratio=0.5)
    assert rubber.static_stiffness({"rubber.storage": 250e3, "rubber.loss": 25e3}) == 62.5e3
    rows = {"frequency": [1.0, 10.0], "storage": [240e3, 260e3], "loss": [12e3, 25e3]}
    mount = sc.MeasuredStiffness(**rows, installation_ratio=0.5)
    assert mount.static_stiffness({"mount.scale": 2.0}) == 120e3
    for element in (rubber, mount):
        with pytest.raises(ValueError, match=rf"^strut must be of springs, .* got {element.name}$"):
            element.fraction({})


@pytest.mark.parametrize(
    ("make", "error"),
    [
        (lambda: sc.Spring("two words"), "name must be of letters"),
        (lambda: sc.Damper(value=-1.0), "damper must be finite and > 0 N s/m, got -1.0"),
        (lambda: sc.Spring(installation_ratio=0.0), "installation_ratio must be finite and > 0, got 0.0"),
        (lambda: sc.Rubber(storage=-1.0), "storage must be finite and > 0 N/m, got -1.0"),
        (
            lambda: sc.MeasuredStiffness(frequency=[1.0, 2.0], storage=[1.0], loss=[1.0, 1.0]),
            "frequency, storage and loss must be of one length, 2 or more, got (2,), (1,), (2,)",
        ),
    ],
)
def test_numbers_out_of_range_are_refused(make, error):
    with pytest.raises(ValueError, match="^" + re.escape(error)):
        make()
