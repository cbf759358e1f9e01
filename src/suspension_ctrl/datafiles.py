"""Data files of the package, in a checkout and in an installed wheel."""

import csv
from os import PathLike
from pathlib import Path

from . import checks

_FOLDERS = (Path(__file__).parent / "data", Path(__file__).parents[2] / "data")  # of a wheel, of a checkout
DATA = next(filter(Path.is_dir, _FOLDERS))


def path(name: str) -> Path:
    """Return the path of the data file `name`, e.g. ``"paper/table1_vehicle.csv"``."""
    if not (DATA / name).is_file():
        raise FileNotFoundError(f"data file {name!r} must be in {str(DATA)!r}")
    return DATA / name


def named(kind: str, folder: str, source: str | PathLike[str]) -> Path:
    """Return the path of a TOML file, or of the TOML file in the data folder with this name."""
    if checks.path_of(kind, source).suffix == ".toml":
        return Path(source)
    shipped = stems(folder)
    if str(source) not in shipped:
        allowed = f"one of {checks.listing(shipped, source)} or the path of a .toml file"
        raise ValueError(f"{kind} must be {allowed}, got {checks.shown(str(source))}")
    return path(f"{folder}/{source}.toml")


def stems(folder: str) -> list[str]:
    """Return the names, without endings, of the TOML files in a data folder, sorted."""
    return sorted(file.stem for file in (DATA / folder).glob("*.toml"))


def rows(name: str) -> list[dict[str, str]]:
    """Return the rows of a CSV data file by column name, without comments (``#``)."""
    with path(name).open(encoding="utf-8", newline="") as file:
        return list(csv.DictReader(line for line in file if not line.startswith("#")))
