"""A problem whose parameters stand at those of a design has the measures of that design."""

import numpy as np

import suspension_ctrl as sc
from suspension_ctrl.response.parameters_at import without_parameters


def problem(**bounds):
    car = sc.load_vehicle("yuen_ramli_2010").vehicle
    limits = {"spring": (1e4, 3e4), "damper": (1e3, 4e3)} | bounds
    return sc.RideProblem(car, sc.Iso8608Road("C"), speed=20.0, bounds=limits, nodes=256)


def test_measures_are_those_of_the_design():
    """The tyre stands in the matrices in place of a port: rounding alone differs."""
    whole = problem(tyre_stiffness=(1.5e5, 2.5e5))
    design = np.array([2e4, 2e3, 1.7e5])
    plain, coefficients = without_parameters(whole, design)
    assert plain.variables == ("spring", "damper")
    np.testing.assert_allclose(coefficients, design[:2])
    np.testing.assert_allclose(plain.evaluate([coefficients]), whole.evaluate([design]), rtol=1e-10)


def test_without_parameters_it_is_the_problem_as_it_is():
    whole, design = problem(), np.array([2e4, 2e3])
    plain, coefficients = without_parameters(whole, design)
    assert plain is whole
    assert coefficients is design
