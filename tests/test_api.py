"""Things that a user does first, each of which once failed."""

import pickle
from dataclasses import replace
from pathlib import Path

import control
import numpy as np
import pandas as pd
import pytest

import suspension_ctrl as sc

CAR = sc.QuarterCar(body_mass=317.5, wheel_mass=45.4, tyre_stiffness=192e3)
ROAD = sc.PowerLawRoad(roughness=5e-6, exponent=2.5)
SETTING = {"spring": 22e3, "damper": 1500.0}
BOUNDS = {"spring": (1e3, 30e3), "damper": (1e3, 5e3)}


@pytest.fixture(scope="module")
def problem() -> sc.RideProblem:
    return sc.RideProblem(CAR, ROAD, speed=20.0, bounds=BOUNDS)


@pytest.fixture(scope="module")
def run(problem) -> sc.Run:
    return sc.minimise(problem, sc.Nsga2(population=20), iterations=5, seed=1)


def test_the_ride_of_one_car_needs_no_search_box(problem):
    table = sc.ride(CAR, SETTING, ROAD, speed=20.0)
    assert list(table.index[:6]) == ["ACC", "SWS", "DTL", "body_acceleration", "suspension_travel", "tyre_load"]
    np.testing.assert_allclose(table.value[:3], problem.evaluate([[22e3, 1500.0]])[0], rtol=1e-12)
    assert list(table.unit[:6]) == ["m/s^2", "m", "N"] * 2


def test_every_vehicle_is_closed_alike():
    quarter = CAR.closed(22e3, 1500.0)
    for same in (CAR.closed(SETTING), CAR.closed(spring=22e3, damper=1500.0)):
        np.testing.assert_array_equal(same.A, quarter.A)
    half = sc.load_vehicle("minaker_half").vehicle
    pairs = {"front": (35e3, 1000.0), "rear": (38e3, 1200.0)}
    np.testing.assert_array_equal(half.closed(**pairs).A, half.closed(pairs).A)
    closed = half.closed(pairs, responses=["front_tyre_load"])
    assert closed.output_labels == ["front_tyre_load"]


@pytest.mark.parametrize("name", ["jian_2022_full", Path("jian_2022_full")])
def test_vehicles_and_roads_by_text_or_path(name, checkout):
    file = sc.load_vehicle(name)
    assert file.vehicle.closed(file.setting).ninputs == 8
    assert file == sc.load_vehicle(checkout / "data/vehicles/jian_2022_full.toml")
    assert sc.load_road("C") == sc.Iso8608Road("C")
    path = checkout / "data/roads/yuen_ramli_2010.toml"
    assert sc.load_road(path) == sc.load_road(str(path)) == ROAD
    study = checkout / "data/studies/full_car.toml"
    assert sc.load_problem(study) == sc.load_problem(str(study))


def test_a_run_is_a_table_with_units(problem, run):
    headers = ["spring [N/m]", "damper [N s/m]", "ACC [m/s^2]", "SWS [m]", "DTL [N]"]
    whole, front = run.to_frame(), run.front()
    assert list(whole.columns) == list(front.columns) == headers
    np.testing.assert_array_equal(whole[headers[2:]], run.objectives)
    best = run.designs[sc.non_dominated(run.objectives)]
    each_once = list(dict.fromkeys(map(tuple, best.tolist())))
    np.testing.assert_array_equal(front[headers[:2]], each_once)


def test_one_thing_of_a_problem_is_changed(problem):
    other = {"spring": (10e3, 20e3), "damper": (1e3, 2e3)}
    for changed in (problem.replace(bounds=other), replace(problem, bounds=other)):
        assert dict(changed.bounds) == other
        assert (tuple(changed.lower), tuple(changed.upper)) == ((10e3, 1e3), (20e3, 2e3))
        assert replace(changed, speed=20.0) == changed
    assert replace(problem, speed=30.0).lower == problem.lower
    by_bounds = sc.RideProblem(CAR, ROAD, speed=20.0, lower=(1e3, 1e3), upper=(30e3, 5e3))
    assert by_bounds == problem
    assert replace(by_bounds, bounds=other) == problem.replace(bounds=other)


def test_driving_takes_the_car_itself_and_judging_takes_a_weighting():
    profile = ROAD.profile(length=200.0, step=0.1, seed=1)
    history = sc.simulate(CAR, SETTING, profile, 20.0)
    pd.testing.assert_frame_equal(history, sc.simulate(CAR.closed(SETTING), profile, 20.0))
    acceleration = history["body_acceleration [m/s^2]"]
    assert sc.exposure(acceleration, 0.005, weighting="Wk").rms < sc.exposure(acceleration, 0.005).rms
    half = sc.load_vehicle("minaker_half")
    assert len(sc.simulate(half.vehicle, half.setting, profile, 20.0)) > 0


def test_own_weighting(problem):
    own = problem.replace(weighting=sc.weighting("Wk"))
    np.testing.assert_allclose(own.evaluate([[22e3, 1500.0]]), problem.evaluate([[22e3, 1500.0]]), rtol=1e-12)
    assert own == problem.replace(weighting=sc.weighting("Wk"))
    state_space = problem.replace(weighting=control.ss(sc.weighting("Wk")))
    np.testing.assert_allclose(state_space.evaluate([[22e3, 1500.0]]), own.evaluate([[22e3, 1500.0]]), rtol=1e-7)


def test_a_road_of_one_wheel_needs_a_spectrum_alone(problem):
    class Mine:
        def psd(self, f, speed):
            return 5e-6 * speed**1.5 / np.asarray(f) ** 2.5

    own = problem.replace(road=Mine())
    np.testing.assert_allclose(own.evaluate([[22e3, 1500.0]]), problem.evaluate([[22e3, 1500.0]]), rtol=1e-9)


def test_own_measures_beside_those_by_name(problem):
    def travel(frequency, psd):
        return np.sqrt(np.trapezoid(psd["suspension_travel"], frequency))

    def stiffness(designs):
        return designs[:, 0]

    own = problem.replace(
        measures=["ACC", sc.Measure("travel", "m", travel), sc.Measure("stiffness", "N/m", stiffness)]
    )
    values = own.evaluate([[22e3, 1500.0], [12e3, 2000.0]])
    here = problem.evaluate([[22e3, 1500.0], [12e3, 2000.0]])
    np.testing.assert_array_equal(values[:, [0, 2]], np.column_stack([here[:, 0], [22e3, 12e3]]))
    np.testing.assert_allclose(values[:, 1], here[:, 1], rtol=1e-3)  # the trapezoidal rule at the nodes
    for optimiser in (sc.Nsga2(population=8), sc.MoeadDra(population=20)):
        found = sc.minimise(own, optimiser, iterations=2, seed=1).to_frame()
        assert list(found.columns[2:]) == ["ACC [m/s^2]", "travel [m]", "stiffness [N/m]"]


def test_a_measured_plant_takes_python_controls_own_response():
    half = sc.load_vehicle("minaker_half")
    plant, omega = half.vehicle.plant(), 2 * np.pi * np.arange(0.2, 20.1, 0.01)
    rig = control.frd(
        plant.frequency_response(omega, squeeze=False).frdata, omega,
        inputs=plant.input_labels, outputs=plant.output_labels,
    )  # fmt: skip
    contacts = {"front": (1.189, 0.0), "rear": (-1.696, 0.0)}
    road = sc.Iso8608Road("C")
    expected = sc.ride(half.vehicle, half.setting, road, speed=20.0, band=(0.5, 20.0))
    for system, tolerance in ((rig, 1e-3), (plant, 1e-12)):
        measured = sc.Plant(system, contacts=contacts, struts=("front", "rear"))
        found = sc.ride(measured, half.setting, road, speed=20.0, band=(0.5, 20.0))
        same = [name for name in found.index if not name.startswith("pitch")]
        np.testing.assert_allclose(found.value[same], expected.value[same], rtol=tolerance)


def test_a_track_cannot_vary_and_the_error_says_what_can():
    with pytest.raises(ValueError, match=r"spring.*damper.*tyre_stiffness.*got 'track'"):
        sc.RideProblem(CAR, ROAD, speed=20.0, bounds={"track": (1.0, 2.0), **BOUNDS})


def test_nothing_of_a_problem_changes_from_outside(problem):
    mine = {name: np.array(pair) for name, pair in BOUNDS.items()}
    made = sc.RideProblem(CAR, ROAD, speed=20.0, bounds=mine)
    mine["spring"][0] = 5e3
    mine["damper"] = (2e3, 3e3)
    assert made == problem
    assert hash(made) == hash(problem)
    assert pickle.loads(pickle.dumps(made)) == problem
    with pytest.raises(TypeError):
        made.bounds["spring"] = (1.0, 2.0)


def test_the_arrays_of_a_run_are_read_only(run):
    for array in (run.designs, run.objectives, run.constraints):
        with pytest.raises(ValueError, match="read-only"):
            array[:] = 0.0


def test_what_is_shown_of_a_thing_is_short(problem, run):
    half = sc.load_vehicle("jian_2022_full")
    for thing in (CAR, ROAD, problem, run, half, half.vehicle, ROAD.profile(10.0, 0.1, 1)):
        lines = repr(thing).splitlines()
        assert 1 <= len(lines) <= 6, repr(thing)
        assert max(map(len, lines)) <= 100, repr(thing)
    assert "317.5 kg" in repr(CAR)
