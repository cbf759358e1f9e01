"""Modes of a vehicle with its struts: undamped, and followed to its dampers; names."""

from collections.abc import Iterator, Mapping
from dataclasses import replace
from functools import partial
from typing import TYPE_CHECKING

import numpy as np

from ..quantities import Complex, Real
from .assembly import Assembly, turning
from .feedback import Dynamics, gains_by_order
from .motion import plant_of

if TYPE_CHECKING:
    import pandas as pd

FREQUENCY, DAMPED, RATIO = "frequency [Hz]", "damped frequency [Hz]", "damping ratio [-]"
"""Columns of a table of modes."""
_STEPS = 200  # of the share of damping
_LIKE = 0.01  # of a pole, cost of a shape without likeness


def modes_of(assembly: Assembly, values: Mapping[str, float]) -> "pd.DataFrame":
    """Return `Vehicle.modes` at coefficients by name."""
    import pandas as pd

    undamped, shapes = _eigen(_matrix(assembly, values, 0.0))
    first = _pairs(undamped)
    names = _names(assembly, assembly.displacements @ _displacements(assembly, shapes[:, first[:, 0]]))
    poles, vectors = _followed(assembly, values, undamped[first], shapes[:, first.ravel()])
    rows = []
    for name, start, pair, vector in zip(names, undamped[first[:, 0]], poles, vectors.T, strict=True):
        shape = assembly.displacements @ _displacements(assembly, vector)
        rows.append(
            (name, abs(start) / (2 * np.pi), *_oscillation(pair), *(shape / shape[np.abs(shape).argmax()]))
        )
    table = pd.DataFrame(rows, columns=["name", FREQUENCY, DAMPED, RATIO, *assembly.movements])
    return table.sort_values(FREQUENCY, kind="stable", ignore_index=True)


def _oscillation(pair: Complex) -> tuple[float, float]:
    """Return damped frequency [Hz] and damping ratio [-] of a pair of poles; 0 Hz of two real ones."""
    product = abs(pair[0] * pair[1])
    ratio = float(-pair.sum().real / (2 * np.sqrt(product))) if product else np.nan
    return abs(float(pair[0].imag)) / (2 * np.pi), ratio


def _matrix(assembly: Assembly, values: Mapping[str, float], share: float) -> Real:
    """Return A (s, s) of the closed vehicle with a share of all dampers; coordinates and rates come first."""
    lighter = (
        tuple(link._replace(damping=share * link.damping) for link in links)
        for links in (assembly.tyres, assembly.supports)
    )
    tyres, supports = lighter
    plant = plant_of(replace(assembly, tyres=tyres, supports=supports), [])
    return np.asarray(_dynamics(assembly, values, share).around(plant).A)


def _dynamics(assembly: Assembly, values: Mapping[str, float], share: float) -> Dynamics:
    """Return the struts with a share of all dampers."""
    units = {one.name: one.unit for one in assembly.strut_coefficients}
    own = {name: value * (share if units[name] == "N s/m" else 1.0) for name, value in values.items()}
    gains = gains_by_order(assembly.strut_coefficients, own, len(assembly.struts))
    return Dynamics.of(assembly.networks, own, gains)


def _eigen(matrix: Real) -> tuple[Complex, Complex]:
    poles, vectors = np.linalg.eig(matrix)
    return poles.astype(complex), vectors.astype(complex)


def _displacements(assembly: Assembly, vectors: Complex) -> Complex:
    """Return the coordinates (n, ...) in eigenvectors (s, ...)."""
    return vectors[: 2 * len(assembly.coordinates) : 2]


def _pairs(poles: Complex) -> np.ndarray:
    """Return pairs (m, 2) of poles (2m,) by index: of conjugates that with a positive imaginary part first."""
    upper, lower, real = (np.flatnonzero(one) for one in (poles.imag > 0, poles.imag < 0, poles.imag == 0))
    upper = upper[np.lexsort((poles[upper].real, poles[upper].imag))]
    lower = lower[np.lexsort((poles[lower].real, -poles[lower].imag))]
    real = real[np.argsort(-poles[real].real)]
    return np.concatenate([np.column_stack([upper, lower]), real[: real.size // 2 * 2].reshape(-1, 2)])


def _followed(
    assembly: Assembly, values: Mapping[str, float], pairs: Complex, shapes: Complex
) -> tuple[Complex, Complex]:
    """Return the damped poles (m, 2) and the shapes (s, m) to which undamped pairs (m, 2) lead."""
    from scipy.optimize import linear_sum_assignment

    poles, before, coordinates = pairs.ravel(), pairs.ravel(), partial(_displacements, assembly)
    shapes = coordinates(shapes)
    for matrix in _damped(assembly, values):
        found, vectors = _eigen(matrix)
        unit = coordinates(vectors) / np.linalg.norm(coordinates(vectors), axis=0)
        likeness = np.abs((shapes / np.linalg.norm(shapes, axis=0)).conj().T @ unit)
        ahead = 2 * poles - before
        cost = np.abs(found - ahead[:, None]) + _LIKE * np.abs(poles)[:, None] * (1 - likeness)
        chosen = linear_sum_assignment(cost)[1]
        before, poles, shapes = poles, found[chosen], coordinates(vectors)[:, chosen]
    return _repaired(poles.reshape(-1, 2), vectors[:, chosen])


def _damped(assembly: Assembly, values: Mapping[str, float]) -> Iterator[Real]:
    """Yield A (s, s) with rising shares of all dampers, up to 1."""
    shares = np.linspace(0.0, 1.0, _STEPS + 1)[1:]
    none, whole = (_matrix(assembly, values, share) for share in (0.0, 1.0))
    by_filters = bool(_dynamics(assembly, values, 1.0).filters)  # else A is linear in the share
    for share in shares.tolist():
        if by_filters:
            yield _matrix(assembly, values, share)
        else:
            yield none + share * (whole - none)


def _repaired(pairs: Complex, vectors: Complex) -> tuple[Complex, Complex]:
    """Return pairs (m, 2) of conjugates or of real poles, and the shape (s, m) of the first of each.

    Real poles of two modes may have met and left the real axis together. A real one and that of elements in
    series, which belongs to no mode, may have too: then the mode has both of what they became.
    """
    pairs, vectors = pairs.copy(), vectors.copy()
    poles = pairs.ravel()
    for one in np.flatnonzero((poles.imag != 0) & ~np.isin(poles.conj(), poles)):
        poles[one ^ 1], vectors[:, one ^ 1] = poles[one].conj(), vectors[:, one].conj()
    index = np.arange(pairs.size).reshape(-1, 2)
    broken = np.abs(pairs[:, 0].conj() - pairs[:, 1]) > 0
    broken &= (pairs.imag != 0).any(axis=1)
    mixed = index[broken].ravel()
    index[broken] = mixed[_pairs(pairs.ravel()[mixed])]
    flat = pairs.ravel()[index]
    slower = np.where((flat.imag == 0).all(axis=1), flat.real.argmax(axis=1), flat.imag.argmax(axis=1))
    order = np.column_stack([slower, 1 - slower])
    index = np.take_along_axis(index, order, axis=1)
    return pairs.ravel()[index], vectors[:, index[:, 0]]


def _names(assembly: Assembly, shapes: Complex) -> list[str]:
    """Return a name of its own for each mode: the motions (m, k) with most of the kinetic energy, all at once."""
    from scipy.optimize import linear_sum_assignment

    labels, motions = zip(*motions_of(assembly).items(), strict=True)
    energy = np.column_stack([energy_along(motion, assembly.inertia, shapes) for motion in motions])
    share = energy / energy.sum(axis=1, keepdims=True)
    modes, chosen = linear_sum_assignment(-share)
    names = dict(zip(modes.tolist(), (labels[i] for i in chosen), strict=True))
    for i in range(len(share)):  # more modes than motions: of an inerter in series
        names.setdefault(i, f"{labels[int(share[i].argmax())]} {i + 1}")
    return [names[i] for i in range(len(share))]


def motions_of(assembly: Assembly) -> dict[str, Real]:
    """Return motions (m,) of masses and inertias by name; two wheels of an axle hop in phase and tramp opposed."""
    found: dict[str, Real] = {}
    at, inertia = {name: i for i, name in enumerate(assembly.movements)}, assembly.inertia
    unit = np.eye(len(at))
    for name, i in at.items():
        other = at.get(name.replace("_left_wheel", "_right_wheel"), i)
        if name.endswith("_left_wheel") and other != i:
            axle = name.removesuffix("_left_wheel").replace("_", " ")
            found[f"{axle} wheel hop"], found[f"{axle} wheel tramp"] = unit[i] + unit[other], unit[i] - unit[other]
        elif inertia[i] and not (name.endswith("_right_wheel") and name.replace("_right_", "_left_") in at):
            turned = {turning(name, motion) for motion in ("pitch", "roll")} & at.keys()
            plain = "heave" if name == "body" else f"{name} heave" if turned else name
            found[(f"{name} hop" if name.endswith("wheel") else plain).replace("_", " ")] = unit[i]
    return found


def energy_along(motion: Real, inertia: Real, shapes: Real | Complex) -> Real:
    """Return twice the kinetic energy (..., k) of shapes (..., m, k) in a motion (m,) at a rate of 1 rad/s."""
    return np.asarray(np.abs((motion * inertia) @ shapes) ** 2 / (motion**2 @ inertia))
