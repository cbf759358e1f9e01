"""Does a campaign spend more on indicators than on searches? Processor time of both, by algorithm and population.

``python benchmarks/judging.py --study full_car`` makes the runs of a study from one seed in this process and
prints a table. A first pass, which compiles and is not counted, gives the reference front.
"""

import argparse
from dataclasses import replace
from time import thread_time

import pandas as pd

import suspension_ctrl as sc
from suspension_ctrl.search.indicators import ReferenceFront
from suspension_ctrl.search.trace import Trace, trace
from suspension_ctrl.study.comparison import Comparison
from suspension_ctrl.study.judging import ARCHIVE, judged
from suspension_ctrl.study.reference import best_known
from suspension_ctrl.study.study import Study
from suspension_ctrl.threads import limited

ALGORITHMS = ("nsga2", "moead-dra", "nsga2-gamultiobj", "random", "sobol")


def measured(comparison: Comparison, repeats: int = 3) -> pd.DataFrame:
    """Return a row per population and algorithm: the least processor times [ms] of repeats, states, size.

    They are those of the search, of judging, and of judging the states that are compared alone.
    """
    rows = []
    for population, study in comparison.studies().items():
        traces = {name: searched(study, name)[0] for name in study.algorithms}
        front = best_known([seen.objectives[seen.feasible] for seen in traces.values()])
        for name in study.algorithms:
            timed_judging(traces[name], population, front)
            searches, judgings, alone, found = [], [], [], pd.DataFrame()
            for _ in range(repeats):
                seen, seconds = searched(study, name)
                searches.append(1e3 * seconds)
                found, seconds = timed_judging(seen, population, front)
                judgings.append(1e3 * seconds)
                few = {one: state for one, state in seen.states.items() if one in comparison.compared(population)}
                alone.append(1e3 * timed_judging(replace(seen, states=few), population, front)[1])
            size = found[found.set == ARCHIVE].members.max()
            row = {"N": population, "algorithm": name, "search": min(searches), "judging": min(judgings)}
            row["compared"] = min(alone)
            rows.append(row | {"states": found.evaluations.nunique(), "archive": size})
    return pd.DataFrame(rows)


def searched(study: Study, name: str) -> tuple[Trace, float]:
    """Return the trace of a run from the first seed and its processor time [s]."""
    began = thread_time()
    seen = trace(study.problems["ride"], study.algorithms[name], study.budgets, study.seeds[0])
    return seen, thread_time() - began


def timed_judging(seen: Trace, population: int, front: ReferenceFront) -> tuple[pd.DataFrame, float]:
    """Return the rows of a judged run and the processor time [s]."""
    began = thread_time()
    rows = list(judged(seen, population, front))
    return pd.DataFrame(rows), thread_time() - began


def main() -> None:
    """Print the table of a study and the share of judging."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--study", default="paper")
    study = sc.load_study(parser.parse_args().study)
    search = replace(study.search, algorithms=ALGORITHMS)
    with limited(1):
        table = measured(search.comparison(study.problem))
    print(table.round(1).to_string(index=False))
    total = table[["search", "judging", "compared"]].sum()
    shares = f"{total.judging / total.search:.2f}, of states compared alone {total.compared / total.search:.2f}"
    print(f"searches {total.search:.0f} ms, judging {total.judging:.0f} ms: {shares}")


if __name__ == "__main__":
    main()
