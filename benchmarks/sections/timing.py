"""Stopwatches: contenders take turns, so that whatever slows the machine for a while slows them all."""

import gc
from collections.abc import Callable, Mapping
from math import ceil
from time import perf_counter, process_time
from typing import Any, NamedTuple

Prepare = Callable[[int], Callable[[], Any]]
"""From the number of a repeat to what is to be timed; what it does itself is not."""


class Timing(NamedTuple):
    """One timed call: wall-clock and processor time [s], and what the call returned."""

    seconds: float
    cpu_seconds: float
    result: Any


def timed(function: Callable[[], Any], calls: int = 1) -> Timing:
    """Call the function, several times if wished, and return the mean time of a call and the last result.

    As in `timeit`, garbage is not collected meanwhile.
    """
    gc.disable()
    try:
        wall, cpu = perf_counter(), process_time()
        for _ in range(calls):
            result = function()
        return Timing((perf_counter() - wall) / calls, (process_time() - cpu) / calls, result)
    finally:
        gc.enable()


def take_turns(
    contenders: Mapping[str, Prepare], repeats: int, limit: float, least: float = 0.0
) -> list[dict[str, Any]]:
    """Time each contender `repeats` times after a first call that warms it up, two with `least`.

    The order is turned round from one repeat to the next. Who takes longer than `limit` seconds in the first
    call has had its turn: that call is its only one. Calls shorter than `least` seconds, the second tells,
    are repeated within a timing until they make up that time.

    Returns
    -------
    list of dict
        ``contender``, ``repeat`` (from 1), ``seconds``, ``cpu_seconds`` of every timed call.
    """
    rows: list[dict[str, Any]] = []
    calls: dict[str, int] = {}
    for name, prepare in contenders.items():
        first = timed(prepare(0))
        if first.seconds > limit:
            rows.append(_row(name, 1, first))
        else:
            warm = timed(prepare(0)) if least else first  # loaded, compiled, in the cache
            calls[name] = max(1, ceil(least / warm.seconds))
    for repeat in range(1, repeats + 1):
        gc.collect()
        order = list(calls) if repeat % 2 else list(reversed(calls))
        rows += [_row(name, repeat, timed(contenders[name](repeat), calls[name])) for name in order]
    return rows


def _row(name: str, repeat: int, timing: Timing) -> dict[str, Any]:
    return {
        "contender": name,
        "repeat": repeat,
        "seconds": timing.seconds,
        "cpu_seconds": timing.cpu_seconds,
    }
