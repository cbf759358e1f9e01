"""Candidates beside the present design: values, changes, modes, travel by other roads."""

import numpy as np
import pytest

import garage
from suspension_ctrl import (
    Iso8608Road,
    LoadCase,
    Nsga2,
    Payload,
    Problem,
    RideProblem,
    SpeedBump,
    candidates,
    knee,
    load_vehicle,
    minimise,
    pick,
    ride,
    save_system,
    simulate,
)
from suspension_ctrl.desk.candidate_table import changes_of, full_changes, reaching

BOUNDS = {"spring": (10e3, 60e3), "damper": (500.0, 5e3)}
PRESENT = {"spring": 25e3, "damper": 2e3}


@pytest.fixture(scope="module")
def problem() -> RideProblem:
    return RideProblem(
        garage.QUARTER, Iso8608Road("B"), speed=27.78, bounds=BOUNDS, constraints=["SWS <= 8mm"],
        events={"bump": (SpeedBump(height=0.05, length=2.0), 8.0)},
    )  # fmt: skip


@pytest.fixture(scope="module")
def run(problem):
    return minimise(problem, Nsga2(population=100), iterations=40, seed=1)


@pytest.fixture(scope="module")
def table(problem, run):
    return candidates(problem, run, present=PRESENT)


def test_seven_candidates_follow_the_present_design(problem, run, table):
    assert table.index.tolist() == list(range(8))
    assert table.name[0] == "present design"
    named = ", ".join(table.name[1:])
    assert all(one in named for one in ("least ACC", "least SWS", "least DTL", "knee", "compromise", "between"))
    headers = list(run.headers)
    front = {tuple(row) for row in run.front().to_numpy()}
    assert {tuple(row) for row in table.loc[1:, headers].to_numpy()} <= front
    assert table.loc[1:, "ACC [m/s^2]"].is_monotonic_increasing
    np.testing.assert_allclose(table[headers[2:]], problem.evaluate(table[headers[:2]])[:, :3], rtol=1e-12)
    (row,) = table[table.name.str.contains("knee")].index
    assert table.loc[row, headers].tolist() == knee(problem, run).tolist()
    (row,) = table[table.name.str.contains("least DTL")].index
    assert table.loc[row, headers].tolist() == pick(problem, run, minimise="DTL").tolist()


def test_changes_are_against_the_present_design(problem, table):
    own = problem.evaluate([list(PRESENT.values())])[0]
    for j, name in enumerate(problem.objectives):
        values = table[f"{name} [{problem.units[name]}]"]
        np.testing.assert_allclose(table[f"{name} change [%]"], 100 * (values / own[j] - 1), atol=1e-9)


def test_modes_are_those_of_the_vehicle(table):
    for _, row in table.iterrows():
        modes = garage.QUARTER.modes(tuple(row[["spring [N/m]", "damper [N s/m]"]]))
        found = row[["heave [Hz]", "wheel hop [Hz]", "heave damping [-]", "wheel hop damping [-]"]].tolist()
        expected = [*modes["frequency [Hz]"], *modes["damping ratio [-]"]]
        assert found == pytest.approx(expected, rel=1e-12)


def test_travel_is_driven_over_the_bump_and_expected_on_the_road(problem, table):
    row = table.loc[3]
    setting = {"spring": row["spring [N/m]"], "damper": row["damper [N s/m]"]}
    event, speed = problem.events["bump"]
    driven = simulate(garage.QUARTER, setting, event, speed, responses=["suspension_travel"])
    assert row["peak travel in bump [m]"] == pytest.approx(driven["suspension_travel [m]"].abs().max(), rel=1e-3)
    expected = ride(garage.QUARTER, setting, Iso8608Road("B"), 27.78, measures=["largest travel 1000"]).value.iloc[
        0
    ]
    assert row["largest travel in 1 km [m]"] == pytest.approx(expected, rel=1e-6)


def test_active_bounds_and_limits_are_told(table):
    first, last = table.active[1], table.active.iloc[-1]
    assert "at the limit SWS <= 8 mm" in first
    assert "damper at its upper bound" in last
    assert table.active[0] == ""


def test_the_present_design_may_be_outside_and_beyond_a_limit(problem, run):
    table = candidates(problem, run, present=[8e3, 400.0])
    assert table.active[0] == (
        "spring beyond its lower bound; damper beyond its lower bound; beyond the limit SWS <= 8 mm"
    )
    expected = ride(garage.QUARTER, (8e3, 400.0), Iso8608Road("B"), 27.78).value[["ACC", "SWS", "DTL"]]
    np.testing.assert_allclose(table.loc[0, ["ACC [m/s^2]", "SWS [m]", "DTL [N]"]].tolist(), expected, rtol=1e-6)


def test_without_a_present_design_nothing_is_compared(problem, run):
    table = candidates(problem, run, count=5)
    assert table.index.tolist() == [1, 2, 3, 4, 5]
    assert not table.filter(like="change").columns.tolist()
    assert not table.isna().any(axis=None)


@pytest.mark.parametrize(
    ("present", "message"),
    [
        ({"spring": 2e4}, "present must have spring, damper, got none for damper"),
        ([1.0, 2.0, 3.0], "present must be finite values of spring, damper, got [1.0, 2.0, 3.0]"),
        ([np.nan, 2.0], "present must be finite values of spring, damper, got [nan, 2.0]"),
        ("soft", "present must be"),
    ],
)
def test_a_wrong_present_design(problem, run, present, message):
    with pytest.raises(ValueError, match="present must") as error:
        candidates(problem, run, present=present)
    assert str(error.value).startswith(message)


def test_fewer_designs_than_candidates():
    problem = Problem(
        evaluate=lambda x: np.column_stack([x[:, 0], -x[:, 0]]), lower=(0,), upper=(1,), objectives=("a", "b"),
        kinds={"x1": "integer"}, units={"a": "m"},
    )  # fmt: skip
    run = minimise(problem, Nsga2(population=8), iterations=3, seed=1)
    table = candidates(problem, run, present=[0.5])
    assert table.columns.tolist() == ["name", "x1", "a [m]", "b", "a change [%]", "b change [%]", "active"]
    assert sorted(", ".join(table.name).split(", ")) == [
        "compromise",
        "knee",
        "least a",
        "least b",
        "present design",
    ]
    assert table.active.tolist() == ["", "x1 at its lower bound", "x1 at its upper bound"]
    with pytest.raises(ValueError, match=r"^count must be a whole number >= 1, got 0$"):
        candidates(problem, run, count=0)


def test_force_laws_and_load_cases():
    """Modes of the linearised vehicle of the first case; travel of the worst case."""
    file = load_vehicle("volvo_xc90_digressive")
    laden = Payload(mass=150.0, position=(-0.5, 0.0)).on(file.vehicle)
    cases = [
        LoadCase(vehicle=one, road=Iso8608Road(name), speed=20.0)
        for one, name in ((file.vehicle, "B"), (laden, "D"))
    ]
    problem = RideProblem(cases=cases, bounds=file.bounds, struts=fixed_of(file), band=(0.1, 20.0))
    run = minimise(problem, Nsga2(population=12), iterations=2, seed=1)
    present = {name: file.vehicle.coefficients(file.setting)[name] for name in file.bounds}
    table = candidates(problem, run, present=present, count=2)
    linear = file.vehicle.linearised(file.setting, Iso8608Road("B"), 20.0, band=(0.1, 20.0))
    modes = linear.modes().set_index("name")
    assert table.loc[0, "heave damping [-]"] == pytest.approx(modes.loc["heave", "damping ratio [-]"], rel=1e-6)
    rough = ride(laden, file.setting, Iso8608Road("D"), 20.0, band=(0.1, 20.0), measures=["largest travel 1000"])
    assert table.loc[0, "largest travel in 1 km [m]"] == pytest.approx(rough.value.iloc[0], rel=1e-4)


def fixed_of(file):
    return {name: value for name, value in file.setting.items() if name not in file.bounds}


def test_a_plant_has_no_modes(tmp_path):
    save_system(tmp_path / "car.npz", garage.QUARTER.plant())
    (tmp_path / "car.toml").write_text('kind = "plant"\nfile = "car.npz"\n')
    problem = RideProblem(
        load_vehicle(tmp_path / "car.toml").vehicle, Iso8608Road("B"), speed=27.78, bounds=BOUNDS
    )
    table = candidates(problem, minimise(problem, Nsga2(population=20), iterations=5, seed=1))
    assert not [name for name in table if "[Hz]" in name]
    assert (table["largest travel in 1 km [m]"] > 2 * table["SWS [m]"]).all()


def test_bounds_reach_a_design_outside_and_stay_for_one_inside(problem):
    logarithmic = problem.replace(kinds={"spring": "log"})
    assert reaching(logarithmic, np.array([10e3, 5e3])) is logarithmic
    wide = reaching(logarithmic, np.array([8e3, 6e3]))
    assert wide.bounds == {"spring": (8e3, 60e3), "damper": (500.0, 6e3)}
    assert not wide.kinds


def test_changes_against_negative_values_and_zero():
    """Of a measure of which more is better the value is negative: -3 after -2 is half as much less."""
    np.testing.assert_array_equal(changes_of([-3.0, 3.0, 1.0], [-2.0, 2.0, 0.0]), [-50.0, 50.0, np.nan])
    np.testing.assert_array_equal(
        full_changes(np.array([[1.0, 0.0, 3.0]]), np.array([0.0, 0.0, 2.0])), [[np.inf, 0.0, 50.0]]
    )
