"""The ride problem: discomfort (ACC), suspension working space (SWS) and dynamic tyre load (DTL) of a strut."""

from collections.abc import Callable, Sequence
from dataclasses import KW_ONLY, dataclass
from functools import cached_property
from itertools import product
from typing import ClassVar

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import checks, weightings
from .quadrature import frequency_nodes
from .responses import Road, StrutLoop, root_mean_squares, root_mean_squares_of_all
from .vehicles import QuarterCar

_RESOLVED = 1e-6
"""Largest relative change of an objective that twice the nodes may make at a corner of the box."""


@dataclass(frozen=True)
class RideProblem:
    """Objectives of a strut's spring and damper on a random road, equations (3) to (13) of Yuen and Ramli 2010.

    Parameters
    ----------
    vehicle : QuarterCar
        The vehicle.
    road : Road
        The road, e.g. a `PowerLawRoad`.
    speed : float
        Vehicle speed V [m/s].
    weighting : str or None
        ISO 2631 weighting of the body acceleration: a filter (``"Wk"``, ``"Wb"``, ...) or a table
        (``"Wk-table"``, ``"Wb-table"``); None for no weighting.
    band : (float, float)
        Frequencies over which the spectra are integrated [Hz].
    lower, upper : (2,) sequence of float
        Bounds of spring K_s [N/m] and damper C_s [N s/m].
    nodes : int
        Quadrature nodes over the band. With 256 the objectives over the whole box of the paper's Table 1 are
        within 1e-9 of the integral (relative), with 200 within 1e-7.

    Raises
    ------
    ValueError
        If a parameter is out of range, or if `nodes` does not resolve the resonances at a corner of the box.
    """

    vehicle: QuarterCar
    road: Road
    _: KW_ONLY
    speed: float
    weighting: str | None = "Wk"
    band: tuple[float, float] = (0.0, 20.0)
    lower: Sequence[float]
    upper: Sequence[float]
    nodes: int = 256

    objectives: ClassVar[tuple[str, ...]] = ("ACC", "SWS", "DTL")
    constraints: ClassVar[tuple[str, ...]] = ()
    variables: ClassVar[tuple[str, ...]] = ("spring", "damper")
    units: ClassVar[dict[str, str]] = {
        "spring": "N/m", "damper": "N s/m", "ACC": "m/s^2", "SWS": "m", "DTL": "N",
    }  # fmt: skip

    def __post_init__(self) -> None:
        checks.positive("speed", self.speed, "m/s")
        checks.ordered("lower", "upper", self.lower, self.upper)
        if len(self.lower) != len(self.variables):
            raise ValueError(f"lower and upper must bound {', '.join(self.variables)}, got {self.lower!r}")
        for name, value in zip(self.variables, self.lower, strict=True):
            checks.positive(f"lower bound of {name}", value, self.units[name])
        self._check_resolution()

    def evaluate(self, designs: ArrayLike) -> NDArray[np.float64]:
        """Return the objectives of many designs.

        Parameters
        ----------
        designs : (n, 2) array_like
            Spring K_s [N/m] and damper C_s [N s/m] of each design, within the bounds.

        Returns
        -------
        (n, 3) ndarray
            ACC [m/s^2], SWS [m] and DTL [N] of each design.

        Raises
        ------
        ValueError
            If `designs` does not have two columns, or a design is outside the bounds, where resonances may be
            too sharp for the nodes.
        """
        x = checks.designs(designs, len(self.variables))
        checks.rows_within("designs", x, self.lower, self.upper)
        return root_mean_squares_of_all(x, self._loop)

    @property
    def kernel(self) -> tuple[Callable[..., NDArray[np.float64]], tuple[StrutLoop]]:
        """The objectives (3,) of a single design (2,) as a compiled function and its further arguments."""
        return root_mean_squares, (self._loop,)

    @cached_property
    def _loop(self) -> StrutLoop:
        return self._loop_at(self.nodes)

    def _loop_at(self, nodes: int) -> StrutLoop:
        weighting = None if self.weighting is None else weightings.by_name(self.weighting)
        f, w = frequency_nodes(self.band, nodes, weighting.breakpoints if weighting else ())
        density = w * self.road.psd(f, self.speed)
        factor = weighting.factor(f) if weighting else 1.0
        densities = dict.fromkeys(self.vehicle.responses, density) | {"body_acceleration": density * factor**2}
        return StrutLoop.around(self.vehicle.plant(), f, densities)

    def _check_resolution(self) -> None:
        """Hold the corners of the box, where resonances are sharpest, against twice the nodes."""
        corners = np.array(list(product(*zip(self.lower, self.upper, strict=True))), dtype=float)
        fine = root_mean_squares_of_all(corners, self._loop_at(2 * self.nodes))
        change = np.abs(root_mean_squares_of_all(corners, self._loop) / fine - 1).max()
        if not change < _RESOLVED:
            raise ValueError(
                f"nodes must resolve every resonance in the box to {_RESOLVED:g}, got {self.nodes}, "
                f"which is off by {change:.1g} at its corners"
            )
