"""Events in problem files: read as made by hand, written and read back, mistakes among all others."""

from pathlib import Path

import pytest

import suspension_ctrl as sc
from suspension_ctrl.response.event_files import EVENTS

EXAMPLES = {
    "bump": (sc.SpeedBump(height=0.05, length=2.0), 8.0),
    "table": sc.TrapezoidalBump(height=0.08, length=6.0, ramp=1.0, contact_length=0.12),
    "plank": (sc.Plank(height=0.03, length=0.3, side="left"), 10.0),
    "cleat": sc.Cleat(height=0.02, length=0.02),
    "hole": (sc.Pothole(depth=0.06, length=0.5, side="right"), 12.0),
    "kerb": sc.Step(height=0.05),
    "drive": sc.Ramp(height=0.1, length=2.0),
    "waves": (sc.Sine(height=0.01, length=5.0), 15.0),
    "half_wave": sc.Sine(height=0.1, length=5.0, waves=0.5),
    "sweep": sc.Chirp(height=0.01, longest=20.0, shortest=1.0, waves=12.0),
    "shaker": sc.RigSine(motion="heave", amplitude=0.005, frequency=1.5),
    "chirp": sc.RigChirp(motion="heave", amplitude=0.005, lowest=0.5, highest=15.0, waves=40.0),
}
MEASURES = ["ACC", "peak min travel bump", "harshness = peak max body_acceleration plank"]


def problem(**changes) -> sc.RideProblem:
    file = sc.load_vehicle("yuen_ramli_2010")
    given = {"bounds": file.bounds, "events": EXAMPLES, "measures": MEASURES}
    return sc.RideProblem(file.vehicle, sc.Iso8608Road("C"), speed=20.0, **{**given, **changes})


def test_every_kind_of_event_is_written_and_read_back(tmp_path):
    assert {type(one[0] if isinstance(one, tuple) else one) for one in EXAMPLES.values()} == set(EVENTS.values())
    given = problem(constraints=["peak tyre_load kerb <= 9e3"])
    sc.save_problem(tmp_path / "p.toml", given)
    assert sc.load_problem(tmp_path / "p.toml") == given


def test_events_are_read_with_units_and_their_speed(tmp_path):
    path = tmp_path / "p.toml"
    path.write_text("""
measures = ["ACC", "peak travel bump"]
[events.bump]
kind = "speed-bump"
height = "5 cm"
length_m = 2
speed = "28.8 km/h"
[[cases]]
vehicle = "yuen_ramli_2010"
road = "C"
speed_m_per_s = 20
""")
    found = sc.load_problem(path)
    assert dict(found.events) == {"bump": EXAMPLES["bump"]}
    assert found.objectives == ("ACC", "peak travel bump")


def test_events_that_differ_between_cases_have_no_file(tmp_path):
    case = problem().cases[0]
    other = sc.LoadCase(vehicle=case.vehicle, road=case.road, speed=10.0, events={"bump": EXAMPLES["table"]})
    both = sc.RideProblem(cases=[case, other], measures=["ACC", "peak travel bump"], bounds=problem().bounds)
    with pytest.raises(ValueError, match=r"^events .*same"):
        sc.save_problem(Path(tmp_path / "p.toml"), both)
