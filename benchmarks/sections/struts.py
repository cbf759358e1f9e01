"""Section 7: mean squares of struts with force laws and networks, over those of a spring beside a damper."""

from dataclasses import fields
from typing import Any, NamedTuple

import numpy as np
import pandas as pd

import suspension_ctrl as sc
from sections.timing import Prepare, take_turns
from suspension_ctrl.vehicles.struts import Element, Strut

DEFAULT = "default"
"""The strut to which the others are compared: that of a vehicle without one of its own."""
QUARTER, FULL = "quarter car", "full car"
LIMIT, LEAST = 60.0, 0.02
"""Seconds: of a call after which there is no other, and up to which calls are repeated within one timing."""
_SPRING, _DAMPER = (1e4, 3e4), (1e3, 5e3)


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
)


def problems(nodes: int) -> dict[tuple[str, str], sc.RideProblem]:
    """Return a problem by vehicle and strut; one road and one load case, springs and linear dampers vary."""
    front, rear = (_measured(axle) for axle in ("front", "rear"))
    five = sc.TableDamper(velocity=[-1.15, -0.15, 0.0, 0.1, 1.1], force=[-725.0, -225.0, 0.0, 500.0, 1700.0])
    digressive = sc.DigressiveDamper(low_speed=4000.0, high_speed=800.0, knee=0.1)
    mounted = sc.series(sc.Damper(), sc.Spring("mount", 250e3))
    names = [DEFAULT, *(row.strut for row in ROWS)]
    quarter = [(sc.Damper(),), (sc.Damper(),), (digressive,), (five,), (front,), (mounted,)]
    full = [(sc.Damper(),) * 2, (sc.Damper(),) * 2, (front, rear), (mounted, mounted)]
    found = {}
    for name, (part,) in zip(names, quarter, strict=False):
        found[QUARTER, name] = _quarter_car({} if name == DEFAULT else {"strut": _beside_spring(part)}, nodes)
    for name, parts in zip([DEFAULT, *names[-3:]], full, strict=True):
        struts = {f"{axle}_strut": _beside_spring(one) for axle, one in zip(("front", "rear"), parts, strict=True)}
        found[FULL, name] = _full_car({} if name == DEFAULT else struts, nodes)
    return found


def _measured(axle: str) -> Element:
    """Return the damper of an axle of `volvo_xc90_full`."""
    strut: Strut = getattr(sc.load_vehicle("volvo_xc90_full").vehicle, f"{axle}_strut")
    return next(one for one in strut.elements if one.name == "damper")


def _beside_spring(part: Strut) -> Strut:
    return sc.parallel(sc.Spring(), part)


def _quarter_car(struts: dict[str, Strut], nodes: int) -> sc.RideProblem:
    car = sc.QuarterCar(**_frame("yuen_ramli_2010"), **struts)
    return sc.RideProblem(car, sc.Iso8608Road("C"), speed=20.0, bounds=_bounds(car), band=(0.1, 20.0), nodes=nodes)


def _full_car(struts: dict[str, Strut], nodes: int) -> sc.RideProblem:
    car, road = sc.FullCar(**_frame("jian_2022_full"), **struts), sc.Iso8608Road("C")
    fixed = {"front_antiroll": 2e4}
    return sc.RideProblem(car, road, speed=20.0, bounds=_bounds(car), struts=fixed, band=(0.1, 20.0), nodes=nodes)


def _frame(file: str) -> dict[str, Any]:
    """Return the masses, tyres and lengths of a vehicle."""
    car: Any = sc.load_vehicle(file).vehicle
    return {one.name: getattr(car, one.name) for one in fields(car) if "strut" not in one.name}


def _bounds(car: Any) -> dict[str, tuple[float, float]]:
    """Return bounds of springs and linear dampers."""
    kinds = {"spring": _SPRING, "damper": _DAMPER}
    names = [one.name for one in car.strut_coefficients]
    return {name: kinds[kind] for name in names if (kind := name.split(".")[-1]) in kinds}


def measure(nodes: int, designs: dict[str, int], repeats: int) -> pd.DataFrame:
    """Return one row per timed call: vehicle, strut, designs, repeat, seconds, cpu_seconds."""
    entries: dict[str, Prepare] = {}
    keys = {}
    for key, problem in problems(nodes).items():
        size = (designs[key[0]], len(problem.lower))
        drawn = np.random.default_rng(1).uniform(problem.lower, problem.upper, size)
        case = problem.kernel.cases[0]
        keys[", ".join(key)] = key
        entries[", ".join(key)] = lambda _, case=case, drawn=drawn: lambda: case(drawn)
    found = pd.DataFrame(take_turns(entries, repeats, LIMIT, least=LEAST))
    vehicles, struts = zip(*found.pop("contender").map(keys), strict=True)
    return found.assign(vehicle=vehicles, strut=struts, designs=[designs[vehicle] for vehicle in vehicles])


def ratios(timings: pd.DataFrame) -> pd.DataFrame:
    """Return by vehicle and strut the bar, the least processor time per design [s], its ratio to the default."""
    least = (timings.cpu_seconds / timings.designs).groupby([timings.vehicle, timings.strut]).min()
    rows = [(*row, least[row.vehicle, row.strut]) for row in ROWS]
    table = pd.DataFrame(rows, columns=[*Row._fields, "seconds"])
    return table.assign(ratio=table.seconds / [least[vehicle, DEFAULT] for vehicle in table.vehicle])


def goals(timings: pd.DataFrame) -> list[tuple[str, float, float]]:
    """Return what is to hold: what, largest ratio, and the one measured."""
    return [(f"{row.vehicle}, {row.strut}", row.bar, row.ratio) for row in ratios(timings).itertuples()]
