"""A wheel as a dataclass with fields of every form that a file can hold, and its table."""

from dataclasses import dataclass, field

import pytest

from suspension_ctrl.documents import Mistakes, Table
from suspension_ctrl.quantities import Checked, Real, Record, frozen_array, unit
from suspension_ctrl.schema.reading import read_record

NUMBER = "a number from 1e-12 to 1e+12 in size or 0"


@dataclass(frozen=True, eq=False, repr=False)
class Tyre(Checked):
    stiffness: float = field(metadata=unit("N/m"))


@dataclass(frozen=True, eq=False, repr=False)
class Track(Record):
    links: tuple[float, ...]


@dataclass(frozen=True, eq=False, repr=False)
class Weight(Record):
    place: tuple[float, float] = field(metadata=unit("m"))
    share: tuple[float, ...] = field(metadata={"key": "share_percent"})


@dataclass(frozen=True, eq=False, repr=False)
class Wheel(Checked):
    mass: float = field(metadata=unit("kg"))
    place: tuple[float, float] = field(metadata=unit("m"))
    name: str = field(metadata={"key": "called"})
    camber: float = field(default=0.0, metadata=unit("rad"))
    lift: float = field(default=0.0, metadata=unit("m", -1, 1))
    slip: float | None = None
    spokes: tuple[float, ...] = ()
    driven: bool = False
    tyre: Tyre | None = None
    ground: object = field(default=None, metadata={"kinds": {"tyre": Tyre, "track": Track}})
    tyres: tuple[Tyre, ...] = field(default=(), metadata={"most": 3})
    words: tuple[str, ...] = ()
    weights: dict = field(default_factory=dict, metadata={"rows": Weight})
    curve: Real = field(default=None, metadata=unit("m") | {"most": 200})

    def __post_init__(self) -> None:
        super().__post_init__()
        if self.name == "spare":
            raise ValueError(f"name must be of a wheel in use, got {self.name!r}")
        if self.curve is not None:
            self._keep(curve=frozen_array(self.curve))


GOOD = {"mass_kg": 20, "place_m": [1, 0.5], "called": "left"}
FULL = {
    **GOOD, "camber_rad": 0.1, "lift_m": -0.5, "slip": 2, "spokes": [1, 2], "driven": True,
    "tyre": {"stiffness_N_per_m": 2e5}, "ground": {"kind": "track", "links": [3]},
    "tyres": [{"stiffness_N_per_m": 1e5}, {"stiffness_N_per_m": 3e5}], "words": ["a", "b"],
    "weights": [{"place_m": [0, 1], "share_percent": [30, 40]}], "curve_m": [1, 2, 3],
}  # fmt: skip
WHEEL = Wheel(
    20.0, (1.0, 0.5), "left", 0.1, -0.5, 2.0, (1.0, 2.0), True, Tyre(2e5), Track((3.0,)), (Tyre(1e5), Tyre(3e5)),
    ("a", "b"), {(0.0, 1.0): (30.0, 40.0)}, [1, 2, 3],
)  # fmt: skip


def refused(table: dict, name: str = "wheel.") -> list[str]:
    mistakes = Mistakes()
    read_record(Wheel, Table(name, table), mistakes)
    with pytest.raises(ValueError, match="must") as error:
        mistakes.settle()
    return str(error.value).split("\n")


def accepted(table: dict) -> Wheel:
    mistakes = Mistakes()
    wheel = read_record(Wheel, Table("", table), mistakes)
    mistakes.settle()
    return wheel


def accepted_table(table: Table) -> Wheel:
    return accepted(table.content)
