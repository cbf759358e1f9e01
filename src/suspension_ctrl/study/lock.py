"""A lock of a results folder for one process at a time, and the removal of unfinished files."""

import json
import os
import socket
import time
import weakref
from contextlib import suppress
from datetime import datetime
from itertools import count
from pathlib import Path
from typing import TYPE_CHECKING

from .. import tables
from ..checks import installed

if TYPE_CHECKING:
    from filelock import BaseFileLock

LOCK, HOLDER = ".lock", ".in-use.json"
"""Files of a held folder: the lock, and the process that holds it."""

OLD = 60.0
"""Age [s] of an unfinished file that no process writes any more."""


def hold(folder: Path) -> "BaseFileLock":
    """Make a folder and return its lock; the process holds it until the last reference to it is gone.

    The operating system frees the lock of a dead process. BlockingIOError if another process holds the folder.
    """
    with installed("study"):
        from filelock import FileLock, Timeout

    folder.mkdir(parents=True, exist_ok=True)
    folder = folder.resolve()  # one lock of a folder in this process, by whatever path
    lock = FileLock(folder / LOCK, is_singleton=True, thread_local=False)
    if lock.is_locked:
        return lock
    try:
        lock.acquire(blocking=False)
    except Timeout:
        raise BlockingIOError(f"{str(folder)!r} is in use by {_holder(folder / HOLDER)}") from None
    since = datetime.now().astimezone().isoformat(sep=" ", timespec="seconds")
    tables.write_json(folder / HOLDER, {"process": os.getpid(), "host": socket.gethostname(), "since": since})
    weakref.finalize(lock, _leave, folder / HOLDER)
    _clean(folder)
    return lock


def _holder(note: Path) -> str:
    """Return the process that holds a folder in words."""
    with suppress(OSError, ValueError, KeyError, TypeError):
        there = json.loads(note.read_text(encoding="utf-8"))
        return f"process {there['process']} on {there['host']} since {there['since']}"
    return "another process"


def _leave(note: Path) -> None:
    with suppress(OSError):
        note.unlink()


def _clean(folder: Path) -> None:
    """Remove old unfinished files in all of a folder."""
    for path in folder.rglob(f"{tables.UNFINISHED}*"):
        with suppress(OSError):
            if time.time() - path.lstat().st_mtime > OLD:
                path.unlink()


def set_aside(path: Path) -> None:
    """Rename a file or folder, if any, to ``*.spoilt``, or the first free of ``*.spoilt1``, ``*.spoilt2``, ..."""
    if path.is_symlink() or path.exists():
        names = (path.with_name(f"{path.name}.spoilt{number or ''}") for number in count())
        path.rename(next(name for name in names if not name.exists()))
