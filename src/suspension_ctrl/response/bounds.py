"""Bounds of coefficients and parameters that vary."""

from collections.abc import Mapping, Sequence

from .. import checks
from ..quantities import FrozenMapping
from ..vehicles.parameters import Place
from ..vehicles.vehicle import Struts, Vehicle

Bounds = Mapping[str, tuple[float, float]]


def checked_bounds(
    vehicle: Vehicle, bounds: Bounds | None, lower: Sequence[float], upper: Sequence[float], fixed: Struts
) -> Bounds:
    """Return the bounds by name, frozen, with `lower` and `upper` (d,) in place of theirs where given."""
    checks.mapped("bounds", {} if bounds is None else bounds)
    coefficients = {one.name: one for one in vehicle.strut_coefficients}
    known = coefficients if {*(bounds or {}), *fixed} <= {*coefficients} else vehicle.variables
    if bounds is not None and not bounds:
        raise ValueError("bounds must hold one coefficient at least, got none")
    for name, pair in (bounds or {}).items():
        checks.one_of("bounds", name, known)
        checks.interval(
            f"bounds of {name}", pair, known[name].unit, equal=True, signed=isinstance(known[name], Place)
        )
    names = [name for name, p in coefficients.items() if p.default is None] if bounds is None else list(bounds)
    low, high = zip(*bounds.values(), strict=True) if bounds else ((), ())
    low, high = (tuple(map(float, x if len(x) else of_pairs)) for x, of_pairs in ((lower, low), (upper, high)))
    checks.ordered("lower", "upper", low, high)
    if len(low) != len(names):
        raise ValueError(f"lower and upper must bound {checks.listing(names)}, got {checks.shown(low)}")
    for name, value in zip(names, low, strict=True):
        known[name].check(f"lower bound of {name}", value)
    if both := set(names) & fixed.keys():
        raise ValueError(f"struts must be those that do not vary, got {min(both)} with bounds")
    return FrozenMapping(dict(zip(names, zip(low, high, strict=True), strict=True)))
