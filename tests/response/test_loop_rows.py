"""The strut loop in rows beside numpy's complex arrays and its solver, on random numbers."""

import numpy as np
import pytest

from suspension_ctrl.response import loop_rows
from suspension_ctrl.response.many_struts import ManyStruts

N, Q, S = 8, 3, 2  # frequencies, struts, sources
OMEGA = np.linspace(0.5, 2.0, N)
DENSE = np.ones(Q * Q, dtype=bool)


def drawn(seed: int, *shape: int) -> np.ndarray:
    rng = np.random.default_rng(seed)
    return rng.normal(size=(*shape, N)) + 1j * rng.normal(size=(*shape, N))


def rows(values: np.ndarray) -> np.ndarray:
    """Return complex values (..., n) as rows (l, 2, n)."""
    return np.stack([values.real, values.imag], axis=-2).reshape(-1, 2, N)


def values(found: np.ndarray, *shape: int) -> np.ndarray:
    return (found[:, 0] + 1j * found[:, 1]).reshape(*shape, N)


def test_the_stiffness_is_the_sum_of_gains_by_powers_of_jw():
    rng = np.random.default_rng(0)
    order, gain = np.array([0, 1, 2, 1]), rng.normal(size=(4, 2 + Q * Q))
    gain[:, 3] = 0.0
    struts = ManyStruts(
        OMEGA, np.empty((0, 2, N)), np.empty((0, 3)), np.empty(0), np.empty(0), gain, order, np.zeros(4)
    )
    added, present, found = rng.normal(size=4), np.empty(Q * Q, dtype=bool), np.empty((Q * Q, 2, N))
    loop_rows.fill_stiffness(added, struts, 2, present, found)
    expected = np.einsum("v,vn,vi->in", added, (1j * OMEGA) ** order[:, None], gain[:, 2:])
    np.testing.assert_allclose(values(found, Q * Q), expected, rtol=1e-13)
    assert present.tolist() == [i != 1 for i in range(Q * Q)]


def test_the_loop_is_solved():
    """e = (1 - P D)^-1 S, where entries of D that are absent do not count."""
    p, d, s = 0.2 * drawn(1, Q, Q), drawn(2, Q, Q), drawn(3, Q, S)
    present = DENSE.copy()
    present[[1, 5]] = False
    loop = np.empty((Q * (Q + S), 2, N))
    loop_rows.fill_loop(Q, S, present, rows(d), rows(p), rows(s), loop)
    d = d * present.reshape(Q, Q, 1)
    matrix = np.moveaxis(np.eye(Q)[..., None] - np.einsum("ikn,kjn->ijn", p, d), -1, 0)
    np.testing.assert_allclose(values(loop, Q, Q + S)[:, :Q], np.moveaxis(matrix, 0, -1), rtol=1e-13, atol=1e-14)
    loop_rows.eliminate(Q, Q + S, loop)
    expected = np.linalg.solve(matrix, np.moveaxis(s, -1, 0))
    np.testing.assert_allclose(values(loop, Q, Q + S)[:, Q:], np.moveaxis(expected, 0, -1), rtol=1e-10)


def test_rows_are_multiplied_and_inverted_as_complex_numbers():
    (a, b), total = drawn(9, 2), drawn(10)
    product, sum_, inverse, copied = rows(b)[0], rows(total)[0], rows(a)[0], np.empty((2, N))
    loop_rows.multiply(rows(a)[0], product)
    loop_rows.add_product(-1.0, rows(a)[0], rows(b)[0], sum_)
    loop_rows.invert(inverse)
    loop_rows.copy(sum_, copied)
    found = values(np.array([product, copied, inverse]), 3)
    np.testing.assert_allclose(found, [a * b, total - a * b, 1 / a], rtol=1e-12)
    assert loop_rows.sum_of_squares(rows(a)[0]) == pytest.approx((np.abs(a) ** 2).sum(), rel=1e-12)
