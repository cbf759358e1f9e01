"""Reference fronts of grids that settled, kept in the user's cache folder from one comparison to the next."""

import hashlib
import json
import os
from collections.abc import Mapping
from contextlib import suppress
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path
from typing import Any, Self

import numpy as np
from platformdirs import user_cache_path

from .. import tables
from ..search import indicators, kinds, spreading
from ..search.indicators import ReferenceFront
from ..search.problem import Minimisable
from . import machine, plans, reference
from .reference import Reference

FOLDER = "SUSPENSION_CTRL_CACHE"
"""Variable of the environment that names another folder; if it is empty, nothing is kept."""

MOST = 50
"""Fronts in the folder; the one that was kept first leaves it."""

_ARRAYS = ("objectives", "ideal", "nadir")


@dataclass(frozen=True)
class KeptFronts:
    """A folder of reference fronts, a file for each by a digest of all that it depends on."""

    folder: Path | None  # None: nothing is kept

    @classmethod
    def of_user(cls) -> Self:
        """Return the folder of the environment, or else that for caches on this system."""
        given = os.environ.get(FOLDER)
        return cls(
            user_cache_path("suspension-ctrl") / "fronts" if given is None else Path(given) if given else None
        )

    def find(self, problem: Minimisable, tolerance: float) -> Reference | None:
        """Return the front kept of a problem, None without one, or if its file is not as it was written."""
        if self.folder is None:
            return None
        plan = _plan(problem, tolerance)
        with suppress(ValueError, OSError, KeyError, TypeError):
            kept = plans.read(_path(self.folder, plan))
            front = _front(kept["front"])
            if kept["plan"] == plan and kept["summary"] == reference.summary(front):
                return Reference(front, kept["origin"])
        return None

    def keep(self, problem: Minimisable, tolerance: float, found: Reference) -> None:
        """Keep a front, if the folder can be written; the oldest of more than `MOST` leave it."""
        if self.folder is None:
            return
        plan, front = _plan(problem, tolerance), found.front
        numbers = {name: getattr(front, name).tolist() for name in _ARRAYS}
        content = {"plan": plan, "summary": reference.summary(front), "origin": found.origin}
        with suppress(OSError):  # a full disk or a home that is read-only
            self.folder.mkdir(parents=True, exist_ok=True)
            tables.write_json(_path(self.folder, plan), content | {"front": numbers | {"volume": front.volume}})
            for path in sorted(self.folder.glob("[!.]*.json"), key=lambda path: path.stat().st_mtime)[:-MOST]:
                path.unlink(missing_ok=True)


NONE_KEPT = KeptFronts(None)


def _front(numbers: Mapping[str, Any]) -> ReferenceFront:
    arrays = {name: np.array(numbers[name], dtype=float) for name in _ARRAYS}
    return ReferenceFront(**arrays, volume=float(numbers["volume"]))


def _path(folder: Path, plan: Mapping[str, Any]) -> Path:
    return folder / f"{hashlib.sha256(json.dumps(plan, sort_keys=True).encode()).hexdigest()[:32]}.json"


def _plan(problem: Minimisable, tolerance: float) -> dict[str, Any]:
    """Return all on which the front of a grid depends: problem, values, tolerance, code and versions."""
    plan = {"problem": plans.described(problem), "values": reference.fingerprint(problem), "tolerance": tolerance}
    whole: dict[str, Any] = json.loads(json.dumps(plan | {"code": _code(), "versions": machine.provenance()}))
    return whole


@lru_cache
def _code() -> str:
    """Return a digest of the code that makes fronts: the version of the package stays as it is developed."""
    modules = (reference, indicators, kinds, spreading)
    sources = (Path(str(module.__file__)).read_bytes() for module in modules)
    return hashlib.sha256(b"".join(sources)).hexdigest()[:32]
