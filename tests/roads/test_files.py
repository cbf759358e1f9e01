"""Roads and profiles by files and names: what is read is what was written, and bad files are one line."""

import re
import sys
from pathlib import Path

import numpy as np
import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from suspension_ctrl import Iso8608Road, MeasuredRoad, PowerLawRoad, TwoSlopeRoad
from suspension_ctrl.paper import experiment as paper
from suspension_ctrl.roads.coherence import Constant, Exponential, Isotropic, Tabulated
from suspension_ctrl.roads.files import load_road
from suspension_ctrl.roads.measured import COHERENCE, PSD, read_curve
from suspension_ctrl.roads.profile_files import load_profile, save_profile

NUMBER = "a number from 1e-12 to 1e+12 in size or 0"
POWER_LAW, ISO = 'kind = "power-law"\n', 'kind = "iso-8608"\nclass = "A"\n'
SPECTRUM = "wavenumber [cycle/m],psd [m^3]\n0.01,1e-3\n0.1,1e-5\n2,1e-8\n"


def written(folder: Path, name: str, text: str | bytes) -> Path:
    path = folder / name
    path.write_bytes(text if isinstance(text, bytes) else text.encode())
    return path


def test_a_measured_road_from_a_file_is_that_of_its_profile(tmp_path):
    profile = Iso8608Road("C").profile(409.6, 0.1, 1, (0.75, -0.75))
    path = tmp_path / "p.csv"
    save_profile(path, profile)
    road, there = load_road(path), MeasuredRoad.from_profile(profile)
    np.testing.assert_array_equal(road.density, there.density)
    assert road.coherence == there.coherence
    assert road.describe().startswith(f"measured, {path}: Gd(0.1 cycle/m) = ")


def test_a_spectrum_from_a_file(tmp_path):
    road = load_road(written(tmp_path, "s.csv", "\ufeff# Source: none\n" + SPECTRUM))
    np.testing.assert_array_equal(road.density, [1e-3, 1e-5, 1e-8])
    assert road.coherence == Isotropic()


@pytest.mark.parametrize(
    ("text", "road"),
    [
        ("A", Iso8608Road("A")),
        ("C-lower", Iso8608Road("C", level="lower")),
        ("G-upper", Iso8608Road("G", level="upper")),
    ],
)
def test_classes_by_name(text, road):
    assert load_road(text) == load_road(Path(text)) == road


def test_the_papers_road_by_file(checkout):
    assert load_road(checkout / "data/roads/yuen_ramli_2010.toml") == paper.ride_problem().road


def test_example_roads_say_where_they_are_from(checkout):
    files = list((checkout / "data/roads").glob("*.toml"))
    assert len(files) >= 2
    for file in files:
        assert file.read_text().startswith("# Source: ")
        assert load_road(file).describe()


@pytest.mark.parametrize(
    ("text", "road"),
    [
        ('kind = "power-law"\nroughness_m3 = 1e-6\nexponent = 2', PowerLawRoad(roughness=1e-6, exponent=2.0)),
        (
            'kind = "two-slope"\nroughness_m3 = 2e-5\nreference_cycle_per_m = 0.1\nlower_exponent = 3\n'
            'upper_exponent = 2.25\ncorner_cycle_per_m = 0.2\n[coherence]\nkind = "constant"\nvalue = 0',
            TwoSlopeRoad(
                roughness=2e-5,
                reference=0.1,
                lower_exponent=3.0,
                upper_exponent=2.25,
                corner=0.2,
                coherence=Constant(0.0),
            ),
        ),
        (
            'kind = "iso-8608"\nclass = "B"\nlevel = "upper"\nwaviness = 2.5\n'
            '[coherence]\nkind = "exponential"\ndecay = 3',
            Iso8608Road("B", level="upper", waviness=2.5, coherence=Exponential(3.0)),
        ),
        (
            'kind = "iso-8608"\nclass = "B"\n[coherence]\nkind = "isotropic"\nexponent = 2.5',
            Iso8608Road("B", coherence=Isotropic(2.5)),
        ),
        (
            'kind = "iso-8608"\nclass = "B"\n[coherence]\nkind = "tabulated"\nfile = "c.csv"\ndistance_m = 1.5',
            Iso8608Road("B", coherence=Tabulated((0.1, 0.2), (0.5, 0.25), 1.5)),
        ),
    ],
)
def test_roads_by_toml(tmp_path, text, road):
    written(tmp_path, "c.csv", "wavenumber [cycle/m],coherence [-]\n0.1,0.5\n0.2,0.25\n")
    assert load_road(written(tmp_path, "r.toml", text)) == road


def test_measured_roads_by_toml(tmp_path):
    profile = Iso8608Road("C").profile(409.6, 0.1, 1, (0.75, -0.75))
    rows = np.column_stack([profile.distance, profile.height]).tolist()
    lines = ["distance [m],left [m],right [m]", *(",".join(map(repr, row)) for row in rows)]
    written(tmp_path, "p.csv", "\n".join(lines))
    text = 'kind = "measured"\nfile = "p.csv"\ntrack_width_m = 1.5\nsegment_m = 25.6'
    road = load_road(written(tmp_path, "r.toml", text))
    there = MeasuredRoad.from_profile(profile, segment=25.6)
    np.testing.assert_array_equal(road.density, there.density)
    assert road.coherence == there.coherence


TABULATED = ISO + '[coherence]\nkind = "tabulated"\nfile = "{}"\ndistance_m = 1.5'
MEASURED = 'kind = "measured"\nfile = "{}"'


@pytest.mark.skipif(sys.platform == "win32", reason="links need privileges there")
@pytest.mark.parametrize(("text", "key"), [(TABULATED, "coherence.file"), (MEASURED, "file")])
@pytest.mark.parametrize("place", ["../other/{}", "{}/other/{}", "link/{}", "link.csv"])
def test_a_file_names_others_beside_or_below_itself_unless_outside_is_allowed(tmp_path, text, key, place):
    (tmp_path / "roads" / "below").mkdir(parents=True)
    (tmp_path / "other").mkdir()
    name = "c.csv" if text is TABULATED else "s.csv"
    content = "wavenumber [cycle/m],coherence [-]\n0.1,0.5\n0.2,0.25\n" if text is TABULATED else SPECTRUM
    for folder in ("other", "roads", "roads/below"):
        written(tmp_path / folder, name, content)
    (tmp_path / "roads" / "link").symlink_to(tmp_path / "other")
    (tmp_path / "roads" / "link.csv").symlink_to(tmp_path / "other" / name)
    outside = place.format(name) if place.count("{}") < 2 else place.format(tmp_path, name)
    path = written(tmp_path / "roads", "r.toml", text.format(outside))
    needed = f"{key} must be beside this file or below it, unless outside is allowed, got '"
    with pytest.raises(ValueError, match=rf"^{re.escape(str(path))}:\d: {re.escape(needed)}"):
        load_road(path)
    road = load_road(path, allow_outside=True)
    for inside in (name, f"below/{name}", f"../roads/{name}"):
        inner = load_road(written(tmp_path / "roads", "r.toml", text.format(inside)))
        np.testing.assert_array_equal(inner.psd([1.0], 20.0), road.psd([1.0], 20.0))
        assert inner.coherence == road.coherence


def test_a_table_without_names_is_a_profile_where_it_can_be_no_spectrum(tmp_path):
    profile = Iso8608Road("C").profile(102.4, 0.1, 1)
    rows = np.column_stack([profile.distance, profile.height]).tolist()
    path = written(tmp_path, "p.csv", "\n".join(f"{x!r} {z!r}" for x, z in rows))
    np.testing.assert_array_equal(load_road(path).density, MeasuredRoad.from_profile(profile).density)
    path = written(tmp_path, "p.csv", "\n".join(f"{x + 1!r} {z + 1!r}" for x, z in rows))
    with pytest.raises(
        ValueError, match=r"p.csv: columns must have names, 'wavenumber .* or 'distance .*, got none$"
    ):
        load_road(path)


def test_a_curve_without_names_is_what_is_asked_for(tmp_path):
    path = written(tmp_path, "c.csv", "0,1;0,5\n0,2;0,25\n")
    assert [one.tolist() for one in read_curve(path, COHERENCE)] == [[0.1, 0.2], [0.5, 0.25]]


def rows(header: str, *lines: str) -> str:
    return "\n".join([header, *lines])


P, S = "distance [m],height [m]", "wavenumber [cycle/m],psd [m^3]"


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("", "the file must begin with the names of its columns, got nothing"),
        ("# only this", "the file must begin with the names of its columns, got nothing"),
        (b"\xff\xfe\x00", "the file must be CSV in UTF-8, got another encoding"),
        (f'{P}\n0,1\n"', "the file must be CSV in UTF-8, got quotes that do not end"),
        (P, "rows of numbers must be 2 or more, got 0"),
        (rows(P, "0,1"), "rows of numbers must be 2 or more, got 1"),
        (rows(P, "0,1", "1,nan"), r"'height \[m\]' must be a number up to 1e\+09, got 'nan' in row 2"),
        (rows(P, "0,1", "x,1"), r"'distance \[m\]' must be a number up to 1e\+09, got 'x' in row 2"),
        (rows(P, "0,1", ",1"), r"'distance \[m\]' must be a number up to 1e\+09, got '' in row 2"),
        (rows(P, "0,1", "1"), "row 2 must have 2 cells, got [13]$"),
        (rows(P, "0,1", "1,2,3"), "row 2 must have 2 cells, got [13]$"),
        (rows(P, "0,1", "2,2", "1,2"), "distance must ascend, got 1.0 out of order"),
        (rows(P, "0,1", "1,2"), "a profile in steps of 1 m must have 256 points at least"),
        (rows("time [s],speed [m/s]", "0,1", "1,2"), r"columns must be .*, or a distance .*, got \['time"),
        (rows("distance [m]", "0", "1"), r"columns must be a distance such as .*, got \['distance \[m\]'\]"),
        (rows("distance [kg],height [m]", "0,1", "1,2"), r"columns must be a dist.*, got \['height"),
        (rows(S, "0.1,1", "0.2,0"), r"density must be finite and > 0 m\^3 throughout"),
        (rows(S, "0.1,1", "0.2,-1"), r"density must be finite and > 0 m\^3 throughout"),
        (rows(S, "0,1", "0.2,1"), r"wavenumber .* must be finite, above zero and ascend, got 0.0 in row 1"),
        (rows(S, "0.2,1", "0.1,1"), r"wavenumber .* must be finite, above zero and ascend, got 0.1 in row 2"),
        (rows("wavenumber [cycle/m],psd [m^2]", "0.1,1", "0.2,1"), "columns must be 'wavenumber"),
        (rows("wavenumber [rad/m],psd [m^3]", "0.1,1", "0.2,1"), "columns must be 'wavenumber"),
    ],
)  # fmt: skip
def test_bad_tables_are_one_line(tmp_path, text, message):
    path = written(tmp_path, "r.csv", text)
    with pytest.raises(ValueError, match=rf"^{re.escape(str(path))}: {message}[^\n]*$"):
        load_road(path)


def test_a_track_width_goes_with_left_and_right_alone(tmp_path):
    path = written(tmp_path, "p.csv", rows(P, "0,1", "1,2"))
    with pytest.raises(ValueError, match=rf"^{re.escape(str(path))}: a track width goes with [^\n]*$"):
        load_profile(path, track_width=1.5)
    path = written(tmp_path, "p.csv", rows("distance [m],left [m],right [m]", "0,1,1", "1,2,2"))
    with pytest.raises(
        ValueError, match=rf"^{re.escape(str(path))}: track width must be finite and > 0 m, got -1$"
    ):
        load_profile(path, track_width=-1)
    path = written(tmp_path, "s.csv", SPECTRUM)
    with pytest.raises(
        ValueError, match=rf"^{re.escape(str(path))}: a spectrum takes neither step nor track_width nor segment$"
    ):
        MeasuredRoad.from_csv(path, segment=3.0)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("kind = ", "the file must be TOML in UTF-8, got Invalid value"),
        (b"\xff", "the file must be TOML in UTF-8, got another encoding"),
        ("", "kind must be one of power-law, two-slope, iso-8608, measured, got None"),
        ("kind = [1]", "kind must be one of power-law, two-slope, iso-8608, measured, got [1]"),
        (
            f"{POWER_LAW}exponent = 2",
            "roughness_m3 must be given, got none",
        ),
        (
            f"{POWER_LAW}roughness = 1",
            "roughness must be a text with a unit like '1 m^3', or roughness_m3 a number, got 1",
        ),
        (f"{POWER_LAW}roughness_m2 = 1", "roughness_m2 must be a known key, got 1: did you mean roughness_m3?"),
        (f'{POWER_LAW}roughness_m3 = "1"\nexponent = 2', f"roughness_m3 must be {NUMBER}, got '1'"),
        (f"{POWER_LAW}roughness_m3 = true\nexponent = 2", f"roughness_m3 must be {NUMBER}, got True"),
        (f"{POWER_LAW}roughness_m3 = inf\nexponent = 2", f"roughness_m3 must be {NUMBER}, got inf"),
        (f"{POWER_LAW}roughness_m3 = 1e-320\nexponent = 2", f"roughness_m3 must be {NUMBER}, got 1e-320"),
        (f"{POWER_LAW}roughness_m3 = 0\nexponent = 2", "roughness_m3 must be finite and > 0 m^3, got 0.0"),
        ('kind = "iso-8608"\nclass = "Z"', "class must be one of A, B, C, D, E, F, G, H, got 'Z'"),
        ('kind = "iso-8608"\nclass = 3', "class must be a text, got 3"),
        (f'{ISO}level = "lower"', "level must be one of geometric mean, upper, got 'lower'"),
        (
            f"{ISO}speed = 3",
            "speed must be one of the keys kind, coherence, contact_length_m, class, level, waviness, got 3",
        ),
        (f"coherence = 3\n{ISO}", "coherence must be a table, got 3"),
        (
            f"{ISO}[coherence]",
            "coherence.kind must be one of isotropic, exponential, constant, tabulated, got None",
        ),
        (
            f'{ISO}[coherence]\nkind = "exponential"',
            "coherence.decay must be given, got none",
        ),
        (
            f'{ISO}[coherence]\nkind = "constant"\nvalue = 2',
            "coherence.value must be a number from 0.0 to 1.0, got 2.0",
        ),
        (
            f'{ISO}[coherence]\nkind = "tabulated"\nfile = "c.csv"\ndistance_m = 1',
            "coherence.file must be from 0 to 1, got 0.5 to 1.5",
        ),
        (
            f'{ISO}[coherence]\nkind = "tabulated"\ndistance_m = 1',
            "coherence.file must be given, got none",
        ),
        ('kind = "measured"\nfile = 3', "file must be a text, got 3"),
        (
            'kind = "measured"',
            "file must be given, got none",
        ),
        (
            'kind = "measured"\nfile = "c.csv"',
            "c.csv: columns must be 'wavenumber [cycle/m]' and 'psd [m^3]', or a distance and heights, got ",
        ),
        (
            'kind = "measured"\nfile = "s.csv"\nsegment_m = 3',
            "s.csv: a spectrum takes neither step nor track_width nor segment",
        ),
    ],
)
def test_bad_toml_is_one_line(tmp_path, text, message):
    written(tmp_path, "c.csv", "wavenumber [cycle/m],coherence [-]\n0.1,0.5\n0.2,1.5\n")
    written(tmp_path, "s.csv", SPECTRUM)
    path = written(tmp_path, "r.toml", text)
    with pytest.raises(ValueError, match=rf"^{re.escape(str(path))}(:\d+)?: ") as error:
        load_road(path)
    assert message in str(error.value)


@pytest.mark.parametrize("text", ["c", "CC", "C-mean", "", "road.doc", "I", "A-lower"])
def test_other_names_are_no_roads(text):
    with pytest.raises(ValueError, match=r"^(road|road_class|level) must be [^\n]*$"):
        load_road(text)


def test_files_that_are_not_there(tmp_path):
    for name in ("no.csv", "no.toml"):
        with pytest.raises(OSError, match="No such file"):
            load_road(tmp_path / name)


NAMES = st.sampled_from(
    ["distance [m]", "height [m]", "left [m]", "right [m]", "height at y = 0.5 m [m]", "height at y = 9e999 m [m]",
     "wavenumber [cycle/m]", "psd [m^3]", "coherence [-]", '"', "#", ""]
)  # fmt: skip
CELLS = st.one_of(st.floats().map(repr), st.integers(-3, 300).map(str), st.text(max_size=3))
TABLES = st.builds(
    lambda names, body: "\n".join([",".join(names), *(",".join(row) for row in body)]),
    st.lists(NAMES, max_size=3),
    st.lists(st.lists(CELLS, max_size=3), max_size=5),
)
LONG = st.builds(
    lambda heights, step: "\n".join([P, *(f"{i * step!r},{heights[i % len(heights)]!r}" for i in range(260))]),
    st.lists(st.floats(), min_size=1, max_size=4),
    st.floats(0, 1e12),
)


def check_read_or_refused(path: Path, read) -> None:
    """Read a file, or have it refused in one line that names it."""
    try:
        read(path)
        refusal = str(path)
    except ValueError as error:
        refusal = str(error)
    assert str(path) in refusal
    assert len(refusal.splitlines()) == 1


@given(st.one_of(st.text(), TABLES, LONG, st.binary()))
@example(rows(P, *(f"{i},{1e9 * (-1) ** i}" for i in range(300))))
@example(rows(P, *(f"{1e-310 * i!r},{i % 7}" for i in range(300))))
@example(rows(S, "1e-320,1e-320", "1e9,1e-320"))
def test_whatever_the_text_of_a_table_it_is_read_or_refused(tmp_path_factory, text):
    content = text if isinstance(text, bytes) else text.encode(errors="surrogatepass")
    path = written(tmp_path_factory.getbasetemp(), "fuzz.csv", content)
    for read in (
        lambda p: load_road(p).describe(),
        lambda p: load_profile(p, track_width=1.5),
        lambda p: read_curve(p, PSD),
        lambda p: read_curve(p, COHERENCE),
    ):
        check_read_or_refused(path, read)


KEYS = st.sampled_from(
    ["kind", "roughness_m3", "exponent", "class", "level", "waviness", "file", "segment_m", "coherence.kind",
     "coherence.decay", "reference_cycle_per_m", "x"]
)  # fmt: skip
VALUES = st.one_of(
    st.sampled_from(
        [
            '"power-law"',
            '"iso-8608"',
            '"measured"',
            '"C"',
            '"fuzz.csv"',
            '"isotropic"',
            "[1]",
            "1e400",
            "1979-05-27",
        ]
    ),
    st.floats().map(repr),
    st.integers().map(str),
)
TOMLS = st.lists(st.tuples(KEYS, VALUES), max_size=5).map(lambda lines: "\n".join(f"{k} = {v}" for k, v in lines))


@given(st.one_of(st.text(), TOMLS, st.binary()))
@example(f'kind = "power-law"\nexponent = 1{"0" * 400}\nroughness_m3 = 1')
@example(f"x = {'[' * 5000}")
@example('kind = "power-law"\nexponent = 1e9\nroughness_m3 = 1')
def test_whatever_the_text_of_a_toml_it_is_read_or_refused(tmp_path_factory, text):
    folder = tmp_path_factory.getbasetemp()
    written(folder, "fuzz.csv", SPECTRUM)
    content = text if isinstance(text, bytes) else text.encode(errors="surrogatepass")
    check_read_or_refused(written(folder, "fuzz.toml", content), lambda p: load_road(p).describe())
