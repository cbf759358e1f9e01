"""The outcome of a comparison in sentences."""

import pandas as pd

from suspension_ctrl.commands.comparison_texts import outcome_texts
from suspension_ctrl.study.findings import Findings

RUNS = [
    ("nsga2", 10, "iterations", 110, 2.0, 0.9), ("moead-dra", 10, "iterations", 30, 1.0, 0.7),
    ("moead-dra", 10, "evaluations", 110, 4.0, 0.8), ("nsga2", 20, "iterations", 210, 3.0, 0.95),
    ("moead-dra", 20, "iterations", 50, 2.0, 0.8), ("moead-dra", 20, "evaluations", 210, 6.0, 0.85),
]  # fmt: skip
COLUMNS = ["algorithm", "iterations", "budget", "evaluations", "seconds", "hypervolume"]
TIMED = pd.DataFrame(RUNS, columns=COLUMNS).assign(population=10, igd_plus=0.0)
TIMES = (
    "nsga2 takes 1.50 to 2.00 times as long at equal iterations and 0.50 times as long at equal evaluations as "
)


def test_times_and_the_hypervolume_of_the_longest_configuration_are_told():
    about = "Hypervolume of the final populations, medians at equal"
    assert outcome_texts(TIMED, None) == [
        f"{TIMES}moead-dra.",
        f"{about} iterations for N = 10 and 20 iterations: nsga2 0.9500, moead-dra 0.8000.",
        f"{about} evaluations for N = 10 and 20 iterations: nsga2 0.9500, moead-dra 0.8500.",
    ]
    assert outcome_texts(TIMED.drop(columns="hypervolume"), None) == [f"{TIMES}moead-dra."]


def findings(verdict: pd.DataFrame) -> Findings:
    empty = pd.DataFrame()
    differences = pd.DataFrame({"first": ["nsga2"]})
    return Findings(empty, empty, empty, differences, empty, verdict, ["No verdict: too few."])


def test_the_verdict_stands_first():
    rows = [("population", 10, 10, "moead-dra", "nsga2", "no difference"),
            ("population", 10, 20, "moead-dra", "nsga2", "nsga2")]  # fmt: skip
    verdict = pd.DataFrame(
        rows, columns=["set", "population", "iterations", "other", "equal iterations", "equal time"]
    )
    assert outcome_texts(TIMED, findings(verdict))[0] == (
        "Hypervolume of the final population, nsga2 against moead-dra: nsga2 is ahead in 3, no difference in 1 "
        "of 4 tests, over configurations at equal iterations, evaluations and time."
    )
    assert outcome_texts(TIMED, findings(verdict[:0]))[0] == "No verdict: too few."
