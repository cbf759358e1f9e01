"""Parts of a vehicle's struts as a supplier makes them: springs, dampers, stops and bars with their values."""

from collections.abc import Iterator, Mapping
from typing import NamedTuple

import numpy as np

from ..vehicles.assembly import Network, StrutCoefficient
from ..vehicles.force_laws import ForceLaw
from ..vehicles.strut_files import KINDS
from ..vehicles.struts import Element, Parallel, Series, Strut
from ..vehicles.vehicle import Vehicle

_BY_UNIT = {"N/m": "spring", "N s/m": "damper", "kg": "inerter", "N m/rad": "anti-roll bar"}


class Value(NamedTuple):
    """A coefficient of a part."""

    name: str  # of the vehicle's coefficient
    value: float
    unit: str


class Part(NamedTuple):
    """An element of the struts: so many pieces, alike on the left and on the right."""

    name: str
    kind: str
    pieces: int
    ratio: float | None  # deflection over that at the wheel; None in series and of a bar
    values: tuple[Value, ...]
    law: ForceLaw | None = None


def parts_of(vehicle: Vehicle, values: Mapping[str, float]) -> list[Part]:
    """Return the parts in the order of the coefficients, with all coefficients by name."""
    units = {one.name: one.unit for one in vehicle.strut_coefficients}
    plain = [_plain(one, values[one.name]) for one in vehicle.strut_coefficients if one.gain.any()]
    others = [part for network in vehicle.networks for part in _in_network(network, values, units)]
    order = list(units)
    return sorted([*plain, *others], key=lambda part: order.index(part.values[0].name))


def _plain(one: StrutCoefficient, value: float) -> Part:
    """Return the part of a spring, a damper or an inerter in parallel with others, or of a bar."""
    at = np.diagonal(one.gain)
    bar = np.count_nonzero(one.gain) > np.count_nonzero(at)  # it couples struts
    pieces, ratio = (1, None) if bar else (int(np.count_nonzero(at)), float(np.sqrt(at.max())))
    return Part(one.name, _BY_UNIT.get(one.unit, one.unit), pieces, ratio, (Value(one.name, value, one.unit),))


def _in_network(network: Network, values: Mapping[str, float], units: Mapping[str, str]) -> Iterator[Part]:
    words = {record: kind.replace("-", " ") for kind, record in KINDS.items()}
    for element, ratio in _placed(network.strut, 1.0):
        names = [network.prefix + one.name for one in element.coefficients]
        own = tuple(Value(name, values[name], units[name]) for name in names)
        law = element if isinstance(element, ForceLaw) else None
        pieces = int(np.count_nonzero(network.share))
        yield Part(network.prefix + element.name, words[type(element)], pieces, ratio, own, law)


def _placed(strut: Strut, ratio: float | None) -> Iterator[tuple[Element, float | None]]:
    """Yield the elements with their installation ratios, None of those in series, which share a deflection."""
    inner = None if ratio is None or isinstance(strut, Series) else ratio * strut.installation_ratio
    if isinstance(strut, Parallel):
        for part in strut.parts:
            yield from _placed(part, inner)
    else:
        yield strut.elements[0], inner
