"""Mistakes of vehicle, road, problem and study files are a line each, five at once five; all else is read back."""

import tomllib
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

from spoilt import changed
from suspension_ctrl import (
    FlexibleBody,
    HalfCar,
    Iso8608Road,
    LoadCase,
    Measure,
    MeasuredRoad,
    Payload,
    PowerLawRoad,
    RideProblem,
    Seat,
    Tabulated,
    VehicleFile,
    load_problem,
    load_road,
    load_study,
    load_vehicle,
    save_problem,
    save_road,
    save_study,
    save_vehicle,
    weighting,
)
from suspension_ctrl.datafiles import path as data
from suspension_ctrl.datafiles import stems

READERS: dict[str, Callable] = {
    "vehicle": load_vehicle, "road": load_road, "problem": load_problem, "study": load_study,
}  # fmt: skip
FILES = {
    "vehicle": data("vehicles/jian_2022_full.toml").read_text(),
    "road": """kind = "two-slope"
roughness_m3 = 2e-5
reference_cycle_per_m = 0.1
lower_exponent = 3
upper_exponent = 2.25
corner_cycle_per_m = 0.2
[coherence]
kind = "exponential"
decay = 3.0
""",
    "problem": data("studies/full_car.toml").read_text(),
    "study": """title = "Mine"
vehicle = "yuen_ramli_2010"
road = "C"
speed = "80 km/h"
measures = ["ACC", "DTL"]
constraints = ["SWS <= 12mm"]
weighting = "Wk"
band_Hz = [0.1, 20]

[bounds]
spring_N_per_m = [10e3, 60e3]
damper = ["0.5 kN s/m", "5 kN s/m"]

[present]
spring_N_per_m = 25e3
damper = "2 kN s/m"

[search]
algorithms = ["nsga2", "moead-dra"]
populations = [40, 60]
iterations = [3]
repeats = 2
seeds = 5
seed = 0
target = 0.9
""",
}
TABLE = tomllib.loads(Path(__file__).with_name("mistakes.toml").read_text(encoding="utf-8"))
MISTAKES = [(kind, *one.values()) for kind, listed in TABLE.items() for one in listed]


def said(folder: Path, kind: str, text: str) -> list[str]:
    """Mistakes of a file without its path."""
    path = folder / "f.toml"
    path.write_text(text)
    with pytest.raises(ValueError, match="must") as error:
        READERS[kind](path)
    lines = str(error.value).split("\n")
    assert all(line.startswith(str(path)) and line.isprintable() for line in lines)
    return [line.removeprefix(str(path)) for line in lines]


@pytest.mark.parametrize(("kind", "old", "new", "message"), MISTAKES)
def test_a_mistake_is_one_line_with_file_line_key_value_and_what_is_allowed(tmp_path, kind, old, new, message):
    assert said(tmp_path, kind, changed(FILES[kind], old, new)) == [message]


def test_there_are_forty_of_studies_and_of_the_others():
    assert len(TABLE["study"]) >= 40
    assert len(MISTAKES) - len(TABLE["study"]) >= 40
    assert set(TABLE) == set(READERS)


@pytest.mark.parametrize(
    ("kind", "places"),
    [
        ("vehicle", (3, 12, 14, 17, 19)),
        ("vehicle", (8, 14, 18, 20, 21)),
        ("road", (49, 50, 51, 52, 54)),
        ("problem", (57, 58, 60, 62, 63)),
        ("problem", (59, 61, 63, 64, 67)),
        ("problem", (57, 61, 63, 65, 66)),
    ],
)
def test_five_mistakes_at_once_are_five_lines(tmp_path, kind, places):
    text = FILES[kind]
    for place in places:
        text = changed(text, *MISTAKES[place][1:3])
    expected = [MISTAKES[place][3].partition(": ")[2] for place in places]  # lines move with the others
    assert sorted(line.partition(": ")[2] for line in said(tmp_path, kind, text)) == sorted(expected)


def test_six_mistakes_of_a_study_are_six_lines(tmp_path):
    """In the problem, the present design and the settings of searches."""
    text = FILES["study"]
    for old, new in (
        ("80 km/h", "80"),
        ('"DTL"', '"DLT"'),
        ("[10e3, 60e3]", "[60e3, 10e3]"),
        ('damper = "2 ', 'dampr = "2 '),
        ("[40, 60]", "[3, 60]"),
        ("SWS <= 12mm", "SWS < 12mm"),
    ):
        text = changed(text, old, new)
    assert sorted(line.partition(" must")[0] for line in said(tmp_path, "study", text)) == [
        ":11: bounds.spring_N_per_m",
        ":16: present.dampr",
        ":20: search.populations",
        ":4: speed",
        ":5: measures[2]: response",
        ":6: constraints[1]: constraint",
    ]


def test_a_seat_that_cannot_be_read_hides_no_other_mistake(tmp_path):
    """Its own coefficients are unknown then and no mistakes."""
    text = changed(FILES["vehicle"], "[struts]\nfront", '[[seats]]\nname = 3\nmass_kg = "x"\n[struts]\nfront')
    text = changed(changed(text, "= 10e3", "= 0"), "[5e3, 20e3]", "[20e3, 5e3]")
    text = changed(text, "[bounds.front]", "[bounds.driver]\nspring_N_per_m = [1, 2]\n[bounds.front]")
    assert [line.partition(": ")[2].partition(" must")[0] for line in said(tmp_path, "vehicle", text)] == [
        "seats[1].name",
        "seats[1].mass_kg",
        "seats[1].spring_N_per_m",
        "seats[1].damper_N_s_per_m",
        "struts.front.spring_N_per_m",
        "bounds.front.spring_N_per_m",
    ]


def test_a_seat_that_does_not_fit_hides_no_other_mistake_of_a_problem(tmp_path):
    text = changed(FILES["problem"], 'name = "driver"', 'name = "body"')
    text = changed(changed(text, "[0.1, 20.0]", "[20.0, 0.1]"), "[6.5e3, 30e3]", "[6.5e3]")
    assert [line.partition(": ")[2].partition(" must")[0] for line in said(tmp_path, "problem", text)] == [
        "seats[1].name",
        "band_Hz",
        "bounds.rear.spring_N_per_m",
    ]


def test_mistakes_of_a_file_that_a_problem_names_have_both_places(tmp_path):
    (tmp_path / "car.toml").write_text(changed(changed(FILES["vehicle"], "1040", "-1"), "1580", "-2"))
    text = changed(FILES["problem"], "speed_m_per_s = 10.0", 'vehicle = "car.toml"\nspeed = "36km/h"')
    car = f":45: cases[1].vehicle: {tmp_path / 'car.toml'}"
    assert said(tmp_path, "problem", text) == [
        f"{car}:9: body_mass_kg must be finite and > 0 kg, got -1.0",
        f"{car}:11: pitch_inertia_kg_m2 must be finite and > 0 kg m^2, got -2.0",
    ]


SHIPPED = [(folder, stem) for folder in ("vehicles", "roads", "studies") for stem in stems(folder)]
SAVERS: dict[str, tuple[Callable, Callable]] = {
    "vehicles": (load_vehicle, save_vehicle),
    "roads": (load_road, save_road),
    "studies": (load_study, save_study),
}


@pytest.mark.parametrize(("folder", "stem"), SHIPPED)
def test_every_shipped_file_reads_writes_and_reads_back_equal(tmp_path, folder, stem):
    load, save = SAVERS[folder]
    once = load(data(f"{folder}/{stem}.toml"))
    save(tmp_path / "f.toml", once)
    again = load(tmp_path / "f.toml")
    assert again == once
    assert repr(again) == repr(once)


def test_vehicles_with_all_parts_are_written(tmp_path):
    car = HalfCar(
        body_mass=700.0, pitch_inertia=1200.0, front_wheel_mass=40.0, rear_wheel_mass=45.0, rear_tyre_damping=50.0,
        front_tyre_stiffness=2e5, rear_tyre_stiffness=2.1e5, cg_to_front=1.2, cg_to_rear=1.5,
    )  # fmt: skip
    shapes = {(1.2, 0.0): (0.06, 0.05), (-1.5, 0.0): (0.06, -0.05), (0.1, 0.0): (-0.03, 0.01)}
    car = FlexibleBody(frequencies=(18.0, 25.5), damping_ratios=(0.02, 0.03), shapes=shapes).on(car)
    for name in ("driver", "guest"):
        car = Seat(name=name, mass=60.0, spring=8000.0, damper=500.0, position=(0.1, 0.0)).on(car)
    file = VehicleFile(vehicle=car, bounds={"guest.damper": (1.0, 2.0), "rear.spring": (1e4, 2e4)})
    for one in (file, VehicleFile(vehicle=Payload(mass=100.0, position=(1.2, 0.0)).on(car))):
        save_vehicle(tmp_path / "f.toml", one)
        assert load_vehicle(tmp_path / "f.toml") == one
    late = Seat(name="late", mass=60.0, spring=8000.0, damper=500.0, position=(0.1, 0.0))
    loaded = Payload(mass=100.0, position=(1.2, 0.0)).on(car)
    with pytest.raises(ValueError, match=r"^a file must hold all of what is written, got VehicleFile"):
        save_vehicle(tmp_path / "g.toml", VehicleFile(vehicle=late.on(loaded)))  # parts in another order
    assert not (tmp_path / "g.toml").exists()


@pytest.mark.parametrize(
    "road",
    [
        Iso8608Road("H", level="lower", waviness=2.5),
        PowerLawRoad(roughness=1e-6, exponent=2.0, coherence=Tabulated((0.1, 0.2), (0.5, 0.25), 1.5)),
        MeasuredRoad([0.1, 1 / 3, 3.0], [1e-3, 1e-5, 1e-9], source="a survey"),
        MeasuredRoad.from_profile(Iso8608Road("C").profile(409.6, 0.1, 1, (0.75, -0.75))),
    ],
)
def test_roads_are_written(tmp_path, road):
    save_road(tmp_path / "f.toml", road)
    again = load_road(tmp_path / "f.toml")
    assert again == road
    np.testing.assert_array_equal(again.psd([2.0, 9.0], 20.0), road.psd([2.0, 9.0], 20.0))


class OwnRoad(PowerLawRoad):
    """A road of a user's own class."""


def problem(**changes) -> RideProblem:
    file = load_vehicle("minaker_half")
    bounds = {"front.spring": (2e4, 4e4), "rear.damper": (1e3, 4e3)}
    struts = {"front.damper": 1e3, "rear.spring": 4e4}
    vehicle = Payload(mass=50.0, position=(-1.0, 0.0)).on(file.vehicle)
    case = LoadCase(vehicle=vehicle, road=Iso8608Road("C"), speed=20.0)
    given = {
        "cases": [case],
        "bounds": bounds,
        "struts": struts,
        "measures": ["ACC", "SWS front"],
        "band": (0.5, 20.0),
    }
    return RideProblem(**{**given, **changes})


def test_problems_are_written(tmp_path):
    kinds = {"front.spring": (2.5e4, 3e4), "rear.damper": "log"}
    one = problem(kinds=kinds, constraints=["SWS <= 0.1"], worst_case=True, weighting="Wb", nodes=512)
    save_problem(tmp_path / "f.toml", one)
    again = load_problem(tmp_path / "f.toml")
    assert again == one
    np.testing.assert_array_equal(again.evaluate([[3e4, 2e3]]), one.evaluate([[3e4, 2e3]]))
    assert "nodes = 512" in (tmp_path / "f.toml").read_text()
    save_problem(tmp_path / "g.toml", problem())  # its nodes are found anew when it changes
    assert "nodes" not in (tmp_path / "g.toml").read_text()


def test_struts_in_pairs_are_written_one_by_one(tmp_path):
    pairs = problem(bounds={"front.spring": (2e4, 4e4), "front.damper": (1e3, 4e3)}, struts={"rear": (4e4, 2e3)})
    save_problem(tmp_path / "f.toml", pairs)
    again = load_problem(tmp_path / "f.toml")
    assert again.struts == {"rear.spring": 4e4, "rear.damper": 2e3}
    np.testing.assert_array_equal(again.evaluate([[3e4, 2e3]]), pairs.evaluate([[3e4, 2e3]]))


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"weighting": weighting("Wk")}, "weighting must be a text, got "),
        ({"road": OwnRoad(roughness=1e-6, exponent=2.0)}, "a file must hold one of power-law, .* got OwnRoad"),
        ({"measures": ["ACC", Measure("own", "m", lambda designs: designs[:, 0])]}, r"measures\[2\]: response "),
        ({"bounds": {"rear.damper": (1e3, 4e3), "front.spring": (2e4, 4e4)}}, "bounds must be in the vehicle's "),
    ],
)  # fmt: skip
def test_a_problem_that_a_file_cannot_hold_is_refused_in_one_line(tmp_path, changes, message):
    with pytest.raises(ValueError, match=rf"^{message}[^\n]*$"):
        save_problem(tmp_path / "f.toml", problem(**changes))
    assert not (tmp_path / "f.toml").exists()


@pytest.mark.parametrize(
    ("save", "message"),
    [
        (
            lambda path: save_vehicle(path, load_vehicle("minaker_half").vehicle),
            "file must be a VehicleFile, got Half",
        ),
        (
            lambda path: save_road(path, "C"),
            "a file must hold one of power-law, two-slope, iso-8608, measured, got 'C'",
        ),
        (lambda path: save_problem(path, 3), "problem must be a RideProblem, got 3"),
        (lambda path: VehicleFile(vehicle=3), "vehicle must be a Vehicle, got 3"),
    ],
)
def test_other_objects_are_refused_in_one_line(tmp_path, save, message):
    with pytest.raises(ValueError, match=rf"^{message}[^\n]*$"):
        save(tmp_path / "f.toml")


def test_a_vehicle_without_name_source_struts_and_bounds_is_read(tmp_path):
    path = tmp_path / "f.toml"
    path.write_text('kind = "quarter-car"\nbody_mass = "0.3 t"\nwheel_mass_kg = 40\ntyre_stiffness = "200 N/mm"\n')
    file = load_vehicle(path)
    assert (file.name, file.source, file.setting, file.bounds) == ("", "", {}, {})
    assert (file.vehicle.body_mass, file.vehicle.tyre_stiffness) == (300.0, 200e3)


@pytest.mark.parametrize(
    ("kind", "name"), [("vehicle", "a/b.toml"), ("road", "a/b.toml"), ("problem", "a/b.toml")]
)
def test_a_file_that_is_not_there_is_named(tmp_path, kind, name):
    with pytest.raises(FileNotFoundError, match=r"b\.toml"):
        READERS[kind](tmp_path / name)
