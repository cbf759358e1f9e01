"""Both optimisers on problems of the literature: medians over seeds beside what is published.

ZDT1 to ZDT3, hypervolume at (1, 1) with N = 100 and 25,000 evaluations, objectives scaled to the front: A. J.
Nebro, F. Luna, E. Alba, B. Dorronsoro, J. J. Durillo, A. Beham, "AbYSS: adapting scatter search to multiobjective
optimization", IEEE Trans. Evol. Comput. 12(4), 2008, print the medians below for NSGA-II, with interquartile
ranges of 2 to 5e-4, and for the best of the algorithms compared (quoted from memory; jMetal's data, next, agree).

jMetal's repository holds tables of its own over 25 runs at these settings (crossover 0.9 and eta 20, mutation 1/d
and eta 20): ``experiment/NSGAIIStudy/latex/NSGAIIStudy.tex`` at commit 68df5ee, column NSGAIIb, with IGD+ on ZDT1
and ZDT2 (its ZDT3 is scaled otherwise: a hypervolume of 0.796). jMetalPy's has DTLZ2 of two objectives in
``examples/experiment/latex/statistical/Median-HV.csv`` at commit 027271a, without settings: presumed are jMetal's
standard ones, which are these.

A hundred points spread evenly over the true front have the best hypervolume printed to 2e-4. By them is judged
what no printed medians were found for: IGD+ elsewhere, DTLZ2 of three objectives, MOEA/D-DRA on any of the four.
What its own authors printed for it is in `test_published_cec09`.
"""

import numpy as np
import pandas as pd
import pytest
from deap import benchmarks as deaps

from functions import dtlz2, dtlz2_plane, zdt1, zdt2, zdt3
from suspension_ctrl import MoeadDra, Nsga2, minimise
from suspension_ctrl.search.indicators import ReferenceFront, evenly_spread, non_dominated

PROBLEMS = {"zdt1": zdt1, "zdt2": zdt2, "zdt3": zdt3, "dtlz2": dtlz2}
NSGA2 = {"zdt1": 0.6594, "zdt2": 0.3261, "zdt3": 0.5148}
BEST = {"zdt1": 0.6614, "zdt2": 0.3282, "zdt3": 0.5158}
JMETAL_IGD_PLUS = {"zdt1": (3.94e-3, 3.3e-4), "zdt2": (3.67e-3, 1.9e-4)}
JMETAL_DTLZ2_PLANE = (0.20932, 2.8e-4)
"""Medians and interquartile ranges."""

F1 = np.linspace(0, 1, 2000)


def fronts() -> dict[str, ReferenceFront]:
    third = np.stack([F1, 1 - np.sqrt(F1) - F1 * np.sin(10 * np.pi * F1)], axis=1)
    a, b = (angle.ravel() * np.pi / 2 for angle in np.meshgrid(np.linspace(0, 1, 200), np.linspace(0, 1, 200)))
    return {
        "zdt1": ReferenceFront.of(np.stack([F1, 1 - np.sqrt(F1)], axis=1)),
        "zdt2": ReferenceFront.of(np.stack([F1, 1 - F1**2], axis=1)),
        "zdt3": ReferenceFront.of(third[non_dominated(third)]),
        "dtlz2": ReferenceFront.of(np.stack([np.cos(a) * np.cos(b), np.cos(a) * np.sin(b), np.sin(a)], axis=1)),
    }


class AtNadir(ReferenceFront):
    """A front whose hypervolume is taken at its nadir, as in the publication."""

    HYPERVOLUME_REFERENCE = 1.0


REFERENCES = {name: AtNadir.of(front.objectives) for name, front in fronts().items()}
EVEN = {name: front.objectives[evenly_spread(front.objectives, 100)] for name, front in REFERENCES.items()}


def medians(optimiser, evaluations: int, seeds: int) -> pd.DataFrame:
    """Medians over seeds by problem."""
    rows = []
    for name, front in REFERENCES.items():
        problem = PROBLEMS[name](compiled=True)
        runs = [minimise(problem, optimiser, evaluations=evaluations, seed=s).objectives for s in range(seeds)]
        volumes, distances = [front.hypervolume(o) for o in runs], [front.igd_plus(o) for o in runs]
        rows.append({"problem": name, "hypervolume": np.median(volumes), "igd_plus": np.median(distances)})
    return pd.DataFrame(rows).set_index("problem")


def check_igd_plus_and_dtlz2(found: pd.DataFrame) -> None:
    """Up to 2.2 times as far from the front as an even spread, at least 0.88 of its volume."""
    for name, front in REFERENCES.items():
        assert 0.9 < found.igd_plus[name] / front.igd_plus(EVEN[name]) < 2.2
    assert 0.88 < found.hypervolume["dtlz2"] / REFERENCES["dtlz2"].hypervolume(EVEN["dtlz2"]) < 1.02


def test_an_even_spread_is_as_good_as_the_best_published():
    for name, best in BEST.items():
        assert REFERENCES[name].hypervolume(EVEN[name]) == pytest.approx(best, abs=2e-4)


def test_nsga2_is_as_good_as_published():
    found = medians(Nsga2(population=100), 25_000, seeds=11)
    for name, published in NSGA2.items():
        assert found.hypervolume[name] == pytest.approx(published, abs=5e-4)
    for name, (published, spread) in JMETAL_IGD_PLUS.items():
        assert found.igd_plus[name] < published + spread  # of zdt2 it is less by twice the spread
    check_igd_plus_and_dtlz2(found)


def test_nsga2_on_dtlz2_of_two_objectives_is_as_good_as_published():
    """To the interquartile range printed; the whole quarter of a circle has 1 - pi / 4 = 0.2146."""
    published, spread = JMETAL_DTLZ2_PLANE
    problem, optimiser = dtlz2_plane(), Nsga2(population=100)
    runs = [minimise(problem, optimiser, evaluations=25_000, seed=seed).objectives for seed in range(11)]
    angle = F1 * np.pi / 2
    front = AtNadir.of(np.stack([np.cos(angle), np.sin(angle)], axis=1))
    assert np.median([front.hypervolume(o) for o in runs]) == pytest.approx(published, abs=spread)


def test_moead_dra_gets_there_with_twice_the_evaluations():
    """Differential evolution alone takes longer on 30 variables; T = 20 and n_r = 2 as in MOEA/D-DE for N = 100.

    H. Li and Q. Zhang, "Multiobjective optimization problems with complicated Pareto sets, MOEA/D and NSGA-II",
    IEEE Trans. Evol. Comput. 13(2), 2009, for the settings.
    """
    found = medians(MoeadDra(population=100, neighbourhood=0.2, replacement_limit=0.02), 50_000, seeds=3)
    for name, published in NSGA2.items():
        assert published - 3e-3 < found.hypervolume[name] < BEST[name]
    check_igd_plus_and_dtlz2(found)


@pytest.mark.parametrize("name", PROBLEMS)
def test_problems_are_deaps(name):
    """In arrays, compiled, and as another library has them."""
    other = {"zdt1": deaps.zdt1, "zdt2": deaps.zdt2, "zdt3": deaps.zdt3, "dtlz2": lambda x: deaps.dtlz2(x, 3)}[
        name
    ]
    problem = PROBLEMS[name](compiled=True)
    designs = np.random.default_rng(0).random((50, len(problem.lower)))
    expected = np.array([sorted(other(design)) for design in designs])
    np.testing.assert_allclose(np.sort(problem.evaluate(designs), axis=1), expected, rtol=1e-12)
    kernel, arguments = problem.kernel
    np.testing.assert_allclose([kernel(d, *arguments) for d in designs], problem.evaluate(designs), rtol=1e-12)
