"""The results folder of a command: new, empty, or of an interrupted command."""

from contextlib import suppress
from datetime import datetime
from itertools import chain, count
from pathlib import Path
from tempfile import NamedTemporaryFile

from ..tables.atomic import UNFINISHED


def results_folder(out: Path | None, resumed_by: str | None = None) -> Path:
    """Make and return a results folder: `out`, or a new folder ``results/<date-time>``.

    ValueError unless `out` is absent, empty, or contains `resumed_by`, and can be written.
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


def check(out: Path | None) -> None:
    """Raise ValueError where `results_folder` would, before any work, and leave no folder behind."""
    if out is not None:
        absent = [path for path in (out, *out.parents) if not path.exists()]
        results_folder(out)
        for path in absent:
            path.rmdir()


def _made_new(folder: Path) -> Path:
    """Make and return `folder`, or if it exists the first free one of folder_2, folder_3, ..."""
    for path in chain([folder], (folder.with_name(f"{folder.name}_{number}") for number in count(2))):
        with suppress(FileExistsError):  # another command may take the name at the same moment
            path.mkdir(parents=True)
            break
    return path
