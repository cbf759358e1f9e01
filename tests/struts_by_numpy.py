"""Blocks of struts of random numbers, and their mean squares and derivatives by numpy."""

from collections.abc import Sequence

import numpy as np

from suspension_ctrl.response.many_struts import ManyStruts

VARIABLES = 4


def random_struts(sizes: Sequence[tuple[int, int, int]], crossed: Sequence[bool], cases: int = 1) -> ManyStruts:
    """Return blocks of q struts, s sources and k responses, with an entry that no variable reaches."""
    rng = np.random.default_rng(0)
    rows = [0.1 ** (part == 0) * rng.normal(size=(count, 2, 24)) for q, s, k in sizes
            for part, count in enumerate((q * q, q * s, k * s, k * q))]  # fmt: skip
    gains = [rng.normal(size=(VARIABLES, q, q)) * (1 if each else np.eye(q))
             for (q, _, _), each in zip(sizes, crossed, strict=True)]  # fmt: skip
    for gain in gains:
        gain[:, 0, -1] *= gain.shape[1] == 1
    responses = sum(k for _, _, k in sizes)
    return ManyStruts(
        omega=rng.uniform(0.5, 2.0, 24),
        rows=np.concatenate(rows),
        sizes=np.array(sizes),
        response=np.array([0, 2, 1, 1, 0])[np.arange(responses) % 5],
        channel=np.array([2, 0, 0, 1]),
        gain=np.hstack([gain.reshape(VARIABLES, -1) for gain in gains]),
        order=np.array([0, 1, 2, 0]),
        origin=rng.normal(size=VARIABLES),
        cases=cases,
    )


def with_slopes(struts: ManyStruts, design: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return the mean squares (cases k,) of a design (v,), and their derivatives (cases k, v)."""
    complex_rows, powers = struts.rows[:, 0] + 1j * struts.rows[:, 1], (1j * struts.omega) ** struts.order[:, None]
    channels = struts.channel.max() + 1
    squares, slopes = np.zeros((struts.cases, channels)), np.zeros((struts.cases, channels, design.size))
    row = entry = output = 0
    for q, s, k in struts.sizes.tolist():
        p, by_source, r, t = (
            complex_rows[row + sum(before) : row + sum(before) + a * b].T.reshape(-1, a, b)
            for before, (a, b) in (
                ((0,), (q, q)), ((q * q,), (q, s)), ((q * q, q * s), (k, s)), ((q * q, q * s, k * s), (k, q))
            )
        )  # fmt: skip
        gain = struts.gain[:, entry : entry + q * q].reshape(-1, q, q)
        d = np.einsum("v,vn,vij->nij", design - struts.origin, powers, gain)
        e = np.linalg.solve(np.eye(q) - p @ d, by_source)
        y, h = r + t @ d @ e, t @ np.linalg.inv(np.eye(q) - d @ p)
        changes = np.einsum("nks,nki,vij,njs,vn->ksv", y.conj(), h, gain, e, powers)
        for case in range(struts.cases):
            own = slice(case * s // struts.cases, (case + 1) * s // struts.cases)
            for i, channel in enumerate(struts.response[output : output + k]):
                squares[case, channel] += (np.abs(y[:, i, own]) ** 2).sum()
                slopes[case, channel] += 2 * changes[i, own].real.sum(axis=0)
        row, entry, output = row + (q + k) * (q + s), entry + q * q, output + k
    return squares[:, struts.channel].ravel(), slopes[:, struts.channel].reshape(-1, design.size)
