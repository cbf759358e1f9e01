"""Blocks of struts of random numbers, and their mean squares and derivatives by numpy."""

from collections.abc import Sequence

import numpy as np

import suspension_ctrl as sc
from suspension_ctrl.response.any_struts import AnyStruts
from suspension_ctrl.response.many_struts import ManyStruts
from suspension_ctrl.response.strut_data import networks_of

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


def with_slopes(
    struts: ManyStruts, design: np.ndarray, networks: Sequence[np.ndarray] = ()
) -> tuple[np.ndarray, np.ndarray]:
    """Return the mean squares (cases k,) of a design (v,), and their derivatives (cases k, v + t).

    The last are by factors of the dynamic stiffnesses (n,) of t networks, whose gains follow those of variables.
    """
    complex_rows = struts.rows[:, 0] + 1j * struts.rows[:, 1]
    powers = np.array([*(1j * struts.omega) ** struts.order[:, None], *networks])
    added = np.append(design - struts.origin, np.ones(len(networks)))
    channels = struts.channel.max() + 1
    squares, slopes = np.zeros((struts.cases, channels)), np.zeros((struts.cases, channels, added.size))
    row = entry = output = 0
    for q, s, k in struts.sizes.tolist():
        p, by_source, r, t = (
            complex_rows[row + sum(before) : row + sum(before) + a * b].T.reshape(-1, a, b)
            for before, (a, b) in (
                ((0,), (q, q)), ((q * q,), (q, s)), ((q * q, q * s), (k, s)), ((q * q, q * s, k * s), (k, q))
            )
        )  # fmt: skip
        gain = struts.gain[:, entry : entry + q * q].reshape(-1, q, q)
        d = np.einsum("v,vn,vij->nij", added, powers, gain)
        e = np.linalg.solve(np.eye(q) - p @ d, by_source)
        y, h = r + t @ d @ e, t @ np.linalg.inv(np.eye(q) - d @ p)
        changes = np.einsum("nks,nki,vij,njs,vn->ksv", y.conj(), h, gain, e, powers)
        for case in range(struts.cases):
            own = slice(case * s // struts.cases, (case + 1) * s // struts.cases)
            for i, channel in enumerate(struts.response[output : output + k]):
                squares[case, channel] += (np.abs(y[:, i, own]) ** 2).sum()
                slopes[case, channel] += 2 * changes[i, own].real.sum(axis=0)
        row, entry, output = row + (q + k) * (q + s), entry + q * q, output + k
    return squares[:, struts.channel].ravel(), slopes[:, struts.channel].reshape(-1, added.size)


def on_mounts(struts: ManyStruts, values: np.ndarray) -> tuple[AnyStruts, list[np.ndarray]]:
    """Return these struts with a network in all entries of D that vary, and its stiffness and derivatives (n,).

    A damper on rubber beside an inerter, whose coefficients (4,) are the variables of the struts too.
    """
    car = sc.QuarterCar(body_mass=300.0, wheel_mass=30.0, tyre_stiffness=2e5, strut=sc.parallel(
        sc.Spring("k", 2e4), sc.series(sc.Damper("d"), sc.parallel(sc.Rubber("r"), sc.Inerter("b"))),
        installation_ratio=0.7))  # fmt: skip
    names = [one.name for one in car.strut_coefficients if one.name != "k"]
    setting = {"k": 2e4, **dict(zip(names, values, strict=True))}
    networks = networks_of(car, setting, names, struts.omega / (2 * np.pi), np.eye(1) > 0)
    gain = struts.gain.any(axis=0) * np.linspace(0.5, 1.5, struts.gain.shape[1])
    nothing, density = np.zeros((1, 2)), np.zeros((2, struts.omega.size))
    case = AnyStruts(struts._replace(gain=np.vstack([struts.gain, gain])), networks, nothing, density, np.ones(1))
    s = 1j * struts.omega
    a, b = values[0] * s, values[1] + 1j * values[2] + values[3] * s**2
    slopes = [b**2 * s, a**2, 1j * a**2, a**2 * s**2]
    return case, [0.49 * one for one in (a * b / (a + b), *(slope / (a + b) ** 2 for slope in slopes))]
