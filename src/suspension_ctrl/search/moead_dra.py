"""MOEA/D-DRA (Zhang, Liu and Li 2009) as a DEAP toolbox over arrays."""

from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import ClassVar

import numpy as np
from deap.base import Toolbox

from .. import checks
from ..compiled_verbs import call_compiled
from ..quantities import Real, frozen_array, unit
from . import decomposition, operators
from .constraints import constrained, ideal_with
from .evaluation import SearchProblem
from .kinds import box
from .neighbours import neighbourhoods
from .population import Settings, State
from .problem import Minimisable
from .replacement import ReplaceWorse
from .selection import select_survivors
from .subproblems import Decomposed
from .sweep import sweep_batch, sweep_sequential

_SWEEPS = {"sequential": sweep_sequential, "batch": sweep_batch}


@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class MoeadDra(Settings):
    """Settings of MOEA/D-DRA: `population` evaluations at the start, a fifth of that in each iteration.

    Parameters
    ----------
    population : int
        Number of subproblems N, at least five times the number of objectives.
    neighbourhood : float, optional
        Size T of a neighbourhood as a fraction of N, at least 2 subproblems. The default is a tenth, at least 20
        subproblems.
    neighbour_probability : float
        Probability delta that mates come from the neighbourhood.
    replacement_limit : float, optional
        Largest number n_r of partners that a child replaces as a fraction of N, at least 1. The default is a
        hundredth, at least 2.
    scale_factor : float
        Factor F of differential evolution.
    repair_reach : float
        A variable of a child outside its bounds is drawn between the bound and this fraction of the way to the
        parent's value. With 0 it is set to the bound, which helps if the front lies on bounds.
    mutation_probability : float, optional
        Probability that a variable mutates, 1/d if not given.
    mutation_eta : float
        Distribution index of polynomial mutation.
    tournament : int
        Number of subproblems that compete by utility.
    utility_period : int
        Iterations from one update of the utilities to the next.
    utility_threshold : float
        Relative progress above which a subproblem's utility is 1.
    normalise : bool
        Divide each objective by its span at the start of the iteration: the distance from the ideal point to the
        worst value in the population, of feasible designs if there are any. False is equation (14) to the letter.
    objective_scales : (m,) sequence of float, optional
        Divisors of the objectives without normalisation, 1 by default. On the ride problem ``(1, 1, 1e3)``
        means DTL in kN, as in the paper.
    update : {"sequential", "batch"}
        "sequential", the definition: each child is made of the population after the replacements before it.
        "batch": all children of an iteration are made of the population at its start and evaluated in one call.

    Examples
    --------
    An iteration evaluates a fifth of the population. As each objective is divided by its span, tyre loads in
    newtons do not outweigh travels in metres.

    >>> import suspension_ctrl as sc
    >>> file = sc.load_vehicle("yuen_ramli_2010")
    >>> problem = sc.RideProblem(file.vehicle, sc.Iso8608Road("C"), speed=20.0, bounds=file.bounds)
    >>> run = sc.minimise(problem, sc.MoeadDra(population=100), iterations=10, seed=1)
    >>> run.evaluations
    300
    >>> print(run.front()["damper [N s/m]"].agg(["min", "max"]).round(-2).to_list())
    [1000.0, 5000.0]
    """

    neighbourhood: float | None = field(default=None, metadata=unit("", 0, 1))
    neighbour_probability: float = field(default=0.9, metadata=unit("", 0, 1))
    replacement_limit: float | None = field(default=None, metadata=unit("", 0, 1))
    scale_factor: float = field(default=0.5, metadata=unit(""))
    repair_reach: float = field(default=1.0, metadata=unit("", 0, 1))
    mutation_probability: float | None = field(default=None, metadata=unit("", 0, 1))
    mutation_eta: float = field(default=20.0, metadata=unit(""))
    tournament: int = field(default=10, metadata={"least": 1})
    utility_period: int = field(default=50, metadata={"least": 1})
    utility_threshold: float = field(default=0.001, metadata=unit(""))
    normalise: bool = True
    objective_scales: tuple[float, ...] | None = None
    update: str = "sequential"

    phases: ClassVar[tuple[str, ...]] = ("sample", "evaluate", "choose_subproblems", "sweep", "update_utility")

    def __post_init__(self) -> None:
        super().__post_init__()
        checks.one_of("normalise", self.normalise, (True, False))
        if self.objective_scales is not None:
            for scale in np.ravel(self.objective_scales):
                checks.positive("objective_scales", scale)
            self._keep(objective_scales=tuple(np.ravel(self.objective_scales).tolist()))
            if self.normalise:
                raise ValueError(f"objective_scales must be None with normalise, got {self.objective_scales!r}")
        checks.one_of("update", self.update, _SWEEPS)

    @property
    def neighbours(self) -> int:
        """Number T of subproblems in a neighbourhood."""
        n = self.population
        return min(n, max(20, n // 10) if self.neighbourhood is None else max(2, int(self.neighbourhood * n)))

    @property
    def replacements(self) -> int:
        """Largest number n_r of partners that a child replaces."""
        n = self.population
        return max(2, n // 100) if self.replacement_limit is None else max(1, int(self.replacement_limit * n))

    def evaluations_per_iteration(self, objectives: int, /) -> int:
        """Return the number of evaluations in an iteration; ValueError if it is less than the objectives."""
        if self.population < 5 * objectives:
            needed = f">= {5 * objectives} for {objectives} objectives"
            reason = "since a fifth of it holds every corner subproblem"
            raise ValueError(f"population must be {needed}, {reason}, got {self.population}")
        return self.population // 5

    def toolbox(self, problem: Minimisable) -> Toolbox:
        """Return the toolbox of the algorithm for a problem."""
        lower, upper = box(problem)
        probability = 1 / lower.size if self.mutation_probability is None else self.mutation_probability
        toolbox = Toolbox()
        toolbox.register("sample", operators.sample_uniform, lower=lower, upper=upper)
        toolbox.register("evaluate", problem.evaluate)
        toolbox.register("choose_subproblems", call_compiled, decomposition.ByTournament(self.tournament))
        mating_range = decomposition.MatingRange(float(self.neighbour_probability), np.arange(self.population))
        toolbox.register("mating_range", call_compiled, mating_range)
        toolbox.register("reproduce", call_compiled, operators.DifferentialChild(float(self.scale_factor)))
        toolbox.register("repair", call_compiled, operators.RedrawOutside(lower, upper, float(self.repair_reach)))
        eta, p = float(self.mutation_eta), float(probability)
        toolbox.register("mutate", call_compiled, operators.MutateDesign.of(lower, upper, eta, p))
        toolbox.register("update", call_compiled, ReplaceWorse(self.replacements))
        toolbox.register("sweep", _SWEEPS[self.update])
        toolbox.register("update_utility", decomposition.updated_utility, threshold=float(self.utility_threshold))
        return toolbox

    def search(
        self, problem: SearchProblem, toolbox: Toolbox, rng: np.random.Generator, state: State | None = None
    ) -> Iterator[State]:
        """Yield the states of the search in Figure 4 of the paper, see `Optimiser.search`."""
        size, m = self.population, len(problem.objectives)
        vectors = decomposition.weight_vectors(size, m)
        corners = vectors.argmax(axis=0)  # the unit vectors, wherever they stand
        vectors = np.where(vectors == 0, decomposition.ZERO_WEIGHT, vectors) / self._scales(m)
        neighbours, chosen = neighbourhoods(size, m, self.neighbours), self.evaluations_per_iteration(m)
        if state is None:
            designs = np.array(toolbox.sample(rng, size), dtype=float)
            values = problem.values(toolbox.evaluate, designs)
            ideal, evaluations = ideal_with(np.full(m, np.inf), values, False), len(designs)
            if evaluations > size:
                kept, *_ = select_survivors(constrained(values, m), size)
                designs, values = designs[kept], values[kept]
            utility, before, iteration = np.ones(size), frozen_array(values), 0
            yield State.of(designs, values, ideal, evaluations, utility=utility, before=before, iteration=0)
        else:
            designs, values, ideal, evaluations = state.arrays()
            utility, before = state.memory["utility"].copy(), state.memory["before"]
            iteration = int(state.memory["iteration"])
        known = frozen_array(utility)
        population = Decomposed.of(
            designs, values, ideal, vectors, self.normalise, neighbours, corners, utility, chosen
        )
        while True:
            together = min(problem.together, self.utility_period - iteration % self.utility_period)
            course = toolbox.sweep(rng, population, np.empty((together, m)), toolbox, problem)
            iteration += len(course)
            evaluations += len(course) * chosen
            if iteration % self.utility_period == 0:
                utility[:] = toolbox.update_utility(utility, before, values, population.weights, ideal)
                known, before = frozen_array(utility), frozen_array(values)
            yield State.of(
                designs, values, ideal, evaluations, course, utility=known, before=before, iteration=iteration
            )

    def _scales(self, objectives: int) -> Real:
        given = np.ones(objectives) if self.objective_scales is None else self.objective_scales
        scales = np.ravel(given).astype(float)
        if scales.size != objectives:
            needed = f"{objectives} numbers, one per objective"
            raise ValueError(f"objective_scales must be {needed}, got {self.objective_scales!r}")
        return scales
