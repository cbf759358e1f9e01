"""Ports of a plant over frequency; closed by numpy they are python-control's closed vehicle."""

import numpy as np

from garage import QUARTER, ROAD
from suspension_ctrl import RideProblem
from suspension_ctrl.desk.explorer.plant_ports import plant_ports
from suspension_ctrl.response.ports import dynamic_stiffness, paths

BOUNDS = {"spring": (15e3, 30e3), "damper": (1e3, 3e3)}


def test_ports_closed_around_a_strut_are_the_vehicle():
    problem = RideProblem(QUARTER, ROAD, speed=20.0, bounds=BOUNDS)
    ports = plant_ports(problem.scores, 0, problem.scores.kernel(problem.nodes).cases[0], 30)
    added = np.array([18e3, 2500.0]) - ports.origin
    gains = np.zeros((3, 1, 1))
    for gain, order, value in zip(ports.gain, ports.order, added, strict=True):
        gains[order] += gain * value
    d, m = dynamic_stiffness(gains, ports.omega), ports.m
    h11, h12, h21, h22 = ports.h[:, :m, :1], ports.h[:, :m, 1:], ports.h[:, m:, :1], ports.h[:, m:, 1:]
    wanted = paths(QUARTER.closed(18e3, 2500.0, responses=ports.responses), ports.f)
    np.testing.assert_allclose(h11 + h12 * d / (1 - h22 * d) * h21, wanted, rtol=1e-9)
    np.testing.assert_allclose(ports.weights[ports.responses.index("suspension_travel")], 1.0)
    np.testing.assert_allclose(ports.roads[:, 0, 0], ROAD.psd(ports.f, 20.0))
