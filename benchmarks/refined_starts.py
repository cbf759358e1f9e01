"""Is an optimum found from anywhere? Every measure of a study refined from random designs.

Prints for each measure how many starts end with a residual below 1e-8, how many of them at the best value found
and at other (local) ones, and the processor time of a descent. By default data/studies/full_car.toml: eight
variables, two limits, the worst of four wheels in three load cases.
"""

import argparse
import time
from collections import Counter
from pathlib import Path
from typing import NamedTuple

import numpy as np

import suspension_ctrl as sc

STUDY = Path(__file__).parents[1] / "data" / "studies" / "full_car.toml"
EXACT = 1e-8
EQUAL = 1e-6  # relative difference of values of one optimum


class Ends(NamedTuple):
    """Where descents end: values, residuals, processor times (n,) [s]; and starts without a design in limits."""

    values: np.ndarray
    residuals: np.ndarray
    seconds: np.ndarray
    failed: int

    def describe(self) -> list[str]:
        """Return the numbers of starts by where they end, and times, a line each."""
        best = self.values.min()
        places = Counter(float(f"{value:.6g}") for value in self.values if value > best * (1 + EQUAL))
        local = ", ".join(f"{value:g} ({count})" for value, count in sorted(places.items()))
        exact = int((self.residuals < EXACT).sum())
        at_best = int((self.values <= best * (1 + EQUAL)).sum())
        return [
            f"{exact} of {self.values.size + self.failed} with a residual below {EXACT:g}"
            f" (largest {self.residuals.max():.0e}), {self.failed} without a design within the limits",
            f"{at_best} at the best value {best:.8g}; local: {local or 'none'}",
            f"{np.median(self.seconds):.3f} s (median), {self.seconds.max():.3f} s (longest) of processor time",
        ]


def refined(problem: sc.RideProblem, measure: str, starts: int, seed: int = 0) -> Ends:
    """Return where descents to the least of a measure end, from random designs."""
    lower, upper = np.array(problem.lower), np.array(problem.upper)
    designs = lower + np.random.default_rng(seed).random((starts, lower.size)) * (upper - lower)
    found, failed = [], 0
    for design in designs:
        begun = time.process_time()
        try:
            best = sc.refine(problem, design, minimise=measure)
        except ValueError:
            failed += 1
            continue
        found.append((best.measures[measure], best.residual, time.process_time() - begun))
    values, residuals, seconds = np.array(found).reshape(-1, 3).T
    return Ends(values, residuals, seconds, failed)


def main() -> None:
    """Refine and print."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--study", default=str(STUDY), help="file or name of a study")
    parser.add_argument("--starts", type=int, default=100)
    parser.add_argument("--seed", type=int, default=0)
    given = parser.parse_args()
    problem = sc.load_problem(given.study)
    for measure in problem.objectives:
        refined(problem, measure, 1)  # compiles
        print(f"least {measure}", *refined(problem, measure, given.starts, given.seed).describe(), sep="\n    ")


if __name__ == "__main__":
    main()
