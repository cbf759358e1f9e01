"""The reference front: a grid that has settled, and its copy on disk."""

import numpy as np
import pytest

from functions import srn, srn_set
from suspension_ctrl import Problem
from suspension_ctrl.search.indicators import ReferenceFront
from suspension_ctrl.study import reference as references
from suspension_ctrl.study.store import FolderStore


class Line:
    """f1 = x, f2 = 1 - x + y, which counts its designs: the front is y = 0, of hypervolume 0.71 below 1.1."""

    def __init__(self, slope: float = 1.0) -> None:
        self.slope, self.designs = slope, 0

    def __call__(self, x):
        self.designs += len(x)
        return np.stack([x[:, 0], self.slope * (1 - x[:, 0] + x[:, 1])], axis=1)

    def problem(self) -> Problem:
        return Problem(evaluate=self, lower=(0, 0), upper=(1, 1), objectives=("f1", "f2"))


def test_refined_front_has_the_hypervolume_of_the_true_one():
    """n points on the line lose (n - 1) triangles of 1/2 (n - 1)^2: with half as many values twice as much."""
    found = references.refined(Line().problem(), 2e-3)
    lost, volume = 0.5 / (found.points - 1), ReferenceFront.of(found.objectives).volume
    assert volume == pytest.approx(0.71 - lost, rel=1e-9)
    half = 0.5 / (found.points // 2 - 1)
    assert found.change == pytest.approx((half - lost) / volume, rel=1e-6)
    assert 0 < found.second < found.change <= 2e-3
    assert found.points == 400  # 200 values change by 3.5e-3


def test_a_grid_has_the_values_of_discrete_variables_and_none_of_a_held_one():
    kinds = {"x1": (0.0, 0.25, 1.0), "x2": "integer"}
    line = Problem(
        evaluate=lambda x: np.stack([x[:, 0], 1 - x[:, 0] + x[:, 1] + x[:, 2]], axis=1),
        lower=(0, 0, 0.5), upper=(1, 3, 0.5), objectives=("f1", "f2"), kinds=kinds,
    )  # fmt: skip
    found = references.refined(line)
    np.testing.assert_array_equal(np.unique(found.objectives, axis=0), [[0, 1.5], [0.25, 1.25], [1, 0.5]])
    assert found.points == 200
    assert found.describe(line) == "grid of 3 x 4 values"


def test_a_front_comes_back_from_its_tables_to_the_last_bit(tmp_path):
    first = references.sought(Line(1 / 3).problem(), [], 1e-2)
    FolderStore(tmp_path, {})["grid"] = first.stored()
    assert references.Reference.of(FolderStore(tmp_path, {})["grid"]) == first


def test_values_tell_one_problem_from_another():
    """By rounding, by a constraint that is met throughout the sample, and by values in a tenth of the box."""
    line = Line()
    problems = [line.problem(), Line(1 + 1e-15).problem(), limited(-1.0, line), limited(-2.0, line)]
    problems.append(line.problem().replace(evaluate=lambda x: np.where(x[:, :1] < 0.9, 1.0, 1.1) * line(x)))
    assert len(set(map(references.fingerprint, problems))) == len(problems)
    assert references.fingerprint(line.problem()) == references.fingerprint(Line().problem())


@pytest.mark.parametrize(
    ("change", "second", "settles"),
    [(1e-3, -1e-3, True), (1.1e-3, 0.0, False), (0.0, -1.1e-3, False), (np.nan, 0.0, False), (0.0, np.nan, False)],
)
def test_a_grid_settles_if_both_changes_are_within_the_tolerance(change, second, settles):
    assert references.Refined(np.zeros((1, 2)), 1.0, 200, change, second).settles(1e-3) == settles


def test_a_front_spans_where_every_objective_differs():
    assert references.spans(np.array([[0.0, 1.0], [1.0, 0.0]]))
    assert not references.spans(np.array([[0.0, 1.0], [1.0, 1.0]]))
    assert not references.spans(np.empty((0, 2)))


def test_as_many_designs_as_allowed_are_taken():
    assert references.refined(Line().problem(), 0.5, most=10_000).points == 100
    assert references.refined(Line().problem(), 0.5, most=9_999) is None


def test_wrong_settings_of_a_grid_are_one_line():
    with pytest.raises(ValueError, match=r"^tolerance must be finite and > 0, got 0$"):
        references.refined(Line().problem(), 0)
    with pytest.raises(ValueError, match=r"^points must be a whole number >= 2, got 1$"):
        references.grid_front(Line().problem(), 1)


def test_a_front_of_a_grid_that_settles_is_handed_on():
    kept = list[references.Reference]()
    found = references.sought(Line().problem(), [], 1e-2, keep=kept.append)
    assert kept == [found]
    assert "settles to 0.0001" in references.sought(Line().problem(), [], most=40_000, keep=kept.append).origin
    assert len(kept) == 1


def test_of_too_many_variables_no_grid_is_tried():
    problem = Problem(evaluate=lambda x: x[:, :2], lower=(0,) * 5, upper=(1,) * 5, objectives=("f1", "f2"))
    assert references.refined(problem) is None


def test_where_no_grid_settles_the_front_is_of_the_runs_and_the_finest_grid():
    """A run has found a point beyond the line of the grid; 50,000 designs allow 200 x 200."""
    found = references.sought(Line().problem(), [np.array([[0.5, 0.4], [0.6, 0.9]])], 1e-9, most=50_000)
    x = np.linspace(0, 1, 200)
    line = np.stack([x, 1 - x], axis=1)[~((x >= 0.5) & (1 - x >= 0.4))]
    points = found.front.objectives[found.front.objectives[:, 0].argsort()]
    np.testing.assert_allclose(points, np.insert(line, 100, [0.5, 0.4], axis=0), atol=1e-12)
    half, lost = 0.5 / 99, 0.5 / 199
    assert found.origin == (
        "all timed runs and a grid of 200 x 200 values (no grid within 50,000 designs and 60 s settles to 1e-09: "
        f"half as many values change its hypervolume by {(half - lost) / (0.71 - lost):.1e})"
    )


def test_what_is_known_of_the_front_counts_where_no_grid_settles():
    """100 points of the line between those of the runs; of a grid that settles nobody asks."""
    x = np.linspace(0, 1, 100)
    line = np.stack([x, 1 - x], axis=1)
    found = references.sought(Line().problem(), [np.array([[0.5, 0.5]])], most=9_999, known=lambda: line)
    assert len(found.front.objectives) == 101
    assert found.origin == (
        "all timed runs and 100 designs of an exact front and between its points "
        "(no grid within 9,999 designs and 60 s has a front)"
    )
    empty = references.sought(Line().problem(), [line], most=9_999, known=lambda: np.empty((0, 2)))
    assert empty.origin.startswith("all timed runs (no grid")

    def asked() -> np.ndarray:
        raise AssertionError

    assert references.sought(Line().problem(), [], 1e-2, known=asked).origin.startswith("a grid of ")


def test_without_a_grid_the_front_is_of_the_runs():
    runs = [np.array([[0, 1.0], [0.5, 0.5]]), np.array([[1.0, 0]])]
    found = references.sought(Line().problem(), runs, most=9_999)
    assert found.front.objectives.tolist() == [[0, 1], [0.5, 0.5], [1, 0]]
    assert found.origin == "all timed runs (no grid within 9,999 designs and 60 s has a front)"


@pytest.mark.parametrize("runs", [[], [np.empty((0, 2))], [np.array([[0.5, 0.5], [0.5, 0.6]])]])
def test_without_two_designs_that_differ_in_every_objective_there_is_no_reference(runs):
    assert references.sought(limited(2.0), runs, most=20_000) is None


def test_a_slow_evaluation_ends_the_search_for_a_finer_grid(monkeypatch):
    """A clock that runs by designs, 1 s for 10,000: 100 x 100 takes 1 s, 200 x 200 4 s, of 6 s in all."""
    line = Line()
    monkeypatch.setattr(references, "perf_counter", lambda: line.designs / 10_000)
    found = references.refined(line.problem(), 1e-9, seconds=6.0)
    assert found.points == 200
    assert line.designs == 50_000 + 20_000  # two evaluations of the next, which would take 16 s
    with pytest.raises(TimeoutError):
        references.grid_front(line.problem(), 400, end=line.designs / 10_000 + 15)
    assert len(references.grid_front(line.problem(), 400, end=line.designs / 10_000 + 17)) == 400


def limited(bound: float, evaluate=None) -> Problem:
    """The line with x >= bound: its front goes from (bound, 1 - bound) to (1, 0)."""
    line = evaluate or Line()
    return Problem(
        evaluate=lambda x: np.column_stack([line(x), bound - x[:, 0]]),
        lower=(0, 0), upper=(1, 1), objectives=("f1", "f2"), constraints=("least",),
    )  # fmt: skip


def test_only_feasible_designs_make_a_front():
    """The feasible half of the line: in its own scale the same 0.71 below 1.1, less as many triangles as steps."""
    found = references.refined(limited(0.5), 2e-3)
    front = ReferenceFront.of(found.objectives)
    assert front.ideal[0] >= 0.5
    steps = np.count_nonzero(np.linspace(0, 1, found.points) >= 0.5) - 1
    assert front.volume == pytest.approx(0.71 - 0.5 / steps, rel=1e-9)


def test_the_front_of_a_constrained_problem_is_its_closed_form():
    """The ends count most: a grid of 800 steps of 0.05 misses each by as much as one step, of a range of 200."""
    grid = ReferenceFront.of(references.grid_front(srn(), 800))
    true = ReferenceFront.of(srn().evaluate(srn_set(500))[:, :2])
    assert true.relative_hypervolume(grid.objectives) == pytest.approx(1, abs=2e-3)


@pytest.mark.parametrize(("bound", "found"), [(0.9999, 1), (2.0, 0)])
def test_without_a_front_of_feasible_designs_there_is_no_reference(bound, found):
    """One point, the bound of the box, has no range to scale by; no point at all is no front either."""
    assert references.grid_front(limited(bound), 100).shape == (found, 2)
    assert references.refined(limited(bound), most=100_000) is None


def test_a_feasible_region_that_the_coarsest_grid_misses_is_found():
    """From 0.991 to 0.994 there is no value of 100, whose last are 0.990 and 1, and one of 200, 198/199."""
    line = Line()
    problem = Problem(
        evaluate=lambda x: np.column_stack([line(x), np.abs(x[:, 0] - 0.9925) - 0.0015]),
        lower=(0, 0), upper=(1, 1), objectives=("f1", "f2"), constraints=("narrow",),
    )  # fmt: skip
    assert len(references.grid_front(problem, 100)) == 0
    assert references.refined(problem, 0.25).points > 200


def test_a_fine_front_is_measured_by_an_even_sample():
    f1 = np.sort(np.random.default_rng(0).random(50_000))
    f1[[0, -1]] = 0, 1
    whole = np.stack([f1, 1 - f1], axis=1)
    front = ReferenceFront.of(whole)
    assert len(front.objectives) == ReferenceFront.SAMPLE
    gaps = np.diff(np.sort(front.objectives[:, 0]))
    assert gaps.max() < 2.1 / ReferenceFront.SAMPLE
    assert front.volume == pytest.approx(front.hypervolume(whole), rel=1e-12)
    assert front.relative_hypervolume(whole) == pytest.approx(1)
