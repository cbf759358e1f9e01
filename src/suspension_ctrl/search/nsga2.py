"""NSGA-II (Deb et al. 2002) as a DEAP toolbox over arrays."""

from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import ClassVar

import numpy as np
from deap.base import Toolbox

from .. import checks
from ..quantities import frozen, unit
from .constraints import any_feasible, constrained, ideal_with
from .deap_adapter import select_with_deap
from .evaluation import SearchProblem
from .kinds import box
from .operators import crowded_tournament, polynomial_mutation, sample_uniform, simulated_binary_crossover
from .population import Generational, State
from .problem import Minimisable
from .selection import select_survivors

_SELECTIONS = {
    "array": (select_survivors, {}),
    "deap-standard": (select_with_deap, {"nd": "standard"}),
    "deap-log": (select_with_deap, {"nd": "log"}),
}


@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class Nsga2(Generational):
    """Settings of NSGA-II: `population` evaluations at the start and in each iteration.

    Parameters
    ----------
    population : int
        Size of the population N, at least 4.
    crossover_probability : float
        Probability that two parents mate.
    crossover_eta : float
        Distribution index of simulated binary crossover.
    mutation_probability : float, optional
        Probability that a variable mutates, 1/d if not given.
    mutation_eta : float
        Distribution index of polynomial mutation.
    selection : {"array", "deap-standard", "deap-log"}
        Survivor selection on arrays, or DEAP's ``selNSGA2`` with its sorting of order m n^2 or its faster one.
        "array" and "deap-standard" keep the same survivors except for ties.

    Examples
    --------
    An iteration evaluates a whole population; the survivors cover the front from soft to firm:

    >>> import suspension_ctrl as sc
    >>> file = sc.load_vehicle("yuen_ramli_2010")
    >>> problem = sc.RideProblem(file.vehicle, sc.Iso8608Road("C"), speed=20.0, bounds=file.bounds)
    >>> run = sc.minimise(problem, sc.Nsga2(population=100), iterations=10, seed=1)
    >>> run.evaluations
    1100
    >>> print(run.front()["damper [N s/m]"].agg(["min", "max"]).round(-2).to_list())
    [1000.0, 5000.0]
    """

    crossover_probability: float = field(default=0.9, metadata=unit("", 0, 1))
    crossover_eta: float = field(default=20.0, metadata=unit(""))
    mutation_probability: float | None = field(default=None, metadata=unit("", 0, 1))
    mutation_eta: float = field(default=20.0, metadata=unit(""))
    selection: str = "array"

    phases: ClassVar[tuple[str, ...]] = ("sample", "evaluate", "tournament", "mate", "mutate", "select")

    def __post_init__(self) -> None:
        super().__post_init__()
        checks.one_of("selection", self.selection, _SELECTIONS)

    def toolbox(self, problem: Minimisable) -> Toolbox:
        """Return the toolbox of the algorithm for a problem."""
        lower, upper = box(problem)
        probability = 1 / lower.size if self.mutation_probability is None else self.mutation_probability
        select, sorting = _SELECTIONS[self.selection]
        toolbox = Toolbox()
        toolbox.register("sample", sample_uniform, lower=lower, upper=upper)
        toolbox.register("evaluate", problem.evaluate)
        toolbox.register("tournament", crowded_tournament)
        bounds = {"lower": lower, "upper": upper}
        mates = {"eta": self.crossover_eta, "probability": self.crossover_probability}
        toolbox.register("mate", simulated_binary_crossover, **bounds, **mates)
        toolbox.register("mutate", polynomial_mutation, **bounds, eta=self.mutation_eta, probability=probability)
        toolbox.register("select", select, **sorting)
        return toolbox

    def search(
        self, problem: SearchProblem, toolbox: Toolbox, rng: np.random.Generator, state: State | None = None
    ) -> Iterator[State]:
        """Yield the states of the search in Figure 3 of the paper, see `Optimiser.search`."""
        size, m = self.population, len(problem.objectives)
        state = state or problem.before_the_start()
        values = np.hstack([state.objectives, state.constraints])
        ideal, evaluations = state.ideal, state.evaluations
        while True:
            if not state.memory:
                children = np.array(toolbox.sample(rng, size), dtype=float)
            else:
                parents = toolbox.tournament(rng, state.memory["rank"], state.memory["crowding"], size)
                children = toolbox.mutate(rng, toolbox.mate(rng, state.designs.take(parents, axis=0)))
            new_values = problem.values(toolbox.evaluate, children)
            ideal = ideal_with(ideal, new_values, any_feasible(values, m))
            evaluations += len(children)
            designs, values = np.concatenate([state.designs, children]), np.concatenate([values, new_values])
            kept, rank, crowding = toolbox.select(constrained(values, m), size)
            designs, values = frozen(designs.take(kept, axis=0)), frozen(values.take(kept, axis=0))
            state = State.of(designs, values, ideal, evaluations, rank=frozen(rank), crowding=frozen(crowding))
            yield state
