"""Signals of systems from elsewhere: their names here, units and signs, ``"front_strut [kN]"``.

A minus sign before the name turns the signal round: ``"-front_strut [N]"`` is a force positive in compression.
"""

import re
from collections.abc import Mapping, Sequence
from typing import NamedTuple

import control
import numpy as np

from .. import checks
from ..quantities import quantity, signal_unit
from .feedback import System, measured
from .plant_tables import input_unit

Names = Sequence[str] | Mapping[str, str]
"""Names of signals in their order, ``""`` for one without use, or by the model's own names."""

SIGNALS = {"inputs": "Input", "outputs": "Output", "states": "State"}
"""What MATLAB calls the signals of a system, as in ``InputName`` and ``InputUnit``."""

_SIGNAL = re.compile(r"\s*(-?)\s*([A-Za-z]\w{0,99})\s*(?:\[([^\[\]]{0,40})\])?\s*", re.ASCII)


_MODAL = "bending_"  # coordinates of modal mass 1, without a unit of length


class Signal(NamedTuple):
    """A signal of a model: its place there, its name here, and the SI value of one unit of the model."""

    place: int
    name: str
    factor: float


def own_label(name: str) -> str:
    """Return the name of a signal in another program as a signal of python-control, without dots."""
    return name.strip().replace(".", "_")


def units_of(system: System) -> dict[str, list[str]]:
    """Return the units of inputs, outputs and states, ``""`` where they are unknown."""
    return {
        "inputs": [input_unit(name) for name in system.input_labels],
        "outputs": [signal_unit(name) for name in system.output_labels],
        "states": ["" if name.startswith(_MODAL) else signal_unit(name) for name in system.state_labels],
    }


def renamed(system: System, inputs: Names | None, outputs: Names | None) -> System:
    """Return the system in SI units with these signals alone, by default all its own; ValueError for others."""
    given = _signals("inputs", inputs, system.input_labels)
    found = _signals("outputs", outputs, system.output_labels)
    columns, rows = ([one.place for one in signals] for signals in (given, found))
    by, of = (np.array([one.factor for one in signals]) for signals in (given, found))
    names = {"inputs": [one.name for one in given], "outputs": [one.name for one in found]}
    if isinstance(system, control.StateSpace):
        b, c, d = system.B[:, columns], system.C[rows], system.D[np.ix_(rows, columns)]
        d = of[:, None] * d / by
        return control.ss(system.A, b / by, of[:, None] * c, d, states=system.state_labels, **names)
    h = system.frdata[np.ix_(rows, columns)]
    for row, column in np.argwhere(np.isnan(h).all(axis=2))[:1]:
        output, cause = system.output_labels[rows[row]], system.input_labels[columns[column]]
        raise ValueError(f"system must have the response of {output} to {cause}, got none")
    return measured((of[:, None] / by)[:, :, None] * h, system.omega, **names)


def _signals(parameter: str, given: Names | None, labels: Sequence[str]) -> list[Signal]:
    """Return the signals in use, in the order of the names; `parameter` is ``inputs`` or ``outputs``."""
    if given is None:
        return [Signal(i, name, 1.0) for i, name in enumerate(labels)]
    if isinstance(given, Mapping):
        for own in given:
            checks.one_of(parameter, own_label(str(own)), labels)
        texts = [(labels.index(own_label(own)), text) for own, text in given.items()]
    else:
        checks.listed(parameter, given)
        if len(given) != len(labels):
            needed = f"{len(labels)} names, one for each of {checks.shown(list(labels))}"
            raise ValueError(f"{parameter} must be {needed}, got {len(given)}")
        texts = list(enumerate(given))
    signals = [_signal(parameter, *one) for one in texts if one[1] != ""]
    names = [one.name for one in signals]
    if not names or len(set(names)) < len(names):
        got = f"{max(names, key=names.count)!r} twice" if names else "none"
        raise ValueError(f"{parameter} must be names that differ, got {got}")
    return signals


def _signal(parameter: str, place: int, text: str) -> Signal:
    found = _SIGNAL.fullmatch(text) if isinstance(text, str) else None
    if not found:
        example = "front_strut [N]" if parameter == "inputs" else "front_deflection [mm]"
        raise ValueError(f"{parameter} must be texts like {example!r}, got {checks.shown(text)}")
    sign, name, unit = found.groups()
    known = input_unit(name) if parameter == "inputs" else signal_unit(name)
    if known and not unit:
        raise ValueError(f"{name} must have its unit, as in '{name} [{known}]', got {checks.shown(text)}")
    factor = quantity(name, f"1 {unit}", known) if unit else 1.0
    return Signal(place, name, -factor if sign else factor)
