"""Shares of the machine's limits, on timings and counts made up for the purpose."""

import numpy as np
import pandas as pd

import struts_by_numpy
from sections import arithmetic, roofline
from suspension_ctrl.response.many_struts import ManyStruts


def roofline_times(share: float = 0.65) -> pd.DataFrame:
    """A share of the limit on one thread, and twice that on two, at the second of two calls."""
    rows = [
        (name, threads, 10, share * 1e-5, seconds)
        for name in (roofline.ARITHMETIC, *(row.what for row in roofline.ROWS), roofline.RANKING)
        for threads in (1, 2)
        for seconds in (2e-4, 1e-4 / threads)
    ]
    return pd.DataFrame(rows, columns=["what", "threads", "designs", "limit", "seconds"])


def test_shares_are_of_the_least_time_on_one_thread():
    found = roofline.shares(roofline_times(0.55))
    np.testing.assert_allclose(found.share, 0.55)
    np.testing.assert_allclose(found.threads, 2.0)
    held = {what: here >= bar for what, bar, here in roofline.goals(roofline_times(0.55))}
    assert held == {
        "quarter car, share of the limit": False,
        "full car, share of the limit": True,
        "quarter car, one thread / two": True,
        "full car, one thread / two": True,
    }


def test_a_machine_of_one_processor_has_no_time_of_two_threads():
    timings = roofline_times().query("threads == 1")
    assert len(roofline.goals(timings)) == 2


def test_operations_are_counted_by_node_and_block(table1_problem):
    """Table 1's car: 7 numerators. Two blocks of two struts with 2 and 1 responses of one source."""
    one = arithmetic.work_of(table1_problem.scores.kernel(256).cases[0], np.empty((0, 2)))
    assert one == (256 * 12.5, 128, 40)
    blocks = ManyStruts(
        omega=np.ones(8), rows=np.ones((1, 2, 8)), sizes=np.array([[2, 1, 2], [2, 1, 1]]), response=np.arange(3),
        channel=np.arange(3), gain=np.ones((4, 8)), order=np.zeros(4, dtype=int), origin=np.ones(4),
    )  # fmt: skip
    assert arithmetic.work_of(blocks, np.empty((0, 4))) == (8 * (2 * (41 + 24) + 30), 16, 56)


def test_a_network_in_series_is_counted_once_for_all_struts():
    """One block of two struts with 3 responses of one source at 24 frequencies, a damper on rubber in both."""
    case, _ = struts_by_numpy.on_mounts(struts_by_numpy.random_struts([(2, 1, 3)], [False]), np.ones(4))
    work = arithmetic.work_of(case, np.empty((0, 4)))
    assert work[:2] == (24 * (41 + 24 + 3 * 10 + 24 + 4), 24 * 2)


def test_the_limit_is_that_of_the_slowest_operation():
    work = arithmetic.Work(multiply_adds=100.0, divisions=10.0, bytes=1.0)
    assert work.seconds(arithmetic.Limits(100.0, 5.0, 10.0)) == 2.0
    assert work.seconds(arithmetic.Limits(10.0, 5.0, 10.0)) == 10.0
