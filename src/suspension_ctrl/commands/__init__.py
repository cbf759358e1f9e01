"""The commands `suspension-ctrl compare|optimum|new|bode|weighting|ride|exposure|road` (extra `cli`)."""

import gc
import sys
from typing import NoReturn

from . import signals

NEW_OBJECTS = 50_000
"""New objects after which the garbage collector looks through them: most of what a command imports stays."""


def main(*command: str) -> NoReturn:
    """Run `suspension-ctrl` with the arguments of this process, after the name of a command if given."""
    signals.end_at_once()
    gc.set_threshold(NEW_OBJECTS, *gc.get_threshold()[1:])
    from ..checks import installed

    try:
        with installed("cli"):
            from .app import app
            from .terminal import run
    except ImportError as error:
        sys.exit(f"error: {error}")
    if not (command or sys.argv[1:]):
        command = ("--help",)
    run(app, *command, name="suspension-ctrl")
