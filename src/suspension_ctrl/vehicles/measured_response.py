"""Frequency responses between the lines at which they were measured."""

from functools import cached_property
from typing import Any

import control
import numpy as np

from ..quantities import Complex


class MeasuredResponse(control.FrequencyResponseData):  # type: ignore[misc]  # python-control has no types
    """Frequency response that is a cubic spline between its lines and unknown beyond them."""

    def eval(self, omega: Any, squeeze: bool | None = None) -> Complex:
        """Return it at angular frequencies [rad/s]; ValueError beyond the lines."""
        at = np.atleast_1d(omega).real
        found, known = (np.array([x.min(), x.max()]) / (2 * np.pi) for x in (at, self.omega))
        if not known[0] <= found[0] <= found[1] <= known[1]:
            got = "{:g} to {:g} Hz, got frequencies from {:g} to {:g} Hz".format(*known, *found)
            raise ValueError(f"band must lie within what was measured, {got}")
        return control.frd(self._spline(at), at).eval(omega, squeeze=squeeze)

    @cached_property
    def _spline(self) -> Any:
        from scipy.interpolate import CubicSpline

        return CubicSpline(self.omega, self.frdata, axis=2)
