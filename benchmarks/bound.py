"""Random passive designs beside the bound of all controllers: the least criterion of designs over that of the LQR.

Prints by problem the number of designs and the least ratio over weights, to the criterion within the band and to
the one over all frequencies. Below 1 a passive design would be beyond the bound.
"""

from collections.abc import Mapping
from typing import Annotated, Any

import numpy as np
import pandas as pd
from typer import Option

from suspension_ctrl import Iso8608Road, PowerLawRoad, RideProblem, attainable, load_vehicle
from suspension_ctrl.commands import options, terminal
from suspension_ctrl.desk.bound import LEAST, WITHIN, criterion

_PART = 10_000
_POINTS = 64

Number = Annotated[int, Option(parser=options.whole_number)]


def problems() -> dict[str, tuple[RideProblem, Mapping[str, float]]]:
    """Return problems with their present designs by name."""
    found: dict[str, tuple[RideProblem, Mapping[str, float]]] = {}
    given: tuple[tuple[str, Any, dict[str, Any]], ...] = (
        ("yuen_ramli_2010", PowerLawRoad(roughness=5e-6, exponent=2.5), {"weighting": "Wk"}),
        ("yuen_ramli_2010", PowerLawRoad(roughness=5e-6, exponent=2.5), {"weighting": None}),
        ("yuen_ramli_2010", Iso8608Road("C"), {"weighting": None, "band": (0.0, 500.0)}),
        ("minaker_half", Iso8608Road("C"), {"band": (0.3, 20.0)}),
        ("jian_2022_full", Iso8608Road("C"), {"band": (0.3, 20.0)}),
    )
    for name, road, settings in given:
        file = load_vehicle(name)
        problem = RideProblem(file.vehicle, road, speed=20.0, bounds=file.bounds, **settings)
        present = {one: file.setting.get(one, 0.0) for one in problem.variables}
        low, high = problem.band
        found[f"{name}, {low:g} to {high:g} Hz, weighting {problem.weighting}"] = problem, present
    return found


def least_ratios(
    problem: RideProblem, present: Mapping[str, float], designs: int, seed: int
) -> tuple[float, float]:
    """Return the least criterion of random designs over that within the band, and over all frequencies."""
    table = attainable(problem, present=present, points=_POINTS)
    rows = table[table["controller"] == "LQR"]
    rng, least = np.random.default_rng(seed), np.full(len(rows), np.inf)
    for _ in range(-(-designs // _PART)):
        values = problem.evaluate(rng.uniform(problem.lower, problem.upper, (_PART, len(problem.lower))))
        least = np.minimum(least, criterion(table, values[:, : len(problem.measures)]).min(axis=0))
    return float((least / rows[WITHIN]).min()), float((least / rows[LEAST]).min())


def main(designs: Number = 1_000_000, seed: Number = 1) -> None:
    """Print the least ratios of random passive designs by problem."""
    rows = []
    for name, (problem, present) in terminal.progress(problems().items(), len(problems()), "problems"):
        rows.append([name, designs, *least_ratios(problem, present, designs, seed)])
    columns = ["problem", "designs", "least over within band [-]", "least over all frequencies [-]"]
    terminal.show(
        "Passive designs over the bound", pd.DataFrame(rows, columns=columns), {columns[2]: 3, columns[3]: 3}
    )


if __name__ == "__main__":
    terminal.run_script(main)
