"""The folder for the results of a command: new, empty, or of a command to resume."""

from contextlib import suppress
from datetime import datetime
from itertools import chain, count
from pathlib import Path
from tempfile import NamedTemporaryFile

from ..tables import UNFINISHED


def results_folder(out: Path | None, resumed_by: str | None = None) -> Path:
    """Make and return the folder for the results of a command: `out`, or a new one ``results/<date-time>``.

    ValueError unless `out` is absent, empty, or holds the name `resumed_by`, and can be written.
    """
    folder = out or Path("results") / datetime.now().strftime("%Y-%m-%d_%H-%M-%S")
    try:
        if out is None:
            folder = _made_new(folder)
        folder.mkdir(parents=True, exist_ok=True)
        if any(folder.glob("[!.]*")) and not (resumed_by and (folder / resumed_by).exists()):
            raise ValueError(
                f"out must be a folder that is absent or empty, got {str(folder)!r}, which is not empty"
            )
        with NamedTemporaryFile(dir=folder, prefix=UNFINISHED):
            return folder
    except OSError as error:
        reason = f"got {str(folder)!r}: {error.strerror}"
        raise ValueError(f"out must be a folder that can be written, {reason}") from error


def _made_new(folder: Path) -> Path:
    """Make `folder`, or where that exists the first of folder_2, folder_3, ... that does not."""
    for path in chain([folder], (folder.with_name(f"{folder.name}_{number}") for number in count(2))):
        with suppress(FileExistsError):  # also when another command takes the name at this moment
            path.mkdir(parents=True)
            break
    return path
