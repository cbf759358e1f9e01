"""Vehicles known without their struts as one system: imported A, B, C, D or measured frequency responses."""

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from os import PathLike
from typing import Any

import control
import numpy as np
from numpy.typing import NDArray

from .. import checks
from ..documents import naming
from ..quantities import FrozenMapping, Record, unit
from ..tables import read_table
from .assembly import (
    ONE_WHEEL,
    Position,
    Response,
    ResponseName,
    StrutCoefficient,
    check_strut_names,
    joined,
    label,
)
from .elements import Damper, Spring
from .feedback import System, around, gains_by_order, numbers_of, selected, system_of, with_copies, with_rates
from .networks import placed
from .plant_tables import frequency_responses
from .signals import Names, renamed
from .struts import parallel
from .vehicle import Setting, Vehicle, coefficients_by_name

_LEAST = 4  # lines of a cubic spline
_CLOSEST = 1e-6  # Hz, least distance of lines: its powers in a spline are finite
_POINT = re.compile(r"acceleration_at_(-?\d{1,6})_(-?\d{1,6})_mm", re.ASCII)
_KINDS = {
    "displacement": "displacement", "velocity": "velocity", "acceleration": "acceleration",
    "tyre_load": "load", "tyre_deflection": "tyre_deflection", "suspension_travel": "travel",
    "suspension_travel_rate": "travel_rate", "strut_force": "strut_force",
}  # fmt: skip
_OUTPUT = re.compile(rf"(?:(\w+)_)?({'|'.join(_KINDS)})", re.ASCII)


def _brief(system: System) -> str:
    if isinstance(system, control.StateSpace):
        return f"StateSpace of {system.nstates} states"
    f = system.omega / (2 * np.pi)
    return f"FrequencyResponseData of {f.size} lines from {f[0]:.6g} to {f[-1]:.6g} Hz"


@dataclass(frozen=True, eq=False, repr=False)
class Plant(Record, Vehicle):
    """A vehicle without its struts as a python-control system: imported from a multibody program, or measured.

    Inputs are ``<wheel>_road`` [m], of a damped tyre ``<wheel>_road_rate`` [m/s] too, and the tensions
    ``<strut>_strut`` [N]; outputs are the responses, ``<strut>_deflection`` [m] and, if known,
    ``<strut>_deflection_rate`` [m/s]. Names of a quarter car have nothing before the underscore. Measures know
    responses by names: ``body_acceleration``, ``acceleration_at_1200_-400_mm`` (point of the body),
    ``front_tyre_load``. The travel of a strut is its deflection.

    Each strut has the coefficients ``<strut>.spring`` and ``<strut>.damper``. Masses, static loads, roll and modes
    are unknown; a plant takes no seat.

    Between the lines of a frequency response real and imaginary parts are cubic splines over frequency; beyond
    them it is unknown. At a resonance of half width b, with lines h apart, the spline errs by up to (h/b)^4/3 of
    the peak: a plant without struts has little damping and needs close lines.

    Parameters
    ----------
    system : control.StateSpace or control.FrequencyResponseData
        In continuous time, or of four lines or more that ascend by 1e-6 Hz or more.
    contacts : mapping of str to (float, float)
        Point (x, y) by wheel where it touches the road, x forward and y to the left [m]; by default one wheel
        without a name.
    struts : sequence of str
        Names of the struts; by default all that the system has as inputs.
    axles : sequence of str
        Names of axles with equal struts: ``front_left`` and ``front_right`` have the coefficients
        ``front.spring`` and ``front.damper`` together.

    Raises
    ------
    ValueError
        If the system, its lines or its signals are not as above, or the rate of a deflection is neither given nor
        defined, because an input acts on the deflection directly.

    Examples
    --------
    A vehicle of another program is known by the names of its signals, here those of a quarter car:

    >>> import suspension_ctrl as sc
    >>> known = sc.load_vehicle("yuen_ramli_2010")
    >>> system = known.vehicle.plant()
    >>> system.input_labels
    ['road', 'strut']
    >>> system.output_labels
    ['body_acceleration', 'suspension_travel', 'tyre_load', 'deflection', 'deflection_rate']
    >>> for vehicle in (known.vehicle, sc.Plant(system)):
    ...     table = sc.ride(vehicle, known.setting, sc.Iso8608Road("C"), speed=20.0)
    ...     print(table["value"].head(3).round(3).to_dict())
    {'ACC': 1.195, 'SWS': 0.011, 'DTL': 753.643}
    {'ACC': 1.195, 'SWS': 0.011, 'DTL': 753.643}
    """

    system: System = field(metadata={"show": _brief})
    contacts: Mapping[str, Position] = field(default=ONE_WHEEL, metadata=unit("m"))
    struts: tuple[str, ...] = ()
    axles: tuple[str, ...] = ()

    def __post_init__(self) -> None:
        system = self.system
        if not isinstance(system, control.StateSpace | control.FrequencyResponseData):
            got = type(system).__name__
            raise ValueError(f"system must be a control.StateSpace or FrequencyResponseData, got {got}")
        if system.isdtime(strict=True):
            raise ValueError(f"system must be in continuous time, got a time step of {system.dt}")
        if isinstance(system, control.FrequencyResponseData):
            _check_lines(system)
        tensions = [name for name in system.input_labels if re.fullmatch("(.*_)?strut", name)]
        checks.listed("struts", self.struts)
        struts = tuple(self.struts) or tuple(name[: -len("_strut")] for name in tensions)
        check_strut_names("struts", struts)
        contacts = _checked_contacts(self.contacts)
        _check_signals(system, [joined(wheel, "road") for wheel in contacts], struts, tensions)
        checks.listed("axles", self.axles)
        for axle in self.axles:
            if missing := [side for side in _sides(axle) if side not in struts]:
                got = checks.listing(struts, missing[0])
                raise ValueError(f"axles must have two struts like {missing[0]!r}, got {got}")
        self._keep(axles=tuple(self.axles))
        self._keep(contacts=contacts, struts=struts, system=_ported(system, tuple(contacts), struts))

    @classmethod
    def from_csv(
        cls, path: str | PathLike[str], contacts: Mapping[str, Position] = ONE_WHEEL, struts: Sequence[str] = ()
    ) -> "Plant":
        """Read a table of frequency responses, see `plant_tables`; errors name the file."""
        names, values = read_table(path)
        with naming(path):
            return cls(frequency_responses(names, values), contacts, tuple(struts))

    @classmethod
    def named(
        cls,
        system: System,
        *,
        inputs: Names | None = None,
        outputs: Names | None = None,
        contacts: Mapping[str, Position] = ONE_WHEEL,
        struts: Sequence[str] = (),
        axles: Sequence[str] = (),
    ) -> "Plant":
        """Return the vehicle of a system with other names, units and signs, as of `load_system`.

        Parameters
        ----------
        system : control.StateSpace or control.FrequencyResponseData
        inputs, outputs : sequence of str, or mapping of str to str, optional
            For each signal its name here with the unit that it has in the system, ``"front_strut [kN]"``; a minus
            sign before it, ``"-front_strut [kN]"``, of a force positive in compression or a downward
            acceleration. In their order, ``""`` for a signal without use, or by their names in the system. A road
            may be given by its rate alone, ``"front_road_rate [m/s]"``.
            All with their own names and in SI units if not given.
        contacts, struts, axles
            As of `Plant`.

        Raises
        ------
        ValueError
            If names are not as above, or about the system as `Plant`.

        Examples
        --------
        A quarter car of MATLAB's guide to active suspensions, whose actuator pushes body and wheel apart with a
        force in kN. It has a spring and a damper already, which `without` takes out:

        >>> import control
        >>> import suspension_ctrl as sc
        >>> mb, mw, bs, ks, kt = 300.0, 60.0, 1000.0, 16000.0, 190000.0
        >>> body = [-ks / mb, -bs / mb, ks / mb, bs / mb]
        >>> wheel = [ks / mw, bs / mw, -(ks + kt) / mw, -bs / mw]
        >>> a, b = [[0, 1, 0, 0], body, [0, 0, 0, 1], wheel], [[0, 0], [0, 1e3 / mb], [0, 0], [kt / mw, -1e3 / mw]]
        >>> system = control.ss(a, b, [[1, 0, -1, 0], body], [[0, 0], [0, 1e3 / mb]])
        >>> plant = sc.Plant.named(
        ...     system, inputs=["road [m]", "-strut [kN]"], outputs=["deflection [m]", "body_acceleration [m/s^2]"]
        ... ).without((ks, bs))
        >>> table = sc.ride(plant, (16e3, 1500.0), sc.Iso8608Road("C"), speed=20.0, measures=["ACC", "SWS"])
        >>> print(table["value"].head(2).round(4).to_dict())
        {'ACC': 1.258, 'SWS': 0.011}
        """
        return cls(renamed(system, inputs, outputs), contacts, tuple(struts), tuple(axles))

    def without(self, setting: Setting) -> "Plant":
        """Return the plant without springs and dampers that the model already has at its struts.

        Parameters
        ----------
        setting : mapping of str to float or (float, float), or (float, float)
            Their coefficients, as of ``closed``; those that the model does not have may be missing.
        """
        values, known = coefficients_by_name(setting, {}), {one.name: one for one in self.strut_coefficients}
        for name, value in values.items():
            checks.one_of("setting", name, known)
            known[name].check(name, value)
        bare = around(self.system, -gains_by_order(known.values(), values, len(self.struts)))
        forces = {joined(strut, "strut_force") for strut in self.struts}  # then of all that is at the strut
        outputs = [name for name in bare.output_labels if name not in forces]
        return Plant(selected(bare, outputs, bare.input_labels, "plant"), self.contacts, self.struts, self.axles)

    @property
    def meanings(self) -> Mapping[str, Response]:
        """Meaning of each response, by name."""
        known = {name: _meaning(name) for name in self.system.output_labels[: -2 * len(self.struts)]}
        jerks = {
            name.replace("acceleration", "jerk"): one
            for name, one in known.items()
            if name.endswith("acceleration")
        }
        return {**known, **{name: Response("jerk", one.where) for name, one in jerks.items() if name not in known}}

    @property
    def responses(self) -> tuple[str, ...]:
        """Names of the responses of `plant` and `closed`: those of the system, but rates of travels and forces."""
        known = self.meanings.items()
        return tuple(name for name, one in known if one.kind not in ("travel_rate", "strut_force", "jerk"))

    @property
    def strut_coefficients(self) -> tuple[StrutCoefficient, ...]:
        """Coefficients of the struts."""
        axles = {side: axle for axle in self.axles for side in _sides(axle)}
        owners = [axles.get(strut, strut) for strut in self.struts]
        shares = {owner: [float(owner == one) for one in owners] for owner in owners}
        placements = (placed(parallel(Spring(), Damper()), *one) for one in shares.items())
        return tuple(one for coefficients, _ in placements for one in coefficients)

    def plant(self, responses: Sequence[ResponseName] | None = None) -> System:
        """Return the vehicle without its struts, see `Vehicle.plant`; points of the body to the millimetre."""
        responses = self.responses if responses is None else responses
        checks.listed("responses", responses)
        names = [label(response) for response in responses]
        for name in names:
            checks.one_of("response", name, self.system.output_labels[: -2 * len(self.struts)])
        ports = self.system.output_labels[-2 * len(self.struts) :]
        return selected(self.system, [*names, *ports], self.system.input_labels, "plant")

    def __reduce__(self) -> tuple[Any, ...]:
        """Pickle the numbers and names alone: a system of python-control cannot be."""
        names = {"inputs": self.system.input_labels, "outputs": self.system.output_labels}
        if isinstance(self.system, control.StateSpace):
            names["states"] = self.system.state_labels
        return _unpickled, (numbers_of(self.system), names, self.contacts, self.struts, self.axles)

    def _values(self) -> tuple[object, ...]:
        labels = (*self.system.input_labels, *self.system.output_labels)
        return (*(a.tobytes() for a in numbers_of(self.system)), labels, self.contacts, self.struts, self.axles)


def _unpickled(numbers: Sequence[NDArray[Any]], names: Mapping[str, list[str]], *rest: Any) -> Plant:
    return Plant(system_of(numbers, **names), *rest)


def _sides(axle: str) -> tuple[str, str]:
    return f"{axle}_left", f"{axle}_right"


def _check_lines(system: control.FrequencyResponseData) -> None:
    f = system.omega / (2 * np.pi)
    if f.size < _LEAST or not np.isfinite(f).all():
        raise ValueError(f"frequency must be {_LEAST} finite values or more, got {f.size}")
    if not (steps := np.diff(f, prepend=0.0)).min() >= _CLOSEST * (1 - 1e-6):  # but for rounding
        raise ValueError(f"frequency must ascend from 0 Hz in steps >= {_CLOSEST:g} Hz, got {steps.min():g} Hz")


def _checked_contacts(contacts: Mapping[str, Position]) -> FrozenMapping[str, Position]:
    if not (isinstance(contacts, Mapping) and contacts and all(isinstance(wheel, str) for wheel in contacts)):
        raise ValueError(f"contacts must be a mapping of wheels to points, got {checks.shown(contacts)}")
    return FrozenMapping({w: checks.position(f"contact of {w or 'the wheel'}", contacts[w]) for w in contacts})


def _check_signals(system: System, roads: Sequence[str], struts: Sequence[str], tensions: Sequence[str]) -> None:
    """Raise ValueError unless the system has these roads and struts, no other inputs, and finite values."""
    if not struts:
        got = checks.listing(system.input_labels, "strut")
        raise ValueError(f"system must have an input like 'front_strut', got {got}")
    inputs, outputs = system.input_labels, system.output_labels
    by_rate = [f"{road}_rate" if f"{road}_rate" in inputs and road not in inputs else road for road in roads]
    ports = [*by_rate, *(joined(strut, "strut") for strut in struts)]
    deflections = [joined(strut, "deflection") for strut in struts]
    for kind, needed, labels in (("input", ports, inputs), ("output", deflections, outputs)):
        for name in needed:
            if name not in labels:
                raise ValueError(f"system must have the {kind} {name!r}, got {checks.listing(labels, name)}")
    for name in system.input_labels:
        if name.removesuffix("_rate") not in roads and name not in tensions:
            allowed = f"{checks.listing(roads, name)}, its rate, or like 'front_strut'"
            raise ValueError(f"input must be {allowed}, got {checks.shown(name)}")
    if not all(np.isfinite(array).all() for array in numbers_of(system)):
        raise ValueError("system must hold finite values throughout, got others")


def _ported(system: System, wheels: Sequence[str], struts: Sequence[str]) -> System:
    """Return the system with the outputs and inputs of `Vehicle.plant`, read-only."""
    roads = [joined(wheel, "road") for wheel in wheels]
    rates = [f"{road}_rate" for road in roads]
    inputs = [*roads, *(rates if {*rates} & {*system.input_labels} else ()), *(joined(s, "strut") for s in struts)]
    deflections = [joined(strut, "deflection") for strut in struts]
    ports = [*deflections, *(f"{deflection}_rate" for deflection in deflections)]
    travels = [joined(strut, "suspension_travel") for strut in struts]
    own, port = system.output_labels, dict(zip(travels, deflections, strict=True))
    derived = {f"{name}_rate": name for name in deflections}
    copies = {**port, **{f"{travel}_rate": f"{name}_rate" for travel, name in port.items()}}
    forces = {f"{tension}_force": tension for tension in inputs[-len(struts) :]}
    derived, copies, forces = (
        {name: of for name, of in further.items() if name not in own} for further in (derived, copies, forces)
    )
    whole = with_copies(with_rates(system, derived), copies, forces)
    outputs = dict.fromkeys([*(name for name in own if name not in ports), *travels, *copies, *forces])
    ported = selected(whole, [*outputs, *ports], inputs, "plant")
    for array in numbers_of(ported):
        array.flags.writeable = False
    return ported


def _meaning(name: str) -> Response:
    """Return the meaning of an output by its name."""
    if point := _POINT.fullmatch(name):
        return Response("acceleration", (int(point[1]) / 1e3, int(point[2]) / 1e3))
    found = _OUTPUT.fullmatch(name)
    return Response(_KINDS[found[2]], found[1] or "") if found else Response("signal", name)
