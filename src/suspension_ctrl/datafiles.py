"""Where the data files are, in a checkout and in an installed wheel."""

import csv
from os import PathLike
from pathlib import Path

_PACKAGE = Path(__file__).parent


def path(name: str) -> Path:
    """Path of the data file `name`, e.g. ``"paper/table1_vehicle.csv"``.

    A wheel carries the top-level folder ``data`` inside the package; in a checkout it lies beside ``src``.
    """
    for folder in (_PACKAGE / "data", _PACKAGE.parents[1] / "data"):
        if (folder / name).is_file():
            return folder / name
    raise FileNotFoundError(f"data file {name!r} is neither in the package nor in the checkout")


def named(kind: str, folder: str, source: str | PathLike[str]) -> Path:
    """Return the path of a TOML file, or of the data file in `folder` of that name without its ending."""
    if Path(source).suffix == ".toml":
        return Path(source)
    known = stems(folder)
    if str(source) not in known:
        raise ValueError(
            f"{kind} must be one of {', '.join(known)} or the path of a .toml file, got {str(source)!r}"
        )
    return path(f"{folder}/{source}.toml")


def stems(folder: str) -> list[str]:
    """Return the names, without their endings, of the data files in a folder, in alphabetical order."""
    for root in (_PACKAGE / "data", _PACKAGE.parents[1] / "data"):
        if (root / folder).is_dir():
            return sorted(file.stem for file in (root / folder).iterdir())
    raise FileNotFoundError(f"data folder {folder!r} is neither in the package nor in the checkout")


def rows(name: str) -> list[dict[str, str]]:
    """Rows of a CSV data file, each a dictionary by column name; lines that start with ``#`` name the source."""
    with path(name).open(encoding="utf-8", newline="") as file:
        return list(csv.DictReader(line for line in file if not line.startswith("#")))
