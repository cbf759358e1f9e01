"""Variables of MATLAB files: those that scipy writes and the tests' own writer, in every type and byte order."""

import struct
from io import BytesIO

import numpy as np
import pytest
from scipy import io, sparse

from programs import matlab_4, matlab_5
from suspension_ctrl.vehicles.mat_variables import variables

M = np.array([[1.0, -2.0, 3.5], [0.0, 5.0, 1e-300]])


def read(content, names, most=10**6):
    return variables(content, names, most)


@pytest.mark.parametrize("version", ["4", "5"])
@pytest.mark.parametrize("packed", [False, True])
@pytest.mark.parametrize("kind", ["f8", "f4", "i2", "u1", "i4"])
def test_matrices_that_scipy_writes(version, packed, kind):
    content = BytesIO()
    matrix = np.array([[1, 2, 3], [4, 5, 250]]).astype(kind)
    io.savemat(content, {"v": 3.0, "A": matrix}, format=version, do_compression=packed and version == "5")
    found = read(content.getvalue(), {"A"})
    assert list(found) == ["v", "A"]
    assert found["v"] is None
    np.testing.assert_array_equal(found["A"], matrix.astype(float))


def test_texts_and_sparse_matrices_that_scipy_writes():
    content, cells = BytesIO(), np.array(["road", "body acceleration", "é"], dtype=object)[:, None]
    io.savemat(content, {"N": cells, "T": "some text", "S": sparse.csc_array(M), "e": np.empty((0, 0))})
    found = read(content.getvalue(), {"N", "T", "S", "e"})
    assert found["N"] == ["road", "body acceleration", "é"]
    assert found["T"] == ["some text"]
    np.testing.assert_array_equal(found["S"], M)
    assert found["e"].shape == (0, 0)


def test_the_tests_own_files():
    found = read(matlab_4({"t": ["ab", "c"], "M": M}), {"t", "M"})
    assert found["t"] == ["ab", "c"]
    np.testing.assert_array_equal(found["M"], M)
    assert read(matlab_5({"n": ["ab", "", "c"]}), {"n"})["n"] == ["ab", "", "c"]


def test_numbers_of_the_other_byte_order():
    """Version 4 and 5 as a big-endian machine writes them."""
    header = struct.pack(">5i", 1000, *M.shape, 0, 2) + b"M\0"
    np.testing.assert_array_equal(read(header + M.astype(">f8").tobytes(order="F"), {"M"})["M"], M)
    data = b"".join(
        struct.pack(">2I", kind, len(part)) + part
        for kind, part in (
            (6, struct.pack(">2I", 6, 0)), (5, struct.pack(">2i", *M.shape)), (1, b"Matrices"),
            (9, M.astype(">f8").tobytes(order="F")),
        )
    )  # fmt: skip
    content = b"MATLAB 5.0".ljust(124) + b"\1\0MI" + struct.pack(">2I", 14, len(data)) + data
    np.testing.assert_array_equal(read(content, {"Matrices"})["Matrices"], M)


@pytest.mark.parametrize("wrong", [M * 1j, np.array([(1.0,)], dtype=[("field", float)])])
def test_wanted_arrays_of_other_kinds_are_refused_and_others_are_not_read(wrong):
    content = BytesIO()
    io.savemat(content, {"A": wrong})
    with pytest.raises(ValueError, match=r"^array of class \d$"):
        read(content.getvalue(), {"A"})
    assert read(content.getvalue(), {"B"}) == {"A": None}


def test_what_unpacks_to_too_much_is_refused_and_passed_over_if_not_wanted():
    content = matlab_5({"A": np.zeros((400, 400)), "B": M})
    with pytest.raises(ValueError, match=r"^more than allowed when unpacked$"):
        read(content, {"A", "B"})
    np.testing.assert_array_equal(read(content, {"B"})["B"], M)


def test_a_cut_off_file_is_refused():
    content = matlab_5({"A": M}, packed=False)
    for end in range(len(content) - 8, 140, -8):
        with pytest.raises((ValueError, StopIteration, RuntimeError)):
            read(content[:end], {"A"})
