"""MATLAB's files, written by the tests' own writer: the same system with its names; others are one line."""

import re

import numpy as np
import pytest

from garage import DAMPED_HALF
from programs import matlab_4, matlab_5
from suspension_ctrl.vehicles.matlab_files import read_mat, write_mat
from suspension_ctrl.vehicles.matrices import labels_of

SYSTEM = DAMPED_HALF.plant()
MATRICES = dict(zip("ABCD", (SYSTEM.A, SYSTEM.B, SYSTEM.C, SYSTEM.D), strict=True))
UNREADABLE = (
    "the file must be a MATLAB file of version 4 to 7 with real matrices of at most 50 MB, "
    "got one that cannot be read"
)
NAMES = {"InputName": SYSTEM.input_labels, "OutputName": SYSTEM.output_labels, "StateName": SYSTEM.state_labels}


def equal(found, names=True):
    for letter, matrix in MATRICES.items():
        np.testing.assert_array_equal(getattr(found, letter), matrix)
    return not names or labels_of(found) == labels_of(SYSTEM)


@pytest.mark.parametrize("packed", [False, True])
def test_version_5_with_names_in_cells_and_other_variables(tmp_path, packed):
    path = tmp_path / "car.mat"
    path.write_bytes(matlab_5({"v": np.eye(2), **MATRICES, "Ts": np.zeros((1, 1)), **NAMES}, packed))
    assert equal(read_mat(path))


def test_version_4_without_names(tmp_path):
    (tmp_path / "car.mat").write_bytes(matlab_4({name.lower(): one for name, one in MATRICES.items()}))
    assert equal(read_mat(tmp_path / "car.mat"), names=False)


def test_linear_models_of_dymola(tmp_path):
    """One matrix, its number of states, and names by rows of characters; dots of names become underscores."""
    whole = np.block([[SYSTEM.A, SYSTEM.B], [SYSTEM.C, SYSTEM.D]])
    names = [*SYSTEM.state_labels, "car.road", *SYSTEM.input_labels[1:], *SYSTEM.output_labels]
    (tmp_path / "dslin.mat").write_bytes(matlab_4({"ABCD": whole, "nx": np.array([[8.0]]), "xuyName": names}))
    found = read_mat(tmp_path / "dslin.mat")
    assert equal(found, names=False)
    assert found.input_labels == ["car_road", *SYSTEM.input_labels[1:]]
    assert found.output_labels == SYSTEM.output_labels


def test_what_is_written_is_read(tmp_path):
    write_mat(tmp_path / "mine.mat", SYSTEM)
    assert equal(read_mat(tmp_path / "mine.mat"))


@pytest.mark.parametrize(
    ("content", "message"),
    [
        (b"x" * 200, UNREADABLE),
        (b"MATLAB 7.3 MAT-file, ...",
         "the file must be of MATLAB version 7 or less, as by save('-v7'), got version 7.3"),
        (matlab_5({"A": np.eye(2), "car": np.eye(2)}),
         "the file must have the variables A, B, C and D, got ['A', 'car']"),
        (matlab_4({"ABCD": np.eye(2), "nx": np.array([[2.0]])}), UNREADABLE),
        (matlab_5({**MATRICES, "E": 2 * np.eye(8)}),
         "system must be of the form x' = A x + B u, got a descriptor system with E"),
        (matlab_5({**MATRICES, "Ts": np.array([[0.01]])}),
         "system must be in continuous time, got TS = array([[0.01]])"),
        (matlab_5({"A": np.zeros((2700, 2700))}), UNREADABLE),
    ],
)  # fmt: skip
def test_other_files_are_one_line(tmp_path, content, message):
    (tmp_path / "car.mat").write_bytes(content)
    with pytest.raises(ValueError, match="^" + re.escape(message) + "$"):
        read_mat(tmp_path / "car.mat")
