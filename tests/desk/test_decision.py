"""Decisions: sentences about limits and bounds against grids of designs; limits that nothing meets."""

import re
from dataclasses import replace

import numpy as np
import pandas as pd
import pytest

import garage
from suspension_ctrl import Iso8608Road, Limit, Measure, MoeadDra, Nsga2, RideProblem
from suspension_ctrl.desk.decision import Decision, measured
from suspension_ctrl.desk.proofs import RESIDUAL
from suspension_ctrl.search.indicators import best_of
from suspension_ctrl.search.population import Population
from suspension_ctrl.vehicles.modes import FREQUENCY

SEARCH = {"iterations": 20, "seed": 1}


def problem_of(*constraints: str, **others) -> RideProblem:
    """A car whose springs and dampers may double."""
    bounds = {"spring": (10e3, 60e3), "damper": (500.0, 5e3)}
    road = Iso8608Road("B")
    return RideProblem(garage.QUARTER, road, speed=27.78, bounds=bounds, constraints=constraints, **others)


def decide(*constraints: str, population: int = 300, **others) -> Decision:
    return Decision.of(problem_of(*constraints), MoeadDra(population=population), **SEARCH, **others)


@pytest.fixture(scope="module")
def grid() -> np.ndarray:
    """Objectives of 601 x 601 designs."""
    problem = problem_of()
    axes = [np.linspace(*pair, 601) for pair in problem.bounds.values()]
    return problem.evaluate(np.stack(np.meshgrid(*axes), axis=-1).reshape(-1, 2))


@pytest.fixture(scope="module")
def within() -> Decision:
    return decide("SWS <= 8mm", present={"spring": 25e3, "damper": 2e3})


def numbers(text: str) -> list[float]:
    return [float(one) for one in re.findall(r"\d+\.?\d*", text)]


def test_the_limits_that_are_possible_are_those_of_the_grid(within, grid):
    travel = 1e3 * best_of(grid)[:, 1]
    (line,) = [one for one in within.describe() if "cuts" in one]
    assert line.startswith("SWS <= 8 mm cuts the front: limits from ")
    assert numbers(line)[1:] == pytest.approx([travel.min(), travel.max()], rel=2e-3)
    (line,) = [one for one in decide().describe() if one.startswith("No limit is set.")]
    assert numbers(re.search(r"SWS from (.*?) mm", line)[1]) == pytest.approx(
        [travel.min(), travel.max()], rel=2e-3
    )


def test_a_limit_that_does_nothing_tells_how_near_the_front_comes_to_it(grid):
    """The nearest design is that of the most travel, of a least heave frequency that of the softest spring."""
    (line,) = [one for one in decide("SWS <= 40mm").describe() if "nothing" in one]
    assert line.startswith("SWS <= 40 mm does nothing: the nearest design of the front has ")
    assert numbers(line)[1] == pytest.approx(1e3 * best_of(grid)[:, 1].max(), rel=2e-3)
    (line,) = [one for one in decide("frequency heave >= 0.5").describe() if "nothing" in one]
    assert line.startswith("frequency heave >= 0.5 Hz does nothing: the nearest design of the front has ")
    softest = garage.QUARTER.modes({"spring": 10e3, "damper": 500.0})[FREQUENCY].min()
    assert numbers(line)[1] == pytest.approx(softest, rel=2e-3)


def test_measures_that_are_equal_on_the_front_are_told():
    """On a quarter car DLC is DTL over a fixed load, and of statics all designs have the same load."""
    load = Measure("load", "N", lambda designs: np.full(len(designs), garage.QUARTER.body_mass * 9.81))
    problem = problem_of(measures=["SWS", "DTL", load])
    told = Decision.of(problem, Nsga2(population=40), iterations=3, seed=1).describe()
    assert told[0] == "All designs of the front have load of 3.115 kN: only other measures are traded."
    assert told[1].startswith("No limit is set. The front has SWS from ")
    assert "load" not in told[1]
    point = Decision.of(problem_of(measures=["DTL", "DLC"]), Nsga2(population=40), iterations=10, seed=1)
    assert point.describe()[0].startswith("The front is one point, the best of every measure: DTL of ")
    assert point.describe()[1] == "No limit is set."
    assert point.table.name.tolist() == ["least DTL, least DLC, knee, compromise"]


def test_a_limit_that_nothing_meets_tells_the_least_that_is_possible(grid):
    with pytest.raises(
        ValueError, match=r"^limits must be possible within the bounds: the nearest design has SWS of "
    ) as error:
        decide("SWS <= 2mm", "DTL <= 2000")
    assert str(error.value).endswith(" mm, got SWS <= 2 mm")
    assert numbers(str(error.value))[0] == pytest.approx(1e3 * grid[:, 1].min(), rel=0.01)


def test_several_limits_are_told_one_by_one(grid):
    lines = decide("SWS <= 6mm", "frequency heave <= 1.2", "damping_ratio heave >= 0.1").describe()
    assert lines[0].startswith("SWS <= 6 mm cuts the front")
    assert lines[1].startswith("frequency heave <= 1.2 Hz cuts the front: limits from")
    assert lines[2].startswith("damping_ratio heave >= 0.1 does nothing: ")


def test_bounds_and_limits_are_told_with_the_candidates_that_reach_them(within):
    text = within.describe()[-1]
    assert text.startswith("Active, by candidate: ")
    parts = re.findall(r"(?:: |; )([^;(]+) \(([\d, ]+)\)", text)
    assert ("at the limit SWS <= 8 mm", "1") in parts
    assert "damper at its upper bound" in dict(parts)
    for words, listed in parts:
        rows = [n for n, active in within.table.active.items() if n and words in active.split("; ")]
        assert rows == [int(one) for one in listed.split(", ")]


def test_candidates_hold_the_least_of_the_grid_within_the_limit(within, grid):
    inside = grid[grid[:, 1] <= 8e-3]
    for j, header in enumerate(("ACC [m/s^2]", "SWS [m]", "DTL [N]")):
        least = within.table[header][1:].min()
        assert least <= inside[:, j].min() * (1 + 1e-4)  # where descents end
        assert least == pytest.approx(inside[:, j].min(), rel=2e-3)


def test_a_catalogue_is_searched_too():
    problem = problem_of("SWS <= 8mm", kinds={"spring": (12e3, 18e3, 24e3), "damper": "log"})
    found = Decision.of(problem, Nsga2(population=60), **SEARCH)
    assert {*found.table["spring [N/m]"]} <= {12e3, 18e3, 24e3}
    assert found.free is not found.run
    assert found.describe()[0].startswith("SWS <= 8 mm cuts the front")


def test_limits_of_several_load_cases_are_of_the_worst_and_the_present_design_may_be_beyond_them():
    first = problem_of("SWS <= 8mm")
    rough = replace(first.cases[0], road=Iso8608Road("C"), share=0.5)
    several = first.replace(cases=[first.cases[0], rough])
    present = {"spring": 20e3, "damper": 700.0}
    found = Decision.of(several, Nsga2(population=40), iterations=5, seed=1, present=present)
    told = found.describe()
    assert told[0].endswith(" mm are possible in the worst load case.")
    assert "present design: beyond the limit SWS <= 8 mm" in told[-1]
    worst = several.replace(worst_case=True).evaluate(found.free.designs[found.free.on_front()])[:, 1]
    assert numbers(told[0])[1:] == pytest.approx([1e3 * worst.min(), 1e3 * worst.max()], rel=1e-3)


@pytest.mark.parametrize(
    "limit", [Limit("SWS", 0.02), Limit("roll_damping", minimum=0.2), Limit("roll_damping", minimum=0.0)]
)
def test_a_measure_is_found_again_from_its_constraint(limit):
    value = np.array([0.013, 0.2, 0.4])
    np.testing.assert_allclose(measured(limit, limit.scale * value + limit.offset), value, rtol=1e-12)


def decided(*rows: tuple[float, float, float, float], residuals: tuple[float, ...]) -> Decision:
    """A decision on discomfort and as much power of dampers as there is, of designs with these values."""
    problem = problem_of(measures=["ACC", "-damper_power"])
    designs, objectives = np.split(np.array(rows), 2, axis=1)
    run = Population(designs=designs, objectives=objectives, constraints=np.empty((len(rows), 0)))
    table = pd.DataFrame({"active": "", RESIDUAL: residuals}, index=range(1, len(rows) + 1))
    return Decision(problem, run, run, table)


def test_more_of_a_measure_has_its_own_sign_and_no_limit():
    rows = (20e3, 1e3, 1.0, -30.0), (20e3, 2e3, 2.0, -40.0)
    told = decided(*rows, residuals=(0.0, np.nan)).describe()
    assert told[0] == "No limit is set. The front has ACC from 1 to 2 m/s^2: limits between these are possible."
    assert told[1] == "Every candidate but 2 is an exact optimum, with a residual of at most 1e-08."
    flat = decided(rows[0], (20e3, 2e3, 1.0, -30.0), residuals=(0.0, 0.0)).describe()
    assert flat[0].endswith("the best of every measure: ACC of 1 m/s^2, -damper_power of 30 W.")
    assert flat[2] == "Every candidate is an exact optimum: no residual is above 1e-08."
