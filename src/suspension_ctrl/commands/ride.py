"""Ride and modes of one vehicle on one road, printed and written as CSV."""

from collections.abc import Mapping
from contextlib import suppress
from pathlib import Path
from typing import TYPE_CHECKING, Any

from . import options as o

if TYPE_CHECKING:
    import pandas as pd

    from ..response.certificates import Certificate
    from ..response.linearisation import LinearisedVehicle
    from ..response.load_case import LoadCase
    from ..response.problem import RideProblem
    from ..vehicles.files import VehicleFile
    from ..vehicles.vehicle import Vehicle

PAPERS = "yuen_ramli_2010"
_NARROW = 1e-3  # half the range of a coefficient of one vehicle, relative


def ride(
    vehicle: o.Vehicle = None,
    setting: o.Setting = None,
    body_mass: o.BodyMass = None,
    wheel_mass: o.WheelMass = None,
    tyre_stiffness: o.TyreStiffness = None,
    spring: o.Spring = None,
    damper: o.Damper = None,
    road: o.Road = None,
    allow_outside: o.AllowOutside = False,
    speed: o.Speed = None,
    band: o.Band = None,
    weighting: o.Weighting = None,
    certify: o.Certify = None,
    out: o.Out = None,
) -> None:
    """Print the ride, modes, springs and wheel loads of one vehicle.

    The vehicle is from a file, with its own struts, or a quarter car with given masses, tyre, spring and
    damper; of a plant the ride alone. Writes ride.csv, modes.csv, springs.csv, static.csv, of force laws laws.csv,
    and of roads driven in time certificate.csv to a folder; its path is the last line printed.
    """
    from ..response.load_case import LoadCase
    from ..response.responses import ride
    from ..tables import write_tables
    from . import results, studies, terminal

    masses = {"body_mass": body_mass, "wheel_mass": wheel_mass, "tyre_stiffness": tyre_stiffness}
    file = chosen_vehicle(vehicle, masses, allow_outside)
    car, values = in_place(file, setting or "", given({"spring": spring, "damper": damper}))
    problem = studies.chosen_study(
        road=road, speed=speed, band=band, weighting=weighting, allow_outside=allow_outside
    ).problem
    case, (low, high) = LoadCase(vehicle=car, road=problem.road, speed=problem.speed), problem.band
    table = ride(car, values, case.road, speed=case.speed, weighting=problem.weighting, band=problem.band)
    table = (table if table.note.any() else table.drop(columns="note")).reset_index()
    linear = linearised_if_assembled(case, values, problem.band)
    tables = {"ride": table, **tables_of(linear, values)}
    certificate = certified(problem, case, values, certify)
    write_tables(folder := results.results_folder(out), tables)
    terminal.note(f"{file.name or vehicle}: {told(values, car)}.")
    terminal.note(f"Road: {case.describe()}; {low:g} to {high:g} Hz.")
    title = f"Ride: root mean squares, ACC weighted with {problem.weighting}"
    terminal.show(title, table, readable=True, sides=True)
    show_tables(tables, linear)
    show_certificate(certificate, folder)
    terminal.end(folder)


def certified(
    problem: "RideProblem", case: "LoadCase", values: Mapping[str, float], length: float | None
) -> "Certificate | None":
    """Return the measures of one vehicle linearised and driven in time on roads of a length [m], if given."""
    from ..response.certifying import certify

    if length is None:
        return None
    varied = {name: value for name, value in values.items() if value > 0}
    bounds = {name: ((1 - _NARROW) * value, (1 + _NARROW) * value) for name, value in varied.items()}
    fixed = {name: value for name, value in values.items() if name not in varied}
    return certify(problem.replace(cases=[case], bounds=bounds, struts=fixed), list(varied.values()), length)


def show_certificate(certificate: "Certificate | None", folder: Path) -> None:
    """Write and print a certificate, if there is one."""
    from ..tables import write_csv
    from . import terminal

    if certificate is None:
        return
    table = certificate.to_frame().reset_index()
    write_csv(folder / "certificate.csv", table)
    terminal.note(certificate.title)
    terminal.note("An asterisk marks a linearised value outside the 95 % interval of the simulated mean.")
    marked = table.assign(outside=table["outside"].map({True: "*", False: ""}))
    shown = ["measure", "unit", "linearised", "simulated", "low", "high", "outside", "equivalent"]
    terminal.show("Certificate", marked[shown], readable=True)
    for line in certificate.limits:
        terminal.note(line)
    for name, text in dict(zip(table["measure"], table["note"], strict=True)).items():
        if text:
            terminal.note(f"{name}: {text}")


def linearised_if_assembled(
    case: "LoadCase", values: Mapping[str, float], band: tuple[float, float]
) -> "LinearisedVehicle | None":
    """Return the linearised vehicle of a load case, none unless it is one of masses and links."""
    from ..response.linearisation import linearised
    from ..vehicles.vehicle import AssembledVehicle

    if not isinstance(case.vehicle, AssembledVehicle):
        return None
    return linearised(case.vehicle, values, case.road, case.speed, band=band)


def in_place(file: "VehicleFile", setting: str, strut: Mapping[str, float]) -> "tuple[Vehicle, dict[str, float]]":
    """Return the vehicle and all coefficients with a setting in place of its own, units judged."""
    from ..vehicles.unit_slips import refuse_slip

    known = file.vehicle.variables
    asked = {**o.by_name("setting", setting, {name: one.unit for name, one in known.items()}), **strut}
    replaced = [getattr(known.get(name), "replaces", None) for name in asked]
    car, values = file.vehicle.at(
        {**{name: value for name, value in file.setting.items() if name not in replaced}, **asked}
    )
    if not file.unusual:
        refuse_slip(car, values)
    return car, values


def given(values: Mapping[str, float | None]) -> dict[str, Any]:
    """Return the values that are not None."""
    return {name: value for name, value in values.items() if value is not None}


def told(values: Mapping[str, float], vehicle: "Vehicle") -> str:
    """Return the values of struts in words, each with its unit."""
    from ..tables.headers import shown_value

    units = {one.name: one.unit for one in vehicle.strut_coefficients}
    return ", ".join(f"{name} {shown_value(value, units[name], 6)}" for name, value in values.items())


def tables_of(linear: "LinearisedVehicle | None", values: Mapping[str, float]) -> "dict[str, pd.DataFrame]":
    """Return tables of modes and springs, of laws if there are any, and of statics on springs; none of a plant."""
    if linear is None:
        return {}
    from ..vehicles.rates import rates_of

    modes = linear.modes().filter(regex=r"^name$|\]$")  # no amplitudes
    laws = {"laws": linear.table().reset_index()} if linear.laws else {}
    tables = {"modes": modes, "springs": rates_of(linear, linear.coefficients()), **laws}
    with suppress(ValueError):  # of a vehicle that no spring carries
        tables["static"] = linear.vehicle.static(values).reset_index()
    return tables


def show_tables(tables: "Mapping[str, pd.DataFrame]", linear: "LinearisedVehicle | None") -> None:
    """Show modes, springs, wheel loads, and force laws at their working point with the mean travel they cause."""
    import pandas as pd

    from . import terminal

    if linear is None:
        return
    terminal.show("Modes", tables["modes"], dict.fromkeys(tables["modes"].columns[1:], 3))
    terminal.show("Springs" + " at the working point" * bool(linear.laws), tables["springs"], readable=True)
    if "static" in tables:
        loads = tables["static"][tables["static"]["name"].str.endswith("wheel_load")]
        terminal.show("Static loads", loads, readable=True, sides=True)
    if linear.laws:
        terminal.show("Force laws, linearised on this road: SI units", tables["laws"])
        travel = [(strut or "strut", mean) for strut, mean in linear.mean_travel.items()]
        table = pd.DataFrame(travel, columns=["strut", "mean travel [m]"])
        terminal.show("Mean travel", table, {"mean travel [mm]": 1}, readable=True, sides=True)


def chosen_vehicle(name: str | None, masses: Mapping[str, float | None], allow_outside: bool) -> "VehicleFile":
    """Return the vehicle of a file, or a quarter car with these masses."""
    from ..vehicles.cars import QuarterCar
    from ..vehicles.files import VehicleFile, load_vehicle

    parameters = given(masses)
    if not parameters:
        return load_vehicle(PAPERS if name is None else name, allow_outside=allow_outside)
    if name is not None:
        raise ValueError(f"vehicle must stand without {', '.join(masses)}, got {name!r} with one")
    if missing := masses.keys() - parameters.keys():
        raise ValueError(f"{', '.join(masses)} must stand together, got no {min(missing)}")
    return VehicleFile(vehicle=QuarterCar(**parameters), name="Quarter car")
