"""Scatter in problem files: a table of deviations by name, with samples, seed and distribution."""

from dataclasses import dataclass
from typing import Any

from ..documents import Mistakes, Table
from ..schema.keys import BAD, Form, bad, keys_of
from ..schema.reading import read
from ..schema.writing import content
from .scatter import Scatter


@dataclass(frozen=True, kw_only=True)
class ScatterKeys:
    """Keys of a scatter beside its deviations.

    Parameters
    ----------
    samples : int
        Number of vehicles.
    seed : int
        Seed of the sample.
    distribution : str
        Between the deviations: "uniform" or "normal".
    """

    samples: int = 256
    seed: int = 1
    distribution: str = "uniform"


def _read(table: Table, mistakes: Mistakes) -> Scatter:
    """Return the scatter in a table, `BAD` after a mistake."""
    keys = keys_of(ScatterKeys)
    values = read(table, keys, mistakes, others=True)
    rest = {key: value for key, value in table.content.items() if key not in keys}
    tolerances = {key: _tolerance(value) for key, value in table._replace(content=rest).flat().content.items()}
    if bad(*values.values()):
        return BAD
    with mistakes.noted():
        return Scatter(tolerances, **values)
    return BAD


def _tolerance(value: Any) -> Any:
    """Return an array as a pair, another value as it is."""
    return tuple(value) if isinstance(value, list) else value


def _write(scatter: Scatter) -> dict[str, Any]:
    """Return the table of a scatter."""
    beside = {name: getattr(scatter, name) for name in ("samples", "seed", "distribution")}
    shares = {name: high if low == -high else [low, high] for name, (low, high) in scatter.intervals.items()}
    return {**content(ScatterKeys(**beside)), **shares}


IN_TABLE = {"form": Form(_read, _write)}
"""Metadata of a field with a scatter."""
