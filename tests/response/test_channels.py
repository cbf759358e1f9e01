"""Measured channels: units in headers become SI, by the names of responses or others; bad tables are one line."""

import re

import numpy as np
import pandas as pd
import pytest

from suspension_ctrl.response.channels import channels_of

T = np.arange(5) * 0.01
FRAME = pd.DataFrame(
    {"time [s]": T, "distance [m]": 20 * T, "body_acceleration [g]": T, "suspension_travel [mm]": -T}
)


@pytest.mark.parametrize("as_file", [False, True])
def test_histories_are_in_si_units(tmp_path, as_file):
    source = FRAME.rename(columns={"time [s]": "time [ms]"}).assign(**{"time [ms]": 1e3 * T})
    if as_file:
        source.to_csv(tmp_path / "drive.csv", index=False, sep=";", decimal=",")
        source = tmp_path / "drive.csv"
    found = channels_of(source, None)
    assert (found.responses, found.are_spectra) == (("body_acceleration", "suspension_travel"), False)
    np.testing.assert_allclose(found.axis, T, rtol=1e-12)
    np.testing.assert_allclose(found.numbers, np.column_stack([9.80665 * T, -1e-3 * T]), rtol=1e-12)


@pytest.mark.parametrize(
    ("unit", "factor"), [("g^2/Hz", 9.80665**2), ("(mm/s^2)^2/Hz", 1e-6), ("(m/s^2)^2/Hz", 1.0)]
)
def test_spectra_are_in_si_units(unit, factor):
    found = channels_of(pd.DataFrame({"frequency [Hz]": T, f"body_acceleration [{unit}]": T}), None)
    assert found.are_spectra
    np.testing.assert_allclose(found.numbers[:, 0], factor * T, rtol=1e-12)


def test_columns_of_other_names_and_points_of_the_body():
    frame = FRAME.rename(columns={"body_acceleration [g]": "seat rail z (g)"}).assign(note="ok", speed=np.nan)
    found = channels_of(
        frame, {"seat rail z": ("acceleration", 0.3, 0.4), "suspension_travel": "front_suspension_travel"}
    )
    assert found.responses == (("acceleration", 0.3, 0.4), "front_suspension_travel")
    np.testing.assert_allclose(found.numbers[:, 0], 9.80665 * T, rtol=1e-12)


@pytest.mark.parametrize(
    ("columns", "names", "message"),
    [
        ({"t [s]": T, "body_acceleration [g]": T}, None,
         "first column must be 'time [s]' or 'frequency [Hz]', got 't [s]'"),
        ({"time [s]": T, "body_acceleration": T}, None,
         "columns must be like 'body_acceleration [m/s^2]', got 'body_acceleration'"),
        ({"time [s]": T, "body_acceleration [mm]": T}, None,
         "body_acceleration must be in m/s^2 or a unit like it, got '1 mm' in mm"),
        ({"frequency [Hz]": T, "body_acceleration [g]": T}, None,
         "body_acceleration must be in (m/s^2)^2/Hz or a unit like it, got 'g'"),
        ({"time [s]": T, "distance [m]": T}, None, "columns must include a response, got none"),
        ({"time [s]": T, "a [g]": T}, {"b": "body_acceleration"}, "columns must include 'b' once, got none"),
        ({"time [s]": T[::-1], "body_acceleration [g]": T}, None, "time must ascend, got 0.03 s after 0.04 s"),
        ({"time [s]": T**2, "body_acceleration [g]": T}, None,
         "time must be even, each within 0.4 of a step of 0.0004 s, got 1 steps at 0.0004 s"),
        ({"frequency [Hz]": T - 1, "body_acceleration [g^2/Hz]": T}, None,
         "frequency must be finite and >= 0 Hz, got -1.0"),
        ({"frequency [Hz]": T[::-1], "body_acceleration [g^2/Hz]": T}, None,
         "frequency must ascend, got 0.03 Hz after 0.04 Hz"),
        ({"time": T, "a [g]": T}, {"a": "body_acceleration"},
         "first column must be 'time [s]' or 'frequency [Hz]', got 'time'"),
        ({"time [s]": T * np.nan, "body_acceleration [g]": T}, None,
         "measured must hold finite values throughout, got others"),
        ({"time [s]": T, "body_acceleration [g]": list("abcde")}, None,
         "measured must be an array of real numbers"),
    ],
)  # fmt: skip
def test_other_tables_are_one_line(columns, names, message):
    with pytest.raises(ValueError, match="^" + re.escape(message)):
        channels_of(pd.DataFrame(columns), names)


def test_what_is_no_table_and_the_name_of_a_file(tmp_path):
    with pytest.raises(ValueError, match=r"^measured must be a path of a file or a DataFrame, got 3$"):
        channels_of(3, None)
    (tmp_path / "drive.csv").write_text("t,a\n1,2\n3,4\n")
    with pytest.raises(
        ValueError, match=r"drive.csv: columns must be like 'body_acceleration .m/s\^2.', got 't'$"
    ):
        channels_of(tmp_path / "drive.csv", None)
