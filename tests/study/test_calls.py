"""Calls spread over processes: what raises, cannot be pickled or kills its worker is told, the others are made."""

import os
import signal
import threading

import pytest

from suspension_ctrl.study import calls, workers


def ratio(a: float, b: float) -> float:
    return a / b


def fatal(name: str, lock: object = None) -> str:
    if name == "deadly":
        os.kill(os.getpid(), getattr(signal, "SIGKILL", signal.SIGTERM))
    if name == "leaves":
        raise SystemExit(3)
    return name


@pytest.fixture(scope="module")
def cluster():
    with workers.local_cluster(2) as client:
        yield client


def test_what_raises_is_told_in_one_line_here_and_on_a_worker(cluster):
    work = {"a": (1, 2), "b": (1, 0)}
    wanted = {"a": (0.5, ""), "b": (None, "ZeroDivisionError: division by zero")}
    for client in (None, cluster):
        assert {name: rest for name, *rest in calls.outcomes(ratio, work, client)} == {
            name: list(rest) for name, rest in wanted.items()
        }


def test_the_others_are_made_beside_calls_that_kill_leave_or_cannot_be_pickled(cluster):
    """A call that kills its workers is given up after three of them."""
    names = ["deadly", *"abcd", "leaves"]
    work = {name: (name,) for name in names} | {"local": ("local", threading.Lock())}
    before = set(cluster.run(os.getpid).values())
    found = {name: (result, error) for name, result, error in calls.outcomes(fatal, work, cluster)}
    assert {name: found[name] for name in "abcd"} == {name: (name, "") for name in "abcd"}
    assert found["deadly"] == (None, "KilledWorker: the run killed each of its processes")
    assert found["leaves"] == (None, "SystemExit: 3")
    assert found["local"][0] is None
    assert found["local"][1].startswith("TypeError: cannot pickle")
    cluster.wait_for_workers(2, timeout=60)
    assert set(cluster.run(os.getpid).values()) != before


class NoWorkers:
    """A client whose cluster has lost all workers, or its scheduler."""

    def __init__(self, error: Exception | None = None) -> None:
        self.error = error

    def nthreads(self) -> dict[str, int]:
        if self.error:
            raise self.error
        return {}


@pytest.mark.parametrize(
    ("client", "said"),
    [
        (NoWorkers(), r"workers lost: none for 0 s; what was finished is kept"),
        (NoWorkers(OSError("closed")), r"scheduler lost: closed; what was finished is kept"),
    ],
)
def test_a_cluster_without_workers_or_scheduler_ends_the_calls(client, said, monkeypatch):
    monkeypatch.setattr(calls, "PATIENCE", 0.0)
    with pytest.raises(ConnectionError, match=f"^{said}$"):
        list(calls.outcomes(ratio, {"a": (1, 2)}, client))
