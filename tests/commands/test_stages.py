"""Stages on standard error: a line each, wherever it goes, after the last of its items."""

import contextlib
import io
import re
import signal
import sys

import pytest
from rich.console import Console

from suspension_ctrl.commands import signals, stages, terminal

SIGNALS = (signal.SIGINT, signal.SIGTERM)


def test_a_stage_is_said_at_its_end_with_its_time(capfd):
    with stages.stage("reference front"):
        assert capfd.readouterr() == ("", "")
    out, error = capfd.readouterr()
    assert out == ""
    assert re.fullmatch(r"reference front in 0\.\d s\n", error)
    with stages.stage("reference front", origin="given"):
        pass
    assert re.fullmatch(r"reference front in 0\.\d s, given\n", capfd.readouterr().err)


def test_a_stage_that_fails_is_not_said_to_have_ended(capfd):
    with pytest.raises(KeyboardInterrupt), stages.stage("figures"):
        raise KeyboardInterrupt
    assert capfd.readouterr() == ("", "")


def test_items_are_counted_with_those_that_were_found(capfd):
    assert list(stages.counted("abc", 5, "runs\x1b", found=2)) == ["a", "b", "c"]
    assert re.fullmatch(r"runs\\x1b, 5 of 5 in 0\.\d s, 2 found\n", capfd.readouterr().err)
    assert list(stages.counted("ab", 2, "runs")) == ["a", "b"]
    assert re.fullmatch(r"runs, 2 of 2 in 0\.\d s\n", capfd.readouterr().err)


def test_an_interrupt_that_became_another_error_ends_the_stage(monkeypatch):
    """Numpy makes a TypeError of an interrupt in a comparison, and a run is recorded as one that raised."""
    monkeypatch.setattr(sys, "unraisablehook", sys.unraisablehook)
    handlers = {number: signal.signal(number, signal.default_int_handler) for number in SIGNALS}
    try:
        signals.end_in_order()
        with contextlib.suppress(KeyboardInterrupt):
            signal.raise_signal(signal.SIGINT)
        with pytest.raises(KeyboardInterrupt):
            list(stages.counted("ab", 2, "runs"))
    finally:
        signals.end_in_order()  # forgets what was received
        for number, handler in handlers.items():
            signal.signal(number, handler)


def test_a_terminal_shows_a_bar_of_the_missing_items(monkeypatch, capfd):
    stream = io.StringIO()
    monkeypatch.setattr(terminal, "stderr", Console(file=stream, force_terminal=True, width=80))
    assert list(stages.counted("abc", 5, "runs", found=2)) == ["a", "b", "c"]
    assert "3/3" in stream.getvalue()
    assert capfd.readouterr().err.startswith("runs, 5 of 5 in ")


@pytest.mark.parametrize(
    ("seconds", "text"), [(0.04, "0.0 s"), (9.94, "9.9 s"), (9.96, "10 s"), (99.6, "100 s"), (372, "6.2 min")]
)
def test_times_have_two_digits(seconds, text):
    assert stages.duration(seconds) == text
