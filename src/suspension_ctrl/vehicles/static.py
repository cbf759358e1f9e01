"""Static position of a vehicle on level ground, by name."""

from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING

import numpy as np

from ..quantities import signal_unit
from .assembly import GRAVITY, joined
from .handling import Mechanics

if TYPE_CHECKING:
    import pandas as pd


def static_of(statics: Mechanics, values: Mapping[str, float]) -> "pd.DataFrame":
    """Return `Vehicle.static` at coefficients by name."""
    import pandas as pd

    rows = list(_rows(statics, values))
    index = pd.Index([name for name, _ in rows], name="name")
    units = [signal_unit(name) for name, _ in rows]
    return pd.DataFrame({"value": [float(value) for _, value in rows], "unit": units}, index=index)


def _rows(statics: Mechanics, values: Mapping[str, float]) -> Iterator[tuple[str, float]]:
    """Yield loads of wheels, deflections of tyres and struts, and displacements of bodies and wheels."""
    assembly, coefficients = statics.assembly, np.array([list(values.values())])
    loads = statics.static_loads(coefficients)[0]
    for wheel, load in zip(assembly.contacts, loads, strict=True):
        yield joined(wheel, "wheel_load"), load
    at = np.linalg.solve(statics.stiffness_of(coefficients)[0], -GRAVITY * assembly.weights)
    tyres, struts = (assembly.elongations(links)[0] @ at for links in (assembly.tyres, assembly.struts))
    for tyre, deflection in zip(assembly.tyres, tyres, strict=True):
        yield joined(tyre.name, "tyre_deflection"), deflection
    for strut, deflection in zip(assembly.struts, struts, strict=True):
        yield joined(strut.name, "deflection"), deflection
    for name, displacement in zip(assembly.movements, assembly.displacements @ at, strict=True):
        yield f"{name}_displacement", displacement
