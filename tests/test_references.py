"""The reference front: a grid that has settled, and its copy on disk."""

import numpy as np
import pytest

from suspension_ctrl import Problem, references
from suspension_ctrl.indicators import ReferenceFront


class Line:
    """f1 = x, f2 = 1 - x + y, which counts its designs: the front is y = 0, of hypervolume 0.71 below 1.1."""

    def __init__(self, slope: float = 1.0) -> None:
        self.slope, self.designs = slope, 0

    def __call__(self, x):
        self.designs += len(x)
        return np.stack([x[:, 0], self.slope * (1 - x[:, 0] + x[:, 1])], axis=1)

    def problem(self) -> Problem:
        return Problem(evaluate=self, lower=(0, 0), upper=(1, 1), objectives=("f1", "f2"))


@pytest.fixture(autouse=True)
def cache(tmp_path, monkeypatch):
    monkeypatch.setenv(references.CACHE, str(tmp_path / "cache"))
    return tmp_path / "cache"


def test_refined_front_has_the_hypervolume_of_the_true_one():
    """n points on the line lose (n - 1) triangles of 1/2 (n - 1)^2: with half as many values twice as much."""
    found = references.refined(Line().problem(), 2e-3)
    lost = 0.5 / (found.points - 1)
    assert found.front.volume == pytest.approx(0.71 - lost, rel=1e-9)
    half = 0.5 / (found.points // 2 - 1)
    assert found.change == pytest.approx((half - lost) / found.front.volume, rel=1e-6)
    assert 0 < found.second < found.change <= 2e-3
    assert found.points == 400  # 200 values change by 3.5e-3


def test_a_front_is_made_once(cache):
    line = Line()
    first = references.cached(line.problem(), 1e-2)
    made = line.designs
    second = references.cached(line.problem(), 1e-2)
    assert line.designs - made == 64  # the designs that tell which problem it is
    for name, value in vars(first.front).items():
        np.testing.assert_array_equal(value, getattr(second.front, name))
    assert second[1:] == first[1:]
    assert len(list(cache.iterdir())) == 1


def test_whatever_it_depends_on_makes_another_front(cache, monkeypatch):
    line = Line()
    keys = {references.key(line.problem(), 1e-2), references.key(line.problem(), 1e-3)}
    keys.add(references.key(Line(1 + 1e-15).problem(), 1e-2))
    wider = Problem(evaluate=line, lower=(0, 0), upper=(1, 1.0001), objectives=("f1", "f2"))
    keys.add(references.key(wider, 1e-2))
    monkeypatch.setattr(references, "version", lambda name: "0")
    keys.add(references.key(line.problem(), 1e-2))
    assert len(keys) == 5


def test_a_spoilt_copy_is_made_anew(cache):
    first = references.cached(Line().problem(), 1e-2)
    (path,) = cache.iterdir()
    for spoilt in (b"", path.read_bytes()[:200]):
        path.write_bytes(spoilt)
        assert references.cached(Line().problem(), 1e-2)[1:] == first[1:]


def test_a_cache_that_cannot_be_written_is_done_without(monkeypatch):
    monkeypatch.setenv(references.CACHE, "/proc/nowhere")
    assert references.cached(Line().problem(), 1e-2).front.volume == pytest.approx(0.71, abs=5e-3)


def test_too_many_variables_are_refused():
    problem = Problem(evaluate=lambda x: x[:, :2], lower=(0,) * 5, upper=(1,) * 5, objectives=("f1", "f2"))
    with pytest.raises(ValueError, match=r"^problem must have a front that a grid of 20000000 designs settles"):
        references.refined(problem)


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
