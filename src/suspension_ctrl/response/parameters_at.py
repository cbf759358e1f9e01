"""A ride problem whose vehicles are built at the parameters of a design."""

from dataclasses import replace

import numpy as np

from ..quantities import Real
from ..vehicles.altered import plain_values
from .problem import RideProblem


def without_parameters(problem: RideProblem, design: Real) -> tuple[RideProblem, Real]:
    """Return the problem of coefficients alone at the parameters of a design (d,), and its coefficients there.

    Bounds are as close as numbers are; without parameters it is the problem as it is.
    """
    scoring = problem.scoring
    if all(one.vehicle is given.vehicle for one, given in zip(scoring.ported, problem.cases, strict=True)):
        return problem, design
    given = {**scoring.fixed, **dict(zip(problem.variables, design.tolist(), strict=True))}
    values = plain_values(problem.cases[0].vehicle, given)
    every = [case.vehicle.at(values) for case in problem.cases]
    cases = [replace(case, vehicle=one) for case, (one, _) in zip(problem.cases, every, strict=True)]
    own = {name: float(values[name]) for name in every[0][1] if name in values}
    bounds = {name: (value, float(np.nextafter(value, np.inf))) for name, value in own.items()}
    plain = problem.replace(cases=cases, bounds=bounds, struts={}, kinds={}, nodes=int(problem.nodes))
    return plain, np.array(list(own.values()))
