"""Events of load cases in problem files: a table by name with its kind, values and speed."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

from ..documents import Mistakes, Table
from ..quantities import unit
from ..roads.bumps import Ramp, SpeedBump, TrapezoidalBump
from ..roads.edges import Cleat, Plank, Pothole, Step
from ..roads.events import Event
from ..roads.obstacles import Obstacle
from ..roads.rigs import RigChirp, RigSine
from ..roads.waves import Chirp, Sine
from ..schema.keys import KIND, Form, bad, keys_of
from ..schema.reading import constructed, kind_of, read
from ..schema.writing import content
from .load_case import Drive

EVENTS: dict[str, type[Event]] = {
    "speed-bump": SpeedBump, "trapezoidal-bump": TrapezoidalBump, "plank": Plank, "cleat": Cleat,
    "pothole": Pothole, "step": Step, "ramp": Ramp, "sine": Sine, "chirp": Chirp,
    "rig-sine": RigSine, "rig-chirp": RigChirp,
}  # fmt: skip
_STAND_IN = Drive(SpeedBump(height=1.0, length=1.0))


@dataclass(frozen=True, kw_only=True)
class DriveKeys:
    """Keys beside those of an obstacle.

    Parameters
    ----------
    speed : float
        Speed over the obstacle [m/s]; that of the load case if not given.
    """

    speed: float | None = field(default=None, metadata=unit("m/s", 1e-3, 1e3))


def _read(table: Table, mistakes: Mistakes) -> Mapping[str, Drive]:
    """Return the events by name; in place of a wrong one a bump, so that measures are checked as well."""
    return {name: _read_event(table.inner(name, value), mistakes) for name, value in table.content.items()}


def _read_event(table: Table, mistakes: Mistakes) -> Drive:
    before, kind = len(mistakes), kind_of(EVENTS, table, mistakes)
    if bad(kind):
        return _STAND_IN
    beside = keys_of(DriveKeys) if issubclass(kind, Obstacle) else {}
    values = read(table, {**KIND, **keys_of(kind), **beside}, mistakes)
    event = constructed(kind, values, table.name, mistakes if len(mistakes) == before else Mistakes())
    return _STAND_IN if bad(event) else Drive(event, values.get("speed"))


def _write(events: Mapping[str, Drive]) -> dict[str, Any]:
    """Return the tables of events by name."""
    return {
        name: {**content(one.event, EVENTS), **content(DriveKeys(speed=one.speed))} for name, one in events.items()
    }


IN_FILES = {"form": Form(_read, _write)}
"""Metadata of a field of events by name."""
