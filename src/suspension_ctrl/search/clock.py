"""Wall-clock time of each phase of a search, measured around the verbs of its toolbox."""

from collections.abc import Callable, Iterable
from functools import partial
from time import perf_counter
from typing import Any

from deap.base import Toolbox


class PhaseClock:
    """Timers around the verbs of a toolbox that are phases; a phase excludes the time of phases inside it."""

    def __init__(self, toolbox: Toolbox, phases: Iterable[str]) -> None:
        self.seconds = dict.fromkeys(phases, 0.0)
        self.inner = 0.0  # of phases inside the one that runs
        for phase in self.seconds:
            setattr(toolbox, phase, partial(self.timed, phase, getattr(toolbox, phase)))

    def timed(self, phase: str, verb: Callable[..., Any], /, *arguments: Any, **settings: Any) -> Any:
        """Call a verb and add its time, without phases inside it, to its phase."""
        outer, self.inner = self.inner, 0.0
        start = perf_counter()
        try:
            return verb(*arguments, **settings)
        finally:
            elapsed = perf_counter() - start
            self.seconds[phase] += elapsed - self.inner
            self.inner = outer + elapsed


def untimed(verb: partial[Any]) -> partial[Any]:
    """Return a verb without its timer."""
    clocked = isinstance(getattr(verb.func, "__self__", None), PhaseClock)
    return verb.args[1] if clocked else verb
