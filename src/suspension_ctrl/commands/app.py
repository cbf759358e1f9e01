"""The command line `suspension-ctrl`: its commands with examples; a command imports the library when it runs."""

import inspect
from collections.abc import Callable
from functools import wraps
from typing import Any

from typer import Typer

from . import bode, compare, exposure, new, optimum, options, report_page, ride, road, terminal, weighting
from .report import Form

app = Typer(
    add_completion=False, pretty_exceptions_enable=False,
    rich_markup_mode=None,  # units in brackets are not markup
)  # fmt: skip


@app.callback()
def suspension_ctrl() -> None:
    """Ride optimisation of vehicle suspensions."""


def _reporting(command: Callable[..., None]) -> Callable[..., None]:
    """Return a command with options for the form in which its report is printed."""

    @wraps(command)
    def run(*args: Any, quiet: bool, json: bool, **kwargs: Any) -> None:
        if quiet and json:
            raise ValueError("quiet must stand without json, got both")
        terminal.begin(Form.QUIET if quiet else Form.JSON if json else Form.TEXT)
        command(*args, **kwargs)

    added: dict[str, Any] = {"quiet": options.Quiet, "json": options.Json}
    kind = inspect.Parameter.KEYWORD_ONLY
    signature = inspect.signature(command)
    flags = [inspect.Parameter(name, kind, default=False, annotation=one) for name, one in added.items()]
    vars(run)["__signature__"] = signature.replace(parameters=[*signature.parameters.values(), *flags])
    run.__annotations__ = command.__annotations__ | added
    return run


def _add(command: Callable[..., None], *examples: str) -> None:
    """Add a command, with a paragraph of examples that is not wrapped."""
    lines = ["\b", "Examples:", *(f"  suspension-ctrl {command.__name__} {text}" for text in examples)]
    app.command(epilog="\n".join(lines))(_reporting(command))


_add(compare.compare, "--quick", "--quality --jobs 2", "--vehicle jian_2022_full --road C --repeats 1")
_add(optimum.optimum, "--band 0.1,20", "--vehicle jian_2022_full --road C --sws-limit 0.01")
_add(report_page.report, "--study half_car --out report")
_add(new.new, "quarter-car --out mine.toml")
_add(bode.bode, "--design 22000,1500 --design 12e3,1600", "--vehicle minaker_half --response pitch_acceleration")
_add(weighting.weighting, "--out figure2")
_add(
    ride.ride,
    "--vehicle jian_2022_full --road C --speed 20",
    "--vehicle minaker_half --setting front.damper=2000",
    "--body-mass 400 --wheel-mass 45 --tyre-stiffness 22e4 \\\n      --spring 25e3 --damper 2e3 --road C",
)
_add(
    exposure.exposure,
    "seat.csv --duration 4h",
    "drive.csv --axes body_acceleration=z --settling 5s",
)
_add(
    road.road,
    "survey.csv",
    "survey.txt --columns 'distance [ft],left [in]'",
    "surface.crg --tracks 0.75,-0.75 --segments 100m",
)
