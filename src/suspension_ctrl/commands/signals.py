"""Ctrl-C and requests to end: a command ends in order, in one line, with the exit status of the signal."""

import os
import signal
import sys
import threading
from types import FrameType
from typing import Any, NoReturn

_WORDS = {signal.SIGINT: "interrupted", signal.SIGTERM: "terminated"}

_received: list[int] = []


def end_at_once() -> None:
    """Let a signal end the process on the spot, with its line: there is nothing to put in order yet."""
    _handle(_leave)


def end_in_order() -> None:
    """Let the first signal raise KeyboardInterrupt: contexts close what they opened; let a second one end it."""
    _received.clear()
    _handle(_interrupt)
    sys.unraisablehook = _unraisable


def ended() -> tuple[str, int] | None:
    """Return the word and the exit status of the signal that came since `end_in_order`; later ones say nothing."""
    _handle(lambda number, _frame: os._exit(128 + number))
    sys.unraisablehook = sys.__unraisablehook__
    return _ending(_received[0]) if _received else None


def _ending(number: int) -> tuple[str, int]:
    return _WORDS[signal.Signals(number)], 128 + number


def _handle(handler: Any) -> None:
    if threading.current_thread() is not threading.main_thread():  # Python lets no other set handlers
        return
    for number in _WORDS:
        if signal.getsignal(number) is not signal.SIG_IGN:  # as a shell has it for a background job
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
    if hasattr(signal, "pthread_kill"):  # to the main thread, which may sleep
        signal.pthread_kill(threading.main_thread().ident or 0, number)
    else:
        signal.raise_signal(number)


def _unraisable(found: Any) -> None:
    """Send a signal again that came where Python cannot raise, as in a callback of a library."""
    if isinstance(found.exc_value, KeyboardInterrupt) and _received:
        threading.Timer(0.1, _send, (_received.pop(),)).start()
    else:
        sys.__unraisablehook__(found)
