"""What changes candidates most: against the table of sensitivities of each design."""

import pandas as pd

from garage import QUARTER, ROAD
from suspension_ctrl import Nsga2, RideProblem, candidates, minimise, sensitivity
from suspension_ctrl.desk.candidate_slopes import candidate_slopes

BOUNDS = {"spring": (1e4, 3e4), "damper": (1e3, 4e3)}


def test_each_candidate_has_its_strongest_variables():
    given = {"speed": 20.0, "bounds": BOUNDS, "band": (0.3, 20.0)}
    problem = RideProblem(QUARTER, ROAD, measures=["ACC", "SWS", "-damper_power"], **given)
    run = minimise(problem, Nsga2(population=20), iterations=2, seed=1)
    table = candidates(problem, run, present=[35e3, 1500.0], count=3)
    found = candidate_slopes(problem, table)
    labels = ["ACC", "SWS", "-damper_power"]
    assert list(found) == ["name", *(f"{label} by 1 % more" for label in labels)]
    for number, row in found.iterrows():
        design = table.loc[number, ["spring [N/m]", "damper [N s/m]"]].tolist()
        own = sensitivity(problem, design).loc[list(BOUNDS)]
        for label in labels:
            shares = own[f"{label} [%]"]
            strongest = shares.abs().idxmax()
            assert row[f"{label} by 1 % more"] == f"{strongest} {shares[strongest]:+.2f} %"
    assert found["name"].iloc[0] == "present design"


def test_a_change_that_would_read_zero_is_none():
    """On the flat of the tyre load over the spring, and beside it."""
    given = {"bounds": {"spring": (1e4, 3e4)}, "struts": {"damper": 1500.0}, "measures": ["ACC", "DTL"]}
    problem = RideProblem(QUARTER, ROAD, speed=20.0, band=(0.3, 20.0), **given)
    springs = [1e4, 1.2e4]
    found = candidate_slopes(problem, pd.DataFrame({"name": ["a", "b"], "spring [N/m]": springs}))
    flat, beside = (sensitivity(problem, [one]).loc["spring", "DTL [%]"] for one in springs)
    assert abs(flat) < 0.005 < abs(beside) < 0.05
    assert found["DTL by 1 % more"].tolist() == ["none", f"spring {beside:+.2f} %"]
