"""Handling of SIGINT (Ctrl-C) and SIGTERM: clean end, one line, exit status of the signal."""

import os
import signal
import sys
import threading
from types import FrameType
from typing import Any, NoReturn

_WORDS = {signal.SIGINT: "interrupted", signal.SIGTERM: "terminated"}

_received: list[int] = []


def end_at_once() -> None:
    """End the process at the first signal, as long as there is nothing to clean up."""
    _handle(_leave)


def end_in_order() -> None:
    """Raise KeyboardInterrupt at the first signal, so that contexts are closed; end the process at the second."""
    _received.clear()
    _handle(_interrupt)
    sys.unraisablehook = _unraisable


def check() -> None:
    """Raise KeyboardInterrupt after a signal: a library may have made another error of the interrupt."""
    if _received:
        raise KeyboardInterrupt


def ended() -> tuple[str, int] | None:
    """Return word and exit status of a signal received since `end_in_order`; further signals print nothing."""
    _handle(lambda number, _frame: os._exit(128 + number))
    sys.unraisablehook = sys.__unraisablehook__
    return _ending(_received[0]) if _received else None


def _ending(number: int) -> tuple[str, int]:
    return _WORDS[signal.Signals(number)], 128 + number


def _handle(handler: Any) -> None:
    if threading.current_thread() is not threading.main_thread():  # only this one may set handlers
        return
    for number in _WORDS:
        if signal.getsignal(number) is not signal.SIG_IGN:  # set by a shell for a background job
            signal.signal(number, handler)


def _leave(number: int, _frame: FrameType | None) -> NoReturn:
    word, status = _ending(number)
    os.write(2, f"error: {word}\n".encode())
    os._exit(status)


def _interrupt(number: int, frame: FrameType | None) -> NoReturn:
    if _received:
        _leave(_received[0], frame)
    _received.append(number)
    raise KeyboardInterrupt


def _send(number: int) -> None:
    if hasattr(signal, "pthread_kill"):  # wakes the main thread from a sleep
        signal.pthread_kill(threading.main_thread().ident or 0, number)
    else:
        signal.raise_signal(number)


def _unraisable(event: Any) -> None:
    """Repeat a signal that arrived where Python cannot raise, such as in a callback of a library."""
    if isinstance(event.exc_value, KeyboardInterrupt) and _received:
        threading.Timer(0.1, _send, (_received.pop(),)).start()
    else:
        sys.__unraisablehook__(event)
