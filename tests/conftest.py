"""Fixtures shared by the tests: the paper's problem, and where the checkout is."""

from pathlib import Path

import pytest
from hypothesis import settings

from suspension_ctrl import RideProblem, paper

# Examples are drawn from a fixed stream, so that a failure can be had again; timings of examples say nothing here.
settings.register_profile("suspension_ctrl", deadline=None, derandomize=True)
settings.load_profile("suspension_ctrl")


@pytest.fixture(scope="session")
def checkout() -> Path:
    return Path(__file__).parents[1]


@pytest.fixture(scope="session")
def table1_problem() -> RideProblem:
    return paper.ride_problem()
