"""Scripts of MATLAB and Octave, by a reader of the test's own, and by Octave itself where it is installed."""

import re
import shutil
import subprocess

import control
import numpy as np
import pytest

from garage import DAMPED_HALF, QUARTER, struts_of
from suspension_ctrl import FlexibleBody, save_system
from suspension_ctrl.vehicles.matlab_scripts import write_script

NAMES = {"Input": "input_labels", "Output": "output_labels", "State": "state_labels"}


def assignments(text: str) -> dict[str, np.ndarray | list[str]]:
    """Matrices and cells that a script sets: rows of numbers, and texts in quotes, one a line."""
    found = {}
    code = re.sub("^%.*\n", "", text, flags=re.MULTILINE)
    for name, opening, body in re.findall(r"^(\w+) = ([\[{])\n(.*?)\n[\]}];$", code, re.MULTILINE | re.DOTALL):
        lines = [line.strip() for line in body.split("\n")]
        if opening == "[":
            found[name] = np.array([[float(number) for number in line.split(" ")] for line in lines])
        else:
            assert all(re.fullmatch("'(?:[^']|'')*'", line) for line in lines)
            found[name] = [line[1:-1].replace("''", "'") for line in lines]
    return found


@pytest.mark.parametrize("car", [QUARTER, DAMPED_HALF])
def test_a_script_holds_every_number_name_and_unit(tmp_path, car):
    system = car.closed(struts_of(car))
    save_system(tmp_path / "closed.m", system)
    found = assignments((tmp_path / "closed.m").read_text())
    for letter in "ABCD":
        np.testing.assert_array_equal(found[letter], getattr(system, letter))
    for kind, labels in NAMES.items():
        assert found[f"{kind}Name"] == getattr(system, labels)
        assert len(found[f"{kind}Unit"]) == len(found[f"{kind}Name"])
    units = dict(zip(found["OutputName"], found["OutputUnit"], strict=True))
    assert units["body_acceleration"] == "m/s^2"
    assert found["InputUnit"][0] == "m"
    assert {"m", "m/s"} <= set(found["StateUnit"])


def test_angles_have_radians_and_elastic_modes_no_unit(tmp_path):
    shapes = {(1.2, 0.0): (0.06,), (-1.5, 0.0): (0.06,)}
    car = FlexibleBody(frequencies=(18.0,), damping_ratios=(0.02,), shapes=shapes).on(DAMPED_HALF)
    write_script(tmp_path / "car.m", car.plant())
    found = assignments((tmp_path / "car.m").read_text())
    units = dict(zip(found["StateName"], found["StateUnit"], strict=True))
    assert (units["pitch_displacement"], units["pitch_velocity"]) == ("rad", "rad/s")
    assert units["bending_1_displacement"] == units["bending_1_velocity"] == ""


def test_a_system_without_states_and_quotes_in_names(tmp_path):
    write_script(tmp_path / "gain.m", control.ss([], [], [], [[2.0]], inputs=["o'road"], outputs=["y"]))
    text = (tmp_path / "gain.m").read_text()
    assert "A = zeros(0, 0);" in text
    assert "StateName = cell(0, 1);" in text
    assert assignments(text)["InputName"] == ["o'road"]


@pytest.mark.parametrize("stem", ["2nd", "my car", "a" * 64, "über", "car-1"])
def test_a_name_that_matlab_cannot_run_is_refused(tmp_path, stem):
    with pytest.raises(ValueError, match=r"^name of the script must be of letters, digits and underscores, 63 at"):
        save_system(tmp_path / f"{stem}.m", QUARTER.plant())
    assert not list(tmp_path.iterdir())


@pytest.mark.skipif(shutil.which("octave-cli") is None, reason="Octave is not installed")
def test_octave_runs_it_and_has_the_same_numbers(tmp_path):
    """It prints the poles and the gain at 5 rad/s, with all digits."""
    system = DAMPED_HALF.closed(struts_of(DAMPED_HALF))
    save_system(tmp_path / "closed.m", system)
    code = (
        "closed; h = C / (5i*eye(rows(A)) - A) * B + D; printf('%.17g %.17g\\n', [real(h)(:), imag(h)(:)]');"
        "printf('%s [%s]\\n', [OutputName, OutputUnit]'{:});"
    )
    done = subprocess.run(
        ["octave-cli", "--quiet", "--norc", "--eval", code],
        cwd=tmp_path,
        capture_output=True,
        text=True,
        check=True,
    )
    lines = done.stdout.splitlines()
    p, m = system.noutputs, system.ninputs
    h = np.array([complex(*map(float, line.split())) for line in lines[: p * m]]).reshape(m, p).T
    np.testing.assert_allclose(h, system(5j), rtol=1e-9)
    assert lines[p * m] == "body_acceleration [m/s^2]"
