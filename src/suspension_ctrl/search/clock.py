"""Seconds by phase: every verb of a toolbox that is a phase of the algorithm gets a stopwatch."""

from collections.abc import Iterable
from functools import partial
from time import perf_counter
from typing import Any

from deap.base import Toolbox


class PhaseClock:
    """Stopwatches around verbs of a toolbox; the time of a verb called inside another counts once, for itself.

    Parameters
    ----------
    toolbox : deap.base.Toolbox
        Its verbs are replaced by timed ones.
    phases : iterable of str
        The verbs to be timed.
    """

    def __init__(self, toolbox: Toolbox, phases: Iterable[str]) -> None:
        self.seconds = dict.fromkeys(phases, 0.0)
        self.inner = 0.0  # of phases inside the one that runs
        for phase in self.seconds:
            setattr(toolbox, phase, Timed(getattr(toolbox, phase), self, phase))


class Timed:
    """A verb with a stopwatch around it."""

    __slots__ = ("_clock", "_phase", "verb")

    def __init__(self, verb: partial[Any], clock: PhaseClock, phase: str) -> None:
        self.verb = verb
        self._clock = clock
        self._phase = phase

    def __call__(self, *args: Any, **settings: Any) -> Any:
        """Call the verb and add the time it takes, less that of phases inside it, to its phase."""
        clock = self._clock
        outer, clock.inner = clock.inner, 0.0
        start = perf_counter()
        try:
            return self.verb(*args, **settings)
        finally:
            elapsed = perf_counter() - start
            clock.seconds[self._phase] += elapsed - clock.inner
            clock.inner = outer + elapsed


def untimed(verb: partial[Any] | Timed) -> partial[Any]:
    """Return the verb inside a stopwatch, or the verb itself where there is none."""
    return verb.verb if isinstance(verb, Timed) else verb
