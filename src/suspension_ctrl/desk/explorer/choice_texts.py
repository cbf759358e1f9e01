"""What the words of the choice mean: measures, names of candidates, changes, limits of several load cases."""

from collections.abc import Iterator, Sequence

from ...response.measures.measure import Measure
from ...response.problem import RideProblem
from ..choosing import BETWEEN, COMPROMISE, KNEE, NONE_WORSE

MEANINGS = {
    "ACC": "discomfort, root mean square (r.m.s.) of the weighted vertical acceleration",
    "SWS": "suspension working space, r.m.s. of the travel between body and wheel, of several the largest",
    "DTL": "dynamic tyre load, r.m.s. about the static load, of several tyres the largest",
    "DLC": "dynamic load coefficient, r.m.s. of the tyre load over its static load, of several tyres the largest",
    "SEAT": "weighted acceleration of a seat over that of the floor below it",
    "A8": "daily exposure, weighted acceleration as if it lasted eight hours",
    "VDV": "vibration dose value",
    "MSDV": "motion sickness dose value",
    "q": "value that this share of vehicles keeps to over the scatter",
    "CVaR": "mean of this share of worst values over the scatter",
    "": "root of the sum of squares of",
}
"""Meanings of measures by the word of their class, of those that do not say it themselves."""
NAMES = {
    KNEE: "from there a gain in one measure costs most in the others",
    COMPROMISE: "nearest to the best of all measures at once",
    NONE_WORSE: "worse than the present design in no measure",
    BETWEEN: "between the others along the front",
}
"""Meanings of names of candidates."""


def choice_texts(problem: RideProblem, names: Sequence[str], *, present: bool) -> list[str]:
    """Return a sentence about measures, one about names of candidates, and one about changes and limits."""
    return [" ".join(_reading(problem, present)), *_sentence(_measures(problem)), *_sentence(_candidates(names))]


def _sentence(parts: Iterator[str]) -> list[str]:
    text = "; ".join(parts)
    return [f"{text}."] if text else []


def _reading(problem: RideProblem, present: bool) -> Iterator[str]:
    yield "Less is better in every measure."
    if present:
        yield "Changes are against the present design: ▼ better, ▲ worse."
    if problem.constraints and limited_by_case(problem):
        yield "Measures are means over the load cases; limits hold in the worst of them."


def limited_by_case(problem: RideProblem) -> bool:
    """Return whether a limit, which holds in the worst load case, is of another value than the measure."""
    return len(problem.cases) > 1 and not problem.worst_case


def _measures(problem: RideProblem) -> Iterator[str]:
    """Yield the meanings of measures of the problem and of its limits, one for places alike."""
    measures = [*problem.measures, *(one.measure for one in problem.constraints)]
    told = dict.fromkeys(text for one in measures for text in (_meaning(one), _meaning(one.nominal)))
    yield from filter(None, told)


def _meaning(measure: Measure) -> str:
    meaning = MEANINGS.get(getattr(measure, "word", "-"))
    if meaning is None:
        return ""
    if not measure.word:
        return f"{measure.label}: {meaning} {measure.label if not measure.name else str(measure).split(' = ')[1]}"
    return f"{measure.name or measure.word}: {meaning}"


def _candidates(names: Sequence[str]) -> Iterator[str]:
    own = {one for name in names for one in name.split(", ")}
    yield from (f"{name}: {meaning}" for name, meaning in NAMES.items() if name in own)
