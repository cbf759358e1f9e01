"""The ride problem: measures of a vehicle by coefficients of its struts, in load cases, within limits."""

from collections.abc import Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, fields, replace
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike

from .. import checks
from ..quantities import FrozenMapping, Real, Record
from ..threads import number
from ..vehicles.unit_slips import warn_of_slip
from ..vehicles.vehicle import Struts, Vehicle
from .bands import OwnBand, band_of
from .bounds import checked_bounds
from .kernel import Kernel
from .load_case import LoadCase, Road, load_cases
from .mean_squares import Nodes
from .measures.limits import Limit
from .measures.measure import Measure, MeasureLike
from .placed_nodes import checked_accuracy
from .problem_texts import representation, sentences, sentences_of_cases
from .robust_scores import RobustKernel
from .scatter import Scatter, Tolerance, scatter_of
from .scores import Scores
from .scoring import Scoring, judged_by
from .weightings import Weighting, checked

if TYPE_CHECKING:
    import control


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
    accuracy : float, optional
        Largest relative error of a root mean square, from 1e-9 to 1e-6, by nodes that are placed for the box: a
        third of those, say. They are found in a tenth of a second for one strut, in seconds for many load cases.
        Vehicles with networks and force laws, and samples of a scatter, keep the others.

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
    accuracy: float | None

    def __init__(
        self,
        vehicle: Vehicle | None = None,
        road: Road | None = None,
        *,
        speed: float | None = None,
        weighting: "Weighting | control.LTI | None" = "Wk",
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
        accuracy: float | None = None,
    ) -> None:
        fixed = _fixed(struts or {})
        every = load_cases(cases, events, vehicle=vehicle, road=road, speed=speed)
        objectives, limits = judged_by(measures, constraints)
        self._keep(
            cases=every,
            bounds=checked_bounds(every[0].vehicle, bounds, lower, upper, fixed),
            struts=FrozenMapping(fixed),
            weighting=checked(weighting),
            band=band_of(None if isinstance(band, OwnBand) else band, ((one.road, one.speed) for one in every)),
            measures=objectives,
            constraints=limits,
            worst_case=bool(worst_case),
            scatter=scatter_of(scatter),
            accuracy=checked_accuracy(accuracy),
        )
        self._keep(kinds=FrozenMapping(checks.kinds(kinds or {}, self.variables, self.lower, self.upper)))
        self._warn_of_slips()
        self._keep(nodes=self._resolving(nodes))

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

    def evaluate(self, designs: ArrayLike, *, threads: int | None = None) -> Real:
        """Return the objectives and constraints of many designs.

        Parameters
        ----------
        designs : (n, d) array_like
            Variables of each design, within the bounds: spring K_s [N/m] and damper C_s [N s/m] of a quarter car.
            Outside, where resonances may be too sharp for the nodes, a ValueError is raised.
        threads : int, optional
            Most threads, by default one per processor, and one in timed runs and on workers of a study. Few
            designs take one. The values are the same bit by bit.

        Returns
        -------
        (n, m + c) ndarray
            Objectives, ACC [m/s^2], SWS [m] and DTL [N] unless `measures` says otherwise; then for each constraint
            the violation as a share of the limit.
        """
        x, threads = self._inside(designs), number(threads)
        values = self.scores.evaluate(x, self._rules, threads)
        return self.scoring.robust.put(values, x, self.nodes, threads) if self.scoring.robust else values

    def jacobian(self, designs: ArrayLike, *, threads: int | None = None) -> Real:
        """Return the derivatives of the objectives and constraints by the variables.

        They are exact to rounding at the nodes of `evaluate`: of the largest of several wheels, and of the worst
        load case, those of the largest, of equal ones of the first; of a root mean square of 0 they are 0. Force
        laws have their slopes at the working point of each design, which is differentiated as an implicit
        function. Roll gradient and load transfer are differentiated exactly where coefficients alone vary. Roll
        damping, modes, doses, events and measures of your own are differentiated by differences of fourth order,
        of 0.2 % of a variable within its bounds; their mean squares have exact derivatives. Over a scatter samples
        keep their ranks.

        Parameters
        ----------
        designs : (n, d) array_like
            Variables of each design, as of `evaluate`.
        threads : int, optional
            Most threads, as of `evaluate`.

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
        return self.with_jacobian(designs, threads=threads)[1]

    def with_jacobian(self, designs: ArrayLike, *, threads: int | None = None) -> tuple[Real, Real]:
        """Return the values (n, m + c) of `evaluate` and the `jacobian` (n, m + c, d) in one pass.

        The values are those of `evaluate` but for rounding.
        """
        from .gradients.on_threads import differentiated  # a fifth of the time to import this package

        x, bounds = self._inside(designs), (np.array(self.lower), np.array(self.upper))
        return differentiated(self.scoring, x, self._rules, self.nodes, bounds, number(threads))

    @cached_property
    def _rules(self) -> Nodes:
        """The nodes of values and derivatives."""
        return self.nodes if self.accuracy is None else self.scoring.placed(self.nodes, self.accuracy)

    @cached_property
    def kernel(self) -> Kernel | RobustKernel | None:
        """The compiled evaluation of one design; None with measures of handling or of a user's own."""
        if not self.scores.compiled:
            return None
        nominal = self.scores.kernel(self._rules).one_by_one()
        return self.scoring.robust.kernel(nominal, self.nodes) if self.scoring.robust else nominal

    @property
    def scores(self) -> Scores:
        """The scores of designs at any number of nodes: of each measure, then of each limit."""
        return self.scoring.scores

    @cached_property
    def scoring(self) -> Scoring:
        """What designs are judged by."""
        return Scoring(**{one.name: getattr(self, one.name) for one in fields(Scoring)})

    def describe(self) -> list[str]:
        """Return variables, limits and load cases in sentences, a line each."""
        return sentences(self)

    def describe_cases(self) -> list[str]:
        """Return the road and the speed of each load case, a line each; a road in common once."""
        return sentences_of_cases(self)

    def __repr__(self) -> str:
        return representation(self)

    def _inside(self, designs: ArrayLike) -> Real:
        """Return designs (n, d) as an array; ValueError for others, and outside the bounds."""
        x = checks.designs(designs, len(self.variables))
        checks.rows_within("designs", x, self.lower, self.upper)
        return x

    def _common(self, name: str) -> Any:
        first, *others = (getattr(case, name) for case in self.cases)
        if any(other != first for other in others):
            raise AttributeError(f"{name} differs between load cases, see cases")
        return first

    def _resolving(self, nodes: int | None) -> int:
        """Return the nodes that are given or found; ValueError where they do not resolve every resonance."""
        found = nodes is None or isinstance(nodes, _Found)
        taken = self.scoring.resolving(None if found else nodes)
        return _Found(taken) if found else taken

    def _warn_of_slips(self) -> None:
        """Warn the caller of a likely slip of units in the vehicles, in the middle of the bounds."""
        for case in self.cases:
            with suppress(ValueError):  # of values that do not fit, which are told later
                warn_of_slip(*case.vehicle.at({**self.scoring.fixed, **self.scoring.middle}), caller=4)
