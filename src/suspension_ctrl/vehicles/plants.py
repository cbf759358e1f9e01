"""Vehicles known by their measured frequency responses in place of masses and links."""

import re
from collections.abc import Sequence
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..quantities import signal_unit
from ..tables import read_table
from .assembly import Response

if TYPE_CHECKING:
    from os import PathLike

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Any

import control
from numpy.typing import ArrayLike

from .. import checks
from .assembly import Assembly, Position, ResponseName, StrutParameter, joined, label
from .vehicle import Car, Settings, around, check_measured, spring_and_damper

if TYPE_CHECKING:
    from os import PathLike


Transfer = dict[tuple[str, str], NDArray[np.complex128]]
"""Frequency responses (n,) by output and input."""

FREQUENCY = "frequency [Hz]"
_COLUMN = re.compile(r"([\w-]+)/(\w+) (real|imag) \[(.*)\]", re.ASCII)
_INPUT = re.compile(r"(?:(\w+)_)?(road|strut)", re.ASCII)
_OUTPUT = re.compile(r"(?:(\w+)_)?(acceleration|tyre_load|deflection)", re.ASCII)
_POINT = re.compile(r"acceleration_at_(-?\d{1,6})_(-?\d{1,6})_mm", re.ASCII)
_KINDS = {"acceleration": "acceleration", "tyre_load": "load", "deflection": "travel"}


class Input(NamedTuple):
    """A ``road`` or a ``strut``, and its name."""

    kind: str
    where: str

    @property
    def unit(self) -> str:
        """Its unit."""
        return {"road": "m", "strut": "N"}[self.kind]


def input_of(name: str) -> Input:
    """Return which input a name means; ValueError if none."""
    found = _INPUT.fullmatch(name)
    if not found:
        raise ValueError(f"input must be like 'front_road' or 'front_strut', got {name!r}")
    return Input(found[2], found[1] or "")


def output_of(name: str) -> Response:
    """Return which output a name means, of a deflection the travel; ValueError if none."""
    if point := _POINT.fullmatch(name):
        return Response("acceleration", (int(point[1]) / 1e3, int(point[2]) / 1e3))
    found = _OUTPUT.fullmatch(name)
    if not found or name == "acceleration":
        raise ValueError(
            "output must be like 'body_acceleration', 'acceleration_at_1200_-400_mm', 'front_tyre_load' or "
            f"'front_deflection', got {name!r}"
        )
    return Response(_KINDS[found[2]], found[1] or "")


def read_plant(path: "str | PathLike[str]") -> tuple[NDArray[np.float64], Transfer]:
    """Read a table.

    Parameters
    ----------
    path : path-like
        CSV file (see `plant_tables`).

    Returns
    -------
    (n,) ndarray, dict of (str, str) to (n,) complex ndarray
        Lines [Hz], and frequency responses by output and input.

    Raises
    ------
    ValueError
        Naming the file, if columns are missing, unknown, there twice or of another unit, or a cell is no finite
        number.
    OSError
        If the file cannot be read.
    """
    names, values = read_table(path)
    if names[0] != FREQUENCY:
        raise ValueError(f"{path}: first column must be {FREQUENCY!r}, got {names[0]!r}")
    try:
        return values[:, 0], _transfer(names[1:], values[:, 1:])
    except ValueError as error:
        raise ValueError(f"{path}: {error}") from None


def _transfer(names: Sequence[str], values: NDArray[np.float64]) -> Transfer:
    parts = {}
    for name, column in zip(names, values.T, strict=True):
        part = _part(name)
        if part in parts:
            raise ValueError(f"column must be there once, got {name!r} twice")
        parts[part] = column
    for output, given, which in parts:
        other = "imag" if which == "real" else "real"
        if (output, given, other) not in parts:
            raise ValueError(f"column {output}/{given} {which} must have one beside it called {other}, got none")
    pairs = dict.fromkeys((output, given) for output, given, _ in parts)
    return {pair: parts[*pair, "real"] + 1j * parts[*pair, "imag"] for pair in pairs}


def _part(name: str) -> tuple[str, str, str]:
    """Return what is in a column: output, input and whether the real or the imaginary part."""
    found = _COLUMN.fullmatch(name)
    if not found:
        raise ValueError(f"column must be like 'body_acceleration/front_road real [m/s^2/m]', got {name!r}")
    output, given, part, unit = found.groups()
    output_of(output)  # whether it is one
    right = f"{signal_unit(output)}/{input_of(given).unit}"
    if unit != right:
        raise ValueError(f"column {output}/{given} {part} must be in {right}, got {unit!r}")
    return output, given, part


_LEAST = 4
"""Lines that a cubic spline needs."""
_CLOSEST = 1e-6
"""Least distance of lines [Hz], of which no power is beyond what numbers can be."""


class MeasuredResponse(control.FrequencyResponseData):  # type: ignore[misc]  # python-control has no types
    """Frequency responses that do not go on beyond the lines that were measured."""

    def eval(self, omega: Any, squeeze: bool | None = None) -> Any:
        """Return them at angular frequencies [rad/s]; ValueError if one of these lies beyond."""
        check_measured(np.atleast_1d(omega).real, self.omega)
        return super().eval(omega, squeeze=squeeze)


@dataclass(frozen=True, kw_only=True, eq=False)
class MeasuredPlant(Car):
    """A vehicle that is known, without its struts, by a table of frequency responses.

    Between the lines of the table real and imaginary parts are cubic splines over frequency, beyond them they are
    not known. Where the vehicle without its struts has little damping, as a wheel on its tyre, lines have to be
    close: with lines h apart the spline is off by up to (h/b)^4/3 of a resonance of half width b.

    Its struts have the coefficients ``<strut>.spring`` and ``<strut>.damper``. What takes masses is not known:
    static loads (DLC), roll and modes, and seats cannot be put on it.

    Parameters
    ----------
    frequency : (n,) array_like
        Lines, four or more, above zero and ascending by 1e-6 Hz or more [Hz].
    transfer : mapping of (str, str) to (n,) array_like
        Complex frequency response of each output by each input, with names and units as in `plant_tables`.
        What is in files of other formats, such as universal files read by pyuff, is given here.
    contacts : mapping of str to Position
        Where each road among the inputs touches the ground, x forward and y to the left [m].

    Raises
    ------
    ValueError
        If lines or values are not as above, a name means nothing, a pair is missing, deflections are not those of
        the struts, contacts not those of the roads, or there is no road or no strut.
    """

    frequency: ArrayLike
    transfer: Mapping[tuple[str, str], ArrayLike]
    contacts: Mapping[str, Position]

    def __post_init__(self) -> None:
        lines = np.array(self.frequency, dtype=float)
        if lines.ndim != 1 or lines.size < _LEAST or not np.isfinite(lines).all():
            raise ValueError(f"frequency must be {_LEAST} finite values or more, got {lines.size}")
        if not (steps := np.diff(lines, prepend=0.0)).min() >= _CLOSEST:
            raise ValueError(
                f"frequency must ascend from 0 Hz in steps >= {_CLOSEST:g} Hz, got {steps.min():g} Hz"
            )
        object.__setattr__(self, "frequency", lines)
        values = {pair: np.array(h, dtype=complex) for pair, h in self.transfer.items()}
        for (output, given), h in values.items():
            if h.shape != lines.shape or not np.isfinite(h).all():
                raise ValueError(f"transfer must be {lines.size} finite values, got others for {output}/{given}")
        object.__setattr__(self, "transfer", values)
        self._check_names()

    @classmethod
    def from_csv(cls, path: "str | PathLike[str]", contacts: Mapping[str, Position]) -> "MeasuredPlant":
        """Read a table.

        Parameters
        ----------
        path : path-like
            CSV file (see `plant_tables`).
        contacts : mapping of str to Position
            As above.

        Raises
        ------
        ValueError
            Naming the file, if it is no such table or what it holds is not a plant.
        OSError
            If the file cannot be read.
        """
        frequency, transfer = read_plant(path)
        try:
            return cls(frequency=frequency, transfer=transfer, contacts=contacts)
        except ValueError as error:
            raise ValueError(f"{path}: {error}") from None

    def assembly(self) -> Assembly:
        """Raise ValueError: masses and links are not known."""
        raise ValueError(
            "vehicle must be one of masses and links for static loads, roll, modes and seats, got a measured plant"
        )

    @property
    def meanings(self) -> Mapping[str, Response]:
        """What each response is, by name."""
        return {response: output_of(output) for response, output in self._measured.items()}

    @property
    def struts(self) -> tuple[str, ...]:
        """Names of the struts."""
        return tuple(input_of(name).where for name in self._inputs if input_of(name).kind == "strut")

    @property
    def tyres(self) -> tuple[str, ...]:
        """Names of the tyres; struts over them are called the same."""
        return tuple(input_of(road).where for road in self._roads)

    @property
    def contact_points(self) -> NDArray[np.float64]:
        """Where each road input touches the ground, x forward and y to the left [m], (r, 2)."""
        return np.array([self.contacts[road] for road in self._roads], dtype=float)

    @property
    def parameters(self) -> tuple[StrutParameter, ...]:
        """Coefficients of the struts."""
        shares = np.eye(len(self.struts)).tolist()
        pairs = (spring_and_damper(strut, share) for strut, share in zip(self.struts, shares, strict=True))
        return tuple(parameter for pair in pairs for parameter in pair)

    def plant(self, responses: Sequence[ResponseName] | None = None) -> control.FrequencyResponseData:
        """Return the vehicle without its struts, each of which has a port here instead.

        Parameters
        ----------
        responses : sequence of str or ("acceleration", x, y), optional
            Its first outputs, points of the body to the millimetre; all there are if not given.

        Returns
        -------
        control.FrequencyResponseData
            Inputs and outputs as of any `Vehicle`; it refuses frequencies that were not measured.
        """
        names = [label(response) for response in (self.responses if responses is None else responses)]
        for name in names:
            checks.one_of("response", name, self.meanings)
        deflections = [joined(strut, "deflection") for strut in self.struts]
        rows = [*(self._measured[name] for name in names), *deflections]
        h = np.array([[self.transfer[row, name] for name in self._inputs] for row in rows], dtype=complex)
        omega = 2 * np.pi * np.asarray(self.frequency)
        return MeasuredResponse(
            np.concatenate([h, 1j * omega * h[len(names) :]]),
            omega,
            smooth=True,
            inputs=self._inputs,
            outputs=[*names, *deflections, *(f"{deflection}_rate" for deflection in deflections)],
            name="plant",
        )

    def with_struts(
        self, settings: Settings, responses: Sequence[ResponseName] | None = None
    ) -> control.FrequencyResponseData:
        """Return the vehicle with its struts, from roads to responses, as of any `Vehicle`."""
        plant, roads = self.plant(responses), len(self._roads)
        measured = plant.noutputs - 2 * len(self.struts)
        return MeasuredResponse(
            around(plant, np.hstack(self.strut_gains(settings))).frdata[:measured, :roads],
            plant.omega,
            smooth=True,
            inputs=plant.input_labels[:roads],
            outputs=plant.output_labels[:measured],
            name="vehicle",
        )

    def _check_names(self) -> None:
        deflections = {str(output_of(output).where) for output in self._outputs if output.endswith("deflection")}
        if not self._roads or not self.struts or deflections != set(self.struts):
            raise ValueError(
                "transfer must have roads, struts and the deflection of each strut, got "
                f"{', '.join(self._inputs) or 'no inputs'} and deflections of {', '.join(deflections) or 'none'}"
            )
        for output in self._outputs:
            for given in self._inputs:
                if (output, given) not in self.transfer:
                    raise ValueError(f"transfer must have each output by each input, got no {output}/{given}")
        if set(self.contacts) != set(self._roads):
            raise ValueError(
                f"contacts must be of {', '.join(self._roads)}, got {', '.join(self.contacts) or 'none'}"
            )
        for road, position in self.contacts.items():
            checks.position(f"contact of {road}", position)

    @property
    def _outputs(self) -> list[str]:
        return list(dict.fromkeys(output for output, _ in self.transfer))

    @cached_property
    def _inputs(self) -> list[str]:
        """Names of the roads, then of the struts."""
        names = dict.fromkeys(name for _, name in self.transfer)
        return sorted(names, key=lambda name: input_of(name).kind)

    @property
    def _roads(self) -> list[str]:
        return [name for name in self._inputs if input_of(name).kind == "road"]

    @cached_property
    def _measured(self) -> dict[str, str]:
        """Outputs by the names of the responses that they are: a travel is the deflection of its strut."""
        return {
            joined(str(output_of(output).where), "suspension_travel")
            if output.endswith("deflection")
            else output: output
            for output in self._outputs
        }
