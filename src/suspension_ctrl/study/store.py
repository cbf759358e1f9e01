"""Finished runs on disk: each file whole or not at all, so that a campaign goes on where it was stopped."""

import json
from collections.abc import Iterator, MutableMapping
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

from .. import tables as files

if TYPE_CHECKING:
    import pandas as pd


PLAN = "plan.json"
VIOLATION = "violation"
"""Column of a final population's total violations, where the problem has constraints."""


class Record(NamedTuple):
    """What is kept of a run: a table of its course, and what it ended with.

    Parameters
    ----------
    course : DataFrame
        A row per iteration, or per budget and set judged.
    final : DataFrame
        A row per individual of its final population, with a column `VIOLATION` where there are constraints.
    """

    course: "pd.DataFrame"
    final: "pd.DataFrame"


class FolderStore(MutableMapping[str, Record]):
    """Records by name of a run, as two CSV files each in a folder that belongs to one plan.

    Parameters
    ----------
    folder : Path
        Made if absent. A run is in the store once its file in ``runs`` is; that is written last.
    plan : dict
        What the results depend on, for ``plan.json``.

    Raises
    ------
    ValueError
        If the folder holds runs of another plan.
    """

    def __init__(self, folder: Path, plan: dict[str, Any]) -> None:
        self._course, self._final = folder / "runs", folder / "final"
        folder.mkdir(parents=True, exist_ok=True)
        path = folder / PLAN
        if not path.exists():
            files.write_json(path, plan)
        there, wanted = json.loads(path.read_text()), json.loads(json.dumps(plan))
        for name in wanted | there:
            if there.get(name) != wanted.get(name):
                raise ValueError(
                    f"{name} must be {there.get(name)!r} as in {str(path)!r} to go on there, "
                    f"got {wanted.get(name)!r}"
                )
        for part in (self._course, self._final):
            part.mkdir(exist_ok=True)
            for unfinished in part.glob(".*"):  # left by a process that was killed as it wrote
                unfinished.unlink()

    def __getitem__(self, name: str) -> Record:
        import pandas as pd

        if name not in self:
            raise KeyError(name)
        paths = (part / f"{name}.csv" for part in (self._course, self._final))
        return Record(*(pd.read_csv(path) for path in paths))

    def __setitem__(self, name: str, record: Record) -> None:
        files.write_csv(self._final / f"{name}.csv", record.final)
        files.write_csv(self._course / f"{name}.csv", record.course)

    def __delitem__(self, name: str) -> None:
        (self._course / f"{name}.csv").unlink()

    def __contains__(self, name: object) -> bool:
        return (self._course / f"{name}.csv").exists()

    def __iter__(self) -> Iterator[str]:
        return (path.stem for path in sorted(self._course.glob("*.csv")))

    def __len__(self) -> int:
        return sum(1 for _ in self)
