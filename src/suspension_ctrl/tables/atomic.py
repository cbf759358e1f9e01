"""Files written whole or not at all: under temporary names, flushed to the disk, then renamed."""

import errno
import os
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager, suppress
from pathlib import Path
from uuid import uuid4

UNFINISHED = ".unfinished-"
"""Prefix of the name of a temporary file."""


def write_whole(path: Path, write: Callable[[Path], object]) -> None:
    """Write a file atomically: `write` fills a temporary file beside it; an OSError names `path`."""
    write_together({path: write})


def write_together(files: Mapping[Path, Callable[[Path], object]], *, flushed: bool = True) -> None:
    """Write files atomically as `write_whole`; none has its name before the content of all is there.

    Flushing many files at once takes a tenth of the time of one after another. Files that are not `flushed` may be
    empty or missing after a loss of power in the next half minute: for contents that are checked when read.
    """
    temporary = {path: path.with_name(f"{UNFINISHED}{uuid4().hex}{path.suffix}") for path in files}
    try:
        for path, write in files.items():
            with _naming(path):
                write(temporary[path])
        for path in files if flushed else ():
            with _naming(path), temporary[path].open("rb+") as file:
                os.fsync(file.fileno())  # the content reaches the disk before the name
        for path in files:
            with _naming(path):
                os.replace(temporary[path], path)
        for folder in dict.fromkeys(path.parent for path in files) if flushed else ():
            with _naming(folder):
                sync_folder(folder)
    finally:
        for one in temporary.values():
            with suppress(OSError):
                one.unlink(missing_ok=True)


@contextmanager
def _naming(path: Path) -> Iterator[None]:
    """Name `path` in an OSError."""
    try:
        yield
    except OSError as error:
        raise OSError(error.errno or errno.EIO, error.strerror or str(error), str(path)) from error


def sync_folder(folder: Path) -> None:
    """Flush the entries of a folder to the disk, if the system can."""
    if os.name == "posix":
        number = os.open(folder, os.O_RDONLY)
        try:
            with suppress(OSError):  # not on some network file systems
                os.fsync(number)
        finally:
            os.close(number)
