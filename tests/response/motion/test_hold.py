"""The exact response begins on the first heights or on a level road; all else is tested in `test_driving`."""

import numpy as np
import pytest

from garage import HALF, struts_of
from suspension_ctrl.response.motion.hold import Model, Wheels, states_of
from suspension_ctrl.roads.profiles import Profile


def test_states_begin_in_equilibrium():
    model = Model.of(HALF.closed(struts_of(HALF)))
    profile = Profile(0.1 * np.arange(80), 0.01 * np.sin(np.arange(80.0))[:, None])
    wheels = Wheels.on(profile, HALF.contact_points, periodic=False)
    first = {height: states_of(model, wheels, 0.01, False, height)[0] for height in (None, 0.03)}
    np.testing.assert_allclose(model.a @ first[None] + model.b @ wheels.elevation()[0], 0, atol=1e-9)
    assert (model.c @ first[0.03] + 0.03 * model.d.sum(axis=1)) == pytest.approx(0, abs=1e-9)
