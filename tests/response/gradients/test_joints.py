"""Rows and joints of two elements in series, in one pass as in two; below other nodes see `test_tangents`."""

import numpy as np

from suspension_ctrl.response.gradients.joints import fill_direct_joint, join_directly
from suspension_ctrl.response.network_rows import elements, join

OMEGA = 2 * np.pi * np.linspace(0.3, 20.0, 11)


def test_two_direct_elements_in_series_in_one_pass_are_those_in_two():
    direct = np.array([[2e4, 1500.0, 3.0, 50.0], [2e5, 30.0, 1.0, 4e3]])
    row, joint, zero, expected, factor = np.zeros((5, 2, OMEGA.size))
    join_directly(0.64, OMEGA, elements(direct, 0), elements(direct, 1), row, joint)
    join(0.64, OMEGA, direct, 0, 1, zero, zero, expected)
    fill_direct_joint(0.64, OMEGA, elements(direct, 0), elements(direct, 1), factor)
    np.testing.assert_allclose(row, expected, rtol=1e-12)
    np.testing.assert_allclose(joint, factor, rtol=1e-12)
