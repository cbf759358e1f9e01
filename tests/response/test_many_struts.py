"""The compiled solve of the strut loop beside numpy's solver, on loops of random numbers."""

import numpy as np
import pytest

from suspension_ctrl.response.many_struts import ManyStruts

SIZES = [(2, 1, 3), (3, 2, 2)]
"""Struts, sources and responses of two blocks."""
ORDER = np.array([0, 1, 2, 0])


def complex_rows(rng: np.random.Generator, *shape: int) -> np.ndarray:
    return rng.normal(size=shape) + 1j * rng.normal(size=shape)


def real_rows(values: np.ndarray) -> np.ndarray:
    return np.stack([values.real, values.imag], axis=-2).reshape(-1, 2, values.shape[-1])


@pytest.mark.parametrize(("seed", "n"), [*((seed, 8) for seed in range(5)), *((seed, 24) for seed in range(5))])
def test_mean_squares_are_those_of_a_dense_solve(seed, n):
    """With e = S + P D e the responses are R + T D (1 - P D)^-1 S, squared, summed over nodes and sources.

    With a seed above 0 two struts without coupling are closed by themselves, others by elimination.
    """
    rng = np.random.default_rng(seed)
    omega, origin = rng.uniform(0.5, 2.0, n), rng.normal(size=4)
    gains = [rng.normal(size=(4, q, q)) for q, _, _ in SIZES]
    gains[0][:, 0, 1] = 0.0  # an entry that no coefficient reaches
    if seed:
        gains[0][:, 1, 0] = 0.0
    parts = [
        tuple(
            complex_rows(rng, *shape, n) * (0.1 if shape == (q, q) else 1.0)
            for shape in ((q, q), (q, s), (k, s), (k, q))
        )
        for q, s, k in SIZES
    ]
    response = np.array([0, 2, 1, 1, 0])
    struts = ManyStruts(
        omega=omega,
        rows=np.concatenate([real_rows(part) for block in parts for part in block]),
        sizes=np.array(SIZES),
        response=response,
        channel=np.array([2, 0, 0, 1]),
        gain=np.hstack([gain.reshape(4, -1) for gain in gains]),
        order=ORDER,
        origin=origin,
    )
    designs = rng.normal(size=(19, 4))  # more than pass together, an odd number of them
    designs[0] = origin  # nothing is added
    found = struts(designs)
    for design, row in zip(designs, found, strict=True):
        distinct = np.zeros(3)
        factors = (design - origin)[:, None] * (1j * omega) ** ORDER[:, None]
        first = 0
        for gain, (p, s, r, t) in zip(gains, parts, strict=True):
            d = np.einsum("vn,vij->nij", factors, gain)
            p, s, r, t = (np.moveaxis(part, -1, 0) for part in (p, s, r, t))
            h = r + t @ d @ np.linalg.solve(np.eye(d.shape[1]) - p @ d, s)
            np.add.at(distinct, response[first : first + h.shape[1]], (np.abs(h) ** 2).sum(axis=(0, 2)))
            first += h.shape[1]
        np.testing.assert_allclose(row, distinct[[2, 0, 0, 1]], rtol=1e-9)


def test_no_blocks_give_nothing():
    """As of roll on a road shaped like a cylinder."""
    none, whole = np.empty((0, 2, 7)), np.zeros(0, dtype=np.int64)
    struts = ManyStruts(
        omega=np.ones(7), rows=none, sizes=np.empty((0, 3), dtype=np.int64), response=whole,
        channel=np.array([0, 0]), gain=np.empty((1, 0)), order=np.array([0]), origin=np.ones(1),
    )  # fmt: skip
    np.testing.assert_array_equal(struts(np.array([[2.0], [3.0]])), np.zeros((2, 2)))
