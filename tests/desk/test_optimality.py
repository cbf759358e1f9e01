"""Conditions of an optimum and Newton's method on programs whose optima are known by hand."""

import numpy as np
import pytest

from suspension_ctrl.desk.optimality import conditions, polished
from suspension_ctrl.desk.programs import Values


class Known:
    """Least of (x - 3)^2 + (y - 2)^2, both from 0 to 1, with x + y at most `most`, as a program."""

    lower, upper = np.zeros(2), np.ones(2)

    def __init__(self, most: float, *, equal: bool = False) -> None:
        self.most, self.equal = most, np.array([False, equal])

    def at(self, z: np.ndarray) -> Values:
        rows = np.array([(z[0] - 3) ** 2 + (z[1] - 2) ** 2, z.sum() - self.most])
        return Values(rows, np.array([[2 * (z[0] - 3), 2 * (z[1] - 2)], [1.0, 1.0]]))

    def many(self, z: np.ndarray) -> list[Values]:
        return [self.at(one) for one in z]


@pytest.mark.parametrize(
    ("most", "optimum", "multiplier", "gradient"),
    [
        (1.5, (1.0, 0.5), 3.0, (-1.0, 0.0)),  # x at its bound, the limit active
        (0.8, (0.8, 0.0), 4.4, (0.0, 0.4)),  # y at its bound
        (2.5, (1.0, 1.0), 0.0, (-4.0, -2.0)),  # both at their bounds, the limit free
    ],
)
def test_multipliers_of_optima_known_by_hand(most, optimum, multiplier, gradient):
    program = Known(most)
    found = conditions(program, np.array(optimum), program.at(np.array(optimum)))
    assert found.residual <= 1e-12
    np.testing.assert_allclose(found.multipliers, [1.0, multiplier], atol=1e-12)
    np.testing.assert_allclose(found.gradient, gradient, atol=1e-12)
    np.testing.assert_array_equal(found.held, np.abs(gradient) > 0)


def test_newton_comes_to_the_optimum_from_nearby():
    z, found = polished(Known(1.5), np.array([1.0 - 3e-6, 0.5 + 4e-6]))
    assert found.residual <= 1e-12
    np.testing.assert_allclose(z, [1.0, 0.5], atol=1e-12)


def test_an_equality_may_hold_against_the_descent():
    """The objective would rather have a larger sum below it: the multiplier is below zero."""
    program = Known(0.0, equal=True)
    program.most = 1.9
    program.at = lambda z: Values(np.array([z @ z, z.sum() - 1.9]), np.array([2 * z, [1.0, 1.0]]))
    _, found = polished(program, np.array([0.95, 0.95]))
    assert found.residual <= 1e-12
    np.testing.assert_allclose(found.multipliers, [1.0, -1.9], atol=1e-9)


def test_what_is_no_optimum_has_a_residual():
    """Inside, the slope remains; beyond the limit, the excess; short of it, its multiplier times the distance."""
    program = Known(1.5)
    inside = np.array([0.5, 0.5])
    assert conditions(program, inside, program.at(inside)).residual == pytest.approx(5.0)
    beyond = np.array([1.0, 0.7])
    assert conditions(program, beyond, program.at(beyond)).residual >= 0.2
    short = np.array([1.0, 0.5 - 5e-6])
    assert conditions(program, short, program.at(short)).residual == pytest.approx(3 * 5e-6, rel=1e-3)


class Free(Known):
    """The least of a function of x and y inside the box: its limit is far away."""

    def __init__(self, rows, slopes) -> None:
        super().__init__(9.0)
        self.rows, self.slopes = rows, slopes

    def at(self, z: np.ndarray) -> Values:
        return Values(np.array([self.rows(*z), -9.0]), np.array([self.slopes(*z), [1.0, 1.0]]))


def test_newton_takes_the_second_derivatives_of_the_objective():
    """Of (x - 0.3)^2 + 2 (y - 0.6)^2 + (x - 0.3)(y - 0.6) it needs one step."""
    program = Free(
        lambda x, y: (x - 0.3) ** 2 + 2 * (y - 0.6) ** 2 + (x - 0.3) * (y - 0.6),
        lambda x, y: [2 * (x - 0.3) + y - 0.6, 4 * (y - 0.6) + x - 0.3],
    )
    z, found = polished(program, np.array([0.31, 0.58]))
    assert found.residual <= 1e-12
    np.testing.assert_allclose(z, [0.3, 0.6], atol=1e-12)


def test_where_newton_goes_astray_the_best_point_is_kept():
    """Of |x - 0.5|^1.2 a step goes to the other side, five times as far."""
    program = Free(
        lambda x, y: abs(x - 0.5) ** 1.2 + (y - 0.5) ** 2,
        lambda x, y: [1.2 * np.sign(x - 0.5) * abs(x - 0.5) ** 0.2, 2 * (y - 0.5)],
    )
    z, found = polished(program, np.array([0.51, 0.5]))
    np.testing.assert_array_equal(z, [0.51, 0.5])
    assert found.residual == pytest.approx(1.2 * 0.01**0.2)
