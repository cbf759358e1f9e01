"""Property files in TeimOrbit format: units, signs, comments and encodings; whatever else is refused in a line."""

import re

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import suspension_ctrl as sc
from spoilt import changed

DAMPER = """$---------------------------------------------------------------------MDI_HEADER
[MDI_HEADER]
 FILE_TYPE     =  'dpr'
 FILE_VERSION  =  4.0
 FILE_FORMAT   =  'ASCII'
(COMMENTS)
{comment_string}
'A valve of our own, ! 3 rows'
$--------------------------------------------------------------------------UNITS
[UNITS]
 LENGTH  =  'mm'
 ANGLE   =  'degrees'
 FORCE   =  'newton'
 MASS    =  'kg'
 TIME    =  'second'   $ of all numbers
! a comment
$--------------------------------------------------------------------------CURVE
[CURVE]
{    vel             force  }
   -520.5           -810.0
      0.0               0    $ origin
     51.0            2.5E+02 ! rebound
"""
SPRING = changed(
    changed(DAMPER, "'dpr'", "'spr'"),
    DAMPER[DAMPER.index("[CURVE]") :],
    """[SPRING_DATA]
 FREE_LENGTH = 300.0
[CURVE]
{ disp force }
-50 -1000
0 0
100 2000
150 5000
""",
)
STOP = DAMPER[: DAMPER.index("[CURVE]")] + "[CURVE]\n{ disp force }\n0 0\n10 100\n20.5 1000\n"
TABLE = {"velocity": [-0.5205, 0.0, 0.051], "force": [-810.0, 0.0, 250.0]}


def read(folder, text: str | bytes, name: str = "f.dpr", **parameters):
    (folder / name).write_bytes(text if isinstance(text, bytes) else text.encode())
    return sc.load_property(folder / name, **parameters)


@pytest.mark.parametrize(
    "text",
    [
        DAMPER,
        DAMPER.replace("\n", "\r\n"),
        DAMPER.replace("\n", "\r"),
        b"\xef\xbb\xbf" + DAMPER.encode(),
        DAMPER.replace("our own", "Müller & Söhne").encode("latin-1"),
        DAMPER.lower(),
        DAMPER.replace("MDI_HEADER]", "HEADER]").replace("[CURVE]", "[CURVE]\n(XY_DATA)"),
        DAMPER.replace("{    vel             force  }", "{velocity force}"),
        re.sub(
            r" LENGTH(.*\n)*? TIME.*",
            "(BASE)\n{length force angle mass time}\n'mm' 'newton' 'deg' 'kg' 's'",
            DAMPER,
        ),
    ],
)
def test_a_damper_is_read_from_every_spelling(tmp_path, text):
    assert read(tmp_path, text) == sc.TableDamper(**TABLE)


@pytest.mark.parametrize(
    ("units", "velocity", "force"),
    [
        (("meter", "newton", "second"), 1.0, 1.0),
        (("mm", "kN", "ms"), 1.0, 1e3),
        (("inch", "pound_force", "sec"), 0.0254, 4.4482216152605),
        (("cm", "kgf", "minute"), 0.01 / 60, 9.80665),
        (("FOOT", "Newton", "hour"), 0.3048 / 3600, 1.0),
    ],
)
def test_units_are_those_of_the_block(tmp_path, units, velocity, force):
    text = DAMPER
    for old, new in zip(("'mm'", "'newton'", "'second'"), units, strict=True):
        text = changed(text, old, f"'{new}'")
    damper = read(tmp_path, text)
    np.testing.assert_allclose(damper.velocity, [-520.5 * velocity, 0.0, 51.0 * velocity], rtol=1e-15)
    np.testing.assert_allclose(damper.force, [-810.0 * force, 0.0, 250.0 * force], rtol=1e-15)


def test_a_damper_with_compression_positive_is_turned(tmp_path):
    turned = sc.TableDamper(velocity=[-0.051, 0.0, 0.5205], force=[-250.0, 0.0, 810.0])
    assert read(tmp_path, DAMPER, compression_positive=True) == turned


def test_a_spring_changes_about_its_static_position(tmp_path):
    """At 180 mm it is 120 mm shorter than free and carries 3200 N; extended by 20 mm it carries 2000 N."""
    for mounting in ({"installed_length": 0.18}, {"static_load": 3200.0}):
        spring = read(tmp_path, SPRING, "f.spr", **mounting)
        np.testing.assert_allclose(spring.deflection, [-0.03, 0.02, 0.12, 0.17], rtol=1e-14)
        np.testing.assert_allclose(spring.force, [-1800.0, 1200.0, 3200.0, 4200.0], rtol=1e-14)


def test_a_stop_is_read_and_given_a_gap_in_a_vehicle_file(tmp_path):
    stop = read(tmp_path, STOP, "f.bum")
    assert stop == sc.BumpStop(compression=[0.0, 0.01, 0.0205], force=[0.0, 100.0, 1000.0])
    (tmp_path / "f.dpr").write_text(DAMPER)
    (tmp_path / "f.spr").write_text(SPRING)
    (tmp_path / "car.toml").write_text("""
kind = "quarter-car"
body_mass_kg = 317.5
wheel_mass_kg = 45.4
tyre_stiffness_N_per_m = 192e3
[strut]
layout = "coil | valve | bump_stop | droop"
[strut.coil]
file = "f.spr"
static_load_N = 3200
[strut.valve]
file = "f.dpr"
compression_positive = true
installation_ratio = 0.9
[strut.bump_stop]
file = "f.bum"
gap = "24 mm"
[strut.droop]
kind = "rebound-stop"
file = "f.bum"
""")
    strut = sc.load_vehicle(tmp_path / "car.toml").vehicle.strut
    coil, valve, bump, droop = strut.elements
    assert coil.force.tolist() == sc.load_property(tmp_path / "f.spr", static_load=3200.0).force.tolist()
    assert (valve.name, valve.installation_ratio, valve.velocity[-1]) == ("valve", 0.9, 0.5205)
    assert bump == sc.BumpStop(gap=0.024, compression=stop.compression, force=stop.force)
    assert droop == sc.ReboundStop("droop", compression=stop.compression, force=stop.force)


rates = st.lists(st.integers(1, 10**6), min_size=2, max_size=20, unique=True).map(sorted)


@given(rates, st.lists(st.floats(0.0, 1e3), min_size=41, max_size=41), st.floats(1e-9, 1e-3))
def test_what_is_written_is_read_back(tmp_path_factory, steps, rises, size):
    folder = tmp_path_factory.getbasetemp()
    x = np.concatenate([-np.array(steps)[::-1], [0], steps]) * size
    force = np.cumsum(rises)[: x.size]
    force = force - force[len(steps)]
    damper = sc.TableDamper(velocity=x, force=force)
    sc.save_property(folder / "w.dpr", damper)
    assert sc.load_property(folder / "w.dpr") == damper
    stop = sc.BumpStop(compression=x[len(steps) :], force=force[len(steps) :])
    sc.save_property(folder / "w.bum", stop)
    assert sc.load_property(folder / "w.bum") == stop


def test_a_spring_is_written_with_its_free_length(tmp_path):
    """The free length follows from the installed length, the load and the curve, also beyond its end."""
    spring = read(tmp_path, SPRING, "f.spr", installed_length=0.18)
    for load in (3200.0, 4000.0, 5000.0):
        sc.save_property(tmp_path / "w.spr", spring, installed_length=0.2, static_load=load)
        for mounting in ({"installed_length": 0.2}, {"static_load": load}):
            again = sc.load_property(tmp_path / "w.spr", **mounting)
            np.testing.assert_allclose(again.deflection, spring.deflection, rtol=0, atol=1e-15)
            np.testing.assert_allclose(again.force, spring.force, rtol=0, atol=1e-10)
    sc.save_property(tmp_path / "w.spr", spring, installed_length=0.2, static_load=3200.0)
    free = re.search(r"FREE_LENGTH = (.*)", (tmp_path / "w.spr").read_text())
    assert float(free[1]) == pytest.approx(320.0, abs=1e-9)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("", "the file must have a table { vel force }, got none"),
        ("<?xml version='1.0'?>", "the file must have a table { vel force }, got none"),
        (STOP, "the file must have a table { vel force }, got none"),
        (
            changed(DAMPER, "vel             force", "vel<rpm> torque"),
            "the file must have a table { vel force }, got 'vel<rpm> torque'",
        ),
        (changed(DAMPER, " LENGTH  =  'mm'\n", ""), "LENGTH in [UNITS] must be one of m, meter, .*, got 'none'"),
        (changed(DAMPER, "'second'", "'fortnight'"), "TIME in [UNITS] must be one of s, sec, .*, got 'fortnight'"),
        (changed(DAMPER, "51.0 ", "x "), "vel must be a number with a unit like m/s, got 'x mm/s'"),
        (changed(DAMPER, "51.0 ", "nan "), "vel must be a number with a unit like m/s, got 'nan mm/s'"),
        (changed(DAMPER, "51.0 ", "1e300 "), "vel must be a number from -1000000000.0 to .*, got 1e+297"),
        (changed(DAMPER, "51.0 ", "1e999 "), "vel must be of moderate size, got '1e999 mm/s'"),
        (changed(DAMPER, "51.0 ", "51,0 1 "), "rows must be two numbers, vel and force, got '51,0 1 2.5E+02'"),
        (changed(DAMPER, "   0    $", "  50    $"), "force must be 0 N at velocity 0, got 50 N"),
        (changed(DAMPER, "2.5E+02", "-1"), "force must not fall over velocity, got 0 N, then -1 N"),
        (changed(DAMPER, "51.0 ", "0 "), "velocity must ascend, got 0, then 0"),
        (DAMPER[: DAMPER.index("   -520")], "velocity and force must be of one length, 2 or more, got (0,) .*"),
        (DAMPER + "60 300\n" * 1000, "rows of vel and force must be 1000 or less, got 1003"),
        ("$" * 1_100_000, "the file must be a regular one of at most 1 MB, got 1.1 MB"),
    ],
)  # fmt: skip
def test_a_bad_file_is_one_line(tmp_path, text, message):
    pattern = re.escape(message).replace(r"\.\*", ".*")
    with pytest.raises(ValueError, match=rf"^{re.escape(str(tmp_path / 'f.dpr'))}: {pattern}$"):
        read(tmp_path, text)


@pytest.mark.parametrize(
    ("mounting", "message"),
    [
        ({}, "installed_length or static_load must be given, one of them, for a spring, got none"),
        (
            {"installed_length": 0.2, "static_load": 1.0},
            "installed_length or static_load must be given, .* got both",
        ),
        ({"installed_length": 0.4}, "force must be 0 N at deflection 0, got deflection from -0.25 to -0.05"),
        ({"static_load": 6000.0}, "force must be 0 N at deflection 0, got deflection from 0.01.* to 0.21.*"),
        ({"installed_length": -0.1}, "installed_length must be a number from 1e-06 to 1000000.0, got -0.1"),
    ],
)
def test_a_spring_needs_its_static_position(tmp_path, mounting, message):
    with pytest.raises(ValueError, match=rf"{message}$"):
        read(tmp_path, SPRING, "f.spr", **mounting)
    with pytest.raises(ValueError, match=r"the file must have FREE_LENGTH in .SPRING_DATA., got none$"):
        read(tmp_path, changed(SPRING, "FREE_LENGTH", "LENGTH_FREE"), "f.spr", installed_length=0.2)


def test_other_endings_and_elements_are_refused(tmp_path):
    with pytest.raises(
        ValueError, match=r"^ending of a property file must be one of .dpr, .spr, .bum, got '.xml'$"
    ):
        sc.load_property(tmp_path / "f.xml")
    damper, stop = sc.TableDamper(**TABLE), sc.BumpStop(gap=0.02, stiffness=2e5)
    for path, element in (("f.spr", damper), ("f.dpr", sc.Damper()), ("f.bum", stop)):
        with pytest.raises(
            ValueError, match=r"^element must be a Table\w+ with a table|^element must be a BumpStop"
        ):
            sc.save_property(tmp_path / path, element)
    (tmp_path / "f.dpr").write_text(DAMPER)
    (tmp_path / "car.toml").write_text("""
kind = "quarter-car"
body_mass_kg = 317.5
wheel_mass_kg = 45.4
tyre_stiffness_N_per_m = 192e3
[strut]
layout = "spring | damper"
[strut.spring]
kind = "table-spring"
file = "f.dpr"
""")
    with pytest.raises(
        ValueError, match=r"strut.spring.file: .*f.dpr: the file must be of a TableSpring, got one of a "
    ):
        sc.load_vehicle(tmp_path / "car.toml")
