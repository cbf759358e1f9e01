"""Plans of results folders: settings as JSON, differences named by key, spoilt files by their path."""

from dataclasses import replace

import numpy as np
import pytest

from suspension_ctrl import Problem
from suspension_ctrl.study import plans


def test_a_difference_in_a_vehicle_or_on_a_road_is_named_by_its_key(tmp_path, table1_problem):
    path = tmp_path / "plan.json"
    plans.settle(path, {"problem": table1_problem}, started=False)
    plans.settle(path, {"problem": table1_problem}, started=True)
    case = table1_problem.cases[0]
    faster = table1_problem.replace(speed=25.0)
    heavier = table1_problem.replace(vehicle=replace(case.vehicle, body_mass=320.0))
    both = table1_problem.replace(speed=25.0, weighting="Wb")
    for other, key, there, here in (
        (faster, "problem.cases.0.speed", "20.0", "25.0"),
        (heavier, "problem.cases.0.vehicle.body_mass", "317.5", "320.0"),
        (both, "problem.cases.0.speed", "20.0", "25.0 (also another problem.weighting)"),
    ):
        with pytest.raises(ValueError, match=rf"^{key} must be") as found:
            plans.settle(path, {"problem": other}, started=True)
        assert str(found.value) == f"{key} must be {there} as in {str(path)!r} to resume there, got {here}"


def test_settings_of_any_kind_are_described_alike_in_every_process():
    def evaluate(x):
        return x

    problem = Problem(evaluate=evaluate, lower=(0, 0), upper=(1, 1), objectives=("a", "b"))
    found = plans.described(
        {"p": problem, "long": np.arange(200.0), "short": np.arange(2), "inf": np.inf, "o": object()}
    )
    assert found["p"]["evaluate"] == evaluate.__qualname__
    assert found["p"]["upper"] == [1.0, 1.0]
    assert found["long"]["shape"] == [200]
    assert found["short"] == [0, 1]
    assert found["inf"] == "inf"
    assert found["o"] == "<object object>"
    assert plans.described(np.arange(200.0)) != plans.described(np.arange(200.0) + 1)


def test_long_values_are_cut_to_where_they_differ(tmp_path):
    path = tmp_path / "plan.json"
    plans.settle(path, {"text": "a" * 100 + "b" + "c" * 100}, started=False)
    with pytest.raises(ValueError, match=r"^text must be \.\.\.a+bc+\.\.\. as in .*, got \.\.\.a+dc+\.\.\.$"):
        plans.settle(path, {"text": "a" * 100 + "d" + "c" * 100}, started=True)


@pytest.mark.parametrize(
    ("content", "said"),
    [
        (b"", "must be JSON, got JSONDecodeError"),
        (b"[1]", "must be a JSON object, got list"),
        (b"null", "must be a JSON object, got NoneType"),
        (b'{"seeds": NaN}', "must be JSON, got ValueError"),
        (b"[" * 100_000, "must be JSON, got RecursionError"),
        (b"\x80{}", "must be JSON, got UnicodeDecodeError"),
        (b" " * 2_000_000, "must be a regular file of up to 1000000 bytes"),
        (None, "must be a regular file of up to 1000000 bytes"),
    ],
)
def test_a_spoilt_plan_is_named_or_without_runs_made_anew(tmp_path, content, said):
    path = tmp_path / "plan.json"
    if content is not None:
        path.write_bytes(content)
    with pytest.raises(ValueError, match=f"^.*plan.json: {said}; without it its runs cannot be told from those "):
        plans.settle(path, {"seeds": 3}, started=True)
    plans.settle(path, {"seeds": 3}, started=False)
    assert plans.read(path) == {"seeds": 3}
