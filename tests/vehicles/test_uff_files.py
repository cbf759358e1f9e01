"""Universal Files, written by the tests' own writer: responses by node and direction; bad files are one line."""

import re

import numpy as np
import pytest

from garage import DAMPED_HALF
from programs import universal
from suspension_ctrl import Plant
from suspension_ctrl.vehicles.uff_files import read_uff

F = np.arange(0, 401) * 0.0625  # Hz, exact in the five digits of the format
NODES = {"front_road": (1, 3), "rear_road": (2, 3), "front_strut": (11, -3), "rear_strut": (12, 3)}
PLACES = {"body_acceleration": (20, 3), "front_deflection": (21, 0), "rear_deflection": (22, 5)}


def h(f):
    found = DAMPED_HALF.plant(["body_acceleration"]).frequency_response(2 * np.pi * np.maximum(f, 1e-3))
    return {(o, i): found[o, i].frdata.ravel() for o in PLACES for i in NODES}


def content(f=F, pairs=None):
    found = h(f)
    return universal([(PLACES[o], NODES[i], found[o, i]) for o, i in pairs or found], f)


def test_a_rig_measures_a_half_car(tmp_path):
    """To the thirteen digits of the format, frequencies to six; the line at 0 Hz is left out."""
    (tmp_path / "rig.uff").write_bytes(content())
    system = read_uff(tmp_path / "rig.uff")
    assert system.input_labels == ["1:+Z", "2:+Z", "11:-Z", "12:+Z"]
    assert system.output_labels == ["20:+Z", "21:scalar", "22:+RY"]
    np.testing.assert_allclose(system.omega, 2 * np.pi * F[1:], rtol=1e-12)
    for (output, given), values in h(F[1:]).items():
        row, column = list(PLACES).index(output), list(NODES).index(given)
        np.testing.assert_allclose(system.frdata[row, column], values, rtol=1e-11, atol=0)
    plant = Plant.named(
        system,
        inputs=["front_road [m]", "rear_road [m]", "front_strut [N]", "rear_strut [N]"],
        outputs={"20:+Z": "body_acceleration [m/s^2]", "21:scalar": "front_deflection [m]",
                 "22:+RY": "rear_deflection [m]"},
        contacts={"front": (1.2, 0.0), "rear": (-1.5, 0.0)},
    )  # fmt: skip
    assert plant.struts == ("front", "rear")


def test_a_pair_that_was_not_measured_has_no_numbers(tmp_path):
    pairs = [pair for pair in h(F) if pair != ("front_deflection", "rear_road")]
    (tmp_path / "rig.unv").write_bytes(content(pairs=pairs))
    missing = np.isnan(read_uff(tmp_path / "rig.unv").frdata).all(axis=2)
    assert np.argwhere(missing).tolist() == [[1, 1]]


@pytest.mark.parametrize(
    ("text", "message"),
    [
        (b"", "the file must hold frequency responses of function type 4, got 0 other functions"),
        (content().replace(b"\n    4         1", b"\n    1         1"),
         "the file must hold frequency responses of function type 4, got 12 other functions"),
        (content() + content(pairs=[("body_acceleration", "rear_strut")]),
         "responses must differ, got 20:+Z to 12:+Z twice"),
        (content() + content(F + 1, pairs=[("body_acceleration", "rear_strut")]).replace(b"20   3", b"29   3"),
         "responses must have the same frequencies, got others of 29:+Z to 12:+Z"),
        (content().replace(b"0.0", b"x.y"),
         "the file must be a Universal File with datasets 58, got one that cannot be read"),
    ],
)  # fmt: skip
def test_other_files_are_one_line(tmp_path, text, message):
    (tmp_path / "rig.uff").write_bytes(text)
    with pytest.raises(ValueError, match="^" + re.escape(message) + "$"):
        read_uff(tmp_path / "rig.uff")
