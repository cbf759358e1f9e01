"""Base class of all measures, with their texts, and measures defined by a user's function."""

import inspect
import re
from collections.abc import Callable
from dataclasses import dataclass, field, replace
from typing import Any, ClassVar, Self

import numpy as np

from ... import checks
from ...quantities import Real, Record, wrapped
from ..load_case import LoadCase
from ..weightings import Weighting
from .terms import CaseMeasure, Designs


@dataclass(frozen=True, init=False, eq=False, repr=False)
class Measure(Record):
    """A number by which a design is judged: a measure of a user's own, and the base of all others.

    Parameters
    ----------
    name : str
        Name of the measure.
    unit : str
        Unit of the measure, ``"-"`` for none.
    function : callable
        Of two positional parameters, ``f(frequency, spectra)``: the value of a design from the one-sided spectra
        (n,) of its responses by name [unit^2/Hz] at the middles (n,) of 1000 equal parts of the band [Hz]. Of one,
        ``f(designs)``: the values (p,) of designs (p, d), the variables in their order. Several load cases count
        by the mean of their values by shares, or by the worst.
    maximise : bool
        Whether more is better.

    Raises
    ------
    ValueError
        If the name is no text without ``=``, or the function takes neither one nor two parameters.

    Examples
    --------
    The mean power that the damper dissipates. On a road of waviness 2 and over all frequencies it is pi^2 K_t
    Gd(n0) n0^2 V for any spring and damper:

    >>> import numpy as np
    >>> import suspension_ctrl as sc
    >>> def heat(frequency, spectra):
    ...     rate = (2 * np.pi * frequency) ** 2 * spectra["suspension_travel"]
    ...     return 1500.0 * np.trapezoid(rate, frequency)
    >>> car = sc.QuarterCar(body_mass=317.5, wheel_mass=45.4, tyre_stiffness=192e3)
    >>> table = sc.ride(
    ...     car,
    ...     {"spring": 22e3, "damper": 1500.0},
    ...     sc.Iso8608Road("C"),
    ...     speed=20.0,
    ...     measures=["ACC", sc.Measure("heat", "W", heat)],
    ...     band=(0.1, 100.0),
    ... )
    >>> print(f"{table['value']['heat']:.0f} W, {np.pi**2 * 192e3 * 256e-6 * 0.1**2 * 20.0:.0f} W")
    97 W, 97 W

    A file has a measure as a text:

    >>> sc.Measure.parse("comfort = ACC driver") == sc.ACC("driver", name="comfort")
    True
    """

    name: str = field(default="", kw_only=True)
    maximise: bool = field(default=False, kw_only=True)
    unit: str = field(default="", init=False)

    words: ClassVar[dict[str, type["Measure"]]] = {}
    """Classes of measures by the first word of their texts, ``""`` for a text without such a word."""
    word: ClassVar[str]
    unit_of_class: ClassVar[str] = ""
    of_ride: ClassVar[bool] = True  # on a road or in an event, not of statics or roll

    def __init_subclass__(cls, word: str | None = None, unit: str = "") -> None:
        cls.unit_of_class = unit or cls.unit_of_class
        if word is not None:
            cls.word = word
            Measure.words[word] = cls

    def __new__(cls, *_: Any, **__: Any) -> Self:
        """Make ``Measure(name, unit, function)`` an `OwnMeasure`."""
        kind: Any = OwnMeasure if cls is Measure else cls
        return object.__new__(kind)

    def __init__(self, *arguments: Any, name: str = "", maximise: bool = False) -> None:
        if arguments:
            raise TypeError(f"{type(self).__name__} takes name and maximise alone, got {checks.shown(arguments)}")
        self._keep(name=name, maximise=maximise)
        self.__post_init__()

    def __post_init__(self) -> None:
        if not isinstance(self.name, str) or "=" in self.name:
            raise ValueError(f"name of a measure must be a text without =, got {checks.shown(self.name)}")
        unit = self.unit_of_class or self.unit
        self._keep(name=" ".join(self.name.split()), maximise=bool(self.maximise), unit=unit)

    @property
    def label(self) -> str:
        """Name of the measure: its own, or its text."""
        return self.name or self._text()

    @property
    def nominal(self) -> "Measure":
        """The measure of one vehicle: itself, but of a measure over a scatter."""
        return self

    @property
    def sign(self) -> float:
        """Factor of the objective: -1 if more is better."""
        return -1.0 if self.maximise else 1.0

    def in_case(self, case: LoadCase, weighting: Weighting | None, /) -> CaseMeasure:
        """Return the measure in a load case, with the weighting of ACC; ValueError if the vehicle lacks it."""
        raise NotImplementedError

    @classmethod
    def read(cls, rest: str, **options: Any) -> "Measure":
        """Return the measure of a text after its word; options name and maximise."""
        if rest:
            raise ValueError(f"{cls.word} must stand alone, got {checks.shown(rest)}")
        return cls(**options)

    @staticmethod
    def parse(text: str) -> "Measure":
        """Return the measure of a text.

        Raises
        ------
        ValueError
            If the text begins with no word of a measure and is no sum of terms.
        """
        written = " ".join(text.split()) if isinstance(text, str) else ""
        *name, body = (part.strip() for part in written.split("=", 1))
        if not body or name == [""]:
            got = checks.shown(text)
            raise ValueError(f"measure must be a text such as 'SWS front' or 'name = SWS front', got {got}")
        plain = body.removeprefix("-").strip()
        first = re.split(r"\W", plain, maxsplit=1)[0]
        word = next((one for one in (first, first.rstrip("0123456789")) if one in Measure.words), "")
        rest, options = plain.removeprefix(word).strip(), {"maximise": plain != body}
        found = Measure.words[word].read(rest, name="".join(name), **options)
        return found if name or str(found) == written else replace(found, name=written)

    def __str__(self) -> str:
        return f"{self.name} = {self._text()}" if self.name else self._text()

    def __repr__(self) -> str:
        return wrapped(f"<{self} [{self.unit}]>")

    def _text(self) -> str:
        return "-" * self.maximise + f"{self.word} {self._rest()}".strip()

    def _rest(self) -> str:
        return ""


def likely(text: str) -> str:
    """Return a hint at the words of measures that are spelt like a text, empty without one."""
    from difflib import get_close_matches

    alike = get_close_matches(text[:100], [word for word in Measure.words if word])
    return f": did you mean {' or '.join(alike)}?" if alike else ""


@dataclass(frozen=True, eq=False, repr=False)
class OwnMeasure(Measure):
    """A measure of a user's own, see `Measure`."""

    name: str = field()
    unit: str = field()
    function: Callable[..., Any] = field()

    def __post_init__(self) -> None:
        super().__post_init__()
        if not self.name:
            raise ValueError(f"name of a measure must be a text without =, got {self.name!r}")
        if _positional(self.function) not in (1, 2):
            got = checks.shown(self.function)
            raise ValueError(f"function must take designs, or frequency and spectra, got {got}")

    def __str__(self) -> str:
        return self.name

    def in_case(self, _case: LoadCase, _weighting: Weighting | None, /) -> CaseMeasure:
        """Return the measure in any load case."""
        if _positional(self.function) == 1:
            return CaseMeasure(values=self._of_designs)
        return CaseMeasure(values=self._of_designs, in_trip=lambda trip, _: float(self.function(*trip.spectra())))

    def _of_designs(self, designs: Designs) -> Real:
        """Return the values (p,) of designs; ValueError unless they are finite numbers."""
        if _positional(self.function) == 1:
            found = np.asarray(self.function(designs.values.copy()), dtype=float)
        else:
            found = np.array([self.function(*one) for one in designs.spectra()], dtype=float)
        if found.shape != (len(designs.values),) or not np.isfinite(found).all():
            raise ValueError(
                f"measure {self.name} must return a finite number for each design, got {checks.shown(found)}"
            )
        return found


MeasureLike = str | Measure | type[Measure]
"""A measure by its text, itself, or a class in place of its default measure."""


def measure_of(given: MeasureLike) -> Measure:
    """Return the measure."""
    if isinstance(given, type) and issubclass(given, Measure):
        return given()
    return given if isinstance(given, Measure) else Measure.parse(given)


def _positional(function: object) -> int:
    """Return the number of positional parameters without default."""
    parameters = inspect.signature(function).parameters.values() if callable(function) else ()
    kinds = (inspect.Parameter.POSITIONAL_ONLY, inspect.Parameter.POSITIONAL_OR_KEYWORD)
    return sum(p.kind in kinds and p.default is p.empty for p in parameters)
