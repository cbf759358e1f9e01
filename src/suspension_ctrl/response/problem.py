"""The ride problem: measures of a vehicle by coefficients of its struts, in load cases, within limits."""

from collections.abc import Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import product
from typing import Any

import control
import numpy as np
from numpy.typing import ArrayLike

from .. import checks
from ..quantities import FrozenMapping, Real, Record, wrapped
from ..tables.headers import shown_range, shown_unit
from ..vehicles.altered import plain_values
from ..vehicles.unit_slips import warn_of_slip
from ..vehicles.varied import Varied, ported, setting_of
from ..vehicles.vehicle import Struts, Vehicle, coefficients_by_name
from .bands import OwnBand, band_of
from .bounds import checked_bounds
from .gradients.robust_scores import over_scatter
from .gradients.scores import with_jacobian
from .load_case import LoadCase, Road, load_cases
from .measures.limits import Limit
from .measures.measure import Measure, MeasureLike, measure_of
from .measures.robust import Robust
from .measures.terms import CaseMeasure
from .robust_scores import RobustKernel, RobustScores, ScatteredScores, Statistics
from .scatter import Scatter, Tolerance, scatter_of
from .scattered import Scattered
from .scores import NODES, RESOLVED, Kernel, Score, Scores
from .weightings import Weighting, checked

_CORNERS = 64  # most corners of the box at which nodes are checked, drawn at random from more


class _Found(int):
    """Number of nodes that the problem found; a changed problem finds it anew."""


def _fixed(struts: Struts) -> dict[str, Any]:
    """Return coefficients that do not vary, pairs as tuples."""
    checks.mapped("struts", struts)
    return {name: tuple(v) if isinstance(v, list | np.ndarray) else v for name, v in struts.items()}


@dataclass(frozen=True, init=False, eq=False, repr=False)
class RideProblem(Record):
    """Objectives of springs and dampers on a random road, equations (3) to (13) of Yuen and Ramli 2010.

    Parameters
    ----------
    vehicle : Vehicle, optional
    road : Road, optional
        E.g. a `PowerLawRoad`; under one wheel any object with ``psd(f, speed)``.
    speed : float, optional
        Vehicle speed V [m/s].
    weighting : str, control.LTI or None
        Weighting of ``ACC``: a filter of ISO 2631 (``"Wk"``, ``"Wb"``), a table (``"Wk-table"``, ``"Wb-table"``)
        or a system of one input and one output; None for no weighting.
    band : (float, float), optional
        Frequencies over which the spectra are integrated [Hz]; by default 0 to 20 Hz, of measured roads as far as
        all are known.
    lower, upper : sequence of float, optional
        Bounds of the coefficients that have no default, in the vehicle's order: spring K_s [N/m] and damper C_s
        [N s/m] of a quarter car. Beside `bounds` they take the place of its lower or upper values.
    bounds : mapping of str to (float, float), optional
        Bounds by name of those coefficients that vary, ``{"front.spring": (1e4, 4e4), ...}``.
    kinds : mapping, optional
        By name as in `Problem`: ``{"spring": (18e3, 20e3, 22e3), "damper": "log"}`` takes springs from a catalogue
        and searches the damper by its logarithm.
    struts : mapping of str to float, optional
        Coefficients that do not vary.
    measures : sequence of Measure or str
        The objectives; also by texts, ``"ACC driver"``, and classes, `DTL` for ``DTL()``.
    constraints : sequence of Limit or str
        Limits on measures; also by texts, ``"SWS <= 0.0287"``, on a measure with a name of its own by that.
    cases : sequence of LoadCase, optional
        Several load cases; a vehicle, road or speed replaces theirs. An objective is the root mean square over
        them by their shares, of handling and a `Measure` the mean, or if `worst_case` the worst of them.
    worst_case : bool
    scatter : Scatter or mapping, optional
        Deviations of coefficients and parameters by name, for robust measures and limits: a `Mean`, a `Quantile`
        or a `CVaR` of another measure, in texts ``"mean ACC"``, ``"q95 SWS <= 30mm"``, ``"CVaR90 DTL front"``.
        All other measures are those of the nominal vehicle.
    events : mapping of str to Event or (Event, float), optional
        Events by name for `Peak` in every load case, see `LoadCase`.
    nodes : int, optional
        Quadrature nodes over the band, enough to resolve every resonance at the corners of the box; by default
        they are found. The paper's Table 1 takes 256, with which the objectives over its whole box are within 1e-9
        of the integral (relative).

    Examples
    --------
    The reference car of Yuen and Ramli and their optimum: the softer spring improves comfort and grip at the
    same travel.

    >>> import suspension_ctrl as sc
    >>> car = sc.QuarterCar(body_mass=317.5, wheel_mass=45.4, tyre_stiffness=192e3)
    >>> road = sc.PowerLawRoad(roughness=5e-6, exponent=2.5)
    >>> bounds = {"spring": (1e3, 30e3), "damper": (1e3, 5e3)}
    >>> problem = sc.RideProblem(car, road, speed=20.0, bounds=bounds)
    >>> for acc, sws, dtl in problem.evaluate([[22e3, 1500.0], [12.389e3, 1616.3]]):
    ...     print(f"ACC {acc:.3f} m/s^2, SWS {1e3 * sws:.1f} mm, DTL {dtl:.0f} N")
    ACC 2.260 m/s^2, SWS 28.7 mm, DTL 1365 N
    ACC 2.158 m/s^2, SWS 28.7 mm, DTL 1305 N

    A limit on the travel is a further column, the violation as a share of the limit, met up to 0:

    >>> limited = problem.replace(constraints=["SWS <= 0.02"])
    >>> limited.evaluate([[22e3, 1500.0], [12.389e3, 4000.0]])[:, 3].round(2).tolist()
    [0.43, -0.13]
    """

    cases: tuple[LoadCase, ...]
    bounds: Mapping[str, tuple[float, float]]
    kinds: Mapping[str, str | Sequence[float]]
    struts: Struts
    weighting: Weighting | None
    band: tuple[float, float]
    measures: tuple[Measure, ...]
    constraints: tuple[Limit, ...]
    worst_case: bool
    scatter: Scatter | None
    nodes: int

    def __init__(
        self,
        vehicle: Vehicle | None = None,
        road: Road | None = None,
        *,
        speed: float | None = None,
        weighting: Weighting | control.LTI | None = "Wk",
        band: tuple[float, float] | None = None,
        lower: Sequence[float] = (),
        upper: Sequence[float] = (),
        bounds: Mapping[str, tuple[float, float]] | None = None,
        kinds: Mapping[str, str | Sequence[float]] | None = None,
        struts: Struts | None = None,
        measures: Sequence[MeasureLike] = ("ACC", "SWS", "DTL"),
        constraints: Sequence[Limit | str] = (),
        cases: Sequence[LoadCase] = (),
        worst_case: bool = False,
        scatter: Scatter | Mapping[str, Tolerance] | None = None,
        events: Mapping[str, Any] | None = None,
        nodes: int | None = None,
    ) -> None:
        checks.listed("measures", measures)
        checks.listed("constraints", constraints)
        fixed = _fixed(struts or {})
        every = load_cases(cases, events, vehicle=vehicle, road=road, speed=speed)
        self._keep(
            cases=every,
            bounds=checked_bounds(every[0].vehicle, bounds, lower, upper, fixed),
            struts=FrozenMapping(fixed),
            weighting=checked(weighting),
            band=band_of(None if isinstance(band, OwnBand) else band, ((one.road, one.speed) for one in every)),
            measures=tuple(map(measure_of, measures)),
            worst_case=bool(worst_case),
            scatter=scatter_of(scatter),
        )
        limits = (one if isinstance(one, Limit) else Limit.parse(one, self.measures) for one in constraints)
        self._keep(constraints=tuple(limits))
        self._keep(kinds=FrozenMapping(checks.kinds(kinds or {}, self.variables, self.lower, self.upper)))
        self._warn_of_slips()
        self._keep(nodes=self._resolving(None if isinstance(nodes, _Found) else nodes))

    def replace(self, **changes: Any) -> "RideProblem":
        """Return the problem with other parameters, as `dataclasses.replace`; nodes not given are found anew."""
        return replace(self, **changes)

    @property
    def nominal(self) -> "RideProblem":
        """The problem of the nominal vehicle: robust measures are replaced by those of one vehicle."""
        measures = list(dict.fromkeys(one.nominal for one in self.measures))
        constraints = list(dict.fromkeys(one.nominal for one in self.constraints))
        return self.replace(measures=measures, constraints=constraints, scatter=None) if self.scatter else self

    @property
    def vehicle(self) -> Vehicle:
        """The vehicle of every load case."""
        return self._common("vehicle")

    @property
    def road(self) -> Road:
        """The road of every load case."""
        return self._common("road")

    @property
    def speed(self) -> float:
        """Speed in every load case [m/s]."""
        return self._common("speed")

    @property
    def events(self) -> Mapping[str, Any]:
        """Events of every load case, with their speeds [m/s], None for that of the case."""
        events: Mapping[str, Any] = self._common("events")
        return events

    @cached_property
    def lower(self) -> tuple[float, ...]:
        """Lower bounds of the variables."""
        return tuple(low for low, _ in self.bounds.values())

    @cached_property
    def upper(self) -> tuple[float, ...]:
        """Upper bounds of the variables."""
        return tuple(high for _, high in self.bounds.values())

    @property
    def variables(self) -> tuple[str, ...]:
        """Names of the variables."""
        return tuple(self.bounds)

    @cached_property
    def objectives(self) -> tuple[str, ...]:
        """Names of the objectives."""
        return tuple(measure.label for measure in self.measures)

    @cached_property
    def units(self) -> Mapping[str, str]:
        """Unit of each variable and each objective by name."""
        units = {name: one.unit for name, one in self.cases[0].vehicle.variables.items() if name in self.bounds}
        return FrozenMapping(units | {measure.label: measure.unit for measure in self.measures})

    @cached_property
    def weighted(self) -> bool:
        """Whether a measure depends on the weighting of the problem."""
        case, weightings = self.cases[0], (None, self.weighting)
        plain, weighted = ([one.nominal.in_case(case, w).terms for one in self.measures] for w in weightings)
        return plain != weighted

    def evaluate(self, designs: ArrayLike) -> Real:
        """Return the objectives and constraints of many designs.

        Parameters
        ----------
        designs : (n, d) array_like
            Variables of each design, within the bounds: spring K_s [N/m] and damper C_s [N s/m] of a quarter car.
            Outside, where resonances may be too sharp for the nodes, a ValueError is raised.

        Returns
        -------
        (n, m + c) ndarray
            Objectives, ACC [m/s^2], SWS [m] and DTL [N] unless `measures` says otherwise; then for each constraint
            the violation as a share of the limit.
        """
        x = self._inside(designs)
        values = self._scores.evaluate(x, self.nodes)
        return self._robust.put(values, x, self.nodes) if self._robust else values

    def jacobian(self, designs: ArrayLike) -> Real:
        """Return the derivatives of the objectives and constraints by the variables.

        They are exact to rounding at the nodes of `evaluate`: of the largest of several wheels, and of the worst
        load case, those of the largest, of a root mean square of 0 they are 0. Force laws have their slopes at the
        working point of each design, which is differentiated as an implicit function. Measures of handling, modes,
        doses and events, those of your own and all others by a function of designs are differentiated by
        differences of fourth order, of 0.2 % of a variable within its bounds; their mean squares have exact
        derivatives. Over a scatter samples keep their ranks.

        Parameters
        ----------
        designs : (n, d) array_like
            Variables of each design, as of `evaluate`.

        Returns
        -------
        (n, m + c, d) ndarray
            Derivatives of the columns of `evaluate` by each variable [unit of the column by unit of the variable].

        Raises
        ------
        ValueError
            As of `evaluate`.

        Examples
        --------
        A stiffer spring costs comfort and leaves the travel as it is; a harder damper costs comfort too, and saves
        travel:

        >>> import suspension_ctrl as sc
        >>> car = sc.QuarterCar(body_mass=317.5, wheel_mass=45.4, tyre_stiffness=192e3)
        >>> bounds = {"spring": (1e3, 30e3), "damper": (1e3, 5e3)}
        >>> problem = sc.RideProblem(car, sc.Iso8608Road("C"), speed=20.0, bounds=bounds)
        >>> design = [22e3, 1500.0]
        >>> change = problem.jacobian([design])[0] * design / problem.evaluate([design])[0][:, None]
        >>> for name, (spring, damper) in zip(problem.objectives, change, strict=True):
        ...     print(f"{name}: {spring:+.2f} % by 1 % of the spring, {damper:+.2f} % by 1 % of the damper")
        ACC: +0.13 % by 1 % of the spring, +0.35 % by 1 % of the damper
        SWS: -0.00 % by 1 % of the spring, -0.50 % by 1 % of the damper
        DTL: +0.01 % by 1 % of the spring, -0.26 % by 1 % of the damper
        """
        return self.with_jacobian(designs)[1]

    def with_jacobian(self, designs: ArrayLike) -> tuple[Real, Real]:
        """Return the values (n, m + c) of `evaluate` and the `jacobian` (n, m + c, d) in one pass.

        The values are those of `evaluate` but for rounding.
        """
        x = self._inside(designs)
        found = with_jacobian(self._scores, x, self.nodes, (np.array(self.lower), np.array(self.upper)))
        return over_scatter(self._robust, *found, x, self.nodes) if self._robust else found

    @cached_property
    def kernel(self) -> Kernel | RobustKernel | None:
        """The compiled evaluation of one design; None with measures of handling or of a user's own."""
        if not self._scores.compiled:
            return None
        nominal = self._scores.kernel(self.nodes)
        return self._robust.kernel(nominal, self.nodes) if self._robust else nominal

    @property
    def scores(self) -> Scores:
        """The scores of designs at any number of nodes: of each measure, then of each limit."""
        return self._scores

    def describe(self) -> list[str]:
        """Return variables, limits and load cases in sentences, a line each."""
        lines = [f"Varied: {'; '.join(self._varied())}."]
        lines += [f"Limits: {', '.join(one.describe() for one in self.constraints)}."] if self.constraints else []
        if len(self.cases) > 1:
            how = "their worst" if self.worst_case else "their mean square by shares"
            lines.append(f"Objectives are over {len(self.cases)} load cases, {how}; limits hold in each.")
        lines += [f"Scatter: {self.scatter.describe()}."] if self.scatter else []
        return lines + self.describe_cases()

    def describe_cases(self) -> list[str]:
        """Return the road and the speed of each load case, a line each; a road in common once."""
        first, *others = self.cases
        if not others:
            return [f"Road: {first.describe()}."]
        common = all(case.road == first.road for case in others)
        told = (f"{case.speed:.4g} m/s" if common else case.describe() for case in self.cases)
        lines = [
            f"Case {n}, share {case.share:g}: {text}."
            for n, (case, text) in enumerate(zip(self.cases, told, strict=True), start=1)
        ]
        return [f"Road of all cases: {first.describe_road()}.", *lines] if common else lines

    def __repr__(self) -> str:
        parts = [
            ", ".join(f"{name} [{self.units[name]}]" for name in self.objectives),
            *map(str, self.constraints),
            *self._variables(),
            *([f"scatter {self.scatter.describe()}"] if self.scatter else []),
            *(f"{type(case.vehicle).__name__} at {case.speed:g} m/s" for case in self.cases),
            f"{self.band[0]:g} to {self.band[1]:g} Hz, weighting {self.weighting}, {self.nodes} nodes",
        ]
        return wrapped(f"RideProblem({'; '.join(parts)})")

    def _varied(self) -> Iterator[str]:
        """Yield the text of each variable in units to read: bounds and kind, or the values of a catalogue."""
        for name, (low, high) in self.bounds.items():
            kind, unit = self.kinds.get(name, ""), self.units[name]
            if isinstance(kind, str):
                yield f"{name} {shown_range(low, high, unit)}" + (kind and f", {kind}")
            else:
                shown, factor = shown_unit(unit)
                yield f"{name} of {', '.join(f'{factor * value:.4g}' for value in kind)} {shown}".rstrip()

    def _variables(self) -> Iterator[str]:
        """Yield the text of each variable: bounds and kind, or catalogue."""
        for name, (low, high) in self.bounds.items():
            unit, kind = self.units[name], self.kinds.get(name, "")
            if isinstance(kind, str):
                yield f"{name} {low:g} to {high:g} {unit}".rstrip() + (kind and f", {kind}")
            else:
                yield f"{name} {', '.join(f'{value:g}' for value in kind)} {unit}"

    def _common(self, name: str) -> Any:
        first, *others = (getattr(case, name) for case in self.cases)
        if any(other != first for other in others):
            raise AttributeError(f"{name} differs between load cases, see cases")
        return first

    def _resolving(self, nodes: int | None) -> int:
        """Return the nodes, found if not given; ValueError where they do not resolve every resonance."""
        if nodes is not None:
            nodes = checks.at_least("nodes", nodes, 2)
        taken = nodes or next((n for n in NODES if self._error(n) < RESOLVED), NODES[-1])
        if (error := self._error(taken)) < RESOLVED:
            return taken if nodes else _Found(taken)
        several = any(case.wheels > 1 for case in self.cases) and not self.band[0]
        hint = "; under several wheels a band may have to begin above 0 Hz" if several else ""
        got = f"{taken}, which is off by {error:.1g} at its corners{hint}"
        raise ValueError(f"nodes must resolve every resonance in the box to {RESOLVED:g}, got {got}")

    @cached_property
    def _scores(self) -> Scores:
        texts = list(map(str, self.constraints))
        if len(set(self.objectives)) < max(2, len(self.measures)):
            got = checks.shown(tuple(map(str, self.measures)))
            raise ValueError(f"measures must be 2 or more with different names, got {got}")
        for names, what in ((list(self.objectives), "measures"), (texts, "constraints")):
            if len({*names, *self.bounds}) < len(names) + len(self.bounds):
                raise ValueError(f"{what} must have names of their own, got {checks.shown(names)}")
        if not any(
            one.nominal.of_ride for one in (*self.measures, *(limit.measure for limit in self.constraints))
        ):
            raise ValueError(f"measures must hold one of the ride, got {checks.shown(list(self.objectives))}")
        return self.scores_of([self._score(one, self._ported) for one in self._judged])

    @cached_property
    def _robust(self) -> RobustScores | None:
        """Scores over the scatter; None without robust measures."""
        limited = [one if isinstance(one, Measure) else one.measure for one in self._judged]
        robust = {column: one for column, one in enumerate(limited) if isinstance(one, Robust)}
        if not robust:
            if self.scatter:
                self.scattered([], self.scatter)  # which raises ValueError about its names
            return None
        if self.scatter is None:
            raise ValueError(f"scatter must be given for {next(iter(robust.values())).label}, got none")
        scattered = self.scattered([self._judged[column] for column in robust], self.scatter)
        scores = [self._scores.scores[column] for column in robust]
        samples, signs = self.scatter.samples, scattered.signs
        weight = [one.weights(samples, sign) for one, sign in zip(robust.values(), signs, strict=True)]
        scale, offset = (np.array([getattr(one, name) for one in scores]) for name in ("scale", "offset"))
        return RobustScores(scattered, Statistics(np.array([*robust]), np.array(weight), signs, scale, offset))

    def scattered(self, judged: Sequence[Measure | Limit], scatter: Scatter) -> ScatteredScores:
        """Return measures and limits of the samples of designs, as of the nominal vehicle of each."""
        fixed = coefficients_by_name(self.struts, {})
        scattered = Scattered.of(scatter, self.cases, self.variables, fixed)
        scores = [self._score(one, scattered.cases) for one in judged]
        return ScatteredScores(scattered, scores, np.array(self._middle), self.band)

    @property
    def _middle(self) -> list[float]:
        """The middle (d,) of the box."""
        return [(low + high) / 2 for low, high in self.bounds.values()]

    @property
    def _judged(self) -> tuple[Measure | Limit, ...]:
        """Objectives, then limits."""
        return (*self.measures, *self.constraints)

    def _score(self, one: Measure | Limit, cases: Sequence[LoadCase]) -> Score:
        """Return the score of a measure or a limit in load cases."""
        found = tuple(one.nominal.in_case(case, self.weighting) for case in cases)
        if isinstance(one, Limit):
            return Score(found, True, one.scale, one.offset)
        return Score(found, self.worst_case, one.sign)

    def scores_of(self, scores: Sequence[Score]) -> Scores:
        """Return scores of designs in the load cases."""
        middle = dict(zip(self.variables, self._middle, strict=True))
        settings = [setting_of(case.vehicle, middle, self.struts) for case in self._ported]
        return Scores(self._ported, scores, settings, self.variables, self.band)

    def _inside(self, designs: ArrayLike) -> Real:
        """Return designs (n, d) as an array; ValueError for others, and outside the bounds."""
        x = checks.designs(designs, len(self.variables))
        checks.rows_within("designs", x, self.lower, self.upper)
        return x

    def _warn_of_slips(self) -> None:
        """Warn the caller of a likely slip of units in the vehicles, in the middle of the bounds."""
        middle = dict(zip(self.variables, self._middle, strict=True))
        for case in self.cases:
            with suppress(ValueError):  # of values that do not fit, which are told later
                warn_of_slip(*case.vehicle.at({**coefficients_by_name(self.struts, {}), **middle}), caller=4)

    def in_cases(self, judged: Measure | Limit) -> tuple[CaseMeasure, ...]:
        """Return a measure or a limit in each load case."""
        return tuple(judged.nominal.in_case(case, self.weighting) for case in self._ported)

    def without_parameters(self, design: Real) -> "tuple[RideProblem, Real]":
        """Return the problem of coefficients alone at the parameters of a design (d,), and its coefficients there.

        Bounds are as close as numbers are; without parameters it is the problem as it is.
        """
        if all(one is given for one, given in zip(self._ported, self.cases, strict=True)):
            return self, design
        given = {
            **coefficients_by_name(self.struts, {}),
            **dict(zip(self.variables, design.tolist(), strict=True)),
        }
        values = plain_values(self.cases[0].vehicle, given)
        every = [case.vehicle.at(values) for case in self.cases]
        cases = [replace(case, vehicle=one) for case, (one, _) in zip(self.cases, every, strict=True)]
        own = {name: float(values[name]) for name in every[0][1] if name in values}
        bounds = {name: (value, float(np.nextafter(value, np.inf))) for name, value in own.items()}
        nodes = int(self.nodes)
        plain = self.replace(cases=cases, bounds=bounds, struts={}, kinds={}, nodes=nodes)
        return plain, np.array(list(own.values()))

    @cached_property
    def _ported(self) -> tuple[LoadCase, ...]:
        """Load cases with ports on their vehicles for parameters that vary."""
        fixed = coefficients_by_name(self.struts, {})
        first = self.cases[0].vehicle
        vehicles = [ported(case.vehicle, self.variables, fixed, first) for case in self.cases]
        if isinstance(vehicles[0], Varied) and vehicles[0].has_frequencies:
            for corner in self._corners:
                vehicles[0].with_design(corner)  # which raises ValueError where a frequency is out of reach
        return tuple(replace(case, vehicle=one) for case, one in zip(self.cases, vehicles, strict=True))

    @cached_property
    def _corners(self) -> Real:
        """Corners (k, d) of the box, some of many."""
        return np.random.default_rng(0).permutation(list(product(*self.bounds.values())))[:_CORNERS]

    def _error(self, nodes: int) -> float:
        """Return the largest error of a term at corners of the box: there resonances are sharpest."""
        errors = self._scores.errors(self._corners, nodes)
        if self._robust:
            lower, upper = np.array(self.lower), np.array(self.upper)
            errors = [*errors, *self._robust.scattered.errors(self._corners, lower, upper, nodes)]
        return max(float(one.max(initial=0.0)) for one in errors)
