"""Worker processes on this machine or on others, by Dask."""

import ast
import inspect
import logging
import signal
import sys
import warnings
from collections.abc import Callable, Iterator
from concurrent.futures import Future, ThreadPoolExecutor
from contextlib import AbstractContextManager, ExitStack, contextmanager, nullcontext, suppress
from multiprocessing.resource_tracker import ensure_running
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from .. import checks
from ..checks import installed
from ..quantities import Real
from ..search.problem import Minimisable, Problem
from ..threads import limited
from .machine import PACKAGES

if TYPE_CHECKING:
    from distributed import Client

_SETTINGS = {
    "distributed.deploy.lost-worker-timeout": "1 day",  # on a busy machine the restart of a worker is slow
    "distributed.scheduler.allowed-failures": 0,  # `calls` repeats the calls of dead workers
}


def local_cluster(jobs: int, dashboard: str | None = None) -> AbstractContextManager["Client"]:
    """Return a context with a client of `jobs` processes of one thread on this machine, local connections only.

    Dask's dashboard is served at an address such as ``127.0.0.1:8787`` if given. A script must call this under
    ``if __name__ == "__main__":``, as the processes import the script; otherwise the script ends with an error.
    """
    checks.at_least("jobs", jobs, 1)
    if line := _unguarded_line():
        sys.exit(f'error: processes must be started under: if __name__ == "__main__": got {line} outside of it')
    return _local_cluster(jobs, dashboard)


@contextmanager
def _local_cluster(jobs: int, dashboard: str | None) -> Iterator["Client"]:
    with installed("study"):
        import dask
        import distributed  # noqa: F401  # before the settings, which would discard its defaults at their end

    with ExitStack() as stack:
        stack.enter_context(dask.config.set(_SETTINGS))
        helper = stack.enter_context(ThreadPoolExecutor(1))
        with _interrupts_blocked():
            starting = helper.submit(_started, jobs, dashboard)
            stack.callback(_end, starting)
        try:
            _, client = starting.result()
        except RuntimeError as error:
            raise ChildProcessError(f"processes must start, got: {error.__cause__ or error}") from error
        yield client


def _end(starting: "Future[tuple[Any, Client]]") -> None:
    """Close client and cluster once they have started; kill the processes, which would take seconds to stop."""
    if starting.exception() is None:
        started, client = starting.result()
        with ExitStack() as stack:
            stack.callback(started.close)
            stack.callback(_kill, started)
            stack.callback(client.close)


@contextmanager
def begun(context: AbstractContextManager[Any], *needed: Any) -> Iterator[Callable[[], Any]]:
    """Enter the context of a client in a thread, as processes take seconds to start; yield what waits for it.

    Its workers import the modules of what will be `needed`. Errors of entering are raised where it is waited for.
    """
    with installed("study"):
        from distributed import fire_and_forget  # by one thread at a time

    def entered() -> Any:
        client = context.__enter__()
        with suppress(Exception):  # which the calls meet again, and name their run
            for worker in client.nthreads():
                fire_and_forget(client.submit(_unpickled, needed, workers=[worker], pure=False))
        return client

    with ExitStack() as stack:
        entering = stack.enter_context(ThreadPoolExecutor(1)).submit(entered)
        stack.push(lambda *raised: None if entering.exception() else context.__exit__(*raised))
        yield entering.result


def _unpickled(_needed: Any) -> None:
    """Do nothing with arguments, on a worker: they were unpickled."""


def _started(jobs: int, dashboard: str | None) -> tuple[Any, "Client"]:
    """Return a started cluster and its client."""
    from distributed import LocalCluster  # over a second: only where it is used

    # Dask always starts a server of metrics; without an address it would listen to the network.
    scheduler = {"dashboard": dashboard is not None, "dashboard_address": dashboard or "127.0.0.1:0"}
    settings: dict[str, Any] = {"n_workers": jobs, "threads_per_worker": 1, "memory_limit": 0, "host": "127.0.0.1"}
    settings |= {"scheduler_kwargs": scheduler, "dashboard_address": None, "worker_dashboard_address": None}
    _silence()
    started = LocalCluster(**settings, silence_logs="CRITICAL")
    try:
        return started, _client(started)
    except BaseException:
        started.close()
        raise


def _client(server: Any, **settings: Any) -> "Client":
    """Return a client of a cluster or an address; one that fails to connect is closed.

    Left open, it would be closed by the garbage collector, in any thread, and wait for a lock that each client
    holds while it starts: a collection during the start of the next client would stop that one.
    """
    import distributed

    base: Any = distributed.Client  # without annotations

    class Client(base):  # type: ignore[misc]
        def start(self, **given: Any) -> None:
            try:
                super().start(**given)
            except BaseException:
                self.close()
                self._loop_runner.stop()  # which runs on where the client has closed itself
                raise

    client: distributed.Client = Client(server, set_as_default=False, **settings)
    return client


def _silence() -> None:
    """Silence the loggers of Dask: lost processes and connections are reported by errors."""
    for name in ("distributed", *logging.root.manager.loggerDict):
        if name.startswith("distributed"):
            logging.getLogger(name).setLevel(logging.CRITICAL)


def _kill(started: Any) -> None:
    """Kill the processes of a cluster."""
    import psutil  # of distributed

    for nanny in started.workers.values():
        nanny.auto_restart = False
        with suppress(psutil.Error, TypeError):  # TypeError: no process yet
            psutil.Process(nanny.pid).kill()


@contextmanager
def _interrupts_blocked() -> Iterator[None]:
    """Block Ctrl-C for threads started in the block and for their processes: only this process receives it."""
    if not hasattr(signal, "pthread_sigmask"):  # Windows
        yield
        return
    ensure_running()  # the tracker of multiprocessing, which would unblock interrupts at a later start
    before = signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)


def _unguarded_line() -> str:
    """Return line and file if the running script is outside of a main guard, ``""`` otherwise."""
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
    """Return a context with a client of a running scheduler; ValueError without a worker after `timeout` [s].

    The address is ``tcp://host:8786``, or ``tls://host:8786`` with the certificates of Dask's configuration
    (``distributed.comm.tls``). Workers must have the versions of this process.
    """
    if not address.startswith(("tcp://", "tls://")):
        raise ValueError(f"scheduler must be tcp://host:port or tls://host:port, got {address!r}")
    return _connected(address, timeout)


@contextmanager
def _connected(address: str, timeout: float) -> Iterator["Client"]:
    with installed("study"):
        import distributed  # noqa: F401

    _silence()
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # about versions, which are checked below
            client = _client(address, timeout=timeout)
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
    """Raise ValueError if a worker has a package that determines results in another version."""
    versions: Any = client.get_versions(packages=PACKAGES)
    own = versions["client"]["packages"]
    for address, worker in versions["workers"].items():
        for name in ("python", *PACKAGES):
            wanted, got = own[name], worker["packages"].get(name)
            if got != wanted:
                raise ValueError(
                    f"scheduler must have workers with {name} {wanted} as here, got {got} at {address}"
                )


def cluster(jobs: int | None = None, scheduler: str | None = None) -> AbstractContextManager["Client | None"]:
    """Return a context with a client of `jobs` processes or of a scheduler; with None if neither is given."""
    if jobs is not None and scheduler is not None:
        raise ValueError(f"jobs must stand without scheduler, got {jobs} and {scheduler!r}")
    if jobs is not None:
        return local_cluster(jobs)
    return nullcontext() if scheduler is None else scheduler_at(scheduler)


def distributed(problem: Minimisable, client: "Client", chunk: int = 16) -> Problem:
    """Return a slow problem that is evaluated on a cluster, `chunk` designs per call, without its kernel.

    MOEA/D-DRA should then evaluate its children in batches (``update="batch"``).
    """
    checks.at_least("chunk", chunk, 1)

    def evaluate(designs: Real) -> Real:
        parts = [designs[start : start + chunk] for start in range(0, len(designs), chunk)]
        return np.concatenate(
            client.gather(client.map(_on_one_thread, parts, pure=False, evaluate=problem.evaluate))
        )

    names = ("lower", "upper", "objectives", "variables", "units", "kinds")
    same = {name: getattr(problem, name) for name in names}
    return Problem(evaluate=evaluate, constraints=tuple(map(str, problem.constraints)), **same)


def _on_one_thread(designs: Real, evaluate: Callable[[Real], Real]) -> Real:
    """Return the values of designs on a worker: the other processors have workers of their own."""
    with limited(1):
        return evaluate(designs)
