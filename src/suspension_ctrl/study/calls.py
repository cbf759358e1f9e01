"""Function calls in this process or on the workers of a cluster, repeated if a worker dies."""

from collections import deque
from collections.abc import Callable, Iterator, Mapping
from time import monotonic, sleep
from typing import TYPE_CHECKING, Any, TypeVar
from uuid import uuid4

from ..checks import installed
from ..threads import limited

if TYPE_CHECKING:
    from distributed import Client


T = TypeVar("T")

KILLS = 3
"""Deaths of a worker after which its call has failed; before the last one the call runs alone on the cluster."""

PATIENCE = 120.0
"""Longest time [s] without any worker: on a busy machine, starting a new one is slow."""

_PAUSE = 0.005  # between two polls of the calls [s]


def outcomes(
    function: Callable[..., T], arguments: Mapping[str, tuple[Any, ...]], client: "Client | None" = None
) -> Iterator[tuple[str, T | None, str]]:
    """Call a function with each tuple of arguments; yield name, result and error (``""`` if none) of ended calls.

    A call whose worker dies is repeated, and has failed after `KILLS` deaths. ConnectionError if the scheduler or
    all its workers are lost.
    """
    if client is None:
        for name, values in arguments.items():
            yield name, *outcome(function, values)
        return
    with installed("study"):
        from distributed.protocol.pickle import dumps

    pickled: dict[str, bytes] = {}
    for name, values in arguments.items():
        content, error = outcome(dumps, ((function, values),))
        if content is None:
            yield name, None, error
        else:
            pickled[name] = content
    yield from _spread(pickled, client)


def outcome(function: Callable[..., T], arguments: tuple[Any, ...]) -> tuple[T | None, str]:
    """Return the result of a call, or None and its error in one line."""
    try:
        return function(*arguments), ""
    except (Exception, SystemExit) as error:  # an evaluation may raise anything; the other runs continue
        return None, in_one_line(error)


def in_one_line(error: BaseException) -> str:
    """Return type and message of an error."""
    return " ".join(f"{type(error).__name__}: {error}".split())


def _unpickled(content: bytes) -> tuple[Any, str]:
    """Return result and error of a pickled call, on a worker."""
    from distributed.protocol.pickle import loads

    call, error = outcome(loads, (content,))
    with limited(1):  # the other processors have workers of their own
        return (None, error) if call is None else outcome(*call)


def _spread(pickled: Mapping[str, bytes], client: "Client") -> Iterator[tuple[str, Any, str]]:
    """Yield name, result and error of pickled calls, one per thread: a dead worker points to one call."""
    threads = _Threads(client)
    waiting, suspects, kills = deque(pickled), deque[str](), dict.fromkeys(pickled, 0)
    running: dict[Any, str] = {}
    alone = False
    while waiting or suspects or running:
        alone = not waiting and (alone or not running)
        source = suspects if alone else waiting
        while source and len(running) < (1 if alone else threads.count()):
            name = source.popleft()
            running[client.submit(_unpickled, pickled[name], key=f"{name}-{uuid4()}", pure=False)] = name
        ended = [future for future in running if future.done()]
        for future in ended:
            name = running.pop(future)
            killed, *result = _result(future, name)
            kills[name] += killed
            if not killed or (alone and kills[name] >= KILLS):
                yield name, *result
            else:
                (suspects if kills[name] + 1 >= KILLS else waiting).append(name)
            future.release()
        if not ended:
            threads.count()
            sleep(_PAUSE)


def _result(future: Any, name: str) -> tuple[int, Any, str]:
    """Return the number of workers killed by a finished call, its result and its error."""
    from distributed import KilledWorker

    if future.status == "finished":
        return 0, *future.result()
    if future.status != "error":
        raise ConnectionError(f"scheduler lost: {future.status} {name}; what was finished is kept")
    error = future.exception()
    if isinstance(error, KilledWorker):
        return error.allowed_failures + 1, None, "KilledWorker: the run killed each of its processes"
    return 0, None, outcome(_raise, (error,))[1]


def _raise(error: BaseException) -> None:
    raise error


class _Threads:
    """Number of threads of a cluster, requested once a second at most."""

    def __init__(self, client: "Client") -> None:
        self._client, self._count, self._asked, self._seen = client, 0, -1.0, monotonic()

    def count(self) -> int:
        """Return the number; ConnectionError if it was 0 for `PATIENCE`."""
        now = monotonic()
        if now - self._asked >= 1:
            try:
                self._count = sum(self._client.nthreads().values())
            except (OSError, RuntimeError) as error:
                raise ConnectionError(f"scheduler lost: {error}; what was finished is kept") from None
            self._asked = now
        if self._count:
            self._seen = now
        elif now - self._seen > PATIENCE:
            raise ConnectionError(f"workers lost: none for {PATIENCE:g} s; what was finished is kept")
        return self._count
