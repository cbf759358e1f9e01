"""Networks as data of compiled loops: their nodes."""

import numpy as np

import suspension_ctrl as sc
from suspension_ctrl.vehicles.networks import DAMPER, LAW, MEASURED, PARALLEL, SERIES, SPRING, Program, placed


def test_plain_elements_in_parallel_are_gains():
    strut = sc.parallel(sc.Spring(installation_ratio=0.5), sc.Damper(), sc.Inerter(), installation_ratio=0.8)
    coefficients, networks = placed(strut, "front", [1.0, 0.0])
    assert not networks
    assert [one.name for one in coefficients] == ["front.spring", "front.damper", "front.inerter"]
    assert [one.order for one in coefficients] == [0, 1, 2]
    np.testing.assert_allclose([one.gain[0, 0] for one in coefficients], [0.16, 0.64, 0.64])


def test_nodes_come_after_their_parts():
    rows = {"frequency": [1.0, 2.0], "storage": [1e5, 2e5], "loss": [1e4, 1e4]}
    strut = sc.parallel(
        sc.Spring(),
        sc.series(sc.Damper(), sc.Spring("mount"), sc.MeasuredStiffness("bush", **rows), installation_ratio=0.7),
        sc.Friction(),
    )
    coefficients, networks = placed(strut, "rear", [1.0])
    program = Program.of(networks, [one.name for one in coefficients])
    assert program.kind.tolist() == [DAMPER, SPRING, MEASURED, SERIES, SERIES, LAW, PARALLEL]
    assert program.parts.tolist()[3:] == [[0, 1], [3, 2], [-1, -1], [4, 5]]
    assert program.coefficient.tolist()[:3] == [[1, -1], [2, -1], [3, 0]]
    assert program.ratio.tolist() == [1, 1, 1, 1, 0.7, 1, 1]
    assert program.root.tolist() == [6]
    assert program.laws.by[0, 2, 0].tolist() == [4, -1]  # the jump of the friction
