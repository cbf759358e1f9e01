"""Further ports of a vehicle, for parameters that vary, with the slots of their coefficients in formulas."""

from collections.abc import Mapping, Sequence
from dataclasses import replace

import numpy as np

from .assembly import Assembly, Link, StrutCoefficient, turning
from .formulas import Sheet
from .parameters import Ported


def added(name: str) -> str:
    """Return the name of the coefficient of a parameter's ports."""
    return f"{name} added"


class AddedPorts:
    """An assembly with further ports in the making, and the slots of their coefficients."""

    def __init__(self, base: Assembly) -> None:
        self._base, self._links = base, list(base.struts)
        self._entries: list[tuple[str, int, list[tuple[int, int, float]]]] = []
        self.slots: dict[str, int] = {}

    def add(self, one: Ported, slot: int) -> None:
        """Add a port for each place of a parameter; the coefficient of all is in a slot."""
        first = len(self._links)
        self._links += one.links(self._base)
        self._entry(added(one.name), one.order, [(i, i, 1.0) for i in range(first, len(self._links))], slot)

    def turn(
        self,
        strut: str,
        body: str,
        axes: Sequence[int],
        moved: Sequence[int],
        sheet: Sheet,
        slots: Mapping[str, int],
    ) -> None:
        """Add ports of pitch (axis 0) and roll (1) to a strut that is moved by the values in slots."""
        port = [one.name for one in self._base.struts].index(strut)
        if any(network.share[port] for network in self._base.networks):
            raise ValueError(f"{strut} must have a strut of springs and dampers to be moved, got another")
        turns = [len(self._links) + i for i in range(len(axes))]
        angles = [turning(body, ("pitch", "roll")[axis]) for axis in axes]
        self._links += [Link(f"{strut}_{angle}", None, angle) for angle in angles]
        ends = [
            (port, 1.0, {}),
            *((i, (1.0, -1.0)[axis], {slot: 1.0}) for i, axis, slot in zip(turns, axes, moved, strict=True)),
        ]
        for one in self._base.strut_coefficients:
            if gain := float(one.gain[port, port]):
                for a in range(len(ends)):
                    for b in range(max(a, 1), len(ends)):
                        (i, sign, by), (j, other, and_by) = ends[a], ends[b]
                        powers = {s: by.get(s, 0.0) + and_by.get(s, 0.0) for s in (*by, *and_by)}
                        slot = sheet.sum((1.0, {slots[one.name]: 1.0, **powers}))
                        both = {(i, j), (j, i)}
                        cells = [(*cell, gain * sign * other) for cell in both]
                        self._entry(
                            f"{one.name} at {self._links[i].name} and {self._links[j].name}",
                            one.order,
                            cells,
                            slot,
                        )

    def _entry(self, name: str, order: int, cells: list[tuple[int, int, float]], slot: int) -> None:
        self._entries.append((name, order, cells))
        self.slots[name] = slot

    def assembly(self) -> Assembly:
        """Return the assembly with its ports."""
        q, more = len(self._links), len(self._links) - len(self._base.struts)
        own = [replace(one, gain=np.pad(one.gain, (0, more))) for one in self._base.strut_coefficients]
        for name, order, cells in self._entries:
            gain = np.zeros((q, q))
            for i, j, value in cells:
                gain[i, j] = value
            own.append(StrutCoefficient(name, "", gain, order, 0.0))
        networks = (one._replace(share=(*one.share, *[0.0] * more)) for one in self._base.networks)
        return replace(
            self._base,
            struts=tuple(self._links),
            strut_coefficients=tuple(own),
            networks=tuple(networks),
        )
