"""Vehicles known without their struts as one system: imported A, B, C, D or measured frequency responses."""

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, TypeAlias

import control
import numpy as np
from numpy.typing import NDArray

from .. import checks
from ..quantities import FrozenMapping, Real, Record, frozen_array, unit
from .assembly import Position, Response, ResponseName, StrutParameter, check_strut_names, joined, label
from .feedback import MeasuredResponse
from .vehicle import Vehicle, spring_and_damper

if TYPE_CHECKING:
    from os import PathLike

System: TypeAlias = control.StateSpace | control.FrequencyResponseData

_LEAST = 4
"""Lines that a cubic spline needs."""
_CLOSEST = 1e-6
"""Least distance of lines [Hz], of which all powers in a spline are finite."""
_POINT = re.compile(r"acceleration_at_(-?\d{1,6})_(-?\d{1,6})_mm", re.ASCII)
_OUTPUT = re.compile(r"(?:(\w+)_)?(acceleration|tyre_load|suspension_travel)", re.ASCII)
_KINDS = {"acceleration": "acceleration", "tyre_load": "load", "suspension_travel": "travel"}


def _brief(system: System) -> str:
    if isinstance(system, control.StateSpace):
        return f"StateSpace of {system.nstates} states"
    f = system.omega / (2 * np.pi)
    return f"FrequencyResponseData of {f.size} lines from {f[0]:.6g} to {f[-1]:.6g} Hz"


@dataclass(frozen=True, eq=False, repr=False)
class Plant(Record, Vehicle):
    """A vehicle without its struts as a python-control system: imported from a multibody program, or measured.

    Inputs of the system are ``<wheel>_road`` [m], of a damped tyre ``<wheel>_road_rate`` [m/s] beside it, and the
    tensions ``<strut>_strut`` [N]; outputs are the responses, ``<strut>_deflection`` [m] and, if known,
    ``<strut>_deflection_rate`` [m/s]. With one wheel nothing stands before the underscore. Outputs such as
    ``body_acceleration``, ``acceleration_at_1200_-400_mm`` (point of the body) and ``front_tyre_load`` are known
    to the measures by their names. The travel of a strut is its deflection.

    Each strut has the coefficients ``<strut>.spring`` and ``<strut>.damper``. Masses are unknown, and with them
    static loads, roll and modes; a seat cannot be put on.

    Between the lines of a frequency response real and imaginary parts are cubic splines over frequency; beyond
    them it is unknown. At a resonance of half width b the spline errs by up to (h/b)^4/3 of the peak, with lines
    h apart: a plant without struts has little damping, and needs close lines.

    Parameters
    ----------
    system : control.StateSpace or control.FrequencyResponseData
        In continuous time, or of four lines or more that ascend by 1e-6 Hz or more.
    contacts : mapping of str to (float, float)
        By name of the wheel the point where it touches the road, x forward and y to the left [m]. If not given,
        one wheel without a name.
    struts : sequence of str
        Names of the struts; if not given, all that the system has as inputs.

    Raises
    ------
    ValueError
        If the system, its lines or its signals are not as above, or the rate of a deflection is neither given nor
        defined, because an input acts on the deflection directly.
    """

    system: System = field(metadata={"show": _brief})
    contacts: Mapping[str, Position] = field(
        default_factory=lambda: FrozenMapping({"": (0.0, 0.0)}), metadata=unit("m")
    )
    struts: tuple[str, ...] = ()

    def __post_init__(self) -> None:
        system = self.system
        if not isinstance(system, control.StateSpace | control.FrequencyResponseData):
            raise ValueError(f"system must be a control.StateSpace or FrequencyResponseData, got {system!r}")
        if system.isdtime(strict=True):
            raise ValueError(f"system must be in continuous time, got a time step of {system.dt}")
        if isinstance(system, control.FrequencyResponseData):
            _check_lines(system)
        contacts = _checked_contacts(self.contacts)
        tensions = [name for name in system.input_labels if re.fullmatch("(.*_)?strut", name)]
        struts = tuple(self.struts) or tuple(name[: -len("_strut")] for name in tensions)
        check_strut_names("struts", struts)
        _check_signals(system, contacts, struts, tensions)
        object.__setattr__(self, "contacts", contacts)
        object.__setattr__(self, "struts", struts)
        object.__setattr__(self, "system", _ported(system, contacts, struts))

    @classmethod
    def from_csv(
        cls,
        path: "str | PathLike[str]",
        contacts: Mapping[str, Position] | None = None,
        struts: Sequence[str] = (),
    ) -> "Plant":
        """Read a table of frequency responses.

        The first column is ``frequency [Hz]``; two more for each output and input are called as in
        ``body_acceleration/front_road real [m/s^2/m]`` and ``body_acceleration/front_road imag [m/s^2/m]``.

        Raises
        ------
        ValueError
            Naming the file, if it is no such table or the table is no plant.
        OSError
            If the file cannot be read.
        """
        from .plant_tables import read_plant

        system = read_plant(path)
        try:
            return cls(system, {"": (0.0, 0.0)} if contacts is None else contacts, tuple(struts))
        except ValueError as error:
            raise ValueError(f"{path}: {error}") from None

    @property
    def meanings(self) -> Mapping[str, Response]:
        """Meaning of each response, by name."""
        return {name: _meaning(name) for name in self.system.output_labels[: -2 * len(self.struts)]}

    @property
    def tyres(self) -> tuple[str, ...]:
        """Names of the tyres; a strut over a tyre has its name."""
        return tuple(self.contacts)

    @property
    def contact_points(self) -> Real:
        """Where each road touches its tyre, x forward and y to the left [m], (r, 2)."""
        return frozen_array(list(self.contacts.values()))

    @property
    def parameters(self) -> tuple[StrutParameter, ...]:
        """Coefficients of the struts."""
        shares = np.eye(len(self.struts)).tolist()
        pairs = (spring_and_damper(strut, share) for strut, share in zip(self.struts, shares, strict=True))
        return tuple(parameter for pair in pairs for parameter in pair)

    def plant(self, responses: Sequence[ResponseName] | None = None) -> System:
        """Return the vehicle without its struts, see `Vehicle.plant`; points of the body to the millimetre."""
        names = [label(response) for response in (self.responses if responses is None else responses)]
        for name in names:
            checks.one_of("response", name, self.responses)
        ports = self.system.output_labels[-2 * len(self.struts) :]
        return _selected(self.system, {name: name for name in (*names, *ports)}, self.system.input_labels)

    def __reduce__(self) -> tuple[Any, ...]:
        """Pickle the numbers and names alone: a system of python-control cannot be."""
        names = {"inputs": self.system.input_labels, "outputs": self.system.output_labels}
        if isinstance(self.system, control.StateSpace):
            names["states"] = self.system.state_labels
        return _unpickled, (_arrays(self.system), names, self.contacts, self.struts)

    def _values(self) -> tuple[object, ...]:
        labels = (*self.system.input_labels, *self.system.output_labels)
        return (*(a.tobytes() for a in _arrays(self.system)), labels, self.contacts, self.struts)


def _arrays(system: System) -> tuple[NDArray[Any], ...]:
    if isinstance(system, control.StateSpace):
        return system.A, system.B, system.C, system.D
    return system.frdata, system.omega


def _unpickled(
    arrays: Sequence[NDArray[Any]],
    names: Mapping[str, list[str]],
    contacts: Mapping[str, Position],
    struts: tuple[str, ...],
) -> Plant:
    make = control.ss if len(arrays) == 4 else control.frd
    return Plant(make(*arrays, **names), contacts, struts)


def _check_lines(system: control.FrequencyResponseData) -> None:
    f = system.omega / (2 * np.pi)
    if f.size < _LEAST or not np.isfinite(f).all():
        raise ValueError(f"frequency must be {_LEAST} finite values or more, got {f.size}")
    if not (steps := np.diff(f, prepend=0.0)).min() >= _CLOSEST * (1 - 1e-6):
        raise ValueError(f"frequency must ascend from 0 Hz in steps >= {_CLOSEST:g} Hz, got {steps.min():g} Hz")


def _checked_contacts(contacts: Mapping[str, Position]) -> FrozenMapping[str, Position]:
    if not (isinstance(contacts, Mapping) and contacts):
        raise ValueError(f"contacts must be a mapping of wheels to points, got {contacts!r}")
    for wheel, position in contacts.items():
        checks.position(f"contact of {wheel or 'the wheel'}", position)
    return FrozenMapping({wheel: (float(x), float(y)) for wheel, (x, y) in contacts.items()})


def _check_signals(
    system: System, contacts: Mapping[str, Position], struts: Sequence[str], tensions: Sequence[str]
) -> None:
    """Raise ValueError unless the system has a road for each wheel, a port for each strut, and finite values."""
    roads = [joined(wheel, "road") for wheel in contacts]
    if not struts:
        raise ValueError(f"system must have an input like 'front_strut', got {', '.join(system.input_labels)}")
    for kind, needed, labels in (
        ("input", [*roads, *(joined(strut, "strut") for strut in struts)], system.input_labels),
        ("output", [joined(strut, "deflection") for strut in struts], system.output_labels),
    ):
        for name in needed:
            if name not in labels:
                raise ValueError(f"system must have the {kind} {name!r}, got {', '.join(labels)}")
    for name in system.input_labels:
        if name.removesuffix("_rate") not in roads and name not in tensions:
            raise ValueError(f"input must be {', '.join(roads)}, its rate, or like 'front_strut', got {name!r}")
    if not all(np.isfinite(array).all() for array in _arrays(system)):
        raise ValueError("system must hold finite values throughout, got others")


def _ported(system: System, contacts: Mapping[str, Position], struts: Sequence[str]) -> System:
    """Return the system with the outputs and inputs of `Vehicle.plant`, read-only."""
    roads = [joined(wheel, "road") for wheel in contacts]
    rates = [f"{road}_rate" for road in roads]
    inputs = [*roads, *(rates if {*rates} & {*system.input_labels} else ()), *(joined(s, "strut") for s in struts)]
    deflections = [joined(strut, "deflection") for strut in struts]
    ports = [*deflections, *(f"{deflection}_rate" for deflection in deflections)]
    responses = {name: name for name in system.output_labels if name not in ports}
    travels = {joined(strut, "suspension_travel"): joined(strut, "deflection") for strut in struts}
    outputs = travels | responses
    sources = {name: outputs[name] for name in (*responses, *travels)} | {name: name for name in ports}
    ported = _selected(_with_rates(system, deflections), sources, inputs)
    for array in _arrays(ported):
        array.flags.writeable = False
    return ported


def _with_rates(system: System, deflections: Sequence[str]) -> System:
    """Return the system with the rates of the deflections that it lacks as further outputs."""
    lacking = [name for name in deflections if f"{name}_rate" not in system.output_labels]
    row = [system.output_labels.index(name) for name in lacking]
    names = {
        "inputs": system.input_labels,
        "outputs": [*system.output_labels, *(f"{name}_rate" for name in lacking)],
    }
    if not isinstance(system, control.StateSpace):
        rates = 1j * system.omega * system.frdata[row]
        return control.frd(np.concatenate([system.frdata, rates]), system.omega, **names)
    for name, direct in zip(lacking, system.D[row], strict=True):
        if direct.any():
            given = system.input_labels[int(np.flatnonzero(direct)[0])]
            raise ValueError(
                f"system must have the output '{name}_rate' where an input acts on {name}, got {given}"
            )
    c, d = system.C[row] @ system.A, system.C[row] @ system.B
    return control.ss(system.A, system.B, np.vstack([system.C, c]), np.vstack([system.D, d]), **names)


def _selected(system: System, sources: Mapping[str, str], inputs: Sequence[str]) -> System:
    """Return the system with outputs by their names there, and inputs, of which unknown ones have no effect."""
    row = [system.output_labels.index(name) for name in sources.values()]
    known = system.input_labels
    column = [known.index(name) if name in known else len(known) for name in inputs]
    names = {"inputs": list(inputs), "outputs": list(sources), "name": "plant"}
    if isinstance(system, control.StateSpace):
        b, d = (np.pad(matrix, ((0, 0), (0, 1)))[:, column] for matrix in (system.B, system.D))
        return control.ss(system.A.copy(), b, system.C[row], d[row], states=system.state_labels, **names)
    h = np.pad(system.frdata, ((0, 0), (0, 1), (0, 0)))[row][:, column]
    return MeasuredResponse(h, system.omega.copy(), **names)


def _meaning(name: str) -> Response:
    """Return the meaning of an output, of which the name tells it."""
    if point := _POINT.fullmatch(name):
        return Response("acceleration", (int(point[1]) / 1e3, int(point[2]) / 1e3))
    found = _OUTPUT.fullmatch(name)
    return Response(_KINDS[found[2]], found[1] or "") if found else Response("signal", name)
