"""A vehicle on its road, taken apart into struts that feel one another.

What has nothing to do with each other is solved apart: on a vehicle with left and right alike the halves in phase
and out of phase, each with half of the struts.
"""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.sparse.csgraph import connected_components

from ..quantities import Complex, Real
from ..vehicles.assembly import StrutParameter
from .many_struts import StrutBlock
from .ports import Ports

_NOTHING = 1e-11
"""Share of the largest value of its kind at the same frequency below which a coupling is rounding."""

_ALIKE = 1e-9
"""Share of a response by which another may differ that is taken for the same."""

_ROUNDING = 1e-13
"""Share of the road's power that a difference of its spectra may be off by, and of a response's largest value."""


def strut_blocks(
    ports: Ports, omega: Real, roads: Complex, densities: Real, variables: "Variables", pairs: "Pairs"
) -> tuple[tuple[StrutBlock, ...], NDArray[np.int64]]:
    """Take a vehicle on its road apart into blocks that do not feel one another.

    Parameters
    ----------
    ports : Ports
        At n frequencies, around the struts at `variables.origin`.
    omega : (n,) ndarray
        Angular frequencies [rad/s].
    roads : (n, r, r) complex ndarray
        Cross-spectrum of the roads.
    densities : (m, n) ndarray
        What multiplies each response's squared magnitude in its integral.
    variables : Variables
        Of the struts.
    pairs : Pairs
        Which struts and roads are left and right of an axle.

    Returns
    -------
    blocks : tuple of StrutBlock
    channel : (m,) ndarray
        Where the mean square of each response stands: two that are alike, left and right, are worked out once.
    """
    m, r, (p, x) = ports.m, ports.r, pairs
    stiffness, damping = p @ variables.stiffness @ p.T, p @ variables.damping @ p.T
    touched = (_coupled(stiffness) | _coupled(damping)).any(axis=0)
    p, stiffness, damping = p[touched], stiffness[:, touched][:, :, touched], damping[:, touched][:, :, touched]
    deflections, feedback = _cleared(p @ ports.h[:, m:, :r] @ x.T), p @ ports.h[:, m:, r:] @ p.T
    roads, root = x @ roads @ x.T, np.sqrt(densities.T)[:, :, None]
    rows, from_struts = root * _cleared(ports.h[:, :m, :r] @ x.T), root * (ports.h[:, :m, r:] @ p.T)
    power = roads.trace(axis1=1, axis2=2).real
    count, member = _parted(_coupled(feedback) | _coupled(stiffness) | _coupled(damping), deflections, roads)
    blocks = []
    for block in range(count):
        q, s = np.flatnonzero(member[: len(p)] == block), np.flatnonzero(member[len(p) :] == block)
        factor = _factor(roads[:, s][:, :, s], power)
        heard = _audible(rows)[:, s].any(axis=1) | _audible(from_struts)[:, q].any(axis=1)
        if factor.shape[2] and heard.any():
            k = np.flatnonzero(heard)
            blocks.append(
                StrutBlock(
                    omega,
                    _apart(feedback[:, q][:, :, q]),
                    _apart(deflections[:, q][:, :, s] @ factor),
                    _apart(rows[:, k][:, :, s] @ factor),
                    _apart(from_struts[:, k][:, :, q]),
                    k,
                    np.ascontiguousarray(stiffness[:, q][:, :, q]),
                    np.ascontiguousarray(damping[:, q][:, :, q]),
                    variables.origin,
                )
            )
    return _without_doubles(blocks, m)


def _parted(struts: NDArray[np.bool_], deflections: Complex, roads: Complex) -> tuple[int, NDArray[np.int64]]:
    """Return how many parts struts and roads fall into, and the part (q + r,) of each."""
    reached = _coupled(deflections)
    count, member = connected_components(
        np.block([[struts, reached], [reached.T, _coupled(roads)]]), directed=False
    )
    return count, member.astype(np.int64)


def _without_doubles(blocks: Sequence[StrutBlock], m: int) -> tuple[tuple[StrutBlock, ...], NDArray[np.int64]]:
    """Leave out each response (m,) whose rows are in every block those of another one but for the sign."""
    first = np.arange(m)
    for i in range(m):
        for j in range(i):
            if first[j] == j and all(_alike(block, i, j) for block in blocks):
                first[i] = j
                break
    kept = np.unique(first)
    channel = np.searchsorted(kept, first)
    thinned = []
    for block in blocks:
        stays = np.isin(block.response, kept)
        thinned.append(
            block._replace(
                rows=block.rows[stays],
                from_struts=block.from_struts[stays],
                response=channel[block.response[stays]],
            )
        )
    return tuple(thinned), channel


def _alike(block: StrutBlock, i: int, j: int) -> bool:
    """Whether two responses are the same in a block but for the sign."""
    both = [np.flatnonzero(block.response == k) for k in (i, j)]
    if any(rows.size == 0 for rows in both):
        return all(rows.size == 0 for rows in both)
    parts = [(values[both[0][0]], values[both[1][0]]) for values in (block.rows, block.from_struts)]
    return any(all(((a - sign * b) ** 2).sum() <= _ALIKE**2 * (b**2).sum() for a, b in parts) for sign in (1, -1))


def _coupled(matrices: NDArray[np.number]) -> NDArray[np.bool_]:
    """Which rows (a,) of matrices (n, a, b) have to do with which columns (b,)."""
    sizes = np.abs(matrices)
    return (sizes > _NOTHING * sizes.max(axis=(1, 2), keepdims=True, initial=0.0)).any(axis=0)


def _audible(rows: Complex) -> NDArray[np.bool_]:
    """Which columns (b,) have a part in the mean square of which responses, each judged for itself, (m, b)."""
    power = (np.abs(rows) ** 2).sum(axis=0)
    return power > _NOTHING**2 * power.sum(axis=1, keepdims=True)


def _cleared(by_road: Complex) -> Complex:
    """Return responses by roads (n, m, r) without what is below rounding of each.

    Towards frequency zero a vehicle rides undeformed over ever higher roads.
    """
    sizes = np.abs(by_road)
    return np.where(sizes > _ROUNDING * sizes.max(axis=(0, 2), keepdims=True, initial=0.0), by_road, 0.0)


def _factor(spectrum: Complex, power: Real) -> Complex:
    """Return F (n, s, k) with F F^H = `spectrum` (n, s, s), as few columns as there are independent sources.

    What is below rounding of the whole road's `power` (n,) is nothing: towards frequency zero wheels move as one,
    and the road is so high that a vehicle would feel the rounding of their differences.
    """
    values, vectors = np.linalg.eigh(spectrum)
    present = values > _ROUNDING * power[:, None]
    return (vectors * np.sqrt(np.where(present, values, 0.0))[:, None, :])[:, :, present.any(axis=0)]


def _apart(values: Complex) -> Real:
    """Return real and imaginary parts in rows (a, b, 2, n) of complex values (n, a, b)."""
    values = np.moveaxis(values, 0, -1)
    return np.ascontiguousarray(np.stack([values.real, values.imag], axis=2))


class Variables(NamedTuple):
    """Coefficients of struts that vary.

    Parameters
    ----------
    stiffness, damping : (v, q, q) ndarray
        Tensions by deflections and by their rates, of each coefficient.
    origin : (v,) ndarray
        Their values in the struts that are in place already.
    """

    stiffness: Real
    damping: Real
    origin: Real

    @classmethod
    def of(
        cls, parameters: Sequence[StrutParameter], names: Sequence[str], origin: Sequence[float]
    ) -> "Variables":
        """Take those called `names` (v,) out of the coefficients of a vehicle."""
        by_name = {parameter.name: parameter for parameter in parameters}
        stiffness, damping = (
            np.array([by_name[name].gain * (by_name[name].order == order) for name in names]) for order in (0, 1)
        )
        return cls(stiffness, damping, np.array(origin, dtype=float))


class Pairs(NamedTuple):
    """Orthogonal matrices (q, q), (r, r) that make sums and differences of what is left and right of an axle."""

    struts: Real
    roads: Real

    @classmethod
    def of(cls, struts: Sequence[str], contact_points: Real) -> "Pairs":
        """Find them by the names of the struts and the places of the roads (r, 2)."""
        mirrored = [name.replace("left", "right") for name in struts]
        opposite = [
            [i for i, name in enumerate(struts) if name == mirror and name != struts[k]]
            for k, mirror in enumerate(mirrored)
        ]
        beside = [
            [i for i, (x, y) in enumerate(contact_points) if x == here[0] and y == -here[1] and y < 0]
            for here in contact_points
        ]
        return cls(_sums_and_differences(opposite), _sums_and_differences(beside))


def _sums_and_differences(opposite: Sequence[Sequence[int]]) -> Real:
    matrix, half = np.eye(len(opposite)), np.sqrt(0.5)
    for left, rights in enumerate(opposite):
        for right in rights:
            if matrix[left, left] == matrix[right, right] == 1:  # neither has a partner yet
                matrix[np.ix_([left, right], [left, right])] = [[half, half], [half, -half]]
    return matrix
