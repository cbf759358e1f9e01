"""Write docs/files.md, the keys of vehicle, road and problem files, from the dataclasses that files are read by.

``python docs/keys.py`` after a change of a dataclass or its docstring.
"""

import inspect
import json
import re
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any, NamedTuple

from numpy.typing import ArrayLike

from suspension_ctrl.desk.study_files import SearchSettings
from suspension_ctrl.quantities import Real
from suspension_ctrl.response.event_files import EVENTS, DriveKeys
from suspension_ctrl.response.files import CaseDocument
from suspension_ctrl.response.files import Document as ProblemDocument
from suspension_ctrl.response.scatter_files import ScatterKeys
from suspension_ctrl.roads.coherence import COHERENCES
from suspension_ctrl.roads.files import KINDS as ROADS
from suspension_ctrl.roads.files import MeasuredFile, TabulatedFile
from suspension_ctrl.schema.keys import Key, keys_of
from suspension_ctrl.vehicles.body_parts import PARTS
from suspension_ctrl.vehicles.files import KINDS as VEHICLES
from suspension_ctrl.vehicles.files import Document as VehicleDocument
from suspension_ctrl.vehicles.handling import RollGeometry
from suspension_ctrl.vehicles.mounted import FlexibleBody, Payload, Seat, Shape
from suspension_ctrl.vehicles.plant_files import Contact
from suspension_ctrl.vehicles.property_files import Mounting
from suspension_ctrl.vehicles.strut_files import KINDS as ELEMENTS
from suspension_ctrl.vehicles.strut_files import element_keys

PAGE = Path(__file__).with_name("files.md")
HEAD = """# Files

Vehicles, roads, problems and studies are TOML files. This page is made from the code by `python docs/keys.py`.

A quantity has its unit in its key and a number as its value, `front_track_m = 1.5`; or no unit in its key and a
text with any unit of the same dimension as its value: `front_track = "1500mm"`, `speed = "100 km/h"`,
`spring = "20 kN/m"`. Units are kg, t, lb, m, km, cm, mm, in, ft, s, ms, min, h, mph, Hz, N, kN, lbf, rad, deg,
cycle, g (standard gravity) and %, and their products, quotients and powers: `N s/m`, `kg m^2`. Commands take such
texts too: `--speed 72km/h --sws-limit 28.7mm --band 0.5Hz..`.

```toml
kind = "half-car"
name = "A van, one side"
body_mass = "1.1 t"
pitch_inertia_kg_m2 = 2400
front_wheel_mass_kg = 40
rear_wheel_mass_kg = 45
front_tyre_stiffness = "220 N/mm"
rear_tyre_stiffness = "220 N/mm"
cg_to_front = "1300mm"
cg_to_rear = "1700mm"

[struts]
front.spring = "28 kN/m"
front.damper = "2.2 kN s/m"
rear.spring = "34 kN/m"
rear.damper = "2.4 kN s/m"

[bounds]
front.damper = ["1 kN s/m", "4 kN s/m"]
rear.damper = ["1 kN s/m", "4 kN s/m"]
```

`load_vehicle`, `load_road`, `load_problem` and `load_study` read files; `save_vehicle`, `save_road`,
`save_problem` and `save_study` write.
All mistakes of a file are listed at once, each with the file, the line, the key, what is allowed and the value:

```text
van.toml:3: body_mas must be a known key, got '1.1 t': did you mean body_mass_kg?
van.toml:9: cg_to_front must be in m or a unit like it, got '1300 kg' in kg
van.toml:14: struts.front.damper must be finite and > 0 N s/m, got -2200.0
van.toml:19: bounds.front.damper[2] must be a number with a unit like N s/m, got '4'
```

A key without a default is required.
"""
STRUTS = """
In the tables `struts`, `bounds` and `kinds` a coefficient of a strut is a key with its unit: `spring_N_per_m` and
`damper_N_s_per_m` of a quarter car, and of the others `front.spring_N_per_m`, `front.damper_N_s_per_m`,
`rear.spring_N_per_m`, `rear.damper_N_s_per_m`, of a full car `front_antiroll_N_m_per_rad` and
`rear_antiroll_N_m_per_rad` as well, and of each seat `<name>.spring_N_per_m` and `<name>.damper_N_s_per_m`; of
rigid bodies the names begin with those in `coefficients`.
`struts` holds numbers and `bounds` arrays of the lowest and the highest value. Only a search needs bounds.
"""
RIGID_BODIES = """A vehicle of any bodies, such as a truck with its trailer. Places are
in the axes of the vehicle, x forward and y to the left; a strut, a support or a joint joins the points of its two
ends at its place. Struts with the same `coefficients` are alike. Joints are exact: two points have one height, and
two bodies on a fifth wheel one roll.

```toml
kind = "rigid-bodies"
name = "A lorry with a cab on mounts, in its plane"

[[bodies]]
name = "frame"
mass = "7 t"
pitch_inertia_kg_m2 = 30e3

[[bodies]]
name = "cab"
mass_kg = 1100
pitch_inertia_kg_m2 = 900
position_m = [3.2, 0]

[[wheels]]
name = "front"
position_m = [2.4, 0]
mass_kg = 600
tyre_stiffness = "1.8 kN/mm"

[[wheels]]
name = "rear"
position_m = [-2.1, 0]
mass_kg = 1100
tyre_stiffness = "3.6 kN/mm"

[[suspensions]]
name = "front"
upper = "frame"

[[suspensions]]
name = "rear"
upper = "frame"

[[suspensions]]
name = "cab_front"
lower = "frame"
upper = "cab"
position_m = [3.9, 0]
coefficients = "mount"

[[suspensions]]
name = "cab_rear"
lower = "frame"
upper = "cab"
position_m = [2.5, 0]
coefficients = "mount"

[[points]]
name = "driver"
body = "cab"
position_m = [3.3, 0]

[struts]
front.spring = "420 N/mm"
front.damper_N_s_per_m = 15e3
rear.spring = "900 N/mm"
rear.damper_N_s_per_m = 20e3
mount.spring = "50 N/mm"
mount.damper_N_s_per_m = 4e3
```
"""
STUDIES = """A study is a problem with two further tables, `[present]` and `[search]`; `compare`, `optimum` and
`bode` take it by `--study`. `[present]` holds the present design, coefficients as in `[struts]`; those that it
leaves out are the vehicle's own. A problem without these tables is a study too.

```toml
title = "My car on a country road"
vehicle = "car.toml"
road = "C"
speed = "80 km/h"
measures = ["ACC", "SWS", "DTL"]
constraints = ["SWS <= 12mm"]

[bounds]
spring = ["10 kN/m", "60 kN/m"]
damper = ["0.5 kN s/m", "5 kN s/m"]

[present]
spring = "22 kN/m"
damper = "1.5 kN s/m"

[search]
populations = [200]
iterations = [50]
```
"""
SCATTER = """
Beside them stand deviations by name, as of `Scatter`: a number or a text for both sides, or an array of the least
and the largest one. A name is that of a coefficient or a parameter without its unit, or the end of several.

```toml
[scatter]
spring = "5 %"
damper = [-0.25, 0.1]
front_tyre_stiffness = 0.1
samples = 512
```
"""
LAYOUTS = """### `[strut]`, `[front_strut]`, `[rear_strut]`, `[suspensions.strut]`
A strut is elements between its two ends. Its `layout` joins them by name: `|` in parallel, `-` in series (before
`|`), parentheses, and an installation ratio of a group, `0.8*(...)`. An element has a table with its `kind` and
values; `spring`, `damper`, `inerter`, `rubber`, `bump_stop`, `rebound_stop` and `friction` are of the kind that
their name says and need none. Rates and deflections are positive in extension (rebound), forces in tension.

```toml
[front_strut]
layout = "spring | (damper - mount) | bump_stop"

[front_strut.damper]
kind = "table-damper"
velocity_m_per_s = [-1.0, -0.1, 0.0, 0.1, 1.0]
force_N = [-900, -400, 0, 600, 1500]

[front_strut.mount]
kind = "spring"
value = "250 N/mm"

[front_strut.bump_stop]
gap = "24 mm"
stiffness = "200 N/mm"
```

In place of the columns of a table stands `file = "damper.csv"`: a CSV file, beside the vehicle's file or below,
with units in its header, `velocity [mm/s],force [kN]`; or a property file of the supplier in TeimOrbit format,
`.dpr`, `.spr` or `.bum`, which needs no `kind`. A coefficient without a value here has one in `[struts]`, and any
may vary in `[bounds]`: `front.mount_N_per_m`, `front.damper.scale`, `front.bump_stop.gap_m`.
"""
FORMS = {
    float: "number", float | None: "number", bool: "true or false", str: "text",
    int: "whole number", int | None: "whole number",
    tuple[str, ...]: "array of texts", tuple[int, ...]: "array of whole numbers",
    tuple[float, float]: "array of 2 numbers", tuple[float, float] | None: "array of 2 numbers",
    tuple[float, ...]: "array of numbers", str | Mapping[str, Any]: "text or table",
    tuple[str, ...] | Mapping[str, Any]: "array of texts or table",
    **dict.fromkeys([Real, ArrayLike, ArrayLike | None], "array of numbers"),
}  # fmt: skip


class Row(NamedTuple):
    """A key of a table in a file."""

    key: str
    value: str
    unit: str
    default: str
    meaning: str


def rows(record: Any) -> Iterator[Row]:
    """Yield the keys of a dataclass, meanings from its docstring."""
    meanings = dict(parameters(record))
    for key in element_keys(record).values() if record in ELEMENTS.values() else keys_of(record).values():
        plain = key.required or key.default in (None, "", ()) or isinstance(key.default, Mapping)
        default = "" if plain else _shown(key)
        yield Row(key.key, form(key), key.unit, "required" if key.required else default, meanings[key.name])


def form(key: Key) -> str:
    """Return the kind of a value in words."""
    if key.own:
        return "table"
    if key.form in FORMS:
        return FORMS[key.form]
    return "array of tables" if key.rows or "tuple" in str(key.form) else "table"


def parameters(record: Any) -> Iterator[tuple[str, str]]:
    """Yield name and meaning of each parameter in a numpydoc docstring."""
    section = re.split(r"^(?:Parameters\n-+|\w+\n-+)$", inspect.getdoc(record) or "", flags=re.MULTILINE)[1]
    for names, text in re.findall(r"^(\w[\w, ]*) : .*\n((?:    .*\n?)+)", section, re.MULTILINE):
        for name in names.split(", "):
            yield name, " ".join(text.split())


def _shown(key: Key) -> str:
    default = key.default
    if key.own:
        return f'`layout = "{key.own.write(default)["layout"]}"`'.replace("|", r"\|")
    if key.kinds:
        return f'`kind = "{next(kind for kind, record in key.kinds.items() if isinstance(default, record))}"`'
    if isinstance(default, tuple):
        return f"[{', '.join(json.dumps(one) if isinstance(one, str) else f'{one:g}' for one in default)}]"
    if isinstance(default, bool):
        return str(default).lower()
    return f'"{default}"' if isinstance(default, str) else repr(default)


def table(title: str, record: Any) -> str:
    """Return the keys of a dataclass as a section."""
    grouped: dict[tuple[str, ...], list[str]] = {}
    for row in rows(record):
        grouped.setdefault(row[1:], []).append(f"`{row.key}`")
    cells = ["| keys | value | unit | default | meaning |", "|---|---|---|---|---|"]
    cells += [f"| {', '.join(keys)} | {' | '.join(rest)} |" for rest, keys in grouped.items()]
    return f"### {title}\n" + "\n".join(cells) + "\n"


def page() -> str:
    """Return the page."""
    parts = [HEAD, "## Vehicles\n"]
    parts += [table(f'`kind = "{kind}"`', record) for kind, record in VEHICLES.items()]
    parts += [RIGID_BODIES, *(table(f"`[[{name}]]`", record) for name, record in PARTS.items())]
    parts += [table("`[[contacts]]` of a plant", Contact)]
    parts += [table("Beside them, of every vehicle", VehicleDocument), table("`[[seats]]`", Seat)]
    parts += [table("`[flexible_body]`", FlexibleBody), table("`[[flexible_body.shapes]]`", Shape)]
    parts += [table("`[roll_geometry]`", RollGeometry), LAYOUTS]
    for kind, record in ELEMENTS.items():
        both = ' or `"rebound-stop"`' if kind == "bump-stop" else ""
        parts += [table(f'An element, `kind = "{kind}"`{both}', record)] if kind != "rebound-stop" else []
    parts.append(table("An element in a property file, with `file`", Mounting))
    parts += ["### `[struts]`, `[bounds]`" + STRUTS, "## Roads\n"]
    parts += [table(f'`kind = "{kind}"`', record) for kind, record in ROADS.items()]
    parts.append(table('`kind = "measured"` of a file, with `coherence` as above', MeasuredFile))
    parts += [table(f'`[coherence]`, `kind = "{kind}"`', record) for kind, record in COHERENCES.items()]
    parts.append(table('`[coherence]`, `kind = "tabulated"` of a CSV file', TabulatedFile))
    parts += ["## Problems\n", table("A problem", ProblemDocument), table("`[[cases]]`", CaseDocument)]
    parts += [table("`[scatter]`", ScatterKeys) + SCATTER]
    parts += ["## Studies\n", STUDIES, table("`[search]`", SearchSettings)]
    parts.append(table("`[[cases.payload]]`, also `[[payload]]` of a vehicle", Payload))
    parts += [table(f'`[events.<name>]`, `kind = "{kind}"`', record) for kind, record in EVENTS.items()]
    return "\n".join([*parts, table("Beside them, of all but a test rig", DriveKeys)])


if __name__ == "__main__":
    PAGE.write_text(page(), encoding="utf-8")
