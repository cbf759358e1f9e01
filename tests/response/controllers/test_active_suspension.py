"""Controllers of a ride problem: measures by Lyapunov's equation, bounds of passive designs, errors."""

import numpy as np
import pytest
from scipy.linalg import solve_continuous_lyapunov

from garage import QUARTER
from suspension_ctrl import Iso8608Road, LoadCase, PowerLawRoad, RideProblem, load_vehicle
from suspension_ctrl.response.controllers import active_suspension
from suspension_ctrl.response.controllers.active_suspension import ActiveSuspension

BOUNDS = {"spring": (1e3, 30e3), "damper": (1e3, 5e3)}
PRESENT = np.array([22e3, 1500.0])
WEIGHTS = np.array([[1, 1, 1], [8, 1, 1], [1, 8, 1], [1, 1, 8]]) / np.array([[3], [10], [10], [10]])


def _problem(road=None, **changes):
    return RideProblem(QUARTER, road or Iso8608Road("C"), speed=20.0, bounds=BOUNDS, **changes)


@pytest.fixture(scope="module")
def wide():
    """All frequencies: beyond 500 Hz is 0.3 % of the mean square of the tyre load, 2 S_0 K_t^2/(4 pi^2 f)."""
    return ActiveSuspension.of(_problem(weighting=None, band=(0.0, 500.0)), PRESENT)


def test_the_present_design_is_that_of_the_problem(wide):
    problem = _problem(weighting=None, band=(0.0, 500.0))
    np.testing.assert_allclose(wide.measures_of(wide.present), problem.evaluate(PRESENT[None])[0], rtol=1e-12)
    assert not wide.effort.any()  # unweighted acceleration is the force itself


@pytest.mark.parametrize("weights", WEIGHTS)
def test_quadrature_and_lyapunov_give_the_same_mean_squares(wide, weights):
    factors = wide.factors(weights)
    found = wide.controlled(factors)
    plant, gains = wide.plant, found.regulator.feedback
    closed = plant.rates.state - plant.rates.force @ gains
    noise = plant.rates.rate @ wide.roads.direct
    outputs = plant.terms.state - plant.terms.force @ gains
    expected = np.diag(outputs @ solve_continuous_lyapunov(closed, -noise @ noise.T) @ outputs.T)
    # Beyond 500 Hz is up to 0.8 % of the mean square of the acceleration, which falls as 1/f.
    np.testing.assert_allclose(found.mean_squares[:2], expected[:2], rtol=1e-2)
    beyond = 2 * wide.roads.direct[0, 0] ** 2 * 192e3**2 / (4 * np.pi**2 * 500.0)
    np.testing.assert_allclose(found.mean_squares[2] + beyond, expected[2], rtol=1e-3)
    assert factors @ expected == pytest.approx(found.regulator.least, rel=1e-9)
    ratios = found.measures / wide.measures_of(wide.present)
    assert weights @ ratios**2 == pytest.approx(factors @ found.mean_squares)


def test_no_passive_design_is_below_the_least_criterion(wide):
    """White velocity over all frequencies by the closed forms of mean squares, for 100,000 random struts."""
    rng = np.random.default_rng(1)
    k, c = np.exp(rng.uniform(np.log([[1e2], [1e1]]), np.log([[1e6], [1e5]]), (2, 100_000)))
    ms, mu, kt, s = 317.5, 45.4, 192e3, wide.roads.direct[0, 0] ** 2
    m = ms + mu
    deflection = m**3 * k**2 / (2 * ms**2 * kt**2 * c) - mu * m * k / (ms * kt * c) + mu / (2 * c)
    deflection += m**2 * c / (2 * ms**2 * kt)
    squares = s * np.array([(kt * c + k**2 * m / c) / (2 * ms**2), m / (2 * c), kt**2 * deflection])
    for weights in WEIGHTS:
        factors = wide.factors(weights)
        ratio = (factors @ squares) / wide.controlled(factors).regulator.least
        assert 1.0 < ratio.min() < 1.2


def test_nothing_else_than_the_error_of_the_delay_depends_on_its_order(monkeypatch):
    file = load_vehicle("minaker_half")
    problem = RideProblem(file.vehicle, Iso8608Road("C"), speed=20.0, bounds=file.bounds, band=(0.3, 20.0))
    design = np.array([file.setting[name] for name in problem.variables])
    values = []
    for order in (14, 20):
        monkeypatch.setattr("suspension_ctrl.response.controllers.road_model.delay_order", lambda *_, n=order: n)
        active = ActiveSuspension.of(problem, design)
        assert active.roads.orders == (order,)
        values.append(active.controlled(active.factors(np.full(3, 1 / 3))).measures)
    np.testing.assert_allclose(values[0], values[1], rtol=2e-3)


def test_forces_count_where_the_weighting_leaves_them_free():
    active = ActiveSuspension.of(_problem(PowerLawRoad(roughness=5e-6, exponent=2.5)), PRESENT)
    force = 949.774  # N, of the reference car on this road in `ride`
    assert active.effort[0] == pytest.approx(active_suspension.EFFORT / force**2, rel=1e-5)


def test_the_worst_wheel_is_measured_and_their_mean_counts():
    file = load_vehicle("minaker_half")
    problem = RideProblem(file.vehicle, Iso8608Road("C"), speed=20.0, bounds=file.bounds, band=(0.3, 20.0))
    active = ActiveSuspension.of(problem, np.array([file.setting[name] for name in problem.variables]))
    squares = np.array([1.0, 4.0, 9.0, 16.0, 25.0])
    np.testing.assert_allclose(active.measures_of(squares), [1.0, 3.0, 5.0])
    own = active.measures_of(active.present)
    expected = [0.5, 0.15, 0.15, 0.1, 0.1] / own[[0, 1, 1, 2, 2]] ** 2
    np.testing.assert_allclose(active.factors(np.array([0.5, 0.3, 0.2])), expected)


def test_other_problems_are_refused():
    two = [LoadCase(vehicle=QUARTER, road=Iso8608Road("C"), speed=speed) for speed in (10.0, 20.0)]
    several = RideProblem(cases=two, bounds=BOUNDS)
    with pytest.raises(ValueError, match=r"^problem must have one load case for a controller, got 2$"):
        ActiveSuspension.of(several, PRESENT)
    mass = _problem().replace(bounds={**BOUNDS, "body_mass": (300.0, 400.0)})
    with pytest.raises(ValueError, match=r"^problem must have coefficients of struts alone.*, got body_mass$"):
        ActiveSuspension.of(mass, np.array([*PRESENT, 320.0]))
    for measure, name in (("lift", "lift"), ("frequency heave", "frequency heave")):
        with pytest.raises(ValueError, match=f"^measures must be root mean squares, such as ACC.*got '{name}'$"):
            ActiveSuspension.of(_problem(measures=["ACC", measure]), PRESENT)
