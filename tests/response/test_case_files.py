"""Load cases of problem files: the top of a file gives what a case does not."""

import re

import pytest

from suspension_ctrl import Iso8608Road, LoadCase, Payload, load_problem, load_vehicle

TOP = """measures = ["ACC", "SWS"]
vehicle = "minaker_half"
road = "C"
speed_m_per_s = 15
band_Hz = [0.3, 20]
"""
CASES = """
[[payload]]
mass_kg = 50
position_m = [-1, 0]
[[cases]]
share = 2
[[cases]]
road = "B"
speed = "72 km/h"
[[cases.payload]]
mass_kg = 100
position_m = [-1, 0]
[[cases]]
vehicle = "jian_2022_full"
"""


def written(folder, text):
    path = folder / "p.toml"
    path.write_text(text)
    return path


def test_without_cases_the_top_is_the_one_case(tmp_path):
    (case,) = load_problem(written(tmp_path, TOP)).cases
    assert case == LoadCase(vehicle=load_vehicle("minaker_half").vehicle, road=Iso8608Road("C"), speed=15.0)


def test_a_case_takes_from_the_top_what_it_does_not_name(tmp_path):
    half, full = load_vehicle("minaker_half"), load_vehicle("jian_2022_full")
    light, heavy = (Payload(mass=mass, position=(-1.0, 0.0)) for mass in (50.0, 100.0))
    bounds = "[bounds]\nfront.spring_N_per_m = [1e4, 3e4]\n[struts]\n" + "".join(
        f"{name} = 2e3\n" for name in ("front.damper_N_s_per_m", "rear.spring_N_per_m", "rear.damper_N_s_per_m")
    )
    text = TOP.replace("band_Hz", "nodes = 2048\nband_Hz")
    assert load_problem(written(tmp_path, text + bounds.replace("2e3", "9e3") + CASES)).cases == (
        LoadCase(vehicle=light.on(half.vehicle), road=Iso8608Road("C"), speed=15.0, share=2.0),
        LoadCase(vehicle=heavy.on(half.vehicle), road=Iso8608Road("B"), speed=20.0),
        LoadCase(
            vehicle=light.on(full.vehicle), road=Iso8608Road("C"), speed=15.0, roll_geometry=full.roll_geometry
        ),
    )


@pytest.mark.parametrize(
    ("old", "new", "messages"),
    [
        ('"minaker_half"', "3", [":2: vehicle must be a text, got 3"]),
        (
            'road = "C"\n',
            "",
            [": cases[1].road must be given, got none", ": cases[3].road must be given, got none"],
        ),
        ('road = "C"', 'road = "Z"', [":3: road: road_class must be one of A, B, C, D, E, F, G, H, got 'Z'"]),
        ("_per_s = 15", '_per_s = "fast"', [":4: speed_m_per_s must be a number from "]),
        ("mass_kg = 50", "mass_kg = -50", [":8: payload[1].mass_kg must be finite and > 0 kg, got -50.0"]),
        ("share = 2\n", "spede = 3\n", [":11: cases[1].spede must be one of the keys vehicle, road, "]),
    ],
)
def test_mistakes_at_the_top_are_said_once(tmp_path, old, new, messages):
    text = TOP + CASES
    assert old in text
    path = written(tmp_path, text.replace(old, new, 1))
    with pytest.raises(ValueError, match="must") as error:
        load_problem(path)
    said = str(error.value).split("\n")
    assert len(said) == len(messages)
    for line, message in zip(said, messages, strict=True):
        assert re.sub(r":\d+: cases", ": cases", line.removeprefix(str(path))).startswith(
            re.sub(r":\d+: cases", ": cases", message)
        )
