"""Statistical linearisation beside driving in time: six dampers on a quarter car, and a full car with two laws.

The bars are 5 % for ACC and DTL, 6 % for SWS, 10 % or 0.5 mm for the mean travel. The tables go to a folder, whose
path is the last line printed.
"""

from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from typing import Annotated, Any

import pandas as pd
from typer import Option

from suspension_ctrl import (
    BilinearDamper,
    DigressiveDamper,
    Iso8608Road,
    PowerLawRoad,
    QuarterCar,
    RideProblem,
    Spring,
    TableDamper,
    certify,
    checks,
    linearised,
    load_vehicle,
    parallel,
)
from suspension_ctrl import tables as files
from suspension_ctrl.commands import options, results, terminal
from suspension_ctrl.response.certificates import Certified
from suspension_ctrl.vehicles.force_laws import ForceLaw

SPEED, BAND = 20.0, (0.1, 20.0)
SHARES = {"ACC": 0.05, "SWS": 0.06, "DTL": 0.05, "mean travel": 0.1}
"""Bars of the error of the linearised value."""
TRAVEL = 0.5e-3  # m, in place of the share
_MINUTE = 60.0  # s

DAMPERS: dict[str, ForceLaw] = {
    "linear 1500": BilinearDamper(bump=1500.0, rebound=1500.0),
    "750 bump, 2250 rebound": BilinearDamper(bump=750.0, rebound=2250.0),
    "800 outside +-0.1, 4000 inside": DigressiveDamper(low_speed=4000.0, high_speed=800.0, knee=0.1),
    "500 / 1500 / 5000 / 1200, knots -0.15, 0, 0.1": TableDamper(
        velocity=[-1.15, -0.15, 0.0, 0.1, 1.1], force=[-725.0, -225.0, 0.0, 500.0, 1700.0]
    ),
    "1000 inside +-0.5, 3000 outside": DigressiveDamper(low_speed=1000.0, high_speed=3000.0, knee=0.5),
    "20000 inside +-0.02, 500 outside": DigressiveDamper(low_speed=20000.0, high_speed=500.0, knee=0.02),
}
"""Slopes [N s/m] between knots [m/s]."""

CARS: dict[str, tuple[ForceLaw, ForceLaw]] = {
    "full car": (
        BilinearDamper(bump=1500.0, rebound=2500.0),
        DigressiveDamper(low_speed=4000.0, high_speed=1200.0, knee=0.1, rebound_over_bump=1.15),
    ),
    "full car, rebound 3 and 1.5 times bump": (
        BilinearDamper(bump=1000.0, rebound=3000.0),
        DigressiveDamper(low_speed=4000.0, high_speed=1200.0, knee=0.1, rebound_over_bump=1.5),
    ),
}
"""Dampers front and rear."""

Minutes = Annotated[float, Option(help="Minutes of driving with each vehicle.")]
Number = Annotated[int, Option(parser=options.whole_number)]
Folder = Annotated[Path | None, Option(help="Folder for the results, absent or empty.")]


def problems() -> dict[str, tuple[RideProblem, list[float]]]:
    """Return the problems and the designs by vehicle."""
    road = PowerLawRoad(roughness=5e-6, exponent=2.5)
    found = {}
    for name, damper in DAMPERS.items():
        strut = parallel(Spring(), damper)
        car = QuarterCar(body_mass=317.5, wheel_mass=45.4, tyre_stiffness=192e3, strut=strut)
        bounds = {"spring": (20e3, 24e3)}
        found[name] = RideProblem(car, road, speed=SPEED, band=BAND, bounds=bounds), [22e3]
    return found | {name: full_car(*dampers) for name, dampers in CARS.items()}


def full_car(front: ForceLaw, rear: ForceLaw) -> tuple[RideProblem, list[float]]:
    """Return the problem of a full car on dampers in front and in the rear, and its design."""
    file = load_vehicle("jian_2022_full")
    struts = {"front_strut": parallel(Spring(), front), "rear_strut": parallel(Spring(), rear)}
    linear: Any = file.vehicle
    springs = {name: file.setting[name] for name in ("front.spring", "rear.spring")}
    problem = RideProblem(
        replace(linear, **struts),
        Iso8608Road("D"),
        speed=SPEED,
        band=BAND,
        bounds={name: (0.9 * value, 1.1 * value) for name, value in springs.items()},
        struts={"front_antiroll": file.setting["front_antiroll"]},
        measures=["ACC", "SWS front", "SWS rear", "DTL front", "DTL rear"],
    )
    return problem, list(springs.values())


def errors(minutes: float, seeds: int, only: str = "") -> Iterator[dict[str, Any]]:
    """Yield a row for each measure of each vehicle whose name has a text."""
    checks.at_least("seeds", seeds, 2)
    for name, (problem, design) in problems().items():
        if only not in name:
            continue
        certificate = certify(problem, design, minutes * _MINUTE * SPEED / seeds, range(seeds))
        for row in certificate.rows:
            kind = next((one for one in SHARES if row.measure.startswith(one)), "")
            if kind:
                yield {"vehicle": name, "measure": row.measure, "unit": row.unit} | _error(row, kind)


def _error(row: Certified, kind: str) -> dict[str, Any]:
    """Return linearised and simulated value, half the interval, error and whether it is within the bar."""
    error, half = row.linearised - row.simulated, (row.high - row.low) / 2
    met = abs(error) <= SHARES[kind] * abs(row.simulated) or (kind == "mean travel" and abs(error) <= TRAVEL)
    percent = 100 / abs(row.simulated) if abs(row.simulated) > TRAVEL else float("nan")
    return {
        "linearised": row.linearised, "simulated": row.simulated, "95 % [+-%]": percent * half,
        "error [%]": percent * error, "same roads [%]": percent * (row.equivalent - row.simulated), "met": met,
    }  # fmt: skip


def equivalents() -> pd.DataFrame:
    """Return the equivalent damper of each law [N s/m]."""
    rows = []
    for name, (problem, design) in problems().items():
        setting = {**problem.struts, **dict(zip(problem.variables, design, strict=True))}
        linear = linearised(problem.vehicle, setting, problem.road, SPEED, band=BAND)
        rows += [{"vehicle": name, "law": law, "c_eq [N s/m]": one.equivalent} for law, one in linear.laws.items()]
    return pd.DataFrame(rows)


def main(minutes: Minutes = 20.0, seeds: Number = 8, out: Folder = None) -> None:
    """Print equivalents, and the errors of linearised values."""
    folder, laws = results.results_folder(out), equivalents()
    table = pd.DataFrame(errors(minutes, seeds))
    for name, one in {"laws": laws, "errors": table}.items():
        files.write_csv(folder / f"{name}.csv", one)
    terminal.show("Equivalent dampers", laws, {"c_eq [N s/m]": 0})
    digits = {"95 % [+-%]": 1, "error [%]": 1, "same roads [%]": 1}
    terminal.show(f"{minutes:g} min of driving each, {seeds} seeds", table, digits, 2)
    terminal.end(folder)


if __name__ == "__main__":
    terminal.run_script(main)
