"""Block-diagonal form of a vehicle on its road.

A left-right symmetric vehicle decouples into an in-phase half (heave, pitch) and an out-of-phase half (roll) with
half of the struts each: two loops of two equations instead of one of four.
"""

from collections.abc import Mapping, Sequence
from typing import NamedTuple

import numpy as np

from ..quantities import Bool, Complex, Integer, Real
from ..vehicles.assembly import StrutCoefficient
from .many_struts import ManyStruts
from .ports import Ports

_NOTHING = 1e-11  # coupling below this share of the largest at the same frequency is rounding
_ALIKE = 1e-9  # largest relative difference of equal responses
_ROUNDING = 1e-13  # share of the road's power, and of a response's largest value, below which a value is rounding


class Variables(NamedTuple):
    """Coefficients that vary: tensions (v, q, q) by derivatives of `order` (v,), and values in place (v,).

    Further gains (t, q, q) are those of networks.
    """

    gain: Real
    order: Integer
    origin: Real

    @classmethod
    def of(cls, coefficients: Sequence[StrutCoefficient], origin: Mapping[str, float]) -> "Variables":
        """Take the coefficients with a value in `origin`."""
        by_name = {one.name: one for one in coefficients}
        gains, orders = zip(*((by_name[name].gain, by_name[name].order) for name in origin), strict=True)
        return cls(np.array(gains), np.array(orders, dtype=np.int64), np.array(list(origin.values()), dtype=float))


Pairs = tuple[Real, Real]
"""Orthogonal matrices of q struts (q, q) and r roads (r, r): sums and differences of left and right."""


def pairs_of(struts: Sequence[str], contact_points: Real) -> Pairs:
    """Return the pairs by the names of the struts and the contact points (r, 2)."""
    mirrored = [name.replace("left", "right") for name in struts]
    opposite = [
        [i for i, name in enumerate(struts) if name == mirror and name != struts[k]]
        for k, mirror in enumerate(mirrored)
    ]
    beside = [
        [i for i, (x, y) in enumerate(contact_points) if x == here[0] and y == -here[1] and y < 0]
        for here in contact_points
    ]
    return _sums_and_differences(opposite), _sums_and_differences(beside)


def in_blocks(
    ports: Ports, omega: Real, roads: Complex, densities: Real, variables: Variables, pairs: Pairs
) -> ManyStruts:
    """Return mean squares of m responses at n frequencies, for spectra of roads (n, r, r) and densities (m, n)."""
    m, r, (p, x) = ports.m, ports.r, pairs
    gain = _without_rounding(p @ variables.gain @ p.T)
    coupled = _coupled(gain)
    varied = (coupled | coupled.T).any(axis=0)
    p, gain = p[varied], gain[:, varied][:, :, varied]
    by_road, feedback = _cleared(p @ ports.h[:, m:, :r] @ x.T), p @ ports.h[:, m:, r:] @ p.T
    paired_roads, root = x @ roads @ x.T, np.sqrt(densities.T)[:, :, None]
    rows, from_struts = root * _cleared(ports.h[:, :m, :r] @ x.T), root * (ports.h[:, :m, r:] @ p.T)
    power = paired_roads.trace(axis1=1, axis2=2).real
    blocks = []
    for q, s in _parts(_coupled(feedback) | _coupled(gain), by_road, paired_roads):
        factor = _factor(paired_roads[:, s][:, :, s], power)
        heard = np.flatnonzero(_contributes(rows)[:, s].any(axis=1) | _contributes(from_struts)[:, q].any(axis=1))
        networks = gain[variables.order.size :, q][:, :, q].any()  # their working points depend on the block
        if factor.shape[2] and (heard.size or networks):
            parts = [
                feedback[:, q][:, :, q],
                by_road[:, q][:, :, s] @ factor,
                rows[:, heard][:, :, s] @ factor,
                from_struts[:, heard][:, :, q],
            ]
            blocks.append(_Block([_real_rows(part) for part in parts], gain[:, q][:, :, q], heard))
    return _joined(blocks, m, omega, variables)


class _Block(NamedTuple):
    """Rows of a block's four parts (see `ManyStruts`), its gains (v, q, q) and its responses (k,)."""

    parts: list[Real]
    gain: Real
    response: Integer

    def rows_of(self, response: int) -> Real:
        """Return the rows (s + q, 2, n) of a response, zeros if it has none."""
        own = np.concatenate([part[self.response == response] for part in self.parts[2:]], axis=1)
        return own[0] if len(own) else np.zeros_like(self.parts[2][0, :1])

    def sizes(self, m: int) -> Real:
        """Return the root (m,) of the sum of squares of the rows of each response."""
        squares = np.zeros(m)
        squares[self.response] = sum((part**2).sum(axis=(1, 2, 3)) for part in self.parts[2:])
        return np.sqrt(squares)

    def only(self, responses: Integer) -> "_Block":
        """Return the block without other responses."""
        stay = np.isin(self.response, responses)
        terms = [part[stay] for part in self.parts[2:]]
        return self._replace(parts=self.parts[:2] + terms, response=self.response[stay])


def _joined(blocks: Sequence[_Block], m: int, omega: Real, variables: Variables) -> ManyStruts:
    """Return the blocks one after the other, of equal responses among m the first alone."""
    first, sizes = np.arange(m), np.array([block.sizes(m) for block in blocks]).reshape(len(blocks), m)
    for i in range(m):
        near = (np.abs(sizes[:, :i] - sizes[:, i : i + 1]) <= 2 * _ALIKE * sizes[:, :i]).all(axis=0)
        others = np.flatnonzero(near & (first[:i] == np.arange(i))).tolist()
        first[i] = next((j for j in others if all(_alike(block, i, j) for block in blocks)), i)
    kept, channel = np.unique(first, return_inverse=True)
    blocks = [block.only(kept) for block in blocks]
    shapes = [(*block.parts[1].shape[:2], block.response.size) for block in blocks]
    v, n = len(variables.gain), omega.size
    rows = [part.reshape(-1, 2, n) for block in blocks for part in block.parts]
    return ManyStruts(
        omega,
        np.concatenate([np.empty((0, 2, n)), *rows]),
        np.array(shapes, dtype=np.int64).reshape(-1, 3),
        np.concatenate([np.empty(0, dtype=np.int64), *(channel[block.response] for block in blocks)]),
        channel.astype(np.int64),
        np.hstack([np.empty((v, 0)), *(block.gain.reshape(v, -1) for block in blocks)]),
        variables.order,
        variables.origin,
    )


def _alike(block: _Block, i: int, j: int) -> bool:
    """Whether two responses are equal in a block, but for the sign."""
    a, b = block.rows_of(i), block.rows_of(j)
    if a.shape != b.shape:
        return not (a.any() or b.any())
    return any(((a - sign * b) ** 2).sum() <= _ALIKE**2 * (b**2).sum() for sign in (1, -1))


def _parts(struts: Bool, by_road: Complex, roads: Complex) -> list[tuple[Integer, Integer]]:
    """Return struts and roads of each part without coupling to others, from struts (q, q) and roads (n, r, r)."""
    from scipy.sparse.csgraph import connected_components

    reached = _coupled(by_road)
    connected = np.block([[struts, reached], [reached.T, _coupled(roads)]])
    count, member = connected_components(connected, directed=False)
    q = len(struts)
    return [(np.flatnonzero(member[:q] == part), np.flatnonzero(member[q:] == part)) for part in range(count)]


def _coupled(matrices: Real | Complex) -> Bool:
    """Nonzero pattern (a, b) of matrices (n, a, b) over all n."""
    sizes = np.abs(matrices)
    return (sizes > _NOTHING * sizes.max(axis=(1, 2), keepdims=True, initial=0.0)).any(axis=0)


def _contributes(rows: Complex) -> Bool:
    """Return which inputs contribute to each response, (m, b) of rows (n, m, b)."""
    power = (np.abs(rows) ** 2).sum(axis=0)
    return power > _NOTHING**2 * power.sum(axis=1, keepdims=True)


def _cleared(by_road: Complex) -> Complex:
    """Return responses by roads (n, m, r), zero below rounding: as f -> 0 they vanish and the road diverges."""
    sizes = np.abs(by_road)
    return np.where(sizes > _ROUNDING * sizes.max(axis=(0, 2), keepdims=True, initial=0.0), by_road, 0.0)


def _without_rounding(gain: Real) -> Real:
    """Return gains (v, q, q), zero below rounding: a sum of two struts does not act on their difference."""
    sizes = np.abs(gain)
    return np.where(sizes > _ROUNDING * sizes.max(axis=(1, 2), keepdims=True, initial=0.0), gain, 0.0)


def _factor(spectrum: Complex, power: Real) -> Complex:
    """Return F (n, s, k) with F F^H = `spectrum` (n, s, s) of k sources above the rounding of `power` (n,)."""
    values, vectors = np.linalg.eigh(spectrum)
    present = values > _ROUNDING * power[:, None]
    return (vectors * np.sqrt(np.where(present, values, 0.0))[:, None, :])[:, :, present.any(axis=0)]


def _real_rows(values: Complex) -> Real:
    """Return real and imaginary parts in rows (a, b, 2, n) of complex values (n, a, b)."""
    values = np.moveaxis(values, 0, -1)
    return np.ascontiguousarray(np.stack([values.real, values.imag], axis=2))


def _sums_and_differences(opposite: Sequence[Sequence[int]]) -> Real:
    matrix, half = np.eye(len(opposite)), np.sqrt(0.5)
    for left, rights in enumerate(opposite):
        for right in rights:
            if matrix[left, left] == matrix[right, right] == 1:  # neither has a partner yet
                matrix[np.ix_([left, right], [left, right])] = [[half, half], [half, -half]]
    return matrix
