"""The struts that an event moves, and the parts of a response that follow the road at once."""

import numpy as np
import pytest

import suspension_ctrl as sc
from garage import DAMPED_QUARTER, FULL, HALF, QUARTER
from suspension_ctrl.response.passing import passing

PLANK = sc.Plank(height=0.03, length=0.3)


@pytest.mark.parametrize(
    ("vehicle", "event", "struts"),
    [
        (FULL, PLANK, 2),  # both sides alike: sums of left and right
        (FULL, sc.Plank(height=0.03, length=0.3, side="left"), 4),
        (FULL, sc.RigSine(motion="roll", amplitude=0.01, frequency=2.0), 2),
        (HALF, PLANK, 2),
        (QUARTER, PLANK, 1),
    ],
)
def test_struts_that_an_event_does_not_move_are_left_out(vehicle, event, struts):
    found = passing(vehicle, event, 10.0, ("body_acceleration",), 4.0)
    assert found.pairs.shape == (struts, len(vehicle.struts))
    np.testing.assert_allclose(found.pairs @ found.pairs.T, np.eye(struts), atol=1e-12)


def test_the_load_of_a_tyre_follows_the_road_at_once():
    """By the stiffness, of a damped tyre by its damping too; an acceleration of the body does not."""
    found = passing(DAMPED_QUARTER, PLANK, 10.0, ("tyre_load", "body_acceleration"), 4.0)
    flank = np.argmin(np.abs(np.arange(found.kinked.shape[1]) / found.kinked.shape[1] * 4.04 - 0.005))  # s
    time = flank / found.kinked.shape[1] * 4.04
    elevation, rate = 0.03 * time / 0.01, 0.03 / 0.01
    load = -DAMPED_QUARTER.tyre_stiffness * elevation - DAMPED_QUARTER.tyre_damping * rate
    assert found.direct[0, flank] == pytest.approx(load, rel=1e-9)
    assert not found.direct[1].any()
    assert found.kinked[0].any()
    assert not found.kinked[1].any()
