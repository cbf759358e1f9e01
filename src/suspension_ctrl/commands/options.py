"""Options of the commands, each declared once, and the parsers of their texts."""

from collections.abc import Callable
from functools import partial
from pathlib import Path
from typing import Annotated, Any

from typer import BadParameter, Option


def number(text: str, kind: type[float] = float, what: str = "a number") -> float:
    """Parse a number; BadParameter names the option and the text."""
    try:
        return kind(text)
    except ValueError:
        raise BadParameter(f"must be {what}, got {text!r}") from None


def whole_number(text: str) -> float:
    """Parse a whole number."""
    return number(text, int, "a whole number")


def whole_numbers(name: str, text: str) -> list[int]:
    """Return the whole numbers of a comma-separated list, each once; ValueError naming `name` otherwise."""
    try:
        return list(dict.fromkeys(int(part) for part in text.split(",")))
    except ValueError:
        raise ValueError(f"{name} must be whole numbers separated by commas, got {text!r}") from None


def numbers(name: str, text: str, count: int) -> tuple[float, ...]:
    """Return the `count` numbers of a comma-separated list; ValueError naming `name` otherwise."""
    try:
        return tuple(float(part) for part, _ in zip(text.split(","), range(count), strict=True))
    except ValueError:
        raise ValueError(f"{name} must be {count} numbers separated by commas, got {text!r}") from None


def by_name(name: str, text: str) -> dict[str, float]:
    """Return numbers by name of a list such as ``front.spring=1e4,front.damper=2000``; ValueError otherwise."""
    pairs = [part.partition("=") for part in text.split(",") if part]
    try:
        return {key.strip(): float(value) for key, _, value in pairs}
    except ValueError:
        raise ValueError(f"{name} must be like front.spring=1e4,front.damper=2000, got {text!r}") from None


def names(text: str) -> list[str]:
    """Return the names of a comma-separated list, each once."""
    return list(dict.fromkeys(part.strip() for part in text.split(",")))


def settings(weighting: str | None, band: str | None) -> dict[str, Any]:
    """Return the given settings of a ride problem."""
    given: dict[str, Any] = {} if weighting is None else {"weighting": weighting}
    return given if band is None else given | {"band": numbers("band", band, 2)}


def _option(metavar: str | None, text: str, *name: str, parser: Callable[[str], Any] | None = None) -> Any:
    return Option(*name, metavar=metavar, help=text, parser=parser)


_whole = partial(_option, "NUMBER", parser=whole_number)
_real = partial(_option, "NUMBER", parser=number)

Text = str | None
Texts = list[str] | None
Real = float | None
Whole = int | None
File = Path | None

Vehicle = Annotated[Text, _option("NAME", "TOML file, or name of one in the package.  [default: the paper's car]")]
Road = Annotated[Text, _option("ROAD", "ISO 8608 class: C, C-lower; CSV or TOML file.  [default: the paper's]")]
AllowOutside = Annotated[
    bool, _option(None, "Let a road's TOML file name files outside its folder.", "--allow-outside")
]
Speed = Annotated[Real, _real("Speed [m/s].  [default: 20]")]
Band = Annotated[Text, _option("LOW,HIGH", "Frequencies [Hz].  [default: 0,20]")]
Weighting = Annotated[Text, _option("NAME", "ISO 2631 weighting of ACC: Wk, Wb, Wb-table, ...  [default: Wk]")]
Setting = Annotated[Text, _option("NAME=NUMBER,...", "Coefficients of struts [N/m, N s/m, ...] to change.")]
BodyMass = Annotated[Real, _real("Body mass of a quarter car [kg].")]
WheelMass = Annotated[Real, _real("Wheel mass of a quarter car [kg].")]
TyreStiffness = Annotated[Real, _real("Tyre stiffness of a quarter car [N/m].")]
Spring = Annotated[Real, _real("Spring of a quarter car [N/m].")]
Damper = Annotated[Real, _real("Damper of a quarter car [N s/m].")]
Design = Annotated[Texts, _option("NUMBER,...", "Spring [N/m], damper [N s/m]: 22000,1500. Repeatable.")]
Designs = Annotated[File, _option("FILE", "CSV of designs with columns 'spring [N/m]', 'damper [N s/m]'.")]
Response = Annotated[Texts, _option("NAME", "Response to draw, e.g. pitch_acceleration. Repeatable.")]
Points = Annotated[int, _whole("Frequencies on each curve.")]
SwsLimit = Annotated[float, _real("Suspension working space [m].")]
Population = Annotated[int, _whole("Population of MOEA/D-DRA.")]
Generations = Annotated[int, _whole("Iterations of MOEA/D-DRA.", "--iterations")]
Problem = Annotated[File, _option("FILE", "TOML file of load cases, measures, limits.")]
Populations = Annotated[Text, _option("NUMBER,...", "Population sizes.  [default: 500,1000; --quick: 60,100]")]
Iterations = Annotated[Text, _option("NUMBER,...", "Iterations.  [default: 10,20; --quick: 5,10]")]
Repeats = Annotated[Whole, _whole("Timed runs at each configuration.  [default: 5; --quick: 2]")]
ALGORITHMS = "nsga2, nsga2-standard-sort, nsga2-gamultiobj, moead-dra, moead-dra-raw, random, sobol"
Algorithms = Annotated[str, _option("NAME,...", f"Of {ALGORITHMS}; the first is the baseline.")]
Seed = Annotated[int, _whole("Seed of the first run; each repeat adds one.")]
Quick = Annotated[bool, _option(None, "Short form.", "--quick")]
Quality = Annotated[bool, _option(None, "Judge quality over many seeds too.", "--quality")]
Seeds = Annotated[Whole, _whole("Runs of each algorithm in --quality.  [default: 31; --quick: 3]")]
Target = Annotated[float, _real("Share of the reference hypervolume to reach [-].")]
Jobs = Annotated[Whole, _whole("Processes for the runs of --quality.")]
Scheduler = Annotated[Text, _option("ADDRESS", "Dask scheduler for them: tcp://host:8786, tls://host:8786.")]
Out = Annotated[File, _option("FOLDER", "Folder for the results, absent or empty.  [default: a new one]")]
Resumed = Annotated[File, _option("FOLDER", "Folder: absent, empty, or of the same command, to resume it.")]
