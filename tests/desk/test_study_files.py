"""Study files: a problem with the present design and settings of searches."""

from dataclasses import replace

import numpy as np
import pytest

from suspension_ctrl import (
    Iso8608Road,
    LoadCase,
    MeasuredRoad,
    Plant,
    RideProblem,
    SearchSettings,
    StudyFile,
    datafiles,
    load_problem,
    load_study,
    load_vehicle,
    save_study,
)
from suspension_ctrl.paper import experiment as paper

STUDY = """
vehicle = "yuen_ramli_2010"
road = "C"
speed = "80 km/h"
measures = ["ACC", "DTL"]
constraints = ["SWS <= 12mm"]

[present]
spring = "20 kN/m"

[search]
algorithms = ["moead-dra"]
populations = [40, 60]
iterations = [3]
seed = 0
target = 0.9
"""


@pytest.fixture
def path(tmp_path):
    file = tmp_path / "s.toml"
    file.write_text(STUDY)
    return file


def test_a_study_is_a_problem_a_present_design_and_settings(path):
    study = load_study(path)
    file = load_vehicle("yuen_ramli_2010")
    assert study.problem == RideProblem(
        file.vehicle, Iso8608Road("C"), speed=200 / 9, bounds=file.bounds, measures=["ACC", "DTL"],
        constraints=["SWS <= 0.012"],
    )  # fmt: skip
    assert study.name == "Yuen and Ramli 2010"
    assert study.present == {"spring": 20e3, "damper": 1500.0}
    assert study.search == SearchSettings(
        algorithms=("moead-dra",), populations=(40, 60), iterations=(3,), target=0.9
    )
    assert load_problem(path) == study.problem


def test_settings_that_a_file_leaves_out_are_those_of_the_caller(path):
    own = SearchSettings(populations=(4000,), repeats=2)
    search = load_study(path, search=own).search
    assert (search.populations, search.repeats, search.seeds) == ((40, 60), 2, 31)


def test_the_papers_study_has_the_values_of_table_1():
    study = load_study("paper")
    assert study.problem == paper.ride_problem()
    assert tuple(study.present.values()) == paper.reference_design()
    configurations = set(
        paper.published_seconds()[["population", "iterations"]].itertuples(index=False, name=None)
    )
    assert configurations == {(n, i) for n in study.search.populations for i in study.search.iterations}
    assert paper.published_seconds().repeat.max() == study.search.repeats


@pytest.mark.parametrize("name", datafiles.stems("studies"))
def test_every_study_of_the_package_has_a_present_design(name):
    study = load_study(name)
    assert tuple(study.present) == study.problem.variables
    assert study.name


def test_the_present_design_of_a_vehicle_without_struts_is_unknown(path, tmp_path):
    (tmp_path / "car.toml").write_text(
        'kind = "quarter-car"\nbody_mass_kg = 300\nwheel_mass_kg = 40\ntyre_stiffness_N_per_m = 2e5\n'
        "[bounds]\nspring_N_per_m = [1e4, 3e4]\ndamper_N_s_per_m = [1e3, 5e3]\n"
    )
    text = STUDY.replace('"yuen_ramli_2010"', '"car.toml"')
    path.write_text(text.replace('[present]\nspring = "20 kN/m"\n', ""))
    assert load_study(path).present == {}
    assert load_study(path).name == "s"
    path.write_text(text)
    with pytest.raises(ValueError, match=r":8: present must hold all of spring, damper, got spring$"):
        load_study(path)
    path.write_text(text.replace("[present]\n", '[present]\ndamper = "2 kN s/m"\n'))
    assert load_study(path).present == {"spring": 20e3, "damper": 2e3}


def test_a_varied_parameter_is_in_the_present_design_as_the_vehicle_has_it(path):
    path.write_text(STUDY + "[bounds]\nspring_N_per_m = [1e4, 3e4]\ntyre_stiffness_N_per_m = [1.5e5, 2e5]\n")
    assert load_study(path).present == {"spring": 20e3, "tyre_stiffness": 192e3}


def test_a_study_of_plants_is_written_with_their_systems(tmp_path):
    file = load_vehicle("yuen_ramli_2010")
    plant = Plant(file.vehicle.plant())
    cases = [LoadCase(vehicle=plant, road=Iso8608Road(name), speed=20.0) for name in "AC"]
    problem = RideProblem(cases=cases, bounds=file.bounds, band=(0.5, 20.0))
    study = StudyFile(problem=problem, present=file.setting)
    save_study(tmp_path / "study.toml", study)
    assert load_study(tmp_path / "study.toml") == replace(study, name="study")
    assert {one.name for one in tmp_path.iterdir()} == {"study.toml", "study_vehicle1.npz"}


def test_objects_are_checked(tmp_path):
    study = load_study("paper")
    with pytest.raises(ValueError, match=r"^present must hold spring, damper, got spring$"):
        replace(study, present={"spring": 1.0})
    with pytest.raises(ValueError, match=r"^present must hold spring, damper, got spring, damper, seat$"):
        replace(study, present={"spring": 1.0, "damper": 1.0, "seat": 1.0})
    with pytest.raises(ValueError, match=r"^problem must be a RideProblem, got 3$"):
        replace(study, problem=3)
    with pytest.raises(ValueError, match=r"^study must be a StudyFile, got 3$"):
        save_study(tmp_path / "s.toml", 3)
    with pytest.raises(ValueError, match=r"^population must be >= 15 for 3 objectives, .* got 14$"):
        replace(study, search=SearchSettings(populations=[14]))


def test_a_study_holds_a_long_measured_road(path):
    """The longest that a file may have, with all digits."""
    n = np.geomspace(0.01, 10.0, 10_000)
    road = f"{{kind = 'measured', wavenumber_cycle_per_m = {n.tolist()}, density_m3 = {(1e-9 / n**2.1).tolist()}}}"
    path.write_text("nodes = 64" + STUDY.replace('"C"', road))
    assert load_study(path).problem.cases[0].road == MeasuredRoad(n, 1e-9 / n**2.1)


def test_unusual_sizes_are_read_where_the_file_says_so_or_with_units(path):
    odd = STUDY.replace('speed = "80 km/h"', "speed_m_per_s = 0.01").replace("12mm", "12")
    odd = odd.replace("measures", "band_Hz = [0.1, 2e3]\nmeasures", 1)
    path.write_text(odd)
    with pytest.raises(ValueError, match="must be") as error:
        load_study(path)
    assert [line.partition(" must")[0].removeprefix(str(path)) for line in str(error.value).split("\n")] == [
        ":4: speed_m_per_s",
        ":5: band_Hz",
        ":7: constraints[1]: limit of SWS",
    ]
    path.write_text(f"unusual = true\n{odd}")
    problem = load_study(path).problem
    assert (problem.cases[0].speed, problem.band, problem.constraints[0].value) == (0.01, (0.1, 2e3), 12.0)


def test_files_that_are_absent_hide_no_other_mistakes(path):
    """All lines at once; with an absent file among them it is an OSError too, and alone that error itself."""
    text = STUDY.replace('"yuen_ramli_2010"', '"no.toml"').replace('"C"', '"no.csv"')
    path.write_text(text.replace("SWS <= 12mm", "SWS < 12mm").replace("[40, 60]", "[40, 40]"))
    with pytest.raises(ValueError, match="must be") as error:
        load_study(path)
    assert isinstance(error.value, OSError)
    said = [line.removeprefix(str(path)) for line in str(error.value).split("\n")]
    starts = {
        ":2: vehicle: [Errno 2] No such file or directory: ",
        ":3: road: [Errno 2] No such file or directory: ",
        ":6: constraints[1]: constraint must be like ",
        ":13: search.populations must be one at least and different, got 40, 40",
    }
    assert len(said) == len(starts)
    assert all(any(line.startswith(start) for line in said) for start in starts)
    path.write_text(STUDY.replace('"yuen_ramli_2010"', '"no.toml"'))
    with pytest.raises(FileNotFoundError, match=r"no\.toml"):
        load_study(path)


def test_a_search_without_settings_is_that_of_the_paper_and_of_31_seeds():
    search = SearchSettings()
    assert (search.algorithms, search.populations, search.iterations) == (
        ("nsga2", "moead-dra"), (500, 1000), (10, 20)
    )  # fmt: skip
    assert (search.repeats, search.seeds, search.seed, search.target) == (5, 31, 0, 0.995)


@pytest.mark.parametrize(("measures", "least"), [('["ACC", "DTL"]', 10), ('["ACC", "SWS", "DTL"]', 15)])
def test_a_population_too_small_for_an_algorithm_is_a_mistake_of_its_line(path, measures, least):
    path.write_text(STUDY.replace('["ACC", "DTL"]', measures).replace("[40, 60]", "[9]"))
    with pytest.raises(ValueError, match=rf"^[^\n]*search\.populations must be >= {least} [^\n]*, got 9$"):
        load_study(path)
