"""Work spread over processes and machines by Dask, or done here: the same results in any order."""

from collections.abc import Callable, Iterator, Mapping
from contextlib import AbstractContextManager, contextmanager, nullcontext
from typing import TYPE_CHECKING, Any, TypeVar
from uuid import uuid4

import numpy as np

from .. import checks
from ..checks import installed
from ..quantities import Real
from ..search.problem import Described, Problem

if TYPE_CHECKING:
    from distributed import Client


T = TypeVar("T")


def local_cluster(jobs: int) -> AbstractContextManager["Client"]:
    """Start `jobs` processes of one thread each on this machine, reachable from it alone."""
    checks.at_least("jobs", jobs, 1)
    return _local_cluster(jobs)


@contextmanager
def _local_cluster(jobs: int) -> Iterator["Client"]:
    with installed("study"):
        from distributed import Client, LocalCluster  # over a second: only where it is used

    settings: dict[str, Any] = {"n_workers": jobs, "threads_per_worker": 1, "memory_limit": 0}
    # The server of dask's metrics starts in any case; without an address it listens to the network.
    local = {"host": "127.0.0.1"} | dict.fromkeys(("dashboard_address", "worker_dashboard_address"), "127.0.0.1:0")
    with (
        LocalCluster(**settings, **local, silence_logs="CRITICAL") as made,
        Client(made, set_as_default=False) as client,
    ):
        yield client


def scheduler_at(address: str, timeout: float = 10.0) -> AbstractContextManager["Client"]:
    """Connect to a running scheduler that has a worker, within `timeout` [s].

    Its address is ``tcp://host:8786``, or ``tls://host:8786`` with the certificates of Dask's configuration
    (``distributed.comm.tls``).
    """
    if not address.startswith(("tcp://", "tls://")):
        raise ValueError(f"scheduler must be tcp://host:port or tls://host:port, got {address!r}")
    return _connected(address, timeout)


@contextmanager
def _connected(address: str, timeout: float) -> Iterator["Client"]:
    with installed("study"):
        from distributed import Client

    try:
        client = Client(address, timeout=timeout, set_as_default=False)
    except (OSError, TypeError, ValueError) as error:  # TypeError: tls:// without certificates
        raise ValueError(f"scheduler must be one that answers, got {address!r}: {error}") from error
    with client:
        try:
            client.wait_for_workers(1, timeout=timeout)
        except TimeoutError:
            raise ValueError(f"scheduler must have a worker, got {address!r} without one") from None
        yield client


def cluster(jobs: int | None = None, scheduler: str | None = None) -> AbstractContextManager["Client | None"]:
    """Return a context with a client of `jobs` processes or of a scheduler, or with None for work done here."""
    if jobs is not None and scheduler is not None:
        raise ValueError(f"jobs must stand without scheduler, got {jobs} and {scheduler!r}")
    if jobs is not None:
        return local_cluster(jobs)
    return nullcontext() if scheduler is None else scheduler_at(scheduler)


def outcomes(
    function: Callable[..., T], arguments: Mapping[str, tuple[Any, ...]], client: "Client | None" = None
) -> Iterator[tuple[str, T | None, str]]:
    """Call the function with each of the arguments and yield name, result and error (``""``) of each as it ends.

    A cluster repeats the call of a worker that dies, up to four times; ConnectionError if the scheduler is lost.
    """
    if client is None:
        for name, values in arguments.items():
            yield name, *outcome(function, values)
        return
    with installed("study"):
        from distributed import as_completed

    futures = {
        client.submit(outcome, function, values, key=f"{name}-{uuid4()}", pure=False): name
        for name, values in arguments.items()
    }
    for future in as_completed(futures, loop=client.loop):
        name = futures.pop(future)
        if future.status == "error":
            yield name, None, _line(future.exception())
        elif future.status != "finished":
            raise ConnectionError(f"scheduler lost: {future.status} {name}; what was finished is kept")
        else:
            yield name, *future.result()
        future.release()


def outcome(function: Callable[..., T], arguments: tuple[Any, ...]) -> tuple[T | None, str]:
    """Call the function and return its result, or None and its error in one line."""
    try:
        return function(*arguments), ""
    except Exception as error:  # whatever an evaluation raises, the other runs go on
        return None, _line(error)


def _line(error: BaseException) -> str:
    return " ".join(f"{type(error).__name__}: {error}".split())


def distributed(problem: Described, client: "Client", chunk: int = 16) -> Problem:
    """Return a slow problem evaluated on a cluster, `chunk` designs at a time, without its kernel.

    MOEA/D-DRA should then make its children in batches (``update="batch"``).
    """
    checks.at_least("chunk", chunk, 1)

    def evaluate(designs: Real) -> Real:
        parts = [designs[start : start + chunk] for start in range(0, len(designs), chunk)]
        return np.concatenate(client.gather(client.map(problem.evaluate, parts, pure=False)))

    names = ("lower", "upper", "objectives", "constraints", "variables", "units")
    same = {name: getattr(problem, name) for name in names}
    return Problem(evaluate=evaluate, kinds=getattr(problem, "kinds", {}), **same)
