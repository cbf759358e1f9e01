"""Struts closed one after another beside linear equations; lanes are arrays in plain Python."""

import numpy as np
import pytest

from suspension_ctrl.response.gradients.closing import close, fill_plant
from suspension_ctrl.response.lanes import WIDTH

S, K = 2, 4
"""Sources and responses."""
HEARD = [3, 1]
"""Responses of the design."""


@pytest.mark.parametrize("crossed", [False, True])
@pytest.mark.parametrize("q", [1, 2, 3, 4, 5])
def test_deflections_and_responses_are_those_of_linear_equations(q, crossed):
    """Condition numbers of ten: some hundred roundings are below 1e-12."""
    rng, w = np.random.default_rng(q), np.linspace(0.5, 2.0, WIDTH)
    counts = q * q, q * S, K * S, K * q
    rows = np.concatenate(
        [0.1 ** (part == 0) * rng.normal(size=(n, 2, 2 * WIDTH)) for part, n in enumerate(counts)]
    )
    elements = rng.normal(size=(q, q, 3)) * (1 if crossed else np.eye(q)[:, :, None])
    plant, closed = np.empty((q + K) * (q + S) * 2 * WIDTH), np.full(((q + 2) * (q + S) + q) * 2 * WIDTH, np.nan)
    fill_plant(rows, WIDTH, np.array([q, S, K]), plant)
    line = np.array([*range(q), *(q + i for i in HEARD)])
    close(w, plant, elements.reshape(-1, 3), crossed, q, q + S, np.arange(q + 2), line, closed)
    found = closed.reshape(-1, 2, WIDTH)[: (q + 2) * (q + S)]
    found = (found[:, 0] + 1j * found[:, 1]).reshape(q + 2, q + S, WIDTH)
    p, by_source, r, t = np.split(rows[..., WIDTH:][:, 0] + 1j * rows[..., WIDTH:][:, 1], np.cumsum(counts)[:-1])
    for n in range(WIDTH):
        d = elements @ (1.0, 1j * w[n], -(w[n] ** 2))
        plain, forces = p[:, n].reshape(q, q), t[:, n].reshape(K, q)
        e = np.linalg.solve(np.eye(q) - plain @ d, by_source[:, n].reshape(q, S))
        y, h = r[:, n].reshape(K, S) + forces @ d @ e, forces @ np.linalg.inv(np.eye(q) - d @ plain)
        np.testing.assert_allclose(found[:q, q:, n], e, rtol=1e-12, atol=1e-12)
        np.testing.assert_allclose(found[q:, q:, n], y[HEARD], rtol=1e-12, atol=1e-12)
        np.testing.assert_allclose(found[q:, :q, n], h[HEARD], rtol=1e-12, atol=1e-12)
