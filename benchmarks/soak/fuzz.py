"""Fuzzed files for every reader: whatever a file holds, it is read, or refused in a line for each mistake.

``python -m soak.fuzz 10000`` in the folder ``benchmarks`` prints a table of counts.
"""

import argparse
import sys
import tempfile
import time
import warnings
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import NamedTuple

import control
import numpy as np

from suspension_ctrl import (
    BumpStop,
    Iso8608Road,
    MeasuredRoad,
    Plant,
    ProfileWarning,
    TableDamper,
    TableSpring,
    datafiles,
    exposure_by_axis,
    international_roughness_index,
    load_property,
    load_system,
    load_vehicle,
    save_property,
    save_system,
)
from suspension_ctrl.commands.bode import read_designs
from suspension_ctrl.documents import FileError
from suspension_ctrl.paper import experiment
from suspension_ctrl.response.channels import channels_of
from suspension_ctrl.response.files import load_problem
from suspension_ctrl.response.history_files import read_accelerations
from suspension_ctrl.roads.files import load_road
from suspension_ctrl.roads.measured import COHERENCE, read_curve
from suspension_ctrl.roads.profile_files import load_profile, save_profile
from suspension_ctrl.tables import read_columns

MISTAKES = 21  # most lines of an error
SECONDS, MEGABYTES = 20.0, 500.0
"""Processor time for one file, and memory of all: more counts as a failure."""

NUMBERS = (
    b"0", b"-0.0", b"-1", b"1e-320", b"1e308", b"-1e308", b"1e400", b"nan", b"inf", b"1e12", b"2.5e6", b"1e-12",
    b"1_0", b"0x1F", b"0,5", b"1.2.3", b"true", b"''", b'"\\u202e"', b"[]", b"{}", b"[[1]]", b"1979-05-27",
    b"9" * 400, b"9" * 5000,
)  # fmt: skip
PIECES = (
    b"\x00", b"\xff", b"\x1b[31m", "\u202e".encode(), b"\r", b"\n", b"\t", b";", b",", b'"', b"'", b"[", b"]",
    b"{", b"=", b"#", b"%", b"[" * 5000, b"a." * 400, b"../", b"\xef\xbb\xbf",
)  # fmt: skip

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


class Outcome(NamedTuple):
    """Counts of fuzzed files."""

    files: int
    read: int
    refused: int
    slowest: float  # processor time of a file [s]
    memory: float  # peak of the process beyond that before [MB]
    failures: tuple[str, ...]  # exceptions of other kinds, errors of several lines, files that took too long


def readers() -> dict[str, Reader]:
    """Return the readers of all kinds of files by name, with shipped files and small ones made here."""
    problem = experiment.ride_problem()
    toml = {folder: _shipped(folder) for folder in ("vehicles", "roads", "studies")}
    measured = b'kind = "measured"\nfile = "good.csv"\n[coherence]\nkind = "constant"\nvalue = 0.5\n'
    header = "frequency [Hz],{0}/road real [m/m],{0}/road imag [m/m],{0}/strut real [m/N],{0}/strut imag [m/N]"
    plant = header.format("deflection").encode() + b"".join(b"\n%d,1,0,-0.001,0" % i for i in range(1, 60))
    curve = b"wavenumber [cycle/m],%s\n0.01,%s\n0.1,%s\n2,%s\n"
    bodies = tuple(text for text in toml["vehicles"] if b'kind = "rigid-bodies"' in text)
    profiles = _profiles()
    return {
        "vehicle": Reader(load_vehicle, ".toml", toml["vehicles"]),
        "vehicle of rigid bodies": Reader(load_vehicle, ".toml", bodies),
        "road": Reader(load_road, ".toml", (*toml["roads"], measured)),
        "problem": Reader(load_problem, ".toml", toml["studies"]),
        "plant": Reader(Plant.from_csv, ".csv", (plant,)),
        **_systems(),
        "measured channels": Reader(
            lambda path: channels_of(path, None),
            ".csv",
            (
                b"time [ms],distance [m],body_acceleration [g]\n" + b"".join(b"%d,0,0.1\n" % i for i in range(9)),
                b"frequency [Hz];body_acceleration [(m/s^2)^2/Hz]\n0,5;0,1\n1,5;0,2\n4;0,1\n",
            ),
        ),
        "profile": Reader(lambda path: international_roughness_index(load_profile(path)), ".csv", profiles),
        "profile in ERD": Reader(load_profile, ".erd", (ERD + b"0.001 0.002\n" * 200,)),
        "numbers of ERD": Reader(_read_numbers, ".bin", (np.linspace(0, 1, 400, dtype="<f4").tobytes(),)),
        "profile in OpenCRG": Reader(
            load_profile,
            ".crg",
            (
                CRG % b"LRFI" + b" 0.0010000 0.0020000 *missing*-0.0040000\n" * 200,
                CRG % b"KRBI" + np.linspace(0, 1, 800, dtype=">f4").tobytes(),
            ),
        ),
        "measured road": Reader(
            MeasuredRoad.from_csv, ".csv", (*profiles, curve % (b"psd [m^3]", b"1e-3", b"1e-5", b"1e-8"))
        ),
        "coherence": Reader(
            lambda path: read_curve(path, COHERENCE), ".csv", (curve % (b"coherence [-]", b"1", b"0.5", b"0"),)
        ),
        "designs": Reader(
            lambda path: read_designs(path, problem),
            ".csv",
            (b"name,spring [N/m],damper [N s/m]\nsoft,1e4,1e3\nhard,3e4,2e3\n",),
        ),
        "table of a damper": Reader(
            lambda path: read_columns(path, {"velocity": "m/s", "force": "N"}, 1000),
            ".csv",
            (b"# Source: here\nvelocity [mm/s],force [kN]\n-1000,-0.9\n-100,-0.4\n0,0\n100,0.6\n1000,1.5\n",),
        ),
        "history": Reader(lambda path: exposure_by_axis(*read_accelerations(path)), ".csv", _histories()),
        "history in RPC III": Reader(read_accelerations, ".rsp", _rpc_histories()),
        "property of a damper": Reader(load_property, ".dpr", _properties(".dpr")),
        "property of a spring": Reader(
            lambda path: load_property(path, static_load=4e3), ".spr", _properties(".spr")
        ),
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


def _profiles() -> tuple[bytes, ...]:
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


def mutated(seeds: Sequence[bytes], rng: np.random.Generator) -> bytes:
    """Return a file with something wrong in it, most often made of one of the seeds."""
    text = _one(seeds, rng)
    match rng.integers(7):
        case 0:
            return rng.bytes(int(rng.integers(400)))
        case 1:
            return text[: rng.integers(len(text))]
        case 2:
            return _changed(text, rng, lambda: rng.bytes(1))
        case 3:
            return _changed(text, rng, lambda: _one(PIECES, rng))
        case 4:
            return _renumbered(text, rng)
        case 5:
            lines = text.splitlines(keepends=True)
            return b"".join(lines[i] for i in rng.integers(len(lines), size=len(lines)))
        case _:
            other = _one(seeds, rng)
            return text[: rng.integers(len(text))] + other[rng.integers(len(other)) :]


def _one(choices: Sequence[bytes], rng: np.random.Generator) -> bytes:
    return choices[int(rng.integers(len(choices)))]


def _changed(text: bytes, rng: np.random.Generator, piece: Callable[[], bytes]) -> bytes:
    """Return the text with pieces in place of some bytes."""
    for place in rng.integers(len(text), size=rng.integers(1, 5)):
        text = text[:place] + piece() + text[place + 1 :]
    return text


def _renumbered(text: bytes, rng: np.random.Generator) -> bytes:
    """Return the text with odd values in place of some words."""
    words = text.split(b" ") if rng.random() < 0.5 else text.split(b",")
    for place in rng.integers(len(words), size=rng.integers(1, 4)):
        end = words[place][len(words[place].rstrip()) :]
        words[place] = _one(NUMBERS, rng) + end
    return (b" " if b" ".join(words).count(b" ") == text.count(b" ") else b",").join(words)


def fuzz(reader: Reader, count: int, seed: int = 0) -> Outcome:
    """Hand `count` files to a reader and count what happens."""
    rng, before = np.random.default_rng(seed), _peak()
    read, refused, slowest, failures = 0, 0, 0.0, []
    with tempfile.TemporaryDirectory() as folder, warnings.catch_warnings():
        warnings.simplefilter("error")
        warnings.simplefilter("ignore", ProfileWarning)
        (Path(folder) / "good.csv").write_bytes(_profiles()[0])
        path = Path(folder) / f"fuzz{reader.suffix}"
        for number in range(count):
            path.write_bytes(mutated(reader.seeds, rng))
            began = time.process_time()
            try:
                reader.read(path)
                read += 1
            except (ValueError, OSError) as error:
                refused += 1
                lines = str(error).split("\n") if isinstance(error, FileError) else [str(error)]
                if not all(line.isprintable() for line in lines) or len(lines) > MISTAKES:
                    failures.append(f"{number}: {str(error)!r}")
            except BaseException as error:  # of any kind: that is looked for
                failures.append(f"{number}: {error!r}")
            slowest = max(slowest, time.process_time() - began)
    if slowest > SECONDS:
        failures.append(f"{slowest:.1f} s of processor time for one file")
    if (memory := _peak() - before) > MEGABYTES:
        failures.append(f"{memory:.0f} MB of memory")
    return Outcome(count, read, refused, slowest, memory, tuple(failures))


def _peak() -> float:
    """Return the peak of this process's memory [MB], 0 where the system does not tell."""
    try:
        from resource import RUSAGE_SELF, getrusage
    except ImportError:
        return 0.0
    return getrusage(RUSAGE_SELF).ru_maxrss / (1e6 if sys.platform == "darwin" else 1e3)


def table(outcomes: Mapping[str, Outcome]) -> str:
    """Return a Markdown table of the counts."""
    head = (
        "| reader | files | read | refused | failures | slowest [s] | memory [MB] |\n|---|---|---|---|---|---|---|"
    )
    rows = (
        f"| {name} | {o.files} | {o.read} | {o.refused} | {len(o.failures)} | {o.slowest:.2f} | {o.memory:.0f} |"
        for name, o in outcomes.items()
    )
    return "\n".join([head, *rows])


def main() -> None:
    """Fuzz all readers and print the table, then the failures; exit status 1 if there is one."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("count", type=int, help="files per reader")
    parser.add_argument("--seed", type=int, default=0)
    options = parser.parse_args()
    outcomes = {name: fuzz(reader, options.count, options.seed) for name, reader in readers().items()}
    print(table(outcomes))
    failures = [f"{name} {failure}" for name, o in outcomes.items() for failure in o.failures]
    print(*failures, sep="\n")
    sys.exit(bool(failures))


if __name__ == "__main__":
    main()
