"""Fixtures shared by the tests: the paper's problem, and where the checkout is."""

from pathlib import Path

import pytest
from hypothesis import settings

from suspension_ctrl import RideProblem, paper, references

# Examples are drawn from a fixed stream, so that a failure can be had again; timings of examples say nothing here.
settings.register_profile("suspension_ctrl", deadline=None, derandomize=True)
settings.load_profile("suspension_ctrl")


@pytest.fixture(scope="session", autouse=True)
def cache(tmp_path_factory) -> None:
    """Reference fronts are kept for this session alone, in whatever process they are made."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv(references.CACHE, str(tmp_path_factory.mktemp("cache")))
        yield


@pytest.fixture(scope="session")
def checkout() -> Path:
    return Path(__file__).parents[1]


@pytest.fixture(scope="session")
def table1_problem() -> RideProblem:
    return paper.ride_problem()
