"""Files of a design: each is read back by its own reader and is the same design."""

import json
import re
from dataclasses import replace

import control
import numpy as np
import pandas as pd
import pytest

from garage import QUARTER, ROAD, SPEED
from suspension_ctrl import (
    Iso8608Road,
    LoadCase,
    Nsga2,
    Payload,
    Plant,
    RideProblem,
    Spring,
    TableDamper,
    candidates,
    export,
    load_system,
    load_vehicle,
    minimise,
    parallel,
    ride,
)
from suspension_ctrl.desk.exporting import save_candidates, script_name

BOUNDS = {"spring": (10e3, 30e3), "damper": (500.0, 5e3)}
PROBLEM = RideProblem(QUARTER, ROAD, speed=SPEED, bounds=BOUNDS)
VALUES = [12345.678, 1616.3]


def names(files) -> list[str]:
    return [file.name for file in files]


def test_each_file_is_the_design(tmp_path):
    files = export(PROBLEM, VALUES, tmp_path / "new" / "folder", present=[22e3, 1500.0], name="least ACC")
    assert names(files) == [f"least_ACC.{ending}" for ending in ("toml", "mat", "m", "json", "pdf")]
    assert all(file.is_file() for file in files)
    file, closed = load_vehicle(files[0]), QUARTER.closed(VALUES)
    here = ride(file.vehicle, file.setting, ROAD, SPEED)["value"]
    np.testing.assert_array_equal(here, ride(QUARTER, VALUES, ROAD, SPEED)["value"])
    np.testing.assert_array_equal(load_system(files[1]).A, closed.A)
    assert "InputUnit" in files[2].read_text()
    assert json.loads(files[3].read_text())["design"]["spring"]["value"] == VALUES[0]
    assert files[4].read_bytes().startswith(b"%PDF")


def test_the_command_ride_takes_the_vehicle_bit_for_bit(tmp_path, called):
    problem = PROBLEM.replace(road=Iso8608Road("C"))
    path = export(problem, VALUES, tmp_path / "files")[0]
    done = called("ride", "--vehicle", path, "--road", "C", "--speed", str(SPEED), "--out", tmp_path / "out")
    assert done.returncode == 0, done.stderr
    table = pd.read_csv(tmp_path / "out" / "ride.csv", index_col="name")["value"]
    np.testing.assert_array_equal(table, ride(QUARTER, VALUES, problem.road, SPEED)["value"])


def test_the_same_design_gives_the_same_files(tmp_path):
    once, again = (export(PROBLEM, VALUES, tmp_path / folder) for folder in "ab")
    for one, other in zip(once, again, strict=True):
        assert one.read_bytes() == other.read_bytes()


def test_a_laden_vehicle_has_files_of_its_own(tmp_path):
    laden = Payload(mass=100.0).on(QUARTER)
    cases = [*PROBLEM.cases, *(LoadCase(vehicle=one, road=ROAD, speed=10.0) for one in (QUARTER, laden))]
    files = export(PROBLEM.replace(cases=cases), VALUES, tmp_path, name="knee")
    assert names(files) == [
        *(f"knee.{ending}" for ending in ("toml", "mat", "m")),
        *(f"knee_case_3.{ending}" for ending in ("toml", "mat", "m")),
        "knee.json",
        "knee.pdf",
    ]
    assert load_vehicle(files[3]).vehicle == laden


def test_a_vehicle_of_frequency_responses_has_a_table(tmp_path):
    f = np.arange(0.4, 21.0, 0.1)
    plant = QUARTER.plant()
    measured = control.frd(
        plant(2j * np.pi * f), 2 * np.pi * f, inputs=plant.input_labels, outputs=plant.output_labels
    )
    bounds = {"spring": (20e3, 30e3), "damper": (2500.0, 4000.0)}
    problem = RideProblem(Plant(measured), ROAD, speed=SPEED, bounds=bounds, band=(5.0, 20.0))
    assert names(export(problem, [25e3, 3000.0], tmp_path)) == ["design.csv", "design.json", "design.pdf"]
    assert load_system(tmp_path / "design.csv").output_labels[0] == "body_acceleration"


@pytest.mark.parametrize(
    ("name", "stem"),
    [
        ("knee", "knee"),
        ("least ACC", "least_ACC"),
        ("2nd", "design_2nd"),
        ("../x", "x"),
        ("", "design"),
        ("é", "design"),
    ],
)
def test_a_name_is_one_that_matlab_runs(name, stem):
    assert script_name(name) == stem


def test_a_mistake_leaves_no_file(tmp_path):
    with pytest.raises(ValueError, match=re.escape("design must have spring, damper, got none for damper")):
        export(PROBLEM, {"spring": 20e3}, tmp_path / "new")
    assert not (tmp_path / "new").exists()


def test_candidates_are_vehicle_files_with_their_numbers_and_names(tmp_path):
    run = minimise(PROBLEM, Nsga2(population=20), iterations=3, seed=1)
    table = candidates(PROBLEM, run, present=[22e3, 1500.0], count=3)
    files = save_candidates(PROBLEM, table, tmp_path / "candidates", "A car")
    assert names(files)[0] == "0_present_design.toml"
    assert [int(name.split("_")[0]) for name in names(files)] == list(table.index)
    for path, (number, row) in zip(files, table.iterrows(), strict=True):
        file = load_vehicle(path)
        assert file.setting == {"spring": row["spring [N/m]"], "damper": row["damper [N s/m]"]}
        assert (file.name, file.bounds) == (f"A car: {number} {row['name']}", BOUNDS)


def test_candidates_of_a_plant_have_no_files(tmp_path):
    plant = PROBLEM.replace(vehicle=Plant(QUARTER.plant()))
    table = candidates(plant, minimise(plant, Nsga2(population=20), iterations=3, seed=1), count=2)
    assert save_candidates(plant, table, tmp_path / "candidates", "A plant") == []
    assert not (tmp_path / "candidates").exists()


def test_a_car_with_force_laws_has_a_state_space_for_each_load_case(tmp_path):
    """Its equivalent damper depends on the road."""
    strut = parallel(Spring(), TableDamper(velocity=[-1.0, -0.1, 0.1, 1.0], force=[-800.0, -300.0, 300.0, 800.0]))
    car = replace(QUARTER, strut=strut)
    cases = [LoadCase(vehicle=car, road=Iso8608Road(one), speed=20.0) for one in "BD"]
    problem = RideProblem(cases=cases, bounds={"spring": (10e3, 30e3)}, band=(0.1, 20.0))
    files = export(problem, [22e3], tmp_path, name="knee")
    assert "knee_case_2.mat" in names(files)
    assert not np.array_equal(*(load_system(tmp_path / f"knee{one}.mat").A for one in ("", "_case_2")))


def test_the_name_of_a_file_has_forty_letters_at_most():
    assert script_name("least ACC, " * 9) == "least_ACC_least_ACC_least_ACC_least_ACC_"
