"""Between its lines a measured response is a spline, beyond them unknown: see test_feedback."""

import numpy as np
import pytest

from suspension_ctrl.vehicles.measured_response import MeasuredResponse


def test_it_is_known_between_its_lines_alone():
    omega = 2 * np.pi * np.linspace(1.0, 5.0, 9)
    response = MeasuredResponse([[omega**2 + 1j * omega]], omega)
    between = 2 * np.pi * np.array([1.3, 4.9])
    # A cubic spline meets a polynomial of second degree but for rounding.
    np.testing.assert_allclose(response(1j * between), between**2 + 1j * between, rtol=1e-12)
    with pytest.raises(ValueError, match=r"^band must lie within what was measured, 1 to 5 Hz, got .* to 2 Hz$"):
        response(2j * np.pi * np.array([0.5, 2.0]))
