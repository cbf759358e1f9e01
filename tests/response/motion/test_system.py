"""Storage of a motion."""

import numpy as np

from garage import FULL, struts_of
from suspension_ctrl.response.motion.drivable import Drivable
from suspension_ctrl.response.motion.system import work_of


def test_columns_are_the_effects_of_states_roads_their_rates_and_tensions():
    motion = Drivable.of(FULL).motion(np.array(list(FULL.coefficients(struts_of(FULL)).values())))
    e, work = motion.equations, work_of(motion.equations, motion.tree)
    np.testing.assert_array_equal(work.columns, np.hstack([e.a, e.b, e.g, e.f]).T)
    np.testing.assert_array_equal(work.ports, e.c.T)
