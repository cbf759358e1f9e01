"""Active suspension of a ride problem: optimal controllers by weights, with the measures of the problem."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import NamedTuple, Self

import numpy as np

from ... import checks
from ...quantities import Complex, Real
from ...vehicles.vehicle import coefficients_by_name
from ..curves import setting_of
from ..linearisation import linear_at
from ..mapped import mean_squares_of
from ..mean_squares import quadrature_of
from ..problem import RideProblem
from ..scores import Score, Scores
from .actuated import Actuated, dynamics_of, wheel_struts
from .estimator import Estimator
from .loop import Loop
from .regulator import Regulator, regulator
from .road_model import RoadModel

FORCE_NOISE = 0.01
"""White noise of forces within the band, where states are estimated, as a share of present forces (r.m.s.)."""
EFFORT = 1e-3
"""Weight of the forces' mean squares over those of the present design, beside a sum of 1 of all other weights."""


class Controlled(NamedTuple):
    """A controller with the mean squares (k,) of the terms within the band, and the measures (m,)."""

    regulator: Regulator
    mean_squares: Real
    measures: Real


@dataclass(frozen=True)
class ActiveSuspension:
    """A vehicle with actuators in place of its struts on wheels, in the load case of a ride problem."""

    scores: Scores  # of the m measures
    plant: Actuated
    roads: RoadModel
    loop: Loop  # at the n nodes of the quadrature
    spectra: Complex  # (n, r, r), of the roads
    densities: Real  # (k, n), weights of the quadrature with factors of weightings
    squares: Real  # (m, k), factors of the terms' mean squares in each measure
    present: Real  # (k,), mean squares of the present design
    forces: Real  # (q,), mean squares of its forces
    effort: Real  # (q,), factors of the forces' mean squares

    @classmethod
    def of(cls, problem: RideProblem, design: Real, sensors: Sequence[str] = ()) -> Self:
        """Take the vehicle, and its struts that are not on wheels with the coefficients of a present design (d,).

        ValueError if there are several load cases, parameters beside coefficients, measures that are no root mean
        squares or a weighting that is no filter, or about the vehicle as `Actuated.of`.
        """
        _check_coefficients(problem)
        scores = _scores(problem)
        (case,), (terms,), nodes = problem.cases, scores.terms, problem.nodes
        vehicle, setting = linear_at(case, setting_of(problem, design.tolist()), problem.band)
        values, ports = vehicle.coefficients(setting), wheel_struts(vehicle)
        plant = Actuated.of(vehicle, values, terms, sensors)
        roads = RoadModel.of(case, problem.band, falls=plant.load_by_rate, displaced=plant.by_road)
        f, weights, densities = quadrature_of(case, terms, problem.band, nodes)
        bare = Loop.around(plant, roads, f, np.zeros((len(ports), len(plant.rates.state))))
        strut = dynamics_of(vehicle, values, ports).stiffness(bare.s)[:, ports][:, :, ports]
        found = cls(
            scores=scores,
            plant=plant,
            roads=roads,
            loop=bare,
            spectra=case.cross_spectrum(f),
            densities=densities,
            squares=np.array([scores.roots(0, unit) ** 2 for unit in np.eye(len(terms))]).T,
            present=mean_squares_of(scores.kernel(nodes).cases[0], design[None])[0],
            forces=np.zeros(len(ports)),
            effort=np.zeros(len(ports)),
        )
        forces = found.integrals(bare.with_struts(strut)[1], np.tile(weights, (len(ports), 1)))
        free = np.linalg.matrix_rank(plant.terms.force) < len(ports)
        found = replace(found, forces=forces, effort=free * EFFORT / len(ports) / forces)
        equal = found.factors(np.full(len(found.squares), 1 / len(found.squares)))
        stable = regulator(plant, roads, equal, found.effort)
        return replace(found, loop=Loop.around(plant, roads, f, stable.feedback))

    def factors(self, weights: Real) -> Real:
        """Return factors (k,) of the terms by weights (m,) of squared measures over those of the present design.

        The mean over its wheels stands for a measure of the worst wheel, which is no less.
        """
        largest = np.array([score.cases[0].largest for score in self.scores.scores])
        wheels = np.where(largest, np.count_nonzero(self.squares, axis=1), 1)
        return np.asarray(weights / wheels / self.measures_of(self.present) ** 2 @ self.squares)

    def controlled(self, factors: Real) -> Controlled:
        """Return the controller of least sum of mean squares by factors (k,), and of forces by effort."""
        found = regulator(self.plant, self.roads, factors, self.effort * (factors @ self.present))
        mean_squares = self.integrals(self.loop.regulated(found)[0], self.densities)
        return Controlled(found, mean_squares, self.measures_of(mean_squares))

    def estimator(self, noise: Real) -> Estimator:
        """Return the estimator by sensors with white noise of root mean squares `noise` (s,) within the band."""
        intensities = self._densities(noise) / 2
        return Estimator.of(self.plant, self.roads, intensities[: noise.size], intensities[noise.size :])

    def sensed(self, known: Regulator, estimator: Estimator, noise: Real) -> Controlled:
        """Return a regulator that acts on estimated states, with `noise` (s,) as of `estimator`."""
        by_road, by_noise = self.loop.sensed(estimator.forces(known, self.loop.s))
        spectra = np.abs(by_noise) ** 2 @ self._densities(noise)
        mean_squares = self.integrals(by_road, self.densities) + (spectra.T * self.densities).sum(axis=1)
        return Controlled(known, mean_squares, self.measures_of(mean_squares))

    def _densities(self, noise: Real) -> Real:
        """Return the one-sided densities (s + q,) of noises of the sensors and of the forces."""
        low, high = self.scores.band
        return np.concatenate([noise**2, FORCE_NOISE**2 * self.forces]) / (high - low)

    def measures_of(self, mean_squares: Real) -> Real:
        """Return the measures (m,) by mean squares (k,) of the terms."""
        return self.scores.roots(0, mean_squares)

    def integrals(self, h: Complex, densities: Real) -> Real:
        """Return the mean squares (k,) of responses to the roads (n, k, r)."""
        spectra = np.einsum("nki,nij,nkj->kn", h, self.spectra, h.conj(), optimize=True).real
        return np.asarray((spectra * densities).sum(axis=1))


def _check_coefficients(problem: RideProblem) -> None:
    """Raise ValueError unless all that varies or is fixed is a coefficient of a strut, in one load case."""
    if len(problem.cases) > 1:
        raise ValueError(f"problem must have one load case for a controller, got {len(problem.cases)}")
    known = {one.name for one in problem.cases[0].vehicle.strut_coefficients}
    others = [one for one in (*problem.variables, *coefficients_by_name(problem.struts, {})) if one not in known]
    if others:
        raise ValueError(f"problem must have coefficients of struts alone for a controller, got {others[0]}")


def _scores(problem: RideProblem) -> Scores:
    """Return the scores of the measures; ValueError unless each is a root mean square."""
    in_case = [problem.scoring.in_cases(one) for one in problem.measures]
    for one, (found,) in zip(problem.measures, in_case, strict=True):
        if found.values or one.maximise or not found.terms:
            needed = "root mean squares, such as ACC, SWS and DTL, for a controller"
            raise ValueError(f"measures must be {needed}, got {checks.shown(one.label)}")
    return problem.scoring.scores_of([Score(found, False) for found in in_case])
