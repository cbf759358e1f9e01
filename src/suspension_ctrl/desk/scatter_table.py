"""Measures and limits of a design over a scatter, as a table."""

from collections.abc import Mapping, Sequence
from dataclasses import replace
from math import nan
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from .. import checks
from ..quantities import Real
from ..response.measures.limits import Limit
from ..response.measures.measure import Measure
from ..response.measures.robust import of_quantile, of_tail
from ..response.problem import RideProblem
from ..response.robust_scores import ScatteredScores
from ..response.scatter import Scatter, Tolerance, scatter_of
from ..response.scores import NODES, RESOLVED
from .candidate_table import Present, design_of

if TYPE_CHECKING:
    import pandas as pd

_SAMPLES, _SEED = 1000, 1
_QUANTILES = (5.0, 50.0, 95.0)
_TAIL = 95.0
BEYOND = "beyond limit [%]"


class Sampled(NamedTuple):
    """Measures, then limits, of designs: of nominal vehicles (n, k) and of the samples of a scatter (n, k, s)."""

    judged: Sequence[Measure | Limit]
    nominal: Real
    samples: Real
    scatter: Scatter

    @property
    def labels(self) -> list[str]:
        """Names of the measures and limits."""
        return [str(one) if isinstance(one, Limit) else one.label for one in self.judged]

    def measure(self, k: int) -> Measure:
        """Return a measure, or that of a limit."""
        one = self.judged[k]
        return one.measure.nominal if isinstance(one, Limit) else one

    def beyond(self, k: int, design: int = 0) -> float:
        """Return the share of the samples of a design beyond a limit [%], NaN of a measure."""
        one = self.judged[k]
        if not isinstance(one, Limit):
            return nan
        return 100 * float((one.scale * self.samples[design, k] + one.offset > 0).mean())


def robustness(
    problem: RideProblem,
    design: Present,
    scatter: Scatter | Mapping[str, Tolerance] | None = None,
    samples: int | None = None,
    seed: int | None = None,
) -> "pd.DataFrame":
    """Return the measures and limits of a design over the scatter of production, load and age.

    Parameters
    ----------
    problem : RideProblem
    design : (d,) array_like, or mapping of str to float
        Variables of the design, also outside the bounds.
    scatter : Scatter or mapping, optional
        Deviations by name as of `Scatter`, ``{"spring": 0.05, "damper": (-0.25, 0.0)}``; by default those of the
        problem.
    samples, seed : int, optional
        Number of vehicles and seed of their deviations; those of a `Scatter`, else 1000 and 1. The same seed gives
        the same deviations for every design.

    Returns
    -------
    DataFrame
        A row by name of each measure, then of each limit, in the worst load case: ``unit``; the value of the
        ``nominal`` vehicle; over the samples ``mean``, ``standard deviation``, the quantiles ``q5``, ``q50`` and
        ``q95``, and ``CVaR95``, the mean of the worst 5 %, see `CVaR`; the ``limit`` and the share of the samples
        ``beyond limit [%]``. A robust measure of the problem stands for that of one vehicle. Samples and seed are
        in ``attrs`` and in the name of the columns.

    Raises
    ------
    ValueError
        If the problem has no scatter and none is given, or about a name or a deviation.

    Examples
    --------
    >>> import suspension_ctrl as sc
    >>> file = sc.load_vehicle("yuen_ramli_2010")
    >>> road, limits = sc.Iso8608Road("C"), ["SWS <= 12mm"]
    >>> problem = sc.RideProblem(file.vehicle, road, speed=20.0, bounds=file.bounds, constraints=limits)
    >>> aged = {"spring": 0.05, "damper": (-0.25, 0.0), "tyre_stiffness": "10 %"}
    >>> table = sc.robustness(problem, file.setting, aged)
    >>> print(table[["nominal", "q95", "beyond limit [%]"]].round(4))
    1000 samples, seed 1   nominal       q95  beyond limit [%]
    name
    ACC                     1.1949    1.2082               NaN
    SWS                     0.0111    0.0127               NaN
    DTL                   753.6430  860.2064               NaN
    SWS <= 0.012            0.0111    0.0127              39.4
    """
    import pandas as pd

    found = samples_of(problem, design, scatter, samples, seed)
    chosen = found.scatter
    rows = [_row(found, k) for k in range(len(found.judged))]
    table = pd.DataFrame(rows, index=pd.Index(found.labels, name="name"))
    table.columns.name = f"{chosen.samples} samples, seed {chosen.seed}"
    table.attrs |= {"samples": chosen.samples, "seed": chosen.seed}
    return table


def samples_of(
    problem: RideProblem,
    design: Present,
    scatter: Scatter | Mapping[str, Tolerance] | None,
    samples: int | None,
    seed: int | None,
) -> Sampled:
    """Return the measures and limits of one design, of arguments as of `robustness`."""
    checks.of_kind("problem", problem, RideProblem)
    x = design_of(problem, design, "design")
    return sampled(problem, x[None], scatter_in(problem, scatter, samples, seed))


def sampled(problem: RideProblem, designs: Real, scatter: Scatter) -> Sampled:
    """Return the measures and limits of designs (n, d) over a scatter; ValueError about its names or a value."""
    known = problem.cases[0].vehicle.variables
    for name, values in zip(problem.variables, designs.T.tolist(), strict=True):
        for value in values:
            known[name].check(name, value)
    measures = dict.fromkeys(one.nominal for one in problem.measures)
    judged: list[Measure | Limit] = [*measures, *problem.constraints]
    scores = problem.scoring.scattered(judged, scatter)
    nodes = nodes_at(scores, designs, problem.nodes)
    return Sampled(judged, scores.nominal(designs, nodes), scores.samples(designs, nodes), scatter)


def scatter_in(
    problem: RideProblem,
    scatter: Scatter | Mapping[str, Tolerance] | None,
    samples: int | None,
    seed: int | None,
) -> Scatter:
    """Return the scatter, or that of the problem, with other samples and another seed where they are given."""
    found = problem.scatter if scatter is None else scatter_of(scatter)
    if found is None:
        raise ValueError("scatter must be given where the problem has none, got None")
    own = found is problem.scatter or found is scatter
    size, start = (found.samples, found.seed) if own else (_SAMPLES, _SEED)
    return replace(found, samples=size if samples is None else samples, seed=start if seed is None else seed)


def nodes_at(scores: ScatteredScores, x: Real, least: int) -> int:
    """Return quadrature nodes, `least` or more, that resolve every resonance of samples of designs (n, d)."""
    for nodes in (n for n in NODES if n >= least):
        if max(float(one.max(initial=0.0)) for one in scores.errors(x, x[0], x[0], nodes)) < RESOLVED:
            return nodes
    raise ValueError(f"scatter must leave resonances that {NODES[-1]} nodes resolve, got sharper ones")


def _row(found: Sampled, k: int) -> dict[str, Any]:
    """Return the row of a measure or a limit."""
    judged, values = found.judged[k], np.sort(found.samples[0, k])
    sign = float(np.sign(judged.scale)) if isinstance(judged, Limit) else judged.sign
    return {
        "unit": found.measure(k).unit,
        "nominal": found.nominal[0, k],
        "mean": values.mean(),
        "standard deviation": values.std(),
        **{f"q{level:g}": float(values @ of_quantile(values.size, level)) for level in _QUANTILES},
        f"CVaR{_TAIL:g}": float(values @ of_tail(values.size, _TAIL, sign)),
        "limit": judged.value if isinstance(judged, Limit) else nan,
        BEYOND: found.beyond(k),
    }
