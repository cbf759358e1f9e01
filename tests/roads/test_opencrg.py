"""OpenCRG surfaces by a writer of the tests' own, after the public specification (ASAM OpenCRG 1.2, section 6)."""

import math
import struct

import numpy as np
import pytest

from suspension_ctrl import ProfileWarning, load_profile

RNG = np.random.default_rng(1)
V = np.arange(-6, 7) * 0.25
GRID = 0.01 * RNG.standard_normal((41, V.size))
BANKING, SLOPE = 0.02 * RNG.standard_normal(41), 0.05 * RNG.standard_normal(41)


def write_crg(path, grid, v, form="LRFI", increment=0.5, numbered=False, end=True, more="", **reference):
    """Write a grid (n, s) and channels (n,) of its reference line in records of 80 bytes."""
    lines = ["$CT", "A road; $ in a comment does not count", "$", "$ROAD_CRG ! parameters"]
    lines += [f"REFERENCE_LINE_INCREMENT = {increment} ! between rows", "reference_line_start_u=100.0"]
    lines += [f"REFERENCE_LINE_END_U = {100 + increment * (len(grid) - 1)}"] * end
    if numbered:
        lines += [f"LONG_SECTION_V_RIGHT = {v[0]}", f"LONG_SECTION_V_INCREMENT = {v[1] - v[0]}"]
    sections = [
        f"D:long section {i + 1},m" if numbered else f"D:long section at v = {y},m" for i, y in enumerate(v)
    ]
    channels = [f"D:reference line {name},m/m" for name in reference]
    lines += [f"$ {more}", "* a comment", "$KD_DEFINITION", f"#:{form}", "U:reference line u,m,0,1", *channels]
    header = "\n".join([*lines, *sections, "$!****", "$$$$$20$$$$$$$"]) + "\n"
    rows = np.column_stack([*reference.values(), grid])
    path.write_bytes(header.encode() + (as_text(rows, form) if form.endswith("FI") else as_binary(rows, form)))
    return path


def as_text(rows, form) -> bytes:
    width, digits = {"LRFI": (10, 7), "LDFI": (20, 17)}[form]
    lines = []
    for row in rows:
        cells = ["*missing*".rjust(width) if math.isnan(x) else f"{x:{width}.{digits}f}" for x in row]
        per_line = 80 // width
        lines += ["".join(cells[i : i + per_line]) for i in range(0, len(cells), per_line)]
    return ("\r\n".join(lines) + "\r\n").encode()


def as_binary(rows, form) -> bytes:
    kind, size = {"KRBI": ("f", 4), "KDBI": ("d", 8)}[form]
    padding = [math.nan] * (-rows.size % (80 // size))
    return struct.pack(f">{rows.size + len(padding)}{kind}", *rows.ravel(), *padding)


@pytest.mark.parametrize("end", [True, False])
@pytest.mark.parametrize("numbered", [True, False])
@pytest.mark.parametrize(("form", "error"), [("LRFI", 5.1e-8), ("LDFI", 1e-16), ("KRBI", 1e-8), ("KDBI", 0.0)])
def test_tracks_at_long_sections_and_between(tmp_path, form, error, numbered, end):
    path = write_crg(tmp_path / "r.crg", GRID, V, form, numbered=numbered, end=end)
    profile = load_profile(path, tracks=(0.75, -0.6, 1.5, -1.5))
    np.testing.assert_allclose(profile.distance, 100 + 0.5 * np.arange(41), rtol=1e-12)
    between = 0.6 * GRID[:, 4] + 0.4 * GRID[:, 3]  # -0.6 between -0.75 and -0.5
    wanted = np.column_stack([GRID[:, 9], between, GRID[:, 12], GRID[:, 0]])
    np.testing.assert_allclose(profile.height, wanted, rtol=0, atol=error + 1e-17)
    assert profile.tracks == (0.75, -0.6, 1.5, -1.5)


@pytest.mark.parametrize("form", ["LDFI", "KDBI"])
def test_banking_lifts_the_left_and_slope_the_line(tmp_path, form):
    """A slope leads to its point: the first counts for nothing and may be missing."""
    slope = np.where(np.arange(41) == 0, np.nan, SLOPE)
    path = write_crg(tmp_path / "r.crg", GRID, V, form, phi=np.zeros(41), banking=BANKING, slope=slope)
    profile = load_profile(path, track_width=1.5)
    line = [0.5 * math.fsum(SLOPE[1 : i + 1]) for i in range(41)]
    np.testing.assert_allclose(profile.height[:, 0], GRID[:, 9] + line + 0.75 * BANKING, atol=1e-15)
    np.testing.assert_allclose(profile.height[:, 1], GRID[:, 3] + line - 0.75 * BANKING, atol=1e-15)


def test_constant_slope_and_banking_of_the_header(tmp_path):
    more = "\n$ROAD_CRG\nREFERENCE_LINE_START_S = 0.1\nREFERENCE_LINE_START_B = 0.04\n$"
    profile = load_profile(write_crg(tmp_path / "r.crg", GRID, V, "KDBI", more=more), tracks=[0.5])
    np.testing.assert_allclose(profile.height[:, 0], GRID[:, 8] + 0.05 * np.arange(41) + 0.02, atol=1e-15)


def test_without_places_sections_lie_evenly_about_the_line(tmp_path):
    path = write_crg(tmp_path / "r.crg", GRID, V, "KDBI", numbered=True)
    path.write_bytes(path.read_bytes().replace(b"LONG_SECTION_V_RIGHT", b"* LONG_SECTION_V_RIGHT"))
    np.testing.assert_array_equal(load_profile(path, tracks=[0.0]).height[:, 0], GRID[:, 6])


def test_what_is_assumed_or_not_used_is_told(tmp_path):
    more = "\n$ROAD_CRG_MODS\nSCALE_Z_GRID = 2.0\n$"
    path = write_crg(tmp_path / "r.crg", GRID, V, "KDBI", more=more)
    with pytest.warns(ProfileWarning) as told:
        assert load_profile(path).tracks == (0.75, -0.75)
    assert [str(one.message) for one in told] == [
        f"{path}: tracks are taken 1.5 m apart, as neither they nor a width is given",
        f"{path}: modifiers are not used: SCALE_Z_GRID",
    ]


def test_a_track_beyond_the_edge_of_the_road_is_refused(tmp_path):
    """The right edge has no elevation from the tenth row on."""
    grid = GRID.copy()
    grid[9:, :3] = np.nan
    for form in ("LRFI", "KRBI"):
        path = write_crg(tmp_path / "r.crg", grid, V, form)
        np.testing.assert_allclose(load_profile(path, tracks=[-0.75]).height[:, 0], grid[:, 3], atol=5.1e-8)
        with pytest.raises(
            ValueError, match=r"track at -0.8 m must have an elevation everywhere, got none at u = 104.5 m$"
        ):
            load_profile(path, tracks=[-0.8])


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        (b"\n$$$$$20", b"\n$ $$20", "the file must have a header that ends with $$ in 1000000 bytes, got none"),
        (b"INCREMENT = 0.5", b"INCREMENT = 0.0", "REFERENCE_LINE_INCREMENT must be a number from"),
        (b"INCREMENT = 0.5", b"INCREMENT = x", "REFERENCE_LINE_INCREMENT must be a number up to 1e9, got 'x'"),
        (b"#:LRFI", b"#:LRFX", "data format must be one of LRFI, LDFI, KRBI, KDBI, got 'LRFX'"),
        (b"D:long section", b"D:friction", "long sections must be all at a v, ascending, or numbered"),
        (b"at v = -1.5,", b"at v = 9,", "long sections must be all at a v, ascending, or numbered"),
        (b"END_U = 120.0", b"END_U = 121.0", "road data must have 43 rows as u says, got 41"),
        (b"\r\n", b"", "road data must be a multiple of 2 lines of 80 characters at most, got 81 lines of 6"),
        (b"20$$$$$$$\n ", b"20$$$$$$$\nx", "channel 1 must be numbers or *missing*, got others"),
    ],
)  # fmt: skip
def test_a_mistake_is_one_line(tmp_path, old, new, message):
    path = write_crg(tmp_path / "r.crg", GRID, V)
    content = path.read_bytes()
    assert old in content
    path.write_bytes(content.replace(old, new, 1))
    with pytest.raises(ValueError, match=r"^[^\n]*$") as error:
        load_profile(path, tracks=[-1.5])
    if b"friction" not in new:
        assert str(error.value).startswith(f"{path}: {message}")


def test_the_left_edge_may_stand_in_place_of_the_increment(tmp_path):
    path = write_crg(tmp_path / "r.crg", GRID, V, "KDBI", numbered=True)
    path.write_bytes(path.read_bytes().replace(b"LONG_SECTION_V_INCREMENT = 0.25", b"LONG_SECTION_V_LEFT = 1.5"))
    found = load_profile(path, tracks=[1.5, 0.5])
    np.testing.assert_array_equal(found.height, GRID[:, [12, 8]])


@pytest.mark.parametrize("end", [True, False])
def test_padding_of_the_last_record_is_no_row(tmp_path, end):
    """Of 64 numbers of 4 bytes in records of 20; a last row with one number missing is a row."""
    grid = GRID[:32, :2].copy()
    grid[-1, 0] = np.nan
    assert int((103.1 - 100) / 0.1) == 30  # of the steps of the header, 31
    path = write_crg(tmp_path / "r.crg", grid, V[:2], "KRBI", end=end, increment=0.1)
    np.testing.assert_allclose(load_profile(path, tracks=[V[1]]).height[:, 0], grid[:, 1], atol=1e-8)


def test_numbers_that_are_missing_are_told(tmp_path):
    banking = BANKING.copy()
    banking[5] = np.nan
    path = write_crg(tmp_path / "r.crg", GRID, V, "KDBI", banking=banking)
    with pytest.raises(ValueError, match=r"line banking must be numbers up to 1000 from the second"):
        load_profile(path, tracks=[0.5])
    for form, rest in (("KDBI", "have a row or more, got none"), ("LDFI", "be a multiple of 4 lines of 80 ch")):
        path = write_crg(tmp_path / "r.crg", GRID[:0], V, form, end=False)
        with pytest.raises(ValueError, match=f": road data must {rest}"):
            load_profile(path, tracks=[0.5])


def test_many_short_lines_and_one_long_line_are_refused(tmp_path):
    """A million lines of a character would be padded to 80 each."""
    path = write_crg(tmp_path / "r.crg", GRID, V)
    header = path.read_bytes().partition(b"$$$$$20$$$$$$$\n")
    for lines, message in (
        (b"1\n" * 1_000_000, "a multiple of 2 lines of 80 characters at most, got 1000000 lines of 1$"),
        (b" " * 70 + b"1" * 11 + b"\n" + b"1" * 60, "lines of 80 characters at most, got 81$"),
    ):
        path.write_bytes(header[0] + header[1] + lines)
        with pytest.raises(ValueError, match=f": road data must be {message}"):
            load_profile(path, tracks=[0.5])


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"tracks": [1.6]}, "tracks must lie from -1.5 to 1.5 m, got 1.6"),
        ({"tracks": []}, "tracks must be one or more without a track width, got []"),
        ({"tracks": [0.5], "track_width": 1.0}, "tracks must be one or more without a track width, got [0.5]"),
        ({"tracks": ["a"]}, "tracks must be a number from -100.0 to 100.0, got 'a'"),
        ({"tracks": 0.5}, "tracks must be a list, got 0.5"),
        ({"track_width": -1.0}, "track width must be finite and > 0 m, got -1.0"),
        ({"step": 1.0}, "step must not be given for an .crg file, got 1.0"),
    ],
)
def test_wrong_options_are_one_line(tmp_path, options, message):
    path = write_crg(tmp_path / "r.crg", GRID, V)
    with pytest.raises(ValueError, match=r"^[^\n]*$") as error:
        load_profile(path, **options)
    assert str(error.value) == f"{path}: {message}"
