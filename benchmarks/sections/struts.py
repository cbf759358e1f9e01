"""Section 7: mean squares of struts with force laws and networks, over those of a spring beside a damper."""

from collections.abc import Sequence
from dataclasses import fields, replace
from typing import Any, NamedTuple

import numpy as np
import pandas as pd

import suspension_ctrl as sc
from sections.timing import Prepare, take_turns
from suspension_ctrl.vehicles.body_parts import Support
from suspension_ctrl.vehicles.struts import Strut

DEFAULT = "default"
"""The strut to which the others are compared: that of a vehicle without one of its own."""
QUARTER, FULL, TRUCK = "quarter car", "full car", "semitrailer"
_REFERENCE = {QUARTER: QUARTER, FULL: FULL, TRUCK: FULL}  # the vehicle with whose default a vehicle is compared
LIMIT, LEAST = 60.0, 0.02
"""Seconds: of a call after which there is no other, and up to which calls are repeated within one timing."""
_BOUNDS = {"spring": (1e4, 3e4), "damper": (1e3, 5e3)}


class Row(NamedTuple):
    """A vehicle with struts, and the largest ratio to hold."""

    vehicle: str
    strut: str
    bar: float


ROWS = (
    Row(QUARTER, "spring, damper", 1.08),
    Row(QUARTER, "digressive damper", 10.0),
    Row(QUARTER, "damper by a table of 5 rows", 10.0),
    Row(QUARTER, "damper by a measured table of 13 rows", 10.0),
    Row(QUARTER, "damper on a mount", 2.5),
    Row(FULL, "spring, damper", 1.08),
    Row(FULL, "two dampers by measured tables", 10.0),
    Row(FULL, "dampers on mounts", 1.5),
    Row(FULL, "imported, 100 states", 1.1),
    Row(TRUCK, "springs, dampers of two axles", 1.5),
)


def problems(nodes: int) -> dict[tuple[str, str], sc.RideProblem]:
    """Return a problem by vehicle and strut in the order of `ROWS`, each vehicle after its default."""
    front, rear = (_measured(axle) for axle in ("front", "rear"))
    five = sc.TableDamper(velocity=[-1.15, -0.15, 0.0, 0.1, 1.1], force=[-725.0, -225.0, 0.0, 500.0, 1700.0])
    digressive = sc.DigressiveDamper(low_speed=4000.0, high_speed=800.0, knee=0.1)
    straight, mounted = sc.Damper(), sc.series(sc.Damper(), sc.Spring("mount", 250e3))
    quarter: list[tuple[Strut, ...]] = [(), (straight,), (digressive,), (five,), (front,), (mounted,)]
    full: list[tuple[Strut, ...]] = [(), (straight, straight), (front, rear), (mounted, mounted)]
    found = {}
    for vehicle, file, each in ((QUARTER, "yuen_ramli_2010", quarter), (FULL, "jian_2022_full", full)):
        names = [DEFAULT, *(row.strut for row in ROWS if row.vehicle == vehicle)]
        for name, parts in zip(names, each, strict=False):  # without the imported one, which is the last
            found[vehicle, name] = _problem(file, parts, nodes)
    found[FULL, "imported, 100 states"] = imported(nodes, 43)
    found[TRUCK, "springs, dampers of two axles"] = semitrailer(nodes, 2)
    return found


def semitrailer(nodes: int, axles: int) -> sc.RideProblem:
    """Return a tractor with semitrailer, 16 coordinates, 12 tyres in two tracks; so many axles vary."""
    truck: Any = sc.load_vehicle("kraz_semitrailer").vehicle
    wheels = [replace(one, position=(one.position[0], np.copysign(0.9, one.position[1]))) for one in truck.wheels]
    carriers = {one.name: one.carrier for one in truck.wheels}
    names = list(dict.fromkeys(one.name.rsplit("_", 1)[0] for one in truck.suspensions))[:axles]
    varied = [one for one in truck.suspensions if one.name.rsplit("_", 1)[0] in names]
    constant = [
        Support(
            name=one.name, lower=carriers[one.name], upper=one.upper, position=one.position, stiffness=8e5,
            damping=3e4,
        )
        for one in truck.suspensions if one not in varied
    ]  # fmt: skip
    truck = replace(
        truck, wheels=wheels, suspensions=[replace(one, strut=None) for one in varied], supports=constant
    )
    bounds = {
        one.name: (20 * low, 20 * high)
        for one in truck.strut_coefficients
        for low, high in [_BOUNDS[one.name.split(".")[-1]]]
    }
    road = sc.Iso8608Road("C")
    return sc.RideProblem(truck, road, speed=20.0, bounds=bounds, band=(0.1, 20.0), nodes=nodes)


def imported(nodes: int, modes: int) -> sc.RideProblem:
    """Return a full car whose body bends in modes, left and right alike, as a plant: 43 make 100 states."""
    car = sc.load_vehicle("jian_2022_full").vehicle
    front, rear = np.random.default_rng(0).normal(size=(2, modes)) / 60
    side = {1: np.ones(modes), -1: np.resize([1, -1], modes)}
    body = sc.FlexibleBody(
        frequencies=tuple(np.geomspace(12.0, 300.0, modes).tolist()),
        damping_ratios=(0.02,) * modes,
        shapes={(x, 0.9 * y): shape * side[y] for x, shape in ((1.5, front), (-1.5, rear)) for y in side},
    )
    plant = sc.Plant(body.on(car).plant(), car.contacts, axles=("front", "rear"))
    bounds = {one.name: _BOUNDS[one.name.split(".")[-1]] for one in plant.strut_coefficients}
    return sc.RideProblem(plant, sc.Iso8608Road("C"), speed=20.0, bounds=bounds, band=(0.1, 20.0), nodes=nodes)


def _measured(axle: str) -> Strut:
    """Return the damper of an axle of `volvo_xc90_full`."""
    strut = getattr(sc.load_vehicle("volvo_xc90_full").vehicle, f"{axle}_strut")
    found: Strut = next(one for one in strut.elements if one.name == "damper")
    return found


def _problem(file: str, parts: Sequence[Strut], nodes: int) -> sc.RideProblem:
    """Return a vehicle of a file on parts beside springs, on a road; springs and linear dampers vary."""
    car: Any = sc.load_vehicle(file).vehicle
    places = ["strut"] if len(parts) == 1 else ["front_strut", "rear_strut"][: len(parts)]
    struts = {place: sc.parallel(sc.Spring(), part) for place, part in zip(places, parts, strict=True)}
    car = type(car)(**{one.name: getattr(car, one.name) for one in fields(car)} | struts)
    names = [one.name for one in car.strut_coefficients]
    bounds = {name: _BOUNDS[kind] for name in names if (kind := name.split(".")[-1]) in _BOUNDS}
    fixed = {name: 2e4 for name in names if "antiroll" in name}
    road = sc.Iso8608Road("C")
    return sc.RideProblem(car, road, speed=20.0, bounds=bounds, struts=fixed, band=(0.1, 20.0), nodes=nodes)


def measure(nodes: int, designs: dict[str, int], repeats: int) -> pd.DataFrame:
    """Return one row per timed call: vehicle, strut, designs, repeat, seconds, cpu_seconds."""
    entries, keys = dict[str, Prepare](), dict[str, tuple[str, str]]()
    for key, problem in problems(nodes).items():
        name = ", ".join(key)
        keys[name], entries[name] = key, _entry(problem, designs[key[0]])
    found = pd.DataFrame(take_turns(entries, repeats, LIMIT, least=LEAST))
    vehicles, names = zip(*found.pop("contender").map(keys), strict=True)
    return found.assign(vehicle=vehicles, strut=names, designs=[designs[vehicle] for vehicle in vehicles])


def _entry(problem: sc.RideProblem, count: int) -> Prepare:
    """Return the mean squares of designs from the bounds, to be timed."""
    kernel = problem.scores.kernel(problem.nodes)
    drawn = np.random.default_rng(1).uniform(problem.lower, problem.upper, (count, len(problem.lower)))
    return lambda _: lambda: kernel.cases[0](drawn)


def ratios(timings: pd.DataFrame) -> pd.DataFrame:
    """Return by vehicle and strut the bar, the least processor time per design [s], its ratio to the default."""
    least = (timings.cpu_seconds / timings.designs).groupby([timings.vehicle, timings.strut]).min()
    rows = [(*row, least[row.vehicle, row.strut]) for row in ROWS]
    table = pd.DataFrame(rows, columns=[*Row._fields, "seconds"])
    return table.assign(ratio=table.seconds / [least[_REFERENCE[vehicle], DEFAULT] for vehicle in table.vehicle])


def goals(timings: pd.DataFrame) -> list[tuple[str, float, float]]:
    """Return what is to hold: what, largest ratio, and the one measured."""
    found = ratios(timings).ratio
    return [(f"{row.vehicle}, {row.strut}", row.bar, ratio) for row, ratio in zip(ROWS, found, strict=True)]
