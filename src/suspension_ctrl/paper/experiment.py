"""The experiment of Yuen and Ramli (2010): vehicle, road, bounds, and the published tables.

T. J. Yuen and R. Ramli, "Comparison of computational efficiency of MOEA/D and NSGA-II for passive vehicle
suspension optimization", 2010.
"""

from typing import TYPE_CHECKING, Any

from .. import datafiles
from ..response.problem import RideProblem
from ..roads.spectra import PowerLawRoad
from ..vehicles.cars import QuarterCar

if TYPE_CHECKING:
    import pandas as pd


def _table1() -> dict[str, dict[str, str]]:
    return {row["symbol"]: row for row in datafiles.rows("paper/table1_vehicle.csv")}


def table1() -> "pd.DataFrame":
    """Return Table 1 as printed: quantity, symbol, value, unit and bounds, empty where there is none."""
    import pandas as pd

    return pd.DataFrame(datafiles.rows("paper/table1_vehicle.csv"))


def ride_problem(**changes: Any) -> RideProblem:
    """Return the problem of Table 1, with `changes` of parameters of `RideProblem`."""
    rows = _table1()
    value = {symbol: float(row["value"]) for symbol, row in rows.items() if row["value"]}
    car = QuarterCar(body_mass=value["Mb"], wheel_mass=value["Mw"], tyre_stiffness=value["Kt"])
    road = PowerLawRoad(roughness=value["G"], exponent=value["kappa"])
    limits = {symbol: (float(rows[symbol]["lower"]), float(rows[symbol]["upper"])) for symbol in ("f", "Ks", "Cs")}
    lower, upper = zip(limits["Ks"], limits["Cs"], strict=True)
    settings: dict[str, Any] = {"speed": value["V"], "band": limits["f"], "lower": lower, "upper": upper}
    return RideProblem(car, road, **settings | changes)


def reference_design() -> tuple[float, float]:
    """Return spring [N/m] and damper [N s/m] of the reference car, Table 1."""
    rows = _table1()
    return float(rows["Ks"]["value"]), float(rows["Cs"]["value"])


def optimised_design() -> tuple[float, float]:
    """Return spring [N/m] and damper [N s/m] of the published optimum, Table 5."""
    column = table5()["optimised"]
    return column["Ks"], column["Cs"]


def table5() -> dict[str, dict[str, float]]:
    """Return ``reference`` and ``optimised`` of Table 5: Ks [N/m], Cs [N s/m], SWS [m], ACC [m/s^2], DTL [N]."""
    rows = datafiles.rows("paper/table5_optimum.csv")
    return {
        column: {row["quantity"]: float(row[column]) * (1e3 if row["unit"].startswith("k") else 1) for row in rows}
        for column in ("reference", "optimised")
    }


def published_seconds() -> "pd.DataFrame":
    """Return Tables 2 and 3: columns algorithm, population, iterations, repeat, published_seconds."""
    import pandas as pd

    tables = {"nsga2": "paper/table2_nsga2_seconds.csv", "moead-dra": "paper/table3_moead_seconds.csv"}
    frames = {name: pd.read_csv(datafiles.path(path), comment="#") for name, path in tables.items()}
    seconds = pd.concat(frames, names=["algorithm"]).reset_index("algorithm")
    columns = ["algorithm", "population", "iterations", "repeat", "published_seconds"]
    return seconds.rename(columns={"seconds": "published_seconds"})[columns]


def is_papers(problem: RideProblem, *, band: bool = False) -> bool:
    """Whether a problem is the paper's, with any weighting and, unless asked for, any band."""
    kept = ["cases", "bounds", "kinds", "struts", "measures", "constraints", "worst_case"] + ["band"] * band
    papers = ride_problem()
    return all(getattr(problem, name) == getattr(papers, name) for name in kept)
