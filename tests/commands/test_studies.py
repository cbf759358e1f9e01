"""The study of a command: the paper's by default, a file's, and with options in place of what it says."""

from dataclasses import replace

import numpy as np
import pandas as pd
import pytest

from suspension_ctrl import Iso8608Road, MeasuredRoad, SearchSettings, datafiles, load_study, load_vehicle
from suspension_ctrl.commands.studies import chosen_study
from suspension_ctrl.paper import experiment as paper
from suspension_ctrl.quantities import column_headers

CAR = """
kind = "quarter-car"
body_mass_kg = 300
wheel_mass_kg = 40.0
tyre_stiffness_N_per_m = 2e5
[struts]
spring_N_per_m = 2e4
damper_N_s_per_m = 1e3
[bounds]
spring_N_per_m = [1e4, 3e4]
"""


def test_without_choice_it_is_the_papers_problem():
    study = chosen_study()
    assert study.problem == paper.ride_problem()
    assert tuple(study.present.values()) == paper.reference_design()
    assert study.search == SearchSettings()
    changed = chosen_study(weighting="Wb", band="0.5,10").problem
    assert changed == paper.ride_problem(weighting="Wb", band=(0.5, 10.0))
    assert paper.is_papers(changed)
    assert not paper.is_papers(changed, band=True)
    assert not paper.is_papers(chosen_study(speed=21.0).problem)


def test_the_papers_vehicle_by_name_has_the_papers_values():
    study = chosen_study(vehicle="yuen_ramli_2010")
    assert tuple(study.present.values()) == paper.reference_design()
    designs = np.random.default_rng(1).uniform(study.problem.lower, study.problem.upper, (5, 2))
    np.testing.assert_array_equal(study.problem.evaluate(designs), paper.ride_problem().evaluate(designs))


@pytest.mark.parametrize("name", ["jian_2022_full", "minaker_half", "yuen_ramli_2010"])
def test_a_vehicle_brings_its_bounds_struts_and_present_design(name):
    file = load_vehicle(name)
    study = chosen_study(vehicle=name, road="C-upper", speed=12.0, weighting="Wd")
    problem = study.problem
    (case,) = problem.cases
    assert (case.vehicle, case.roll_geometry) == (file.vehicle, file.roll_geometry)
    assert (case.road, case.speed) == (Iso8608Road("C", level="upper"), 12.0)
    assert (problem.bounds, problem.weighting) == (file.bounds, "Wd")
    assert problem.measures == paper.ride_problem().measures
    own = file.vehicle.coefficients(file.setting)
    assert study.present == {name: own[name] for name in problem.variables}
    assert study.name == file.name
    assert np.isfinite(problem.evaluate([list(study.present.values())])).all()


def test_a_vehicle_takes_the_place_of_those_of_all_load_cases():
    """With its own roll geometry; roads and shares stay."""
    file = load_vehicle("jian_2022_full")
    study, own = chosen_study(study="half_car", vehicle="jian_2022_full", speed=22.0), load_study("half_car")
    assert {case.roll_geometry for case in study.problem.cases} == {file.roll_geometry}
    wanted = [
        replace(case, vehicle=file.vehicle, roll_geometry=file.roll_geometry, speed=22.0)
        for case in own.problem.cases
    ]
    assert list(study.problem.cases) == wanted
    assert study.problem.constraints == own.problem.constraints


def test_coefficients_without_bounds_stay_those_of_the_file(tmp_path):
    path = tmp_path / "car.toml"
    path.write_text(CAR)
    study = chosen_study(vehicle=str(path))
    assert (study.problem.variables, study.problem.struts) == (("spring",), {"damper": 1e3})
    assert (study.present, study.name) == ({"spring": 2e4}, "car")


def test_another_road_keeps_the_band_as_far_as_it_is_known(tmp_path):
    (tmp_path / "road.csv").write_text("wavenumber [cycle/m],psd [m^3]\n0.02,1e-3\n0.1,1e-4\n1,1e-6\n")
    assert chosen_study(study="half_car", road="D").problem.band == (0.3, 20.0)
    assert chosen_study(study="half_car", road=str(tmp_path / "road.csv")).problem.band == (0.5, 20.0)


def test_settings_of_searches_are_of_options_then_the_file_then_the_command(tmp_path):
    path = tmp_path / "s.toml"
    path.write_text(
        'vehicle = "yuen_ramli_2010"\nroad = "C"\nspeed_m_per_s = 20\nmeasures = ["ACC", "SWS"]\n'
        "[search]\npopulations = [40]\nseed = 3\n"
    )
    command = SearchSettings(populations=(4000,), iterations=(25,))
    study = chosen_study(study=str(path), search=command, seed=5, algorithms="random, sobol", repeats=None)
    assert study.search == SearchSettings(
        algorithms=("random", "sobol"), populations=(40,), iterations=(25,), seed=5
    )


def test_the_study_of_a_comparison_makes_the_same_fronts_bit_for_bit(called, tmp_path):
    """A car from a file, a measured road and other options, then their resolved study alone."""
    (tmp_path / "car.toml").write_text(CAR.replace("[1e4, 3e4]", "[1e4, 3e4]\ndamper_N_s_per_m = [500, 5e3]"))
    (tmp_path / "road.csv").write_text("wavenumber [cycle/m],psd [m^3]\n0.02,1e-3\n0.1,1e-4\n1,1e-6\n")
    options = ("--vehicle", "car.toml", "--road", "road.csv", "--speed", "85 km/h", "--weighting", "Wb")
    sizes = (
        "--populations",
        20,
        "--iterations",
        2,
        "--repeats",
        2,
        "--seed",
        3,
        "--algorithms",
        "nsga2,moead-dra",
    )
    (tmp_path / "front.csv").write_text("ACC [m/s^2],SWS [m],DTL [N]\n0.5,0.02,500\n2,0.005,900\n")
    first = called("compare", *options, *sizes, "--reference", "front.csv", "--out", "one")
    assert first.returncode == 0, first.stderr
    again = called("compare", "--study", "one/study.toml", "--reference", "front.csv", "--out", "two")
    assert again.returncode == 0, again.stderr
    fronts = sorted((tmp_path / "one" / "fronts").iterdir())
    assert len(fronts) == 6
    for front in fronts:
        assert front.read_bytes() == (tmp_path / "two" / "fronts" / front.name).read_bytes()
    assert (tmp_path / "one/study.toml").read_bytes() == (tmp_path / "two/study.toml").read_bytes()


QUICK = {
    "optimum": ("--population", 60, "--iterations", 4),
    "compare": ("--populations", 20, "--iterations", 1, "--repeats", 1, "--algorithms", "nsga2,sobol"),
}


@pytest.mark.parametrize("name", [name for name in datafiles.stems("studies") if name != "paper"])
def test_every_study_of_the_package_is_decided_and_compared(called, tmp_path, name):
    """Candidates are within its limits, with the values of the problem; the comparison has a front of each run.

    That of the paper is the default of all other tests.
    """
    problem = load_study(name).problem
    done = called("optimum", "--study", name, *QUICK["optimum"], "--out", "one")
    assert (done.returncode, done.stderr) == (0, "")
    table = pd.read_csv(tmp_path / "one" / "candidates.csv").iloc[1:]
    values = problem.evaluate(table[column_headers(problem.variables, problem.units)].to_numpy())
    m = len(problem.objectives)
    np.testing.assert_allclose(table[column_headers(problem.objectives, problem.units)], values[:, :m], rtol=1e-9)
    assert (values[:, m:] <= 1e-6).all()  # to which a descent holds them
    done = called("compare", "--study", name, *QUICK["compare"], "--out", "two")
    assert done.returncode == 0, done.stderr
    runs, fronts = pd.read_csv(tmp_path / "two" / "runs.csv"), list((tmp_path / "two" / "fronts").iterdir())
    assert len(runs) == len(fronts) == 2


def test_a_study_of_a_long_measured_road_runs_and_runs_again(called, tmp_path):
    """Long, as a file may have 10,000 points; the study beside the results makes the same front."""
    n = np.geomspace(0.01, 10.0, 2000)
    road = f"{{kind = 'measured', wavenumber_cycle_per_m = {n.tolist()}, density_m3 = {(1e-9 / n**2.1).tolist()}}}"
    (tmp_path / "long.toml").write_text(
        f'vehicle = "yuen_ramli_2010"\nroad = {road}\nspeed_m_per_s = 20\nmeasures = ["ACC", "SWS"]\nnodes = 64\n'
    )
    for study, out in (("long.toml", "one"), ("one/study.toml", "two")):
        done = called("optimum", "--study", study, *QUICK["optimum"], "--out", out)
        assert done.returncode == 0, done.stderr
    for name in ("front.csv", "study.toml"):
        assert (tmp_path / "one" / name).read_bytes() == (tmp_path / "two" / name).read_bytes()
    assert load_study(tmp_path / "two" / "study.toml").problem.cases[0].road == MeasuredRoad(n, 1e-9 / n**2.1)


@pytest.mark.parametrize("command", ["optimum", "compare"])
def test_a_study_that_no_file_holds_is_refused_before_the_search(called, tmp_path, command):
    """A road of more points than a file may have: `ride` takes it, a search could not be run again."""
    rows = "\n".join(f"{0.01 + n / 1e3:.3f},1e-6" for n in range(10_001))
    (tmp_path / "road.csv").write_text(f"wavenumber [cycle/m],psd [m^3]\n{rows}\n")
    done = called(command, "--road", "road.csv", "--speed", 20, "--band", "0.5,20")
    assert (done.returncode, done.stdout) == (2, "")
    for line, key in zip(done.stderr.splitlines(), ("wavenumber_cycle_per_m", "density_m3"), strict=True):
        assert line.startswith(f"error: road.{key} must be an array of up to 10000 numbers, got [")
    assert [path.name for path in tmp_path.iterdir()] == ["road.csv"]


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"speed": 0.0}, "speed must be finite and > 0 m/s, got 0.0"),
        ({"vehicle": "minaker_half", "speed": 0.0}, "speed must be finite and > 0 m/s, got 0.0"),
        ({"speed": float("nan")}, "speed must be finite and > 0 m/s, got nan"),
        ({"road": ""}, "road must be a class of ISO 8608 .* got ''"),
        ({"vehicle": ""}, "vehicle must be one of bmw_320i_full, .* got ''"),
        ({"vehicle": "cantero_2022_half"}, "vehicle must be a file with bounds, got 'cantero_2022_half'"),
        (
            {"study": "mine"},
            "study must be one of damper_curve, full_car, half_car, matlab_quarter_car, .*, paper or .*",
        ),
        ({"study": "full_car", "vehicle": "minaker_half"}, "response must be one of .* got 'driver_acceleration'"),
    ],
)
def test_bad_choices_are_one_line(options, message):
    with pytest.raises(ValueError, match=rf"^{message}$"):
        chosen_study(**options)


def test_the_study_of_an_optimum_makes_the_same_candidates_bit_for_bit(called, tmp_path):
    options = ("--speed", 25, "--road", "B", "--seed", 3, "--population", 20, "--iterations", 2)
    for given in ((*options, "--out", "one"), ("--study", "one/study.toml", "--out", "two")):
        done = called("optimum", *given)
        assert done.returncode == 0, done.stderr
    for name in ("front.csv", "candidates.csv", "study.toml"):
        assert (tmp_path / "one" / name).read_bytes() == (tmp_path / "two" / name).read_bytes()
