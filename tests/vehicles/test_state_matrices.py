"""State spaces as arrays: the same numbers and names as the systems of python-control made of them."""

import control
import numpy as np
import pytest

from suspension_ctrl import load_vehicle
from suspension_ctrl.vehicles.feedback import Dynamics, around, selected, with_copies, with_rates

KNOWN = load_vehicle("minaker_half")
FILTERED = Dynamics(np.zeros((3, 2, 2)), ((1, (np.array([3e3]), np.array([1.0, 0.1]))),))


def assert_same(matrices, system):
    for name in "ABCD":
        np.testing.assert_array_equal(getattr(matrices, name), getattr(system, name))
    for kind in ("state", "input", "output"):
        assert getattr(matrices, f"{kind}_labels") == getattr(system, f"{kind}_labels")
    sizes = ("nstates", "ninputs", "noutputs")
    assert [getattr(matrices, one) for one in sizes] == [getattr(system, one) for one in sizes]


def test_a_plant_has_the_matrices_that_the_library_computes_with():
    bare, plant = KNOWN.vehicle.bare(), KNOWN.vehicle.plant()
    assert isinstance(plant, control.StateSpace)
    assert plant.name == bare.name == "plant"
    assert_same(bare, plant)
    assert isinstance(KNOWN.vehicle.closed(KNOWN.setting), control.StateSpace)


@pytest.mark.parametrize(
    "change",
    [
        lambda system: around(system, np.array([np.eye(2) * 2e4, np.eye(2) * 1500.0, np.zeros((2, 2))])),
        FILTERED.around,
        lambda system: with_rates(system, {"rate": "front_deflection"}),
        lambda system: with_copies(system, {"copy": "front_deflection"}, {"force": "front_strut"}),
        lambda system: selected(system, ["front_tyre_load"], ["front_road", "nowhere"], "one"),
    ],
)
def test_what_is_done_to_matrices_is_done_to_systems(change):
    assert_same(change(KNOWN.vehicle.bare()), change(KNOWN.vehicle.plant()))
