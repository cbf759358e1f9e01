"""The ride problem: what of a vehicle's struts is judged, in which load cases, within which limits."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import KW_ONLY, dataclass, field
from functools import cached_property
from itertools import product
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .. import checks
from ..vehicles.vehicle import Settings, Vehicle
from .judges import Judge, Score
from .limits import limit
from .load_case import LoadCase, Road
from .measures import measure, name_of

_RESOLVED = 1e-6
"""Largest relative change of an objective that twice the nodes may make at a corner of the box."""

_NODES = (256, 384, 512, 768, 1024, 2048, 4096)
_CORNERS = 64
"""Corners of the box at which the nodes are judged; of a box with more, so many drawn at random."""


@dataclass(frozen=True)
class RideProblem:
    """Objectives of springs and dampers on a random road, equations (3) to (13) of Yuen and Ramli 2010.

    Parameters
    ----------
    vehicle : Vehicle, optional
        The vehicle.
    road : Road, optional
        The road, e.g. a `PowerLawRoad`.
    speed : float, optional
        Vehicle speed V [m/s].
    weighting : str or None
        ISO 2631 weighting of ``ACC``: a filter (``"Wk"``, ``"Wb"``, ...) or a table (``"Wk-table"``,
        ``"Wb-table"``); None for no weighting.
    band : (float, float)
        Frequencies over which the spectra are integrated [Hz].
    lower, upper : sequence of float
        Bounds of the struts' coefficients that have no default, in the vehicle's order: spring K_s [N/m] and
        damper C_s [N s/m] of a quarter car.
    bounds : mapping of str to (float, float)
        In their place: bounds by name of those coefficients that vary, ``{"front.spring": (1e4, 4e4), ...}``.
    struts : mapping of str to float
        With `bounds`: the coefficients that do not vary.
    measures : sequence of str
        The objectives, written as in `measures`.
    constraints : sequence of str
        Limits on measures: ``"SWS <= 0.0287"``, in the worst case of several.
    cases : sequence of LoadCase
        In place of vehicle, road and speed: several of these. An objective is the root mean square over them by
        their shares, of handling the mean.
    worst_case : bool
        Whether in place of that the worst case counts.
    nodes : int, optional
        Quadrature nodes over the band; as many as resolve every resonance if not given. With 256, what the paper's
        Table 1 takes, the objectives over its whole box are within 1e-9 of the integral (relative).

    Raises
    ------
    ValueError
        If a parameter is out of range, or if `nodes` does not resolve the resonances at a corner of the box.
    """

    vehicle: Vehicle | None = None
    road: Road | None = None
    _: KW_ONLY
    speed: float | None = None
    weighting: str | None = "Wk"
    band: tuple[float, float] = (0.0, 20.0)
    lower: Sequence[float] = ()
    upper: Sequence[float] = ()
    bounds: Mapping[str, tuple[float, float]] | None = None
    struts: Settings = field(default_factory=dict)
    measures: Sequence[str] = ("ACC", "SWS", "DTL")
    constraints: Sequence[str] = ()
    cases: Sequence[LoadCase] = ()
    worst_case: bool = False
    nodes: int | None = None

    def __post_init__(self) -> None:
        if isinstance(self.cases, LoadCase):
            raise ValueError("cases must be a list of load cases, got one by itself")
        if self.cases and (self.vehicle, self.road, self.speed) != (None, None, None):
            raise ValueError("cases must stand in place of vehicle, road and speed, got both")
        checks.interval("band", self.band, "Hz")
        self._check_bounds()
        if not (error := self._error(self._nodes)) < _RESOLVED:
            several = any(len(case.vehicle.contact_points) > 1 for case in self.load_cases)
            hint = (
                "; under several wheels a band may have to begin above 0 Hz"
                if several and not self.band[0]
                else ""
            )
            raise ValueError(
                f"nodes must resolve every resonance in the box to {_RESOLVED:g}, got {self._nodes}, "
                f"which is off by {error:.1g} at its corners{hint}"
            )

    @cached_property
    def load_cases(self) -> tuple[LoadCase, ...]:
        """The load cases: those given, or the one that vehicle, road and speed make."""
        if self.cases:
            return tuple(self.cases)
        if self.vehicle is None or self.road is None or self.speed is None:
            raise ValueError("vehicle, road and speed must be given, or cases in their place, got neither")
        return (LoadCase(vehicle=self.vehicle, road=self.road, speed=self.speed),)

    @cached_property
    def objectives(self) -> tuple[str, ...]:
        """Names of the objectives."""
        return tuple(name_of(text) for text in self.measures)

    @cached_property
    def variables(self) -> tuple[str, ...]:
        """Names of the variables."""
        if self.bounds is not None:
            return tuple(self.bounds)
        parameters = self.load_cases[0].vehicle.parameters
        return tuple(parameter.name for parameter in parameters if parameter.default is None)

    @cached_property
    def units(self) -> dict[str, str]:
        """Unit of each variable and each objective by name."""
        of_struts = {parameter.name: parameter.unit for parameter in self.load_cases[0].vehicle.parameters}
        judged = {score.measures[0].name: score.measures[0].unit for score in self._judge.scores}
        return {name: of_struts[name] for name in self.variables} | {
            name: judged[name] for name in self.objectives
        }

    def evaluate(self, designs: ArrayLike) -> NDArray[np.float64]:
        """Return the objectives of many designs.

        Parameters
        ----------
        designs : (n, d) array_like
            Variables of each design, within the bounds: spring K_s [N/m] and damper C_s [N s/m] of a quarter car.

        Returns
        -------
        (n, m) ndarray
            ACC [m/s^2], SWS [m] and DTL [N] of each design, or what `measures` says; after these a column for
            each constraint, how much the limit is exceeded as a share of it.

        Raises
        ------
        ValueError
            If `designs` does not have d columns, or a design is outside the bounds, where resonances may be
            too sharp for the nodes.
        """
        x = checks.designs(designs, len(self.variables))
        checks.rows_within("designs", x, self.lower, self.upper)
        return self._judge.evaluate(x, self._nodes)

    @cached_property
    def kernel(self) -> tuple[Callable[..., NDArray[np.float64]], tuple[Any, ...]] | None:
        """What `evaluate` gives for a single design (d,), as a compiled function and its further arguments.

        None with measures of handling, which are not compiled.
        """
        return self._judge.kernel(self._nodes)

    def _check_bounds(self) -> None:
        names = self.variables
        if self.bounds is not None:
            self._take_bounds(self.bounds)
        checks.ordered("lower", "upper", self.lower, self.upper)
        if len(self.lower) != len(names):
            raise ValueError(f"lower and upper must bound {', '.join(names)}, got {self.lower!r}")
        known = {parameter.name: parameter for parameter in self.load_cases[0].vehicle.parameters}
        for name, value in zip(names, self.lower, strict=True):
            checks.one_of("bounds", name, known)
            check = checks.not_negative if known[name].default == 0 else checks.positive
            check(f"lower bound of {name}", value, known[name].unit)

    def _take_bounds(self, bounds: Mapping[str, tuple[float, float]]) -> None:
        if not bounds:
            raise ValueError("bounds must hold one coefficient at least, got none")
        known = {parameter.name: parameter for parameter in self.load_cases[0].vehicle.parameters}
        for name, pair in bounds.items():
            checks.one_of("bounds", name, known)
            checks.interval(f"bounds of {name}", pair, known[name].unit)
        lower, upper = (tuple(float(pair[i]) for pair in bounds.values()) for i in (0, 1))
        for name, given, taken in (("lower", self.lower, lower), ("upper", self.upper, upper)):
            if len(given) and tuple(given) != taken:
                raise ValueError(f"{name} must not stand beside bounds that differ from it, got {given!r}")
            object.__setattr__(self, name, taken)
        if both := bounds.keys() & self.struts.keys():
            raise ValueError(f"struts must be those that do not vary, got {min(both)} with bounds")

    @cached_property
    def _nodes(self) -> int:
        if self.nodes is None:
            return next((nodes for nodes in _NODES if self._error(nodes) < _RESOLVED), _NODES[-1])
        checks.at_least("nodes", self.nodes, 2)
        return self.nodes

    @cached_property
    def _judge(self) -> Judge:
        def score(text: str) -> Score:
            found = tuple(measure(text, case.vehicle, self.weighting) for case in self.load_cases)
            return Score(found, self.worst_case, found[0].sign)

        def limited(text: str) -> Score:
            found = [limit(text, case.vehicle, self.weighting) for case in self.load_cases]
            return Score(tuple(one.measure for one in found), True, found[0].scale, found[0].offset)

        if isinstance(self.measures, str) or len(set(self.objectives)) < max(2, len(self.measures)):
            raise ValueError(f"measures must be 2 or more with different names, got {self.measures!r}")
        for names, what in ((self.objectives, "measures"), (self.constraints, "constraints")):
            if len(set(names) | set(self.variables)) < len(names) + len(self.variables):
                raise ValueError(f"{what} must have names of their own, got {list(names)}")
        middle = np.add(self.lower, self.upper) / 2
        scores = [*map(score, self.measures), *map(limited, self.constraints)]
        if not any(one.measures[0].terms for one in scores):
            raise ValueError(f"measures must hold one of the ride, got {self.measures!r}")
        variables = dict(zip(self.variables, middle.tolist(), strict=True))
        return Judge(self.load_cases, scores, variables, self.struts, self.band)

    def _error(self, nodes: int) -> float:
        """Return the largest relative change of a score by twice the nodes, at corners of the box.

        There resonances are sharpest.
        """
        corners = np.array(list(product(*zip(self.lower, self.upper, strict=True))), dtype=float)
        if len(corners) > _CORNERS:
            corners = np.random.default_rng(0).permutation(corners)[:_CORNERS]
        coarse, fine = (np.sqrt(self._judge.mean_squares(corners, count)) for count in (nodes, 2 * nodes))
        ratio = np.divide(coarse, fine, out=np.ones_like(fine), where=fine > 0)  # what never moves is resolved
        return float(np.abs(ratio - 1).max())
