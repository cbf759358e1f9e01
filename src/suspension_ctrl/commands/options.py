"""Options of the commands, each declared once, and parsers of their texts."""

from collections.abc import Callable, Mapping, Sequence
from functools import partial
from pathlib import Path
from typing import Annotated, Any

from typer import Argument, BadParameter, Option


def whole_number(text: str) -> int:
    """Parse a whole number; BadParameter names the option and the text."""
    try:
        return int(text)
    except ValueError:
        raise BadParameter(f"must be a whole number, got {text!r}") from None


def whole_numbers(name: str, text: str) -> list[int]:
    """Return the whole numbers of a comma-separated list, each once; ValueError naming `name` otherwise."""
    try:
        return list(dict.fromkeys(int(part) for part in text.split(",")))
    except ValueError:
        raise ValueError(f"{name} must be whole numbers separated by commas, got {text!r}") from None


def numbers(name: str, text: str, units: Sequence[str]) -> tuple[float, ...]:
    """Return the numbers of a comma-separated list in `units`, bare or with a unit; ValueError naming `name`."""
    from ..quantities import quantity

    parts = text.split(",")
    if len(parts) != len(units):
        raise ValueError(f"{name} must be {len(units)} numbers separated by commas, got {text!r}")
    return tuple(quantity(name, part, unit) for part, unit in zip(parts, units, strict=True))


def by_name(name: str, text: str, units: Mapping[str, str]) -> dict[str, float]:
    """Return the numbers by name of a text such as ``front.spring=10kN/m,front.damper=2000``."""
    from ..quantities import quantity

    pairs = [part.partition("=") for part in text.split(",") if part]
    if not all(sign for _, sign, _ in pairs):
        raise ValueError(f"{name} must be like front.spring=10kN/m,front.damper=2000, got {text!r}")
    named = {key.strip(): value for key, _, value in pairs}
    return {key: quantity(f"{name} {key}", value, units.get(key, "")) for key, value in named.items()}


def band(text: str) -> tuple[float, float]:
    """Return the band [Hz] of a text such as ``0.5,20``, ``0.5Hz..20Hz`` or ``0.5Hz..`` (up to 20 Hz)."""
    from ..schema.usual import check_bare

    if ".." in text:
        low, _, high = text.partition("..")
        text = f"{low.strip() or 0},{high.strip() or 20}"
    lower, upper = numbers("band", text, ("Hz", "Hz"))
    if is_bare(text.partition(",")[2]):
        check_bare("band", upper, "Hz")
    return lower, upper


def is_bare(text: str) -> bool:
    """Whether a text is a number without a unit."""
    try:
        float(text)
    except ValueError:
        return False
    return True


def lengths(name: str, text: str) -> tuple[float, ...]:
    """Return the lengths [m] of a comma-separated list, bare or with a unit; ValueError naming `name`."""
    return numbers(name, text, ["m"] * (text.count(",") + 1))


def names(text: str) -> list[str]:
    """Return the names of a comma-separated list, each once."""
    return list(dict.fromkeys(part.strip() for part in text.split(",")))


def settings(weighting: str | None, frequencies: str | None) -> dict[str, Any]:
    """Return the parameters of a ride problem that are given."""
    given: dict[str, Any] = {} if weighting is None else {"weighting": weighting}
    return given if frequencies is None else given | {"band": band(frequencies)}


def in_unit(unit: str, usual: bool = False) -> Callable[[str], float]:
    """Return the parser of a number in this unit, bare, perhaps only of `usual` size, or with a unit like it."""

    def parse(text: str) -> float:
        from ..quantities import quantity
        from ..schema.usual import check_bare

        try:
            number = quantity("", str(text), unit)  # str: a default is a number
            if usual and is_bare(str(text)):
                check_bare("", number, unit)
            return number
        except ValueError as error:
            raise BadParameter(str(error).strip()) from None

    return parse


def _option(metavar: str | None, text: str, *name: str, parser: Callable[[str], Any] | None = None) -> Any:
    return Option(*name, metavar=metavar, help=text, parser=parser)


_whole = partial(_option, "NUMBER", parser=whole_number)


def _real(text: str, unit: str = "", usual: bool = False) -> Any:
    return _option("NUMBER", text, parser=in_unit(unit, usual))


_ELSE = "the study's, else"
Text = str | None
Texts = list[str] | None
Real = float | None
Whole = int | None
File = Path | None

Vehicle = Annotated[Text, _option("NAME", "TOML file, or name of one in the package.  [default: the study's]")]
Road = Annotated[Text, _option("ROAD", "ISO 8608 class: C, C-lower; CSV or TOML file.  [default: the study's]")]
AllowOutside = Annotated[
    bool,
    _option(None, "Let TOML files of vehicles and roads name files outside their folders.", "--allow-outside"),
]
Speed = Annotated[Real, _real("Speed [m/s], or with a unit: 72km/h.  [default: the study's]", "m/s", True)]
Band = Annotated[Text, _option("LOW,HIGH", "Frequencies [Hz]: 0.5,20 or 0.5Hz..  [default: the study's]")]
ProfileFile = Annotated[Path, Argument(metavar="FILE", help="Profile: .csv, .txt, .erd, .crg, ...")]
Columns = Annotated[Text, _option("NAME,...", "Names of all columns: 'distance [ft],left [in],right [in]'.")]
RowStep = Annotated[Real, _real("Step of a table of heights alone [m].", "m")]
TrackWidth = Annotated[Real, _real("Distance of left and right [m].  [default: 1.5]", "m")]
Tracks = Annotated[Text, _option("NUMBER,...", "Places across an OpenCRG surface, to the left [m].")]
Segments = Annotated[str, _option("NUMBER,...", "Lengths of segments for the index [m].")]
Smoothed = Annotated[bool, _option(None, "The profile has been averaged over 250 mm already.", "--smoothed")]
Weighting = Annotated[Text, _option("NAME", "ISO 2631 weighting of ACC: Wk, Wb, ...  [default: the study's]")]
Setting = Annotated[Text, _option("NAME=NUMBER,...", "Coefficients of struts [N/m, N s/m, ...] to change.")]
BodyMass = Annotated[Real, _real("Body mass of a quarter car [kg].", "kg")]
WheelMass = Annotated[Real, _real("Wheel mass of a quarter car [kg].", "kg")]
TyreStiffness = Annotated[Real, _real("Tyre stiffness of a quarter car [N/m].", "N/m")]
Spring = Annotated[Real, _real("Spring of a quarter car [N/m].", "N/m")]
Damper = Annotated[Real, _real("Damper of a quarter car [N s/m].", "N s/m")]
Design = Annotated[Texts, _option("NUMBER,...", "Spring [N/m], damper [N s/m]: 22000,1500. Repeatable.")]
Designs = Annotated[File, _option("FILE", "CSV of designs with columns 'spring [N/m]', 'damper [N s/m]'.")]
Response = Annotated[Texts, _option("NAME", "Response to draw, e.g. pitch_acceleration. Repeatable.")]
Points = Annotated[int, _whole("Frequencies on each curve.")]
SwsLimit = Annotated[Real, _real("Most suspension working space [m], or with a unit: 12mm.", "m", True)]
Population = Annotated[Whole, _whole(f"Population of MOEA/D-DRA.  [default: {_ELSE} 4000]")]
Generations = Annotated[Whole, _whole(f"Iterations of MOEA/D-DRA.  [default: {_ELSE} 25]", "--iterations")]
Study = Annotated[Text, _option("FILE", "TOML file of a study, or name of one in the package.  [default: paper]")]
Reference = Annotated[
    File,
    _option("PATH", "Reference front: CSV of objectives with units, or a comparison's folder.  [default: sought]"),
]
Populations = Annotated[Text, _option("NUMBER,...", f"Population sizes.  [default: {_ELSE} 500,1000]")]
Iterations = Annotated[Text, _option("NUMBER,...", f"Iterations.  [default: {_ELSE} 10,20]")]
Repeats = Annotated[Whole, _whole(f"Timed runs at each configuration.  [default: {_ELSE} 5]")]
ALGORITHMS = "nsga2, nsga2-standard-sort, nsga2-gamultiobj, moead-dra, moead-dra-raw, random, sobol"
Algorithms = Annotated[Text, _option("NAME,...", f"Of {ALGORITHMS}; the first is the baseline.")]
Seed = Annotated[Whole, _whole(f"Seed of the first run; each repeat adds one.  [default: {_ELSE} 0]")]
Quick = Annotated[bool, _option(None, "Populations 60,100, iterations 5,10, 2 repeats, 3 seeds.", "--quick")]
Quality = Annotated[bool, _option(None, "Judge quality over many seeds too.", "--quality")]
Quiet = Annotated[bool, _option(None, "Print the path of the results alone.", "--quiet")]
Json = Annotated[bool, _option(None, "Print tables, notes and the path as one JSON document.", "--json")]
Seeds = Annotated[Whole, _whole(f"Runs of each algorithm in --quality.  [default: {_ELSE} 31]")]
Target = Annotated[Real, _real(f"Share of the reference hypervolume to reach [-].  [default: {_ELSE} 0.995]")]
Jobs = Annotated[Whole, _whole("Processes for the runs of --quality.")]
Scheduler = Annotated[Text, _option("ADDRESS", "Dask scheduler for them: tcp://host:8786, tls://host:8786.")]
Histories = Annotated[Path, Argument(metavar="FILE", help="CSV or RPC III file of accelerations.")]
HistoryColumns = Annotated[Text, _option("NAME,...", "Names of all columns: 'time [s],x [g],z [g]'.")]
Axes = Annotated[Text, _option("COLUMN=AXIS,...", "Axes of columns with other names: body_acceleration=z.")]
Step = Annotated[Real, _real("Time step [s] of a file without times, or with a unit: 5ms.", "s")]
Duration = Annotated[Real, _real("Time of exposure in a day [s], or with a unit: 4h.  [default: 8h]", "s")]
Settling = Annotated[Real, _real("Time [s] at the start in which filters settle, not counted.  [default: 0]", "s")]
Certify = Annotated[Real, _real("Drive 8 random roads of this length [m] in time, or with a unit: 2km.", "m")]
Kind = Annotated[str, Argument(metavar="KIND", help="quarter-car, half-car, full-car or multibody.")]
NewFile = Annotated[Path, _option("FILE", "File to write, absent.", "--out")]
Out = Annotated[File, _option("FOLDER", "Folder for the results, absent or empty.  [default: a new one]")]
Resumed = Annotated[File, _option("FOLDER", "Folder: absent, empty, or of the same command, to resume it.")]
