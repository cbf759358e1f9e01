"""Programs: rows against the problem's own values, slopes against differences, slack variables at the start."""

import numpy as np
import pytest

from suspension_ctrl import Limit, load_problem
from suspension_ctrl.datafiles import path as data
from suspension_ctrl.desk.programs import Mean, Program, Row, Writer
from suspension_ctrl.desk.smooth import atoms_of

STUDY = load_problem(data("studies/full_car.toml"))
MIDDLE = (np.array(STUDY.lower) + np.array(STUDY.upper)) / 2


@pytest.fixture(params=[False, True], ids=["mean of load cases", "worst load case"])
def problem(request):
    return STUDY.replace(worst_case=request.param)


@pytest.mark.parametrize("number", range(3))
def test_an_objective_at_the_start_is_that_of_the_problem(problem, number):
    """Slack variables begin at the worst wheel; then the objective is exact and no wheel is above them."""
    writer = Writer(atoms_of(problem))
    program = Program(writer, writer.objective(number), MIDDLE)
    values, rows = problem.evaluate([MIDDLE])[0], program.at(program.start).rows
    assert rows[0] * program.sizes[0] == pytest.approx(values[number], rel=1e-12)
    limits = [n for n, row in enumerate(program.rows) if row.limit]
    assert rows[limits].max() == pytest.approx(values[3:].max(), rel=1e-9)
    wheels = [n for n in range(1, len(rows)) if n not in limits]
    assert rows[wheels].max(initial=0.0) <= 1e-12
    np.testing.assert_allclose(program.design(program.start), MIDDLE, rtol=1e-12)


def test_slopes_of_all_rows_are_those_of_differences(problem):
    writer = Writer(atoms_of(problem))
    program = Program(writer, writer.objective(1), MIDDLE)
    z, step = program.start, 1e-5
    slopes = program.at(z).slopes
    for n, one in enumerate(step * np.eye(z.size)):
        above, below = program.many(np.array([z + one, z - one]))
        differences = (above.rows - below.rows) / (2 * step)
        np.testing.assert_allclose(slopes[:, n], differences, atol=1e-8 * np.abs(slopes).max())


def test_a_mean_of_the_fourth_power():
    mean = Mean({0: 0.25, 2: 0.75}, 4.0, scale=-2.0)
    value, slopes = mean(np.array([1.0, 9.0, 2.0]))
    root = (0.25 + 0.75 * 16) ** 0.25
    assert value == pytest.approx(-2 * root)
    np.testing.assert_allclose(slopes, [-2 * 0.25 / root**3, -2 * 0.75 * 8 / root**3])
    assert mean(np.zeros(3))[0] == 0.0


def test_rows_are_scaled_and_shifted():
    row = Row({0: 2.0}, 1.0, Mean({1: 1.0}, 2.0)).times(-3.0).plus(5.0, {4: 1.0})
    assert (row.linear, row.offset, row.mean.scale) == ({0: -6.0, 4: 1.0}, 2.0, -3.0)
    assert row.places == {0, 1, 4}


def test_more_of_the_worst_wheel_cannot_be_written():
    writer = Writer(atoms_of(STUDY.replace(measures=["comfort = Wk driver_acceleration", "-SWS"])))
    with pytest.raises(ValueError, match=r"^measures must be of one wheel where more is better, got -SWS$"):
        writer.objective(1)


def test_the_row_of_a_limit_has_its_derivative_by_the_limit():
    """At the limit; by a difference of a millionth of it."""
    writer = Writer(atoms_of(STUDY))
    limits = {str(one): one for one in STUDY.constraints}
    for row in writer.rows:
        limit = limits[row.limit.name]
        wider = Limit(limit.measure, maximum=limit.value * (1 + 1e-6))
        change = (wider.scale * limit.value + wider.offset) / (1e-6 * limit.value)
        assert row.limit.by_limit == pytest.approx(change, rel=1e-5)


@pytest.mark.parametrize("measure", ["VDV", "roll_gradient"])
def test_means_of_other_measures_are_those_of_the_problem(measure):
    """Over load cases fourth powers of doses; statics are the same in all, and have one place."""
    problem = STUDY.replace(measures=["ACC driver", measure], constraints=(), worst_case=False)
    writer = Writer(atoms_of(problem))
    program = Program(writer, writer.objective(1), MIDDLE)
    value = program.at(program.start).rows[0] * program.sizes[0]
    assert value == pytest.approx(problem.evaluate([MIDDLE])[0, 1], rel=1e-9)
