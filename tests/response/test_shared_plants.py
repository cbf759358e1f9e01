"""Load cases with one plant beside each by itself, on loops of random numbers."""

import numpy as np

from suspension_ctrl.response.many_struts import ManyStruts
from suspension_ctrl.response.shared_plants import shared, squares_by_case

SIZES = [(2, 1, 3), (3, 2, 2)]
"""Struts, sources and responses of two blocks."""


def random_struts(plant: int, sources: int) -> ManyStruts:
    """Return blocks of which the rows by sources come from a seed of their own."""
    of_plant, of_sources = np.random.default_rng(plant), np.random.default_rng(100 + sources)
    rows = [
        scale * rng.normal(size=(count, 2, 8))
        for q, s, k in SIZES
        for rng, count, scale in ((of_plant, q * q, 0.1), (of_sources, (q + k) * s, 1.0), (of_plant, k * q, 1.0))
    ]
    gain = of_plant.normal(size=(3, 13))
    gain[:, 1:3] = 0.0  # the first block is that of two struts without coupling
    return ManyStruts(
        omega=np.linspace(0.5, 2.0, 8), rows=np.concatenate(rows), sizes=np.array(SIZES),
        response=np.array([0, 2, 1, 1, 0]), channel=np.array([2, 0, 0, 1]), gain=gain, order=np.array([0, 1, 0]),
        origin=np.ones(3),
    )  # fmt: skip


def test_cases_with_one_plant_are_solved_once_and_have_the_same_bits():
    cases = [random_struts(plant, sources) for plant, sources in ((0, 0), (1, 1), (0, 2), (0, 3), (2, 0))]
    groups = shared(cases)
    assert [numbers for _, numbers in groups] == [(0, 2, 3), (1,), (4,)]
    designs = np.random.default_rng(5).normal(size=(3, 3))
    for found, case in zip(squares_by_case(groups, designs), cases, strict=True):
        np.testing.assert_array_equal(found, case(designs))


def test_cases_that_differ_in_more_than_sources_stay_apart():
    case = random_struts(0, 0)
    others = [
        case._replace(omega=2 * case.omega),
        case._replace(origin=2 * case.origin),
        case._replace(channel=case.channel[::-1].copy()),
        case._replace(
            rows=case.rows * np.where(np.arange(len(case.rows)) == len(case.rows) - 1, 2, 1)[:, None, None]
        ),
    ]
    assert [numbers for _, numbers in shared([case, *others, 7.0])] == [(0,), (1,), (2,), (3,), (4,), (5,)]
