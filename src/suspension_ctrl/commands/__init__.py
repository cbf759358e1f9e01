"""The commands `suspension-ctrl compare|optimum|bode|weighting|ride` (extra `cli`)."""

import sys
from typing import NoReturn

from ..checks import installed


def main(*command: str) -> NoReturn:
    """Run `suspension-ctrl` with the arguments of this process, after the name of a command if given."""
    try:
        with installed("cli"):
            from .app import app
            from .terminal import run
    except ImportError as error:
        sys.exit(f"error: {error}")
    if not (command or sys.argv[1:]):
        command = ("--help",)
    run(app, *command, name="suspension-ctrl")
