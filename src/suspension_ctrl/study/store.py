"""Finished runs in files, written atomically and checked when read, from which a comparison resumes."""

import time
import warnings
from collections.abc import Iterator, Mapping, MutableMapping
from contextlib import contextmanager
from hashlib import sha256
from io import BytesIO
from math import inf
from pathlib import Path
from typing import Any, NamedTuple

import pandas as pd

from .. import escaping, tables
from ..tables import atomic
from . import lock, plans

VIOLATION = "violation"
"""Column of the violation in a final population, if the problem has constraints."""

_PARTS = ("final", "runs")  # folders of the tables of a run
_RECORDS = "records"  # folder of numbers of rows and digests: the last file of a run to be written

FLUSHED_EVERY = 1.0
"""Time [s] in which one run is flushed to the disk, so that long runs all are.

The system flushes the others, on Linux within half a minute. A loss of power before that may cost these short
runs, and digests tell which.
"""


class SpoiltRunWarning(UserWarning):
    """A stored run is damaged or incomplete, and is repeated."""


class NotStoredError(OSError):
    """A result could not be written; finished runs are kept."""


class StoredRun(NamedTuple):
    """The tables of a finished run."""

    course: pd.DataFrame  # a row per iteration, or per budget and set judged
    final: pd.DataFrame  # a row per design of its final population; `VIOLATION` where there are constraints

    @property
    def feasible(self) -> pd.DataFrame:
        """Rows of the final population that meet all constraints."""
        return self.final[self.final[VIOLATION] == 0] if VIOLATION in self.final else self.final


@contextmanager
def keeping(folder: Path) -> Iterator[None]:
    """Extend an OSError by a hint that finished runs are kept, and how to resume."""
    try:
        yield
    except (NotStoredError, BlockingIOError):
        raise
    except OSError as error:
        raise NotStoredError(
            f"{error}; finished runs are kept: start again with {str(folder)!r} to resume"
        ) from error


class FolderStore(MutableMapping[str, StoredRun]):
    """Mapping of finished runs by name, two CSV files each, in a folder with one plan, locked for this process.

    A run is stored as soon as its file in ``records`` exists, which holds numbers of rows and digests of its
    tables. A run whose files do not match is renamed to ``*.spoilt`` with a `SpoiltRunWarning` when the folder is
    opened. ValueError for a folder with another plan, BlockingIOError if another process holds it.
    """

    def __init__(self, folder: Path, plan: Mapping[str, Any]) -> None:
        self._folder, self._lock = folder, lock.hold(folder)
        self._flushed = -inf  # time [s] of the last run that was flushed
        for part in (*_PARTS, _RECORDS):
            (folder / part).mkdir(exist_ok=True)
        atomic.sync_folder(folder)
        plans.settle(folder / plans.FILE, plan, started=len(self) > 0)
        self._set_spoilt_aside()

    def __getitem__(self, name: str) -> StoredRun:
        if name not in self:
            raise KeyError(name)
        return read_run(self._folder, name)

    def __setitem__(self, name: str, run: StoredRun) -> None:
        record, contents = {}, dict[Path, bytes]()
        with keeping(self._folder):
            for part, frame in zip(_PARTS, (run.final, run.course), strict=True):
                content = "".join(tables.csv_parts(frame)).encode()
                contents[self._path(part, name)] = content
                record[part] = {"rows": len(frame), "sha256": sha256(content).hexdigest()}
            contents[self._path(_RECORDS, name)] = tables.as_json(record)
            tables.write_all(contents, flushed=self._flush_is_due())

    def _flush_is_due(self) -> bool:
        """Whether this run is flushed to the disk: flushing many short runs takes longer than to make them."""
        now = time.monotonic()
        due = now - self._flushed >= FLUSHED_EVERY
        self._flushed = now if due else self._flushed
        return due

    def __delitem__(self, name: str) -> None:
        self._path(_RECORDS, name).unlink()

    def __contains__(self, name: object) -> bool:
        return self._path(_RECORDS, str(name)).exists()

    def __iter__(self) -> Iterator[str]:
        return (path.stem for path in sorted((self._folder / _RECORDS).glob("[!.]*.json")))

    def __len__(self) -> int:
        return count_runs(self._folder)

    def _path(self, part: str, name: str) -> Path:
        return _path(self._folder, part, name)

    def _set_spoilt_aside(self) -> None:
        """Warn about each spoilt run and rename its files."""
        stored = (path for part in _PARTS for path in sorted((self._folder / part).glob("[!.]*.csv")))
        for name in dict.fromkeys([*self, *(path.stem for path in stored)]):
            record = self._path(_RECORDS, name)
            try:
                if not record.exists():
                    raise _SpoiltError(self._path("runs", name), "a part of the run is missing")
                self[name]
            except _SpoiltError as spoilt:
                warnings.warn(f"{spoilt}; the run is repeated", SpoiltRunWarning, stacklevel=3)
                for part in (*_PARTS, _RECORDS):
                    lock.set_aside(self._path(part, name))


class Remembered(MutableMapping[str, StoredRun]):
    """A store in which a run that was made or read in this process is not read again."""

    def __init__(self, store: MutableMapping[str, StoredRun]) -> None:
        self._store, self._known = store, dict[str, StoredRun]()

    def __getitem__(self, name: str) -> StoredRun:
        if name not in self._known:
            self._known[name] = self._store[name]
        return self._known[name]

    def __setitem__(self, name: str, run: StoredRun) -> None:
        self._store[name] = self._known[name] = run

    def __delitem__(self, name: str) -> None:
        del self._store[name]
        self._known.pop(name, None)

    def __contains__(self, name: object) -> bool:
        return name in self._store

    def __iter__(self) -> Iterator[str]:
        return iter(self._store)

    def __len__(self) -> int:
        return len(self._store)


def count_runs(folder: Path) -> int:
    """Return the number of finished runs in the folder of a store, 0 without it."""
    return sum(1 for _ in (folder / _RECORDS).glob("[!.]*.json"))


def read_run(folder: Path, name: str) -> StoredRun:
    """Return a finished run in the folder of a store; ValueError with the path of a missing or damaged file."""
    record = _read_record(_path(folder, _RECORDS, name))
    final, course = (_read_part(_path(folder, part, name), record[part]) for part in _PARTS)
    return StoredRun(course, final)


def _path(folder: Path, part: str, name: str) -> Path:
    return folder / part / f"{name}.{'json' if part == _RECORDS else 'csv'}"


class _SpoiltError(ValueError):
    def __init__(self, path: Path, reason: str) -> None:
        super().__init__(f"{path}: {reason}")


def _read_record(path: Path) -> dict[str, Any]:
    """Return number of rows and digest of each table of a run."""
    try:
        record = plans.read(path)
        return {part: {"rows": int(record[part]["rows"]), "sha256": record[part]["sha256"]} for part in _PARTS}
    except (OSError, ValueError, KeyError, TypeError):
        raise _SpoiltError(path, "must hold numbers of rows and digests as they were stored") from None


def _read_part(path: Path, record: Mapping[str, Any]) -> pd.DataFrame:
    """Return a table of a run, checked against its record."""
    if not path.is_file():  # a folder, a pipe
        raise _SpoiltError(path, "must be a regular file")
    try:
        content = path.read_bytes()
    except OSError as error:
        raise _SpoiltError(path, f"cannot be read ({error.strerror})") from None
    if sha256(content).hexdigest() != record["sha256"]:
        raise _SpoiltError(path, f"must be as it was stored, got other {len(content)} bytes")
    frame = pd.read_csv(BytesIO(content))
    if len(frame) != record["rows"]:
        raise _SpoiltError(path, f"must have {record['rows']} rows, got {len(frame)}")
    return escaping.frame(frame, escaping.from_csv)
