"""Finished runs on disk, each file whole or absent: a stopped comparison resumes."""

import json
from collections.abc import Iterator, Mapping, MutableMapping
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

from .. import escaping, tables

if TYPE_CHECKING:
    import pandas as pd


VIOLATION = "violation"
"""Column of a final population's total violations, where the problem has constraints."""


class StoredRun(NamedTuple):
    """The tables of a finished run."""

    course: "pd.DataFrame"  # a row per iteration, or per budget and set judged
    final: "pd.DataFrame"  # a row per design of its final population; `VIOLATION` where there are constraints

    @property
    def feasible(self) -> "pd.DataFrame":
        """Rows of the final population that meet all constraints."""
        return self.final[self.final[VIOLATION] == 0] if VIOLATION in self.final else self.final


class FolderStore(MutableMapping[str, StoredRun]):
    """Finished runs by name, as two CSV files each in a folder that belongs to one plan.

    Parameters
    ----------
    folder : Path
        Made if absent. A run is stored once its file in ``runs`` exists, the last one written.
    plan : mapping
        Settings and versions that the results depend on, for ``plan.json``.

    Raises
    ------
    ValueError
        If the folder holds runs of another plan.
    """

    def __init__(self, folder: Path, plan: Mapping[str, Any]) -> None:
        self._course, self._final = folder / "runs", folder / "final"
        folder.mkdir(parents=True, exist_ok=True)
        path = folder / "plan.json"
        if not path.exists():
            tables.write_json(path, plan)
        kept, wanted = json.loads(path.read_text(encoding="utf-8")), json.loads(json.dumps(dict(plan)))
        for name in wanted | kept:
            there, here = kept.get(name), wanted.get(name)
            if there != here:
                raise ValueError(f"{name} must be {there!r} as in {str(path)!r} to go on there, got {here!r}")
        for part in (self._course, self._final):
            part.mkdir(exist_ok=True)
            for unfinished in part.glob(".*"):  # left by a process that was killed as it wrote
                unfinished.unlink()

    def __getitem__(self, name: str) -> StoredRun:
        import pandas as pd

        if name not in self:
            raise KeyError(name)
        parts = (pd.read_csv(part / f"{name}.csv") for part in (self._course, self._final))
        return StoredRun(*(escaping.frame(part, escaping.from_csv) for part in parts))

    def __setitem__(self, name: str, run: StoredRun) -> None:
        tables.write_csv(self._final / f"{name}.csv", run.final)
        tables.write_csv(self._course / f"{name}.csv", run.course)

    def __delitem__(self, name: str) -> None:
        (self._course / f"{name}.csv").unlink()

    def __contains__(self, name: object) -> bool:
        return (self._course / f"{name}.csv").exists()

    def __iter__(self) -> Iterator[str]:
        return (path.stem for path in sorted(self._course.glob("*.csv")))

    def __len__(self) -> int:
        return sum(1 for _ in self)
