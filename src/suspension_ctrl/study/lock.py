"""Lock of a results folder for one process at a time, and removal of unfinished files."""

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

from ..checks import installed
from ..tables import write_json
from ..tables.atomic import UNFINISHED

if TYPE_CHECKING:
    from filelock import BaseFileLock

LOCK, HOLDER = ".lock", ".in-use.json"
"""Files of a locked folder: the lock, and a note of the process that holds it."""

OLD = 60.0
"""Age [s] from which an unfinished file is abandoned."""


def hold(folder: Path) -> "BaseFileLock":
    """Make a folder and return its lock, held until the last reference is deleted; BlockingIOError if in use."""
    with installed("study"):
        from filelock import FileLock, Timeout

    folder.mkdir(parents=True, exist_ok=True)
    folder = folder.resolve()  # one lock in this process for all paths of a folder
    lock = FileLock(folder / LOCK, is_singleton=True, thread_local=False)
    if lock.is_locked:
        return lock
    try:
        lock.acquire(blocking=False)
    except Timeout:
        raise BlockingIOError(f"{str(folder)!r} is in use by {_holder(folder / HOLDER)}") from None
    since = datetime.now().astimezone().isoformat(sep=" ", timespec="seconds")
    write_json(folder / HOLDER, {"process": os.getpid(), "host": socket.gethostname(), "since": since})
    weakref.finalize(lock, _leave, folder / HOLDER)
    _clean(folder)
    return lock


def _holder(note: Path) -> str:
    """Return the process that holds a folder, in words."""
    with suppress(OSError, ValueError, KeyError, TypeError):
        holder = json.loads(note.read_text(encoding="utf-8"))
        return f"process {holder['process']} on {holder['host']} since {holder['since']}"
    return "another process"


def _leave(note: Path) -> None:
    with suppress(OSError):
        note.unlink()


def _clean(folder: Path) -> None:
    """Remove abandoned files in a folder and its subfolders."""
    for path in folder.rglob(f"{UNFINISHED}*"):
        with suppress(OSError):
            if time.time() - path.lstat().st_mtime > OLD:
                path.unlink()


def set_aside(path: Path) -> None:
    """Rename a file or folder, if any, to ``*.spoilt``, ``*.spoilt1``, ... (the first free name)."""
    if path.is_symlink() or path.exists():
        names = (path.with_name(f"{path.name}.spoilt{number or ''}") for number in count())
        path.rename(next(name for name in names if not name.exists()))
