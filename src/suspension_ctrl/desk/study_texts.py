"""A study in sentences."""

from ..tables.headers import shown_value
from .study_files import StudyFile


def introduced(study: StudyFile) -> list[str]:
    """Return name, band, variables, load cases and present design of a study, a sentence each."""
    problem, (low, high) = study.problem, study.problem.band
    weighted = f"; ACC weighted with {problem.weighting}" if problem.weighted else ""
    own = (f"{name} {shown_value(value, problem.units[name])}" for name, value in study.present.items())
    return [
        f"{study.name}; {low:g} to {high:g} Hz{weighted}.",
        *problem.describe(),
        f"Present design: {', '.join(own) or 'not known'}.",
    ]
