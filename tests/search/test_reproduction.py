"""Children in a sweep, in place and by verbs that return arrays."""

import numpy as np
import pytest

from suspension_ctrl.search.operators import DifferentialChild, MutateDesign, RedrawOutside
from suspension_ctrl.search.reproduction import OUTSIDE, WRONG_SIZE, ChildByVerbs, ChildInSweep, child_maker

LOWER, UPPER = np.zeros(5), np.ones(5)
OWN = DifferentialChild(0.9), RedrawOutside(LOWER, UPPER, 1.0), MutateDesign.of(LOWER, UPPER, 20.0, 0.4)


def test_children_in_place_are_those_of_the_verbs():
    """Half of the differences leave the box, so that all three change the child; the same numbers are drawn."""
    designs = np.random.default_rng(0).random((12, 5))
    rngs = np.random.default_rng(1), np.random.default_rng(1)
    own, verbs = child_maker(*OWN, None), ChildByVerbs(*OWN, np.array([LOWER, UPPER]))
    assert isinstance(own, ChildInSweep)
    for i in range(12):
        one, other = np.empty(5), np.empty(5)
        partners = np.arange(i % 7, 12)
        assert own(rngs[0], designs, i, partners, one) == verbs(rngs[1], designs, i, partners, other) == 0
        np.testing.assert_array_equal(one, other)
    assert rngs[0].random() == rngs[1].random()


@pytest.mark.parametrize(
    ("place", "verb", "mark"),
    [
        (0, lambda rng, designs, i, partners: designs[i, :4], WRONG_SIZE),
        (1, lambda rng, child, parent: child[:4], WRONG_SIZE),
        (2, lambda rng, child: child[:4], WRONG_SIZE),
        (2, lambda rng, child: child - 2.0, OUTSIDE),
        (2, lambda rng, child: child * np.nan, OUTSIDE),
    ],
)
def test_wrong_children_are_marked(place, verb, mark):
    verbs = [*OWN[:place], verb, *OWN[place + 1 :]]
    maker = child_maker(*verbs, np.array([LOWER, UPPER]))
    designs = np.random.default_rng(0).random((6, 5))
    assert maker(np.random.default_rng(0), designs, 0, np.arange(6), np.empty(5)) == mark
