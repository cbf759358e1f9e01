"""Networks of a vehicle's struts: the parts beside plain springs and dampers, as data of compiled loops.

A strut's springs, dampers and inerters directly in parallel are coefficients of gains, see `StrutCoefficient`. All
else, series, rubber and force laws, is a network at each of the strut's ports.
"""

from collections.abc import Iterator, Mapping, Sequence
from typing import NamedTuple, TypeVar

import numpy as np

from ..compiled import compilable
from ..quantities import Bool, Integer, Real
from .assembly import Network, StrutCoefficient
from .elements import Damper, Inerter, LinearElement, MeasuredStiffness, Rubber, Spring
from .force_laws import Curve, ForceLaw
from .stops import BumpStop
from .struts import Element, Parallel, Series, Strut

SPRING, DAMPER, INERTER, RUBBER, MEASURED, LAW, PARALLEL, SERIES = range(8)
"""Kinds of nodes of a program."""

_KINDS = {Spring: SPRING, Damper: DAMPER, Inerter: INERTER, Rubber: RUBBER, MeasuredStiffness: MEASURED}
_NONE = -1
E = TypeVar("E", bound=Element)


def placed(strut: Strut, prefix: str, share: Sequence[float]) -> tuple[list[StrutCoefficient], list[Network]]:
    """Return coefficients and network of a strut at the ports whose `share` (q,) is 1; names after the prefix."""
    top = isinstance(strut, Parallel) and not isinstance(strut, Series)
    parts = strut.parts if isinstance(strut, Parallel) and top else (strut,)
    ratio = strut.installation_ratio if top else 1.0
    gain, dot = np.diag(np.asarray(share, dtype=float)), f"{prefix}." if prefix else ""
    coefficients = []
    for part in parts:
        for one in part.coefficients:
            plain = isinstance(part, LinearElement)
            own = gain * (ratio * part.installation_ratio) ** 2 if plain else np.zeros_like(gain)
            order = part.order if isinstance(part, LinearElement) else 0
            coefficients.append(
                StrutCoefficient(dot + one.name, one.unit, own, order, one.default, dot, ratio if top else None)
            )
    rest = tuple(part for part in parts if not isinstance(part, LinearElement))
    if not rest:
        return coefficients, []
    return coefficients, [Network(Parallel(rest, installation_ratio=ratio), dot, tuple(map(float, share)))]


class Laws(NamedTuple):
    """Force laws as curves of up to k knots, see `force_laws.Curve`, by coefficients of the vehicle.

    A number of a curve is a constant plus a factor times up to two coefficients; index -1 stands for 1.
    """

    of_rate: Bool  # (l,), whether of the rate or of the deflection
    most: Integer  # (l,), number of knots
    number: Real  # (l, 3, k + 1, 2), constant and factor of knots, slopes and jumps
    by: Integer  # (l, 3, k + 1, 2), coefficients of the factor
    power: Integer  # (l, 2), coefficients c and a of c |v|^a, -1 without


class Program(NamedTuple):
    """Networks as nodes; parts come before the node that they make up."""

    kind: Integer  # (n,)
    parts: Integer  # (n, 2), nodes in parallel or series
    ratio: Real  # (n,), installation ratio
    coefficient: Integer  # (n, 2), coefficients of the vehicle; of MEASURED the scale and its row
    law: Integer  # (n,), law of a node of that kind
    root: Integer  # (t,), last node of each network
    laws: Laws

    @classmethod
    def of(cls, networks: Sequence[Network], coefficients: Sequence[str]) -> "Program":
        """Return the program of networks, with indices of the vehicle's coefficients."""
        index, rows, laws = {name: i for i, name in enumerate(coefficients)}, list[_Node](), list[ForceLaw]()
        roots, owners = [], list[Network]()
        for network in networks:
            roots.append(_append(network.strut, network.prefix, index, rows, laws))
            owners += [network] * (len(laws) - len(owners))
        columns = [np.array(column) for column in zip(*rows, strict=True)] if rows else [np.empty(0)] * 5
        kind, parts, ratio, coefficient, law = columns
        return cls(
            kind.astype(np.int64),
            parts.astype(np.int64).reshape(-1, 2),
            ratio.astype(float),
            coefficient.astype(np.int64).reshape(-1, 2),
            law.astype(np.int64),
            np.array(roots, dtype=np.int64),
            _laws_of([_indexed(law, owner.prefix, index) for law, owner in zip(laws, owners, strict=True)], laws),
        )


class _Node(NamedTuple):
    kind: int
    parts: tuple[int, int]
    ratio: float
    coefficient: tuple[int, int]
    law: int


def _append(strut: Strut, prefix: str, index: Mapping[str, int], rows: list[_Node], laws: list[ForceLaw]) -> int:
    """Append the nodes of a strut and return the last."""
    ratio = strut.installation_ratio
    if isinstance(strut, Parallel):
        kind = SERIES if isinstance(strut, Series) else PARALLEL
        last, *others = [_append(part, prefix, index, rows, laws) for part in strut.parts]
        for part in others:
            rows.append(_Node(kind, (last, part), 1.0, (_NONE, _NONE), _NONE))
            last = len(rows) - 1
        rows[last] = rows[last]._replace(ratio=rows[last].ratio * ratio)
        return last
    own = [index[prefix + one.name] for one in strut.coefficients]
    if isinstance(strut, ForceLaw):
        laws.append(strut)
        rows.append(_Node(LAW, (_NONE, _NONE), ratio, (_NONE, _NONE), len(laws) - 1))
    else:
        row = sum(node.kind == MEASURED for node in rows) if isinstance(strut, MeasuredStiffness) else _NONE
        pair = (own[0], own[1] if len(own) > 1 else row)
        rows.append(_Node(_KINDS[type(strut)], (_NONE, _NONE), ratio, pair, _NONE))
    return len(rows) - 1


def elements_of(networks: Sequence[Network], kind: type[E]) -> Iterator[tuple[Network, E]]:
    """Yield the elements of a class in the order of `Program`, each with its network."""
    for network in networks:
        yield from ((network, element) for element in network.strut.elements if isinstance(element, kind))


def has_force_laws(networks: Sequence[Network]) -> bool:
    """Whether a force law is among the elements of networks."""
    return any(isinstance(element, ForceLaw) for network in networks for element in network.strut.elements)


def gap_of_stop(networks: Sequence[Network], strut: int, kind: type[BumpStop]) -> tuple[str, float] | None:
    """Return the coefficient of the gap of a strut's first stop, and its compression by that at the wheel.

    Stops in series with other elements do not count: their gap is no travel of the wheel.
    """
    for network in networks:
        parts = network.strut.parts if type(network.strut) is Parallel and network.share[strut] else ()
        for part in parts:
            if type(part) is kind:
                ratio = network.strut.installation_ratio * part.installation_ratio
                return f"{network.prefix}{part.name}.gap", ratio
    return None


def _indexed(law: ForceLaw, prefix: str, index: Mapping[str, int]) -> tuple[Curve, list[int]]:
    return law.curve, [index[prefix + one.name] for one in law.coefficients]


def _laws_of(curves: Sequence[tuple[Curve, list[int]]], laws: Sequence[ForceLaw]) -> Laws:
    """Return curves in arrays, padded to the most knots."""
    n, k = len(curves), max((len(curve.knots) for curve, _ in curves), default=0)
    number, by, power = np.zeros((n, 3, k + 1, 2)), np.full((n, 3, k + 1, 2), _NONE), np.full((n, 2), _NONE)
    for law, (curve, own) in enumerate(curves):
        slopes, jumps = ([(0.0, one) for one in rows] for rows in (curve.slopes, curve.jumps))
        for part, rows in enumerate((curve.knots, slopes, jumps)):
            for i, (constant, (factor, factors)) in enumerate(rows):
                number[law, part, i] = constant, factor
                by[law, part, i, : len(factors)] = [own[j] for j in factors]
        if curve.power:
            power[law] = [own[j] for j in curve.power]
    count = np.array([len(curve.knots) for curve, _ in curves], dtype=np.int64)
    return Laws(np.array([law.of_rate for law in laws], dtype=bool), count, number, by, power)


@compilable()
def fill_curve(laws: Laws, law: int, values: Real, curve: Real) -> None:
    """Fill in knots, slopes and jumps (3, k + 1) of a law at these coefficients."""
    number, by = laws.number, laws.by
    for part in range(3):
        for i in range(curve.shape[1]):
            factor = number[law, part, i, 1]
            for j in range(2):
                if by[law, part, i, j] >= 0:
                    factor *= values[by[law, part, i, j]]
            curve[part, i] = number[law, part, i, 0] + factor
