"""Seconds by phase: every verb of a toolbox that is a phase of the algorithm gets a stopwatch."""

from collections.abc import Callable, Iterable
from time import perf_counter
from typing import Any

from deap.base import Toolbox


class PhaseClock:
    """Stopwatches around verbs of a toolbox; the time of a verb called inside another counts once, for itself.

    Parameters
    ----------
    toolbox : deap.base.Toolbox
        Its verbs are decorated in place.
    phases : iterable of str
        The verbs to be timed.
    """

    def __init__(self, toolbox: Toolbox, phases: Iterable[str]) -> None:
        self.seconds = dict.fromkeys(phases, 0.0)
        self._inner = 0.0
        for phase in self.seconds:
            toolbox.decorate(phase, lambda function, phase=phase: Timed(function, self, phase))

    def call(self, phase: str, function: Callable[..., Any], *args: Any, **settings: Any) -> Any:
        """Call `function` and add the time it takes, less that of phases inside it, to `phase`."""
        outer, self._inner = self._inner, 0.0
        start = perf_counter()
        try:
            return function(*args, **settings)
        finally:
            elapsed = perf_counter() - start
            self.seconds[phase] += elapsed - self._inner
            self._inner = outer + elapsed


class Timed:
    """A verb's function with a stopwatch around it."""

    def __init__(self, function: Callable[..., Any], clock: PhaseClock, phase: str) -> None:
        self.function = function
        self._clock = clock
        self._phase = phase

    def __call__(self, *args: Any, **settings: Any) -> Any:
        """Call the function, timed."""
        return self._clock.call(self._phase, self.function, *args, **settings)


def untimed(function: Callable[..., Any]) -> Callable[..., Any]:
    """Return the function inside a stopwatch, or the function itself where there is none."""
    return function.function if isinstance(function, Timed) else function
