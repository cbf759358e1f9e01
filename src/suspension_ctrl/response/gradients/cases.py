"""Mean squares of a load case over designs, with the derivatives of what is wanted of them in one pass."""

from collections.abc import Callable
from typing import Any

import numpy as np

from ...quantities import Real
from ..any_struts import AnyStruts
from ..mapped import Mapped, slopes_of, unmapped
from ..mean_squares import Case
from ..one_fraction import OneFraction
from ..one_port import OnePort
from ..one_strut import OneStrut
from . import any_struts, linear_port, mounted_struts, one_fraction, one_port, one_strut
from .wanted import Wanted


def _of_port(port: OnePort, wanted: Wanted, designs: Real) -> tuple[Real, Real]:
    """Return these around one strut, by the derivatives of its network where it has no force laws."""
    method = one_port.with_slopes if port.networks.law.size else linear_port.with_slopes
    return method(port, wanted, designs)


def _of_any(case: AnyStruts, wanted: Wanted, designs: Real) -> tuple[Real, Real]:
    """Return these of any struts, in lanes where blocks have two struts and no force laws."""
    method = mounted_struts.with_slopes if mounted_struts.fits(case) else any_struts.with_slopes
    return method(case, wanted, designs)


_BY_CLASS: dict[type, Callable[[Any, Wanted, Real], tuple[Real, Real]]] = {
    OneStrut: one_strut.with_slopes,
    OneFraction: one_fraction.with_slopes,
    OnePort: _of_port,
    AnyStruts: _of_any,
}


def with_slopes(case: Case, wanted: Wanted, designs: Real) -> tuple[Real, Real]:
    """Return the mean squares (p, k) of designs (p, v), and the derivatives (p, s, v) of what is wanted of them.

    Those of a design without a working point are NaN.
    """
    inner, coefficients = unmapped(case, designs)
    coefficients = np.require(coefficients, requirements=("C", "W"))  # read-only arrays are another type
    squares, slopes = _BY_CLASS[type(inner)](inner, wanted, coefficients)
    if isinstance(case, Mapped):
        slopes = slopes @ slopes_of(case.formulas, np.require(designs, requirements=("C", "W")))
    return squares, slopes
