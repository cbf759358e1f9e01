"""Signals by other names, units and signs: the system is the same but for factors."""

import re

import control
import numpy as np
import pytest

from garage import HALF
from suspension_ctrl.vehicles.signals import own_label, renamed

F = np.array([0.5, 2.0, 11.0])
SYSTEM = HALF.plant(["body_acceleration", "front_tyre_load"])
INPUTS, OUTPUTS = SYSTEM.input_labels, SYSTEM.output_labels
FACTORS = {"front_road": 1e-3, "rear_road": 0.3048, "front_strut": -1e3, "rear_strut": 1.0}
UNITS = {"front_road": "mm", "rear_road": "ft", "front_strut": "kN", "rear_strut": "N"}
TEXTS = [f"{'-' * (FACTORS[name] < 0)}{name} [{UNITS[name]}]" for name in INPUTS]


def unnamed(inputs: int = 4, outputs: int = 6) -> control.StateSpace:
    """The plant in other units and without names: an input of 1 is a factor of SI, of the outputs g and mm."""
    by = np.array([FACTORS[name] for name in INPUTS])
    of = np.array([9.80665, *[1.0] * 5])[:, None]
    b, c, d = SYSTEM.B * by, SYSTEM.C / of, SYSTEM.D * by / of
    return control.ss(SYSTEM.A, b[:, :inputs], c[:outputs], d[:outputs, :inputs])


def texts(first: str = "body_acceleration [g]") -> list[str]:
    units = ["N", "m", "m", "m/s", "m/s"]
    return [first, *(f"{name} [{unit}]" for name, unit in zip(OUTPUTS[1:], units, strict=True))]


@pytest.mark.parametrize("table", [False, True])
def test_units_and_signs_are_taken_back(table):
    found, s = unnamed(), 2j * np.pi * F
    if table:
        found = control.frd(found(s), 2 * np.pi * F, inputs=found.input_labels, outputs=found.output_labels)
    found = renamed(found, TEXTS, texts())
    assert (found.input_labels, found.output_labels) == (INPUTS, OUTPUTS)
    if not table:
        assert found.state_labels == [f"x[{i}]" for i in range(8)]
    at = found.frdata if table else found(s)
    np.testing.assert_allclose(at, SYSTEM(s), rtol=1e-12, atol=1e-14 * np.abs(SYSTEM(s)).max())


def test_signals_by_their_own_names_in_any_order_and_others_are_left_out():
    mine = unnamed()
    mine.update_names(inputs=["zv", "zh", own_label("axle.f"), "fh"])
    found = renamed(
        mine, {"axle.f": "-front_strut [kN]", "zv": "front_road [mm]"}, {"y[0]": "body_acceleration [g]"}
    )
    assert (found.input_labels, found.output_labels) == (["front_strut", "front_road"], ["body_acceleration"])
    np.testing.assert_allclose(
        found(1j), SYSTEM[["body_acceleration"], ["front_strut", "front_road"]](1j), rtol=1e-12
    )


def test_blank_texts_leave_signals_out_and_no_names_change_nothing():
    found = renamed(unnamed(), ["", "", *TEXTS[2:]], texts(""))
    assert (found.input_labels, found.output_labels) == (INPUTS[2:], OUTPUTS[1:])
    assert renamed(SYSTEM, None, None).output_labels == OUTPUTS


def test_signals_of_other_kinds_have_a_name_alone():
    assert renamed(unnamed(), TEXTS, texts("noise")).output_labels[0] == "noise"


@pytest.mark.parametrize(
    ("inputs", "outputs", "message"),
    [
        (TEXTS[:3], None, "inputs must be 4 names, one for each of ['u[0]', 'u[1]', 'u[2]', 'u[3]'], got 3"),
        ("road", None, "inputs must be a list, got 'road'"),
        (None, [*texts()[:5], 3], "outputs must be texts like 'front_deflection [mm]', got 3"),
        (["+front_road [m]", *TEXTS[1:]], None,
         "inputs must be texts like 'front_strut [N]', got '+front_road [m]'"),
        (["front_road", *TEXTS[1:]], None,
         "front_road must have its unit, as in 'front_road [m]', got 'front_road'"),
        (["front_road [N]", *TEXTS[1:]], None, "front_road must be in m or a unit like it, got '1 N' in N"),
        (None, texts("noise [dB]"),
         "noise must be in units of kg, m, s, rad, cycle, t, lb, km, cm, mm, in, ft, ms, min, h, mph, Hz, N, kN, "
         "lbf, g, %, deg, got 'dB'"),
        ([TEXTS[0]] * 4, None, "inputs must be names that differ, got 'front_road' twice"),
        ([""] * 4, None, "inputs must be names that differ, got none"),
        ({"u[9]": "road [m]"}, None, "inputs must be one of u[0], u[1], u[2], u[3], got 'u[9]'"),
    ],
)  # fmt: skip
def test_other_names_are_one_line(inputs, outputs, message):
    with pytest.raises(ValueError, match="^" + re.escape(message) + "$"):
        renamed(unnamed(), inputs, outputs)


def test_a_response_that_was_not_measured_is_named():
    h = np.full((1, 2, 4), 1.0 + 0j)
    h[0, 1] = np.nan
    system = control.frd(h, np.arange(1.0, 5.0), inputs=["1:+Z", "2:+Z"], outputs=["3:+Z"])
    found = renamed(system, {"1:+Z": "road [mm]"}, {"3:+Z": "deflection [m]"})
    np.testing.assert_allclose(found.frdata, 1e3)
    with pytest.raises(ValueError, match=r"^system must have the response of 3:\+Z to 2:\+Z, got none$"):
        renamed(system, ["road [m]", "strut [N]"], ["deflection [m]"])
