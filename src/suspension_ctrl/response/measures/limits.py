"""Limits on measures."""

import re
from collections.abc import Iterable
from dataclasses import dataclass, replace
from math import isinf

from ... import checks
from ...quantities import Record, quantity, wrapped
from ...tables.headers import shown_value
from ..load_case import LoadCase
from ..weightings import Weighting
from .measure import Measure, likely, measure_of
from .terms import NUMBER, CaseMeasure, number_text

_LIMIT = re.compile(rf"((?:(?![<>]=).)+)([<>]=)\s*({NUMBER})(\s*|\s*[^\s\d.].{{0,29}})")
_GREATEST = 1e300


@dataclass(frozen=True, eq=False, repr=False)
class Limit(Record):
    """The most or the least that a measure may be, in the worst load case.

    Parameters
    ----------
    measure : Measure
        A measure of which less is better, or its text.
    maximum, minimum : float
        One of them, in the unit of the measure; a measure of vibration has a maximum above zero.

    Raises
    ------
    ValueError
        If neither or both are given, or more of the measure is better.

    Examples
    --------
    >>> import suspension_ctrl as sc
    >>> print(sc.Limit(sc.SWS("front"), 0.03), sc.Limit(sc.RollDamping(), minimum=0.2), sep="; ")
    SWS front <= 0.03; roll_damping >= 0.2
    """

    measure: Measure
    maximum: float | None = None
    minimum: float | None = None

    def __post_init__(self) -> None:
        self._keep(measure=measure_of(self.measure))
        if (self.maximum is None) == (self.minimum is None):
            raise ValueError(f"limit must have a maximum or a minimum, got {self.maximum} and {self.minimum}")
        name = "minimum" if self.maximum is None else "maximum"
        checks.within(name, self.value, -_GREATEST, _GREATEST)
        self._keep(**{name: float(self.value)})
        if self.measure.maximise:
            raise ValueError(f"constraint must limit a measure without - in front, got {checks.shown(str(self))}")

    @property
    def value(self) -> float:
        """The maximum or the minimum."""
        return next(value for value in (self.maximum, self.minimum) if value is not None)

    @property
    def nominal(self) -> "Limit":
        """The limit on one vehicle: itself, but of one on a measure over a scatter."""
        return replace(self, measure=self.measure.nominal)

    @property
    def scale(self) -> float:
        """Factor of the measure in the constraint g = scale measure + offset, the excess over the value."""
        return (-1.0 if self.maximum is None else 1.0) / (abs(self.value) or 1.0)

    @property
    def offset(self) -> float:
        """Constant of the constraint."""
        return -self.scale * self.value

    def __str__(self) -> str:
        return f"{self.measure} {'>=' if self.maximum is None else '<='} {number_text(self.value)}"

    def describe(self) -> str:
        """Return the limit as an engineer reads it: ``SWS <= 12 mm``."""
        sign = ">=" if self.maximum is None else "<="
        return f"{self.measure.label} {sign} {shown_value(self.value, self.measure.unit)}"

    def __repr__(self) -> str:
        return wrapped(f"<{self} {self.measure.unit}>")

    def in_case(self, case: LoadCase, weighting: Weighting | None, /) -> CaseMeasure:
        """Return the measure in a load case; ValueError if the vehicle lacks it or it has no such limit."""
        found = self.measure.in_case(case, weighting)
        if not found.values and not (self.maximum or 0.0) > 0:
            got = checks.shown(str(self))
            raise ValueError(f"constraint on a measure of the ride must be <= a limit above zero, got {got}")
        return found

    @classmethod
    def parse(cls, text: str, measures: Iterable[Measure] = ()) -> "Limit":
        """Return the limit of a text, on one of the measures by its name or on another by its text.

        A number may have a unit like that of the measure: ``SWS <= 12mm``.

        Raises
        ------
        ValueError
            If the text is not a measure, ``<=`` or ``>=``, and a number, or its unit is another.
        """
        found = _LIMIT.fullmatch(text) if isinstance(text, str) else None
        if not found or isinf(float(found[3])):
            got = checks.shown(text)
            raise ValueError(f"constraint must be like 'SWS <= 30mm' or 'roll_damping >= 0.2', got {got}")
        named = {measure.label: measure for measure in measures}
        measure = named.get(" ".join(found[1].split())) or Measure.parse(found[1])
        value = _value(measure, found[3], found[4].strip())
        return cls(measure, **{"maximum" if found[2] == "<=" else "minimum": value})


def has_unit(text: str) -> bool:
    """Whether the number in the text of a limit has a unit."""
    found = _LIMIT.fullmatch(text)
    return bool(found and found[4].strip())


def _value(measure: Measure, number: str, unit: str) -> float:
    """Return a number in the unit of a measure; ValueError if its unit is another."""
    if unit in ("", measure.unit):
        return float(number)
    try:
        return quantity(f"limit of {measure.label}", number + unit, "" if measure.unit == "-" else measure.unit)
    except ValueError as error:  # without a unit: of no known measure
        raise ValueError(f"{error}{'' if measure.unit else likely(measure.label)}") from None
