"""Readers of every kind of file that the package reads, and good files to begin with.

They are the shipped files, and small ones made here, also those of other programs.
"""

import tempfile
from collections.abc import Callable
from functools import partial
from pathlib import Path
from typing import NamedTuple

import control
import numpy as np

from suspension_ctrl import (
    BumpStop,
    Iso8608Road,
    MeasuredRoad,
    Plant,
    TableDamper,
    TableSpring,
    datafiles,
    exposure_by_axis,
    international_roughness_index,
    load_property,
    load_study,
    load_system,
    load_vehicle,
    save_property,
    save_system,
)
from suspension_ctrl.commands.bode import read_designs
from suspension_ctrl.paper import experiment
from suspension_ctrl.response.channels import channels_of
from suspension_ctrl.response.files import load_problem
from suspension_ctrl.response.history_files import read_accelerations
from suspension_ctrl.roads.files import load_road
from suspension_ctrl.roads.measured import COHERENCE, read_curve
from suspension_ctrl.roads.profile_files import load_profile, save_profile
from suspension_ctrl.tables import read_columns

ERD = b"""ERDFILEV2.00
 2, 200, -1, 8, 5, 0.25, -1,
XUNITS  m
SHORTNAMLElev.  RElev.
UNITSNAMm       in
END
"""
CRG = b"""$CT
A road
$
$ROAD_CRG
REFERENCE_LINE_INCREMENT = 0.25
LONG_SECTION_V_RIGHT = -0.75
LONG_SECTION_V_INCREMENT = 0.75
$
$KD_DEFINITION
#:%s
D:reference line banking,m/m
D:long section 1,m
D:long section 2,m
D:long section 3,m
$
$$$$
"""
"""Headers of small files of a profile."""


class Reader(NamedTuple):
    """A reader of files of an ending, and good files to begin with."""

    read: Callable[[Path], object]
    suffix: str
    seeds: tuple[bytes, ...]


def readers() -> dict[str, Reader]:
    """Return the readers of all kinds of files by name."""
    return {**_documents(), **_systems(), **_roads(), **_tables(), **_recordings(), **_parts()}


def _documents() -> dict[str, Reader]:
    """Return readers of TOML files."""
    vehicles, roads, studies = map(_shipped, ("vehicles", "roads", "studies"))
    templates = _shipped("templates")
    bodies = tuple(text for text in vehicles if b'kind = "rigid-bodies"' in text)
    measured = b'kind = "measured"\nfile = "good.csv"\n[coherence]\nkind = "constant"\nvalue = 0.5\n'
    return {
        "vehicle": Reader(load_vehicle, ".toml", vehicles),
        "vehicle of rigid bodies": Reader(load_vehicle, ".toml", bodies),
        "road": Reader(load_road, ".toml", (*roads, measured)),
        "problem": Reader(load_problem, ".toml", studies),
        "study": Reader(load_study, ".toml", (*templates, *studies)),
    }


def _roads() -> dict[str, Reader]:
    """Return readers of profiles, spectra and coherences."""
    profiles = profiles_as_text()
    curve = b"wavenumber [cycle/m],%s\n0.01,%s\n0.1,%s\n2,%s\n"
    spectrum = curve % (b"psd [m^3]", b"1e-3", b"1e-5", b"1e-8")
    coherence = curve % (b"coherence [-]", b"1", b"0.5", b"0")
    surfaces = (
        CRG % b"LRFI" + b" 0.0010000 0.0020000 *missing*-0.0040000\n" * 200,
        CRG % b"KRBI" + np.linspace(0, 1, 800, dtype=">f4").tobytes(),
    )
    return {
        "profile": Reader(lambda path: international_roughness_index(load_profile(path)), ".csv", profiles),
        "profile in ERD": Reader(load_profile, ".erd", (ERD + b"0.001 0.002\n" * 200,)),
        "numbers of ERD": Reader(_read_numbers, ".bin", (np.linspace(0, 1, 400, dtype="<f4").tobytes(),)),
        "profile in OpenCRG": Reader(load_profile, ".crg", surfaces),
        "measured road": Reader(MeasuredRoad.from_csv, ".csv", (*profiles, spectrum)),
        "coherence": Reader(lambda path: read_curve(path, COHERENCE), ".csv", (coherence,)),
    }


def _tables() -> dict[str, Reader]:
    """Return readers of CSV files of a plant, of designs and of a damper."""
    problem = experiment.ride_problem()
    header = "frequency [Hz],{0}/road real [m/m],{0}/road imag [m/m],{0}/strut real [m/N],{0}/strut imag [m/N]"
    plant = header.format("deflection").encode() + b"".join(b"\n%d,1,0,-0.001,0" % i for i in range(1, 60))
    designs = b"name,spring [N/m],damper [N s/m]\nsoft,1e4,1e3\nhard,3e4,2e3\n"
    damper = b"# Source: here\nvelocity [mm/s],force [kN]\n-1000,-0.9\n-100,-0.4\n0,0\n100,0.6\n1000,1.5\n"
    units = {"velocity": "m/s", "force": "N"}
    return {
        "plant": Reader(Plant.from_csv, ".csv", (plant,)),
        "designs": Reader(lambda path: read_designs(path, problem), ".csv", (designs,)),
        "table of a damper": Reader(lambda path: read_columns(path, units, 1000), ".csv", (damper,)),
    }


def _recordings() -> dict[str, Reader]:
    """Return readers of measured histories and spectra."""
    channels = (
        b"time [ms],distance [m],body_acceleration [g]\n" + b"".join(b"%d,0,0.1\n" % i for i in range(9)),
        b"frequency [Hz];body_acceleration [(m/s^2)^2/Hz]\n0,5;0,1\n1,5;0,2\n4;0,1\n",
    )
    return {
        "measured channels": Reader(lambda path: channels_of(path, None), ".csv", channels),
        "history": Reader(lambda path: exposure_by_axis(*read_accelerations(path)), ".csv", _histories()),
        "history in RPC III": Reader(read_accelerations, ".rsp", _rpc_histories()),
    }


def _parts() -> dict[str, Reader]:
    """Return readers of property files of parts."""
    load_spring = partial(load_property, static_load=4e3)
    return {
        "property of a damper": Reader(load_property, ".dpr", _properties(".dpr")),
        "property of a spring": Reader(load_spring, ".spr", _properties(".spr")),
        "property of a stop": Reader(load_property, ".bum", _properties(".bum")),
    }


def _read_numbers(path: Path) -> object:
    """Read a binary file beside the header of an ERD file."""
    header = path.with_suffix(".erd")
    header.write_bytes(ERD.replace(b"5, 0.25", b"1, 0.25"))
    return load_profile(header)


def _shipped(folder: str) -> tuple[bytes, ...]:
    return tuple(datafiles.path(f"{folder}/{stem}.toml").read_bytes() for stem in datafiles.stems(folder))


def _properties(ending: str) -> tuple[bytes, ...]:
    """Return a property file of an element, in two spellings."""
    force = [-900.0, -400.0, 0.0, 600.0, 1500.0]
    elements: dict[str, TableDamper | TableSpring | BumpStop] = {
        ".dpr": TableDamper(velocity=[-1.0, -0.1, 0.0, 0.1, 1.0], force=force),
        ".spr": TableSpring(deflection=[-0.08, -0.04, 0.0, 0.04, 0.08], force=force),
        ".bum": BumpStop(compression=[0.0, 0.01, 0.02], force=force[2:]),
    }
    mounting = {"installed_length": 0.2, "static_load": 4e3} if ending == ".spr" else {}
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / f"file{ending}"
        save_property(path, elements[ending], **mounting)
        text = path.read_bytes()
    return text, b"$ \xfc ! a comment\r\n" + text.replace(b"\n", b"\r\n")


def _systems() -> dict[str, Reader]:
    """Return readers of a quarter car's plant in files of other programs, and of a vehicle file that names one."""
    system = load_vehicle("yuen_ramli_2010").vehicle.plant()
    with tempfile.TemporaryDirectory() as folder:
        for ending in (".mat", ".npz", ".a"):
            save_system(Path(folder) / f"good{ending}", system)
        _write_universal(Path(folder) / "good.uff", system)
        good = {path.suffix: path.read_bytes() for path in Path(folder).iterdir()}

    def beside(path: Path) -> Path:
        """Return a path that has the files of the system beside it."""
        for ending, content in good.items():
            for stem in {"good", path.stem}:
                if (other := path.with_name(stem + ending)) != path:
                    other.write_bytes(content)
        return path

    toml = (
        b'kind = "plant"\nfile = "good.npz"\n[included]\nspring = "1 kN/m"\n'
        b"[bounds]\ndamper_N_s_per_m = [500, 4000]\n",
        b'kind = "plant"\nfile = "good.a"\ninputs = ["front_road [mm]", "-front_strut [kN]"]\n'
        b'outputs = ["body_acceleration [g]", "", "", "front_deflection [m]", ""]\n'
        b'[[contacts]]\nwheel = "front"\nposition_m = [1, 0]\n',
    )
    return {
        "MATLAB's matrices": Reader(load_system, ".mat", (good[".mat"],)),
        "NumPy's matrices": Reader(load_system, ".npz", (good[".npz"],)),
        "matrices as text": Reader(lambda path: load_system(beside(path)), ".a", (good[".a"],)),
        "Universal File": Reader(load_system, ".uff", (good[".uff"],)),
        "vehicle file of a plant": Reader(lambda path: load_vehicle(beside(path)), ".toml", toml),
    }


def _write_universal(path: Path, system: control.StateSpace) -> None:
    """Write the deflection by road and strut of a quarter car as datasets 58."""
    import pyuff

    f = np.arange(1, 41) * 0.5
    sets = [
        pyuff.prepare_58(
            binary=0, func_type=4, rsp_node=3, rsp_dir=3, ref_node=node, ref_dir=3, id1="a rig", x=f,
            data=system.frequency_response(2 * np.pi * f)["deflection", name].frdata.ravel(), abscissa_spacing=1,
            abscissa_min=0.5, abscissa_inc=0.5, rsp_ent_name="NONE", ref_ent_name="NONE",
            ordinate_spec_data_type=8, orddenom_spec_data_type=8, z_axis_spec_data_type=0,
        )
        for node, name in enumerate(system.input_labels, start=1)
    ]  # fmt: skip
    pyuff.UFF(str(path)).write_sets(sets, "overwrite")


def profiles_as_text() -> tuple[bytes, ...]:
    """One profile in five spellings."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "profile.csv"
        save_profile(path, Iso8608Road("C").profile(75.0, 0.25, seed=1))
        text = path.read_bytes()
    rows = text.partition(b"\n")[2]
    semicolons = text.replace(b",", b";").replace(b".", b",")
    return (
        text,
        semicolons,
        text.replace(b",", b"\t"),
        rows.replace(b",", b" "),
        b"% made\n" + text.replace(b"\n", b",\n"),
    )


def _histories() -> tuple[bytes, ...]:
    """Return a second of acceleration in two spellings."""
    rows = [(0.008 * i, 0.1 * (i % 7), 1 + 0.01 * (i % 5)) for i in range(130)]
    text = "time [s],x [m/s^2],seat z [g]\n" + "".join(f"{t:.3f},{x:.2f},{z:.2f}\n" for t, x, z in rows)
    other = "# made\nTime (ms);Z (g);note\n" + "".join(f"{1e3 * t:.1f};{z:.2f};ok\n" for t, _, z in rows)
    return text.encode(), other.replace(".", ",").encode()


def _rpc_histories() -> tuple[bytes, ...]:
    """Return a second of acceleration in numbers and in integers."""
    from rpc3 import rpc3

    signals = {"x": "m/s^2", "seat z": "g"}
    channels = [rpc3.Channel(name, unit, 0.008, np.sin(np.arange(130.0))) for name, unit in signals.items()]
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "history.rsp"
        content = []
        for kind in (float, int):
            rpc3.write(str(path), channels, datatype=kind, pts_per_group=64, overwrite=True)
            content.append(path.read_bytes())
    return tuple(content)
