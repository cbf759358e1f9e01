"""Plants in vehicle files: the file of a system, and names, units and signs of its signals.

``inputs`` and ``outputs`` are arrays of texts in the order of the signals, or tables of texts by the names that
the system has.
"""

from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeGuard

from ..documents import Mistakes, Table, keyed
from ..quantities import unit
from ..schema.keys import BAD, bad
from ..schema.reading import fields_named
from ..schema.writing import content
from .assembly import ONE_WHEEL, Position
from .feedback import System, has_states
from .vehicle import AssembledVehicle, Vehicle

if TYPE_CHECKING:
    from .plants import Plant
    from .signals import Names


@dataclass(frozen=True)
class Contact:
    """A wheel of a plant in a file.

    Parameters
    ----------
    wheel : str
        Name of the wheel, as in the names of its road and its tyre load.
    position : (float, float)
        Point where it touches the road, x forward and y to the left [m].
    """

    wheel: str
    position: Position = field(metadata=unit("m"))


@dataclass(frozen=True, kw_only=True)
class PlantFile:
    """A vehicle in a file of another program.

    Parameters
    ----------
    file : str
        File beside this one or below, as `load_system` reads it: ``.mat``, ``.npz``, ``.npy``, ``.a``, ``.csv``,
        ``.uff``.
    inputs, outputs : array of str, or table
        Signals with unit and sign, ``"-front_strut [kN]"``, see `Plant.named`; not needed if the file has these
        names and SI units.
    contacts : array of tables
        Points where wheels touch the road; by default one wheel without a name.
    axles : array of str
        Axles with equal struts: ``front_left`` and ``front_right`` have the coefficients of ``front`` together.
    included : table
        Springs and dampers that the model has at its struts, which are taken out.
    """

    file: str
    inputs: tuple[str, ...] | Mapping[str, Any] = ()
    outputs: tuple[str, ...] | Mapping[str, Any] = ()
    contacts: Mapping[str, Position] = field(default=ONE_WHEEL, metadata={"rows": Contact})
    axles: tuple[str, ...] = ()
    included: Mapping[str, Any] = field(default_factory=dict)


def read_plant(record: PlantFile, table: Table, mistakes: Mistakes) -> "Plant":
    """Return the plant of a file, with all that its model includes; `BAD` after a mistake."""
    from .matrices import parts_of
    from .plants import Plant
    from .system_files import load_system

    system: System = BAD
    with mistakes.noted(), keyed(table.name, {"file": "file"}):
        for part in parts_of(Path(record.file)):
            table.folder.file(str(part))
        with mistakes.noted(f"{table.name}file: "):
            system = load_system(table.folder.path / record.file)
    if not bad(system):
        with mistakes.noted(), fields_named(PlantFile, table.name):
            inputs, outputs = _names(record.inputs), _names(record.outputs)
            contacts, axles = record.contacts, record.axles
            return Plant.named(system, inputs=inputs, outputs=outputs, contacts=contacts, axles=axles)
    return BAD


def is_plant(vehicle: Vehicle) -> "TypeGuard[Plant]":
    """Whether a vehicle is a `Plant`; one of masses and links is none without a look at python-control."""
    if isinstance(vehicle, AssembledVehicle):
        return False
    from .plants import Plant

    return isinstance(vehicle, Plant)


def plant_table(plant: "Plant", stem: Path) -> dict[str, Any]:
    """Write the system of a plant to a file of this stem; return the table of a vehicle that is the plant."""
    from .system_files import save_system

    file = stem.with_name(f"{stem.name}{'.npz' if has_states(plant.system) else '.csv'}")
    save_system(file, plant.system)
    record = PlantFile(file=file.name, contacts=plant.contacts, axles=plant.axles)
    return {"kind": "plant", **content(record)}


def _names(given: "Names") -> "Names | None":
    """Return names by the model's own, which may have dots, or in their order; None if there are none."""
    return (Table("", given).flat().content if isinstance(given, Mapping) else given) or None
