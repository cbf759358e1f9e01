"""The commands `suspension-ctrl compare|optimum|new|bode|weighting|ride|exposure|road` (extra `cli`)."""

import sys
from typing import NoReturn

from . import signals


def main(*command: str) -> NoReturn:
    """Run `suspension-ctrl` with the arguments of this process, after the name of a command if given."""
    signals.end_at_once()
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
