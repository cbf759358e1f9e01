"""Matrices of a vehicle by coefficients: those of the vehicle with its parameters changed."""

import numpy as np

from garage import DRIVER, FULL, QUARTER, ROAD
from suspension_ctrl import Plant, RideProblem
from suspension_ctrl.desk.explorer.plant_matrices import PlantMatrices, plant_matrices
from suspension_ctrl.response.curves import setting_of

BOUNDS = {
    "front.spring": (15e3, 30e3), "rear.spring": (15e3, 30e3), "front.damper": (800.0, 3e3),
    "rear.damper": (800.0, 3e3), "body_mass": (1000.0, 1600.0), "front_tyre_stiffness": (150e3, 250e3),
}  # fmt: skip
DESIGN = np.array([18e3, 25e3, 1500.0, 1200.0, 1450.0, 210e3])


def at(matrices: PlantMatrices, design: np.ndarray, problem: RideProblem, name: str) -> np.ndarray:
    """Return numbers of a design by their name."""
    values = matrices.setting.copy()
    values[matrices.variable] = problem.scores.cases[0].vehicle.formulas.of(design[None])[0]
    return getattr(matrices, name) + np.tensordot(values, getattr(matrices, f"{name}_by"), 1)


def test_masses_and_tyres_that_vary_are_those_of_the_changed_vehicle():
    problem = RideProblem(DRIVER.on(FULL), ROAD, speed=20.0, bounds=BOUNDS)
    matrices = plant_matrices(
        problem.scores.cases[0].vehicle, problem.scores.settings[0], problem.scores.variables
    )
    changed, setting = problem.cases[0].vehicle.at(setting_of(problem, DESIGN.tolist()))
    assembly = changed.assembly
    np.testing.assert_allclose(at(matrices, DESIGN, problem, "inertia"), assembly.inertia, rtol=1e-12)
    np.testing.assert_allclose(at(matrices, DESIGN, problem, "weights"), assembly.weights, rtol=1e-12)
    np.testing.assert_allclose(at(matrices, DESIGN, problem, "loads"), changed.statics.tyre_loads, rtol=1e-12)
    np.testing.assert_allclose(at(matrices, DESIGN, problem, "sprung"), [assembly.sprung_mass], rtol=1e-12)
    values = matrices.setting.copy()
    values[matrices.variable] = problem.scores.cases[0].vehicle.formulas.of(DESIGN[None])[0]
    mass, _, stiffness = (
        base + np.tensordot(values * (matrices.order == order), matrices.by, 1)
        for base, order in ((matrices.mass, 2), (matrices.damping, 1), (matrices.stiffness, 0))
    )
    np.testing.assert_allclose(mass, assembly.mass_matrix, rtol=1e-12)
    given = np.array([list(setting.values())])
    np.testing.assert_allclose(stiffness, changed.statics.stiffness_of(given)[0], rtol=1e-12, atol=1e-9)


def test_a_plant_has_none():
    assert plant_matrices(Plant(QUARTER.plant()), {"spring": 2e4, "damper": 1500.0}, ()) is None
