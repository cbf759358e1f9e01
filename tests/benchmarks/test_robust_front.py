"""The benchmark of robust fronts on few vehicles."""

import numpy as np
import pytest

import robust_front


def test_robust_designs_keep_to_the_limit_where_nominal_ones_do_not():
    robust, judge = robust_front.problem(16), robust_front.problem(64, robust_front.OTHER)
    fronts = [robust_front.judged(one, judge, population=16, iterations=8) for one in (robust.nominal, robust)]
    nominal, other = fronts
    assert nominal.met.mean() < 0.5 < other.met.mean()
    volumes = robust_front.hypervolumes(fronts)
    assert volumes[0] < volumes[1] <= 1
    assert robust_front.beaten(nominal, by=other) > robust_front.beaten(other, by=nominal)
    assert nominal.processor > 0


def test_a_front_beats_what_it_dominates_and_what_misses_the_limit():
    values = np.array([[1.0, 3.0], [2.0, 2.0], [3.0, 1.0]])
    met = np.array([True, True, False])
    one = robust_front.Judged(values, values, met, 0.0, 0.0)
    other = robust_front.Judged(values, values - [0.5, 0.0], np.array([False, True, True]), 0.0, 0.0)
    assert robust_front.beaten(one, by=other) == pytest.approx(200 / 3)
    assert robust_front.beaten(other, by=one) == pytest.approx(100 / 3)
    assert robust_front.hypervolumes([one, one]) == [1.0, 1.0]
