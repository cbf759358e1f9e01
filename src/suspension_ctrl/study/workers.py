"""Processes of this machine or of others, by Dask."""

import ast
import inspect
import logging
import signal
import sys
import warnings
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from contextlib import AbstractContextManager, ExitStack, contextmanager, nullcontext, suppress
from multiprocessing.resource_tracker import ensure_running
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from .. import checks
from ..checks import installed
from ..quantities import Real
from ..search.problem import Minimisable, Problem
from .machine import PACKAGES

if TYPE_CHECKING:
    from distributed import Client

_SETTINGS = {
    "distributed.deploy.lost-worker-timeout": "1 day",  # on a busy machine a worker takes long to come back
    "distributed.scheduler.allowed-failures": 0,  # `calls` repeats what was on a worker that died
}


def local_cluster(jobs: int, dashboard: str | None = None) -> AbstractContextManager["Client"]:
    """Start `jobs` processes of one thread each on this machine, reachable from it alone.

    Dask's dashboard is served at an address such as ``127.0.0.1:8787`` if given. A script must call this under
    ``if __name__ == "__main__":`` as the processes import it; one that does not ends with a line that says so.
    """
    checks.at_least("jobs", jobs, 1)
    if line := _unguarded_line():
        sys.exit(f'error: processes must be started under: if __name__ == "__main__": got {line} outside of it')
    return _local_cluster(jobs, dashboard)


@contextmanager
def _local_cluster(jobs: int, dashboard: str | None) -> Iterator["Client"]:
    with installed("study"):
        import dask
        import distributed  # noqa: F401  # its defaults come with it: they would leave with the settings below

    with ExitStack() as stack:
        stack.enter_context(dask.config.set(_SETTINGS))
        helper = stack.enter_context(ThreadPoolExecutor(1))
        with _interrupts_blocked():
            starting = helper.submit(_started, jobs, dashboard)
        try:
            made, client = starting.result()
        except RuntimeError as error:
            raise ChildProcessError(f"processes must start, got: {error.__cause__ or error}") from error
        except KeyboardInterrupt:
            made, client = starting.result()  # never half started
            _kill(made)
            made.close()
            raise
        stack.enter_context(made)
        stack.push(lambda kind, *_: _kill(made) if kind else None)
        yield stack.enter_context(client)


def _started(jobs: int, dashboard: str | None) -> tuple[Any, "Client"]:
    """Start processes and a client of them."""
    from distributed import Client, LocalCluster  # over a second: only where it is used

    # Dask's server of metrics starts in any case; without an address it listens to the network.
    scheduler = {"dashboard": dashboard is not None, "dashboard_address": dashboard or "127.0.0.1:0"}
    settings: dict[str, Any] = {"n_workers": jobs, "threads_per_worker": 1, "memory_limit": 0, "host": "127.0.0.1"}
    settings |= {"scheduler_kwargs": scheduler, "dashboard_address": None, "worker_dashboard_address": None}
    _silence()
    made = LocalCluster(**settings, silence_logs="CRITICAL")
    return made, Client(made, set_as_default=False)


def _silence() -> None:
    """Keep Dask's loggers from telling of lost processes and connections: errors do."""
    for name in ("distributed", *logging.root.manager.loggerDict):
        if name.startswith("distributed"):
            logging.getLogger(name).setLevel(logging.CRITICAL)


def _kill(made: Any) -> None:
    """Kill the processes of a cluster that is given up: in the midst of a run they take seconds to stop."""
    import psutil  # of distributed

    for nanny in made.workers.values():
        nanny.auto_restart = False
        with suppress(psutil.Error, TypeError):  # TypeError: not started
            psutil.Process(nanny.pid).kill()


@contextmanager
def _interrupts_blocked() -> Iterator[None]:
    """Block Ctrl-C for the threads and, through them, processes started here: it reaches this process alone."""
    if not hasattr(signal, "pthread_sigmask"):  # Windows
        yield
        return
    ensure_running()  # of multiprocessing; started later, it lets interrupts through
    before = signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)


def _unguarded_line() -> str:
    """Return file and line of a script that runs now outside of a main guard, ``""`` if there is none."""
    frame: Any = inspect.currentframe()
    while frame and not (frame.f_code.co_name == "<module>" and frame.f_globals.get("__name__") == "__main__"):
        frame = frame.f_back
    path = frame and frame.f_globals.get("__file__")
    if not path or not Path(path).is_file():
        return ""
    try:
        statements = ast.parse(Path(path).read_bytes()).body
    except (OSError, ValueError, SyntaxError):
        return ""
    guards = [s for s in statements if isinstance(s, ast.If) and "__name__" in ast.unparse(s.test)]
    guarded = any(s.lineno <= frame.f_lineno <= (s.end_lineno or s.lineno) for s in guards)
    return "" if guarded else f"line {frame.f_lineno} of {path}"


def scheduler_at(address: str, timeout: float = 10.0) -> AbstractContextManager["Client"]:
    """Connect to a running scheduler that has a worker, within `timeout` [s], and this machine's versions.

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

    _silence()
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # of versions: they are compared below
            client = Client(address, timeout=timeout, set_as_default=False)
    except (OSError, TypeError, ValueError) as error:  # TypeError: tls:// without certificates
        raise ValueError(f"scheduler must be one that answers, got {address!r}: {error}") from error
    with client:
        try:
            client.wait_for_workers(1, timeout=timeout)
        except TimeoutError:
            raise ValueError(f"scheduler must have a worker, got {address!r} without one") from None
        _check_versions(client)
        yield client


def _check_versions(client: "Client") -> None:
    """Raise ValueError where a worker has other versions than this process of what determines a result."""
    found: Any = client.get_versions(packages=PACKAGES)
    here = found["client"]["packages"]
    for address, there in found["workers"].items():
        for name in ("python", *PACKAGES):
            wanted, got = here[name], there["packages"].get(name)
            if got != wanted:
                raise ValueError(
                    f"scheduler must have workers with {name} {wanted} as here, got {got} at {address}"
                )


def cluster(jobs: int | None = None, scheduler: str | None = None) -> AbstractContextManager["Client | None"]:
    """Return a context with a client of `jobs` processes or of a scheduler, or with None for work done here."""
    if jobs is not None and scheduler is not None:
        raise ValueError(f"jobs must stand without scheduler, got {jobs} and {scheduler!r}")
    if jobs is not None:
        return local_cluster(jobs)
    return nullcontext() if scheduler is None else scheduler_at(scheduler)


def distributed(problem: Minimisable, client: "Client", chunk: int = 16) -> Problem:
    """Return a slow problem evaluated on a cluster, `chunk` designs at a time, without its kernel.

    MOEA/D-DRA should then make its children in batches (``update="batch"``).
    """
    checks.at_least("chunk", chunk, 1)

    def evaluate(designs: Real) -> Real:
        parts = [designs[start : start + chunk] for start in range(0, len(designs), chunk)]
        return np.concatenate(client.gather(client.map(problem.evaluate, parts, pure=False)))

    names = ("lower", "upper", "objectives", "variables", "units", "kinds")
    same = {name: getattr(problem, name) for name in names}
    return Problem(evaluate=evaluate, constraints=tuple(map(str, problem.constraints)), **same)
