"""Seconds by phase: each verb counts its own time, a verb inside another only once."""

import time

from deap.base import Toolbox

from suspension_ctrl.search.clock import PhaseClock, untimed


def nap(seconds: float) -> float:
    """Work for some processor-independent time [s]."""
    time.sleep(seconds)
    return seconds


def test_a_verb_inside_another_counts_once_for_itself():
    """Sleeping takes as long as asked or longer; the outer verb's own share is short beside the inner one's."""
    toolbox = Toolbox()
    toolbox.register("inner", nap, 0.05)
    toolbox.register("outer", lambda: toolbox.inner())
    clock = PhaseClock(toolbox, ["inner", "outer"])
    start = time.perf_counter()
    assert toolbox.outer() == 0.05
    whole = time.perf_counter() - start
    assert clock.seconds["inner"] >= 0.05
    assert 0 < clock.seconds["outer"] < clock.seconds["inner"]
    assert sum(clock.seconds.values()) <= whole


def test_a_verb_that_raises_is_timed_and_leaves_the_clock_in_order():
    toolbox = Toolbox()

    def fail() -> None:
        nap(0.01)
        raise RuntimeError

    toolbox.register("fail", fail)
    toolbox.register("after", nap, 0.01)
    clock = PhaseClock(toolbox, ["fail", "after"])
    for verb in (toolbox.fail, toolbox.after):
        try:
            verb()
        except RuntimeError:
            continue
    assert clock.seconds["fail"] >= 0.01
    assert clock.seconds["after"] >= 0.01
    assert clock.inner >= clock.seconds["after"]


def test_the_verb_inside_a_stopwatch_can_be_had():
    toolbox = Toolbox()
    toolbox.register("inner", nap, 0.0)
    plain = toolbox.inner
    assert untimed(plain) is plain
    PhaseClock(toolbox, ["inner"])
    assert toolbox.inner is not plain
    assert untimed(toolbox.inner) is plain
