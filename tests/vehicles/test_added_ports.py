"""Ports of parameters: an assembly with them, without any change, is the vehicle as it was."""

import numpy as np
import pytest

from garage import DRIVER, FULL
from suspension_ctrl.vehicles.added_ports import AddedPorts
from suspension_ctrl.vehicles.motion import plant_of
from suspension_ctrl.vehicles.parameters import parameters_of

CAR = DRIVER.on(FULL).assembly


@pytest.mark.parametrize("name", ["front_tyre_stiffness", "rear_tyre_damping", "body_mass", "driver.mass"])
def test_ports_leave_the_responses_of_a_vehicle_as_they_are(name):
    """To rounding, at 2 Hz from the roads and the struts, rates of roads added."""
    ports = AddedPorts(CAR)
    ports.add(parameters_of(CAR)[name], 0)
    with_ports, names = ports.assembly(), list(CAR.responses)
    s, r, q = 4j * np.pi, len(CAR.roads), len(CAR.struts)
    found, before = (plant_of(one, names).system()(s)[: len(names)] for one in (with_ports, CAR))
    more = found.shape[1] - len(with_ports.struts)
    roads = found[:, :r] + (s * found[:, r:more] if more > r else 0.0)
    np.testing.assert_allclose(roads, before[:, :r], rtol=1e-9, atol=1e-9 * np.abs(before).max())
    np.testing.assert_allclose(found[:, more : more + q], before[:, r:], rtol=1e-12)
    assert list(ports.slots) == [f"{name} added"]


def test_a_tyre_beside_a_tyre_is_in_its_load():
    ports = AddedPorts(CAR)
    ports.add(parameters_of(CAR)["front_tyre_stiffness"], 0)
    plant = plant_of(ports.assembly(), ["front_left_tyre_load"])
    tensions = plant.D[0, -len(plant.input_labels) :]
    assert tensions[plant.input_labels.index("front_left_tyre_stiffness_strut")] == 1.0
    assert tensions[plant.input_labels.index("front_right_tyre_stiffness_strut")] == 0.0
