"""ERD files by a writer of the tests' own, after the public description of the format."""

import re
import struct

import numpy as np
import pytest

from suspension_ctrl import Iso8608Road, ProfileWarning, load_profile

PROFILE = Iso8608Road("C").profile(51.2, 0.1, 1, (0.75, -0.75))
FIELDS = {"SHORTNAM": 8, "LONGNAME": 32, "UNITSNAM": 8}


def write_erd(path, values, step, code=5, order="<", samples=None, binary=".bin", **header):
    """Write channels (n, c): a header, and the numbers below it or in a binary file beside."""
    rows, channels = values.shape
    count = rows if samples is None else samples
    lines = ["ERDFILEV2.00", f"  {channels}, {count}, -1, {4 * channels}, {code}, {step!r}, -1,"]
    for key, value in header.items():
        text = value if isinstance(value, str) else "".join(one.ljust(FIELDS[key]) for one in value)
        lines += [key.ljust(8) + text[:64], *(["&1000   " + text[64:]] if text[64:] else [])]
    lines.append("END")
    if code == 5:
        lines += [" ".join(f"{x:.9E}" for x in row) for row in values]
    else:
        path.with_suffix(binary).write_bytes(struct.pack(f"{order}{values.size}f", *values.ravel()))
    path.write_text("\n".join(lines) + "\n", encoding="utf-8")
    return path


NAMED = {"TITLE": "A road, 1997", "XUNITS": "m", "SHORTNAM": ["LElev.", "RElev."], "UNITSNAM": ["m", "m"]}


def test_text(tmp_path):
    path = write_erd(tmp_path / "r.erd", PROFILE.height, 0.1, **NAMED)
    found = load_profile(path, track_width=1.5)
    np.testing.assert_allclose(found.height, PROFILE.height, rtol=1e-9, atol=1e-12)
    np.testing.assert_allclose(found.distance, PROFILE.distance, rtol=1e-12)
    assert found.tracks == (0.75, -0.75)


@pytest.mark.parametrize("binary", [".bin", ".ERD.bin"])
@pytest.mark.parametrize("order", "<>")
def test_binary_in_either_byte_order(tmp_path, order, binary):
    path = write_erd(tmp_path / "r.ERD", PROFILE.height, 0.1, 1, order, -1, binary, **NAMED)
    found = load_profile(path, track_width=1.5)
    np.testing.assert_array_equal(found.height, PROFILE.height.astype(np.float32))


def test_inches_on_feet_with_long_names_and_further_channels(tmp_path):
    values = np.column_stack([PROFILE.height / 0.0254, np.full(len(PROFILE.height), 60.0)])
    names = ["Left Wheelpath Elevation", "Right Wheelpath Elevation", "Speed"]
    path = write_erd(tmp_path / "r.erd", values, 0.5, XUNITS="ft", LONGNAME=names, UNITSNAM=["in", "in", "mph"])
    found = load_profile(path, track_width=1.5)
    np.testing.assert_allclose(found.height, PROFILE.height, rtol=1e-8, atol=1e-12)
    assert found.step == pytest.approx(0.1524, rel=1e-12)


@pytest.mark.parametrize(("channels", "tracks"), [(1, (0.0,)), (2, (0.75, -0.75))])
def test_one_or_two_channels_without_names_are_height_or_left_and_right(tmp_path, channels, tracks):
    path = write_erd(tmp_path / "r.erd", PROFILE.height[:, :channels], 0.1)
    with pytest.warns(ProfileWarning, match="without a unit are taken in m"):
        assert load_profile(path, track_width=None if channels == 1 else 1.5).tracks == tracks


@pytest.mark.parametrize("order", "<>")
def test_a_level_road_with_a_bump_has_the_byte_order_of_the_bump(tmp_path, order):
    """Zeros are the same in both; samples beyond those of the header do not count."""
    values = np.full((512, 1), -0.0)
    values[200:230, 0] = 0.05 * np.hanning(30)
    path = write_erd(tmp_path / "r.erd", values, 0.1, 1, order, 500, SHORTNAM=["Elev."], UNITSNAM=["m"])
    np.testing.assert_array_equal(load_profile(path).height, values[:500].astype(np.float32))


def test_names_go_on_in_a_second_line_and_short_ones_come_first(tmp_path):
    """Eight names of eight characters fill a line; units likewise."""
    others = [f"Temp{i}" for i in range(8)]
    values = np.column_stack([np.full((512, 8), 20.0), PROFILE.height])
    names = {
        "SHORTNAM": [*others, "LElev.", "RElev."],
        "LONGNAME": ["T"] * 8 + ["Right Elevation", "Left Elevation"],
    }
    path = write_erd(tmp_path / "r.erd", values, 0.1, UNITSNAM=[*["C"] * 8, "m", "m"], **names)
    found = load_profile(path, track_width=1.5)
    assert found.tracks == (0.75, -0.75)
    np.testing.assert_allclose(found.height, PROFILE.height, rtol=1e-9, atol=1e-12)


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("ERDFILE", "ERGFILE", "the file must have a header from ERDFILEV2.00 to END in 65536 characters"),
        ("\nEND\n", "\n", "the file must have a header from ERDFILEV2.00 to END in 65536 characters"),
        (", 5, 0.1", "", "second line must have five whole numbers and the step, got '2, 512, -1, 8, -1,'"),
        (", 5, 0.1", ", 0, 0.1", "fifth number of the second line must be 5 for text or 1 for 32-bit binary"),
        (", 5, 0.1", ", 1, 0.1", "numbers must be in 'r.bin' beside the file, got no such file"),
        (", 5, 0.1", ", 5, 0.0", "step must be finite and > 0 m, got 0.0"),
        (", 5, 0.1", ", 5, 9e307", "step must be up to 1e+09 m, got 9e+307"),
        (", 5, 0.1", ", 5, nan", "step must be finite and > 0 m, got nan"),
        ("XUNITS  m", "XUNITS  s", "XUNITS must be one of m, metre, "),
        ("  2, 512", "  0, 512", "number of channels must be a number from 1 to 1000, got 0"),
        ("  2, 512", "  2, 511", "rows must be 511 as the second line says, got 512"),
        ("  2, 512", "  3, 512", "rows must have 3 numbers, got 2"),
        ("m       m", "s       s", "columns of heights must be one of height, or left and right"),
    ],
)  # fmt: skip
def test_a_mistake_is_one_line(tmp_path, old, new, message):
    path = write_erd(tmp_path / "r.erd", PROFILE.height, 0.1, **NAMED)
    text = path.read_text(encoding="utf-8")
    assert old in text
    path.write_text(text.replace(old, new, 1), encoding="utf-8")
    with pytest.raises(ValueError, match=r"^[^\n]*$") as error:
        load_profile(path)
    assert str(error.value).startswith(f"{path}: {message}")


def test_binary_numbers_that_are_none(tmp_path):
    path = write_erd(tmp_path / "r.erd", PROFILE.height, 0.1, 1, **NAMED)
    path.with_suffix(".bin").write_bytes(b"\x7f\xc0\xc0\x7f" * 1024)  # NaN in either byte order
    with pytest.raises(
        ValueError, match=rf"^{re.escape(str(path))}: numbers must be up to 1e\+09, got others in "
    ):
        load_profile(path)
    path.with_suffix(".bin").unlink()
    path.with_suffix(".bin").symlink_to("/dev/zero")
    with pytest.raises(ValueError, match="must be a regular one of at most 100 MB, got another kind"):
        load_profile(path)


def test_options_of_tables_are_refused(tmp_path):
    path = write_erd(tmp_path / "r.erd", PROFILE.height, 0.1, **NAMED)
    for option in ({"step": 0.1}, {"columns": ["x"]}):
        with pytest.raises(ValueError, match=r": (step|columns) must not be given for an .erd file, got "):
            load_profile(path, **option)
