"""A block of struts at eight frequencies beside numpy's solver, in plain Python."""

import numpy as np
import pytest

from suspension_ctrl.response.lanes import WIDTH, put
from suspension_ctrl.response.struts_in_lanes import add_struts, rows_for

Q, S, K = SIZES = 3, 4, 2
"""Struts, sources of two load cases, and responses."""


def complex_numbers(rng: np.random.Generator, *shape: int) -> np.ndarray:
    return rng.normal(size=(*shape, WIDTH)) + 1j * rng.normal(size=(*shape, WIDTH))


def in_rows(*parts: np.ndarray) -> np.ndarray:
    values = np.concatenate([part.reshape(-1, WIDTH) for part in parts])
    rows = np.empty(2 * WIDTH * len(values))
    for row, value in enumerate(values):
        put((value.real, value.imag), rows, row)
    return rows


@pytest.mark.parametrize("crossed", [False, True])
@pytest.mark.parametrize("designs", [1, 2])
def test_squares_are_those_of_a_dense_solve(designs, crossed):
    """With e = S + P D e the responses are R + T D (1 - P D)^-1 S; couplings of 0.1 lose no digit."""
    rng = np.random.default_rng(designs)
    p, s, r, t = (complex_numbers(rng, *shape) for shape in ((Q, Q), (Q, S), (K, S), (K, Q)))
    w, elements, before = rng.uniform(0.5, 2.0, WIDTH), rng.normal(size=(designs, Q * Q, 3)), 7.0
    if not crossed:
        elements *= np.eye(Q).reshape(-1, 1)
    sums, room = np.full((designs, 2 * K, WIDTH), before), np.empty(2 * 2 * WIDTH * rows_for(Q))
    response, plant = np.array([1, 0]), in_rows(0.1 * p, s, r, t)
    add_struts(w, plant, elements, crossed, np.array(SIZES), response, 2, room, sums)
    for found, own in zip(sums, elements, strict=True):
        stiffness, damping, inertance = own.T[..., None]
        d = (stiffness + 1j * w * damping - w**2 * inertance).reshape(Q, Q, WIDTH)
        p0, s0, r0, t0, d0 = (np.moveaxis(part, -1, 0) for part in (0.1 * p, s, r, t, d))
        squares = np.abs(r0 + t0 @ d0 @ np.linalg.solve(np.eye(Q) - p0 @ d0, s0)) ** 2
        by_case = squares.reshape(WIDTH, K, 2, 2).sum(axis=3)[:, ::-1]  # response 1 is the first
        np.testing.assert_allclose(found - before, by_case.transpose(2, 1, 0).reshape(-1, WIDTH), rtol=1e-10)
