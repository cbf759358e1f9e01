"""Figures drawn by a process of their own while the command goes on, on machines with a second processor.

It imports matplotlib while the command imports the rest, rests while runs are timed, and draws while the command
writes tables and its page.
"""

import pickle
import sys
import warnings
from collections import deque
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from subprocess import DEVNULL, PIPE, Popen
from typing import IO, TYPE_CHECKING, Any

from .. import threads

if sys.platform == "win32":
    from subprocess import CREATE_NEW_PROCESS_GROUP

if TYPE_CHECKING:
    from matplotlib.figure import Figure

Make = Callable[..., "Figure"]
_PROGRAM = "import sys; sys.path[:] = {!r}; from suspension_ctrl.commands.drawing import serve; serve()"
_DONE, _FAILED = b"d", b"f"


class Drawing:
    """Figures written by another process, or by this one if there is none.

    A figure that the other process does not finish, for whatever reason, is made once more here: it succeeds, or
    raises its own error.
    """

    def __init__(self, process: "Popen[bytes] | None" = None) -> None:
        self._process, self._ready = process, False
        self._begun = deque[tuple[Path, Make, tuple[Any, ...]]]()

    def get_ready(self) -> None:
        """Wait until the other process has imported what it needs and rests."""
        if not self._ready:
            self._answer()
        self._ready = True

    def begin(self, stem: Path, make: Make, *arguments: Any) -> None:
        """Begin to write the figure ``make(*arguments)`` as PNG and PDF, named `stem` with the ending added."""
        self._begun.append((stem, make, arguments))
        if self._process and self._process.stdin:
            with suppress(OSError):  # it has ended and will not answer
                self._process.stdin.write(pickle.dumps(self._begun[-1]))
                self._process.stdin.flush()

    def settle(self) -> None:
        """Wait until every figure that was begun is written."""
        self.get_ready()
        while self._begun:
            job = self._begun.popleft()
            if self._answer() != _DONE:
                _write(*job)

    def _answer(self) -> bytes:
        """Return the next answer of the process, empty if it has ended or there is none."""
        return self._process.stdout.read(1) if self._process and self._process.stdout else b""


@contextmanager
def beside() -> Iterator[Drawing]:
    """Return a context with figures drawn by a process of their own if there is a second processor for it."""
    process = started() if threads.number(None) > 1 else None
    try:
        yield Drawing(process)
    finally:
        if process is not None:
            process.kill()  # what was begun and not settled is not wanted
            process.communicate()


def started() -> "Popen[bytes] | None":
    """Start the process with the paths of this one; None if the system cannot."""
    alone: dict[str, Any] = {"process_group": 0}  # Ctrl-C ends this process alone, which then ends that
    if sys.platform == "win32":
        alone = {"creationflags": CREATE_NEW_PROCESS_GROUP}
    with suppress(OSError):
        program = [sys.executable, "-c", _PROGRAM.format(sys.path)]
        return Popen(program, stdin=PIPE, stdout=PIPE, stderr=DEVNULL, **alone)
    return None


def serve() -> None:
    """Draw figures asked for on standard input until it ends, and answer on standard output."""
    asked, answers = sys.stdin.buffer, sys.stdout.buffer
    sys.stdout = sys.stderr
    for seen in (UserWarning, RuntimeWarning):  # with a warning the figure is made where the warning is shown
        warnings.simplefilter("error", seen)
    import matplotlib.backends.backend_agg
    import matplotlib.backends.backend_pdf  # noqa: F401

    from ..study import figures  # noqa: F401

    _say(answers, _DONE)
    with suppress(EOFError):
        while True:
            job = pickle.load(asked)
            try:
                _write(*job)
            except Exception:  # it is made once more, and raises its error, where it was asked for
                _say(answers, _FAILED)
            else:
                _say(answers, _DONE)


def _say(answers: IO[bytes], answer: bytes) -> None:
    answers.write(answer)
    answers.flush()


def _write(stem: Path, make: Make, arguments: tuple[Any, ...]) -> None:
    from ..tables import write_figure

    write_figure(stem, make(*arguments))
