"""Matrices A, B, C and D: of texts and NumPy files as written, and what is no such system is one line."""

import re
import zipfile
from io import BytesIO

import control
import numpy as np
import pytest

from garage import DAMPED_HALF
from programs import texts
from suspension_ctrl.vehicles.matrices import (
    labels_of,
    parts_of,
    read_npy,
    read_npz,
    read_texts,
    state_space,
    write_npz,
    write_texts,
)

SYSTEM = DAMPED_HALF.plant()
MATRICES = dict(zip("ABCD", (SYSTEM.A, SYSTEM.B, SYSTEM.C, SYSTEM.D), strict=True))


def equal(one: control.StateSpace, other: control.StateSpace, names: bool = True) -> bool:
    here, there = ((s.A, s.B, s.C, s.D) for s in (one, other))
    same = all(np.array_equal(*pair) for pair in zip(here, there, strict=True))
    return same and (not names or labels_of(one) == labels_of(other))


def test_texts_of_another_program(tmp_path):
    found = read_texts(texts(tmp_path, list(MATRICES.values())))
    assert equal(found, SYSTEM, names=False)
    assert found.input_labels == [f"u[{i}]" for i in range(6)]
    (tmp_path / "car.d").write_text("\n".join(",;".join(map(repr, row)) for row in SYSTEM.D.tolist()))
    assert equal(read_texts(tmp_path / "car.c"), SYSTEM, names=False)


@pytest.mark.parametrize("ending", [".a", ".A"])
def test_texts_written_are_read_to_the_last_bit(tmp_path, ending):
    write_texts(tmp_path / f"car{ending}", SYSTEM)
    assert len(list(tmp_path.iterdir())) == 4
    assert equal(read_texts(parts_of(tmp_path / f"car{ending}")[3]), SYSTEM, names=False)


def test_numpy_files(tmp_path):
    write_npz(tmp_path / "mine.npz", SYSTEM)
    assert equal(read_npz(tmp_path / "mine.npz"), SYSTEM)
    np.savez_compressed(tmp_path / "car.npz", **{name.lower(): one for name, one in MATRICES.items()}, dt=0)
    assert equal(read_npz(tmp_path / "car.npz"), SYSTEM, names=False)
    for letter, matrix in MATRICES.items():
        np.save(tmp_path / f"car_{letter}.npy", matrix)
    assert equal(read_npy(tmp_path / "car_C.npy"), SYSTEM, names=False)


def test_a_frequency_response_has_no_matrices(tmp_path):
    table = SYSTEM.frequency_response(np.arange(1.0, 9.0))
    with pytest.raises(ValueError, match=r"^system must be a control.StateSpace for matrices, got Freq.*$"):
        write_npz(tmp_path / "mine.npz", table)


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"D": None}, "the file must hold A, B, C and D, got no D"),
        ({"A": np.eye(3)}, "A must be of shape (8, 8) beside B of (8, 6), got (3, 3)"),
        ({"C": SYSTEM.C[:, :3]}, "C must be of shape (10, 8) beside B of (8, 6), got (10, 3)"),
        ({"D": SYSTEM.D[0]}, "D must be a matrix of finite numbers, got shape (6,)"),
        ({"B": SYSTEM.B * np.nan}, "B must be a matrix of finite numbers, got others"),
        ({"A": SYSTEM.A * 1j}, "A must be an array of real numbers, got"),
        ({"A": np.array(["x"])}, "A must be an array of real numbers, got"),
        ({"E": 2 * np.eye(8)}, "system must be of the form x' = A x + B u, got a descriptor system with E"),
        ({"Ts": np.array([[0.01]])}, "system must be in continuous time, got TS = array([[0.01]])"),
        ({"dt": 0.5}, "system must be in continuous time, got DT = 0.5"),
        (dict(zip("ABCD", (np.empty((0, 0)), np.empty((0, 1)), np.empty((1, 0)), np.eye(1)), strict=True)),
         "number of states must be a number from 1 to 1000, got 0"),
    ],
)  # fmt: skip
def test_what_is_no_system_is_one_line(changes, message):
    arrays = {name: one for name, one in (MATRICES | changes).items() if one is not None}
    with pytest.raises(ValueError, match="^" + re.escape(message)):
        state_space(arrays)


def test_names_that_do_not_fit():
    with pytest.raises(ValueError, match=r"^inputs must be 6 names, got 1$"):
        state_space(MATRICES, ["road"])
    with pytest.raises(ValueError, match=r"^names of inputs must differ, got 'road' twice$"):
        state_space(MATRICES, ["road"] * 6)
    assert state_space(MATRICES, ["a.b", "", *"cdef"]).input_labels == ["a_b", "u[1]", *"cdef"]


def test_damaged_files_are_one_line(tmp_path):
    path = texts(tmp_path, list(MATRICES.values()))
    (tmp_path / "car.b").write_text("1 2\n3 x\n")
    with pytest.raises(ValueError, match=r"^the file must be rows of numbers, car.b, got one that cannot .*$"):
        read_texts(path)
    (tmp_path / "car.b").unlink()
    with pytest.raises(FileNotFoundError, match=r"car\.b"):
        read_texts(path)
    (tmp_path / "car.npz").write_bytes(b"PK")
    with pytest.raises(ValueError, match=r"^the file must be a NumPy file of arrays, got one that cannot .*$"):
        read_npz(tmp_path / "car.npz")
    np.save(tmp_path / "A.npy", np.array([{}]), allow_pickle=True)
    with pytest.raises(ValueError, match=r"^the file must be a NumPy array, A.npy, got one that cannot .*$"):
        read_npy(tmp_path / "B.npy")


def test_what_unpacks_to_too_much_is_refused_before_it_is_unpacked(tmp_path):
    with zipfile.ZipFile(tmp_path / "car.npz", "w", zipfile.ZIP_DEFLATED) as archive:
        content = BytesIO()
        np.save(content, np.zeros((2700, 2700)))
        archive.writestr("A.npy", content.getvalue())
    assert (tmp_path / "car.npz").stat().st_size < 1e6
    with pytest.raises(ValueError, match=r"^the file must hold at most 50 MB, got 58.3201 MB$"):
        read_npz(tmp_path / "car.npz")
