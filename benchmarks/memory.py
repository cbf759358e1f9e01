"""Peaks of memory and processor time of the readers of large files, each in a process of its own.

``python memory.py`` in the folder ``benchmarks`` makes files of 99 MB (the limit is 100 MB) and prints a table.
Peaks are `VmHWM` of Linux beyond that after a small file of the same kind.
"""

import argparse
import subprocess
import sys
import tempfile
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import NamedTuple

import numpy as np

from soak.readers import CRG, ERD

MEGABYTES = 99.0
_POINTS = 1000  # of the profile that is repeated
_SMALL = 0.1  # MB

PROGRAM = """
import sys, time
from suspension_ctrl.response.history_files import read_accelerations
from suspension_ctrl.roads.profile_files import load_profile

def peak():
    with open("/proc/self/status", encoding="ascii") as status:
        return next(int(line.split()[1]) for line in status if line.startswith("VmHWM")) / 1e3

_, reader, small, large = sys.argv
read = {"profile": load_profile, "history": read_accelerations}[reader]
read(small)
before, began = peak(), time.process_time()
read(large)
print(peak() - before, time.process_time() - began)
"""


class Kind(NamedTuple):
    """A kind of file: ending, reader, and a function that writes one of so many megabytes to a path."""

    ending: str
    reader: str  # profile or history
    write: Callable[[Path, float], None]


class Peak(NamedTuple):
    """What reading a file takes."""

    size: float  # of the file [MB]
    memory: float  # [MB]
    seconds: float


def kinds() -> dict[str, Kind]:
    """Return the kinds of files by name."""
    return {
        "profile, CSV": Kind(".csv", "profile", _csv("distance [m],height [m]", "{:.2f},{:.5f}", 0.05)),
        "profile, ERD text": Kind(".erd", "profile", lambda path, size: _erd(path, size, 5)),
        "profile, ERD binary": Kind(".erd", "profile", lambda path, size: _erd(path, size, 1)),
        "surface, OpenCRG text": Kind(".crg", "profile", lambda path, size: _crg(path, size, "LRFI")),
        "surface, OpenCRG binary": Kind(".crg", "profile", lambda path, size: _crg(path, size, "KRBI")),
        "history, CSV": Kind(".csv", "history", _csv("time [s],z [m/s^2]", "{:.3f},{:.5f}", 0.005)),
        "history, RPC III numbers": Kind(".rsp", "history", lambda path, size: _rpc(path, size, float)),
        "history, RPC III integers": Kind(".rsp", "history", lambda path, size: _rpc(path, size, int)),
    }


def measured(kind: Kind, megabytes: float) -> Peak:
    """Return what a file of a size takes."""
    with tempfile.TemporaryDirectory() as folder:
        small, large = (Path(folder) / f"{name}{kind.ending}" for name in ("small", "large"))
        kind.write(small, _SMALL)
        kind.write(large, megabytes)
        size = sum(path.stat().st_size for path in Path(folder).glob("large.*")) / 1e6
        command = [sys.executable, "-W", "ignore", "-c", PROGRAM, kind.reader, str(small), str(large)]
        done = subprocess.run(command, capture_output=True, text=True, check=True)
    return Peak(size, *map(float, done.stdout.split()))


def table(peaks: dict[str, Peak]) -> str:
    """Return a Markdown table of peaks by name."""
    rows = (f"| {name} | {p.size:.0f} | {p.memory:.0f} | {p.seconds:.1f} |" for name, p in peaks.items())
    return "\n".join(["| file | size [MB] | memory [MB] | processor time [s] |", "|---|---|---|---|", *rows])


def _csv(header: str, row: str, step: float) -> Callable[[Path, float], None]:
    """Return a writer of tables of an ascending column and one of waves."""

    def write(path: Path, megabytes: float) -> None:
        waves, left = _waves().tolist(), megabytes * 1e6
        with path.open("w", encoding="utf-8") as file:
            for start in _starts():
                text = "".join(f"{row}\n".format(step * (start + i), one) for i, one in enumerate(waves))
                left -= file.write(text if start else f"{header}\n{text}")
                if left < len(text):
                    return

    return write


def _starts() -> Iterator[int]:
    """Yield the numbers of the first rows of pieces."""
    start = 0
    while True:
        yield start
        start += _POINTS


def _erd(path: Path, megabytes: float, code: int) -> None:
    """Write text, or a header beside numbers."""
    header = ERD.replace(b"2, 200, -1, 8, 5", b"2, -1, -1, 8, %d" % code)
    waves = np.column_stack([_waves(), _waves()])
    if code == 1:
        path.write_bytes(header)
        _repeated(path.with_suffix(".bin"), megabytes, b"", waves.astype("<f4").tobytes())
    else:
        lines = b"".join(b"%.6f %.6f\n" % (left, right) for left, right in waves.tolist())
        _repeated(path, megabytes, header, lines)


def _crg(path: Path, megabytes: float, form: str) -> None:
    """Write a surface of three tracks beside the banking."""
    rows = np.tile(_waves()[:, None], (1, 4))
    rows[:, 0] = 0.0
    cells = rows.astype(">f4").tobytes()
    if form == "LRFI":
        cells = b"".join(b"%10.6f%10.6f%10.6f%10.6f\n" % tuple(row) for row in rows.tolist())
    _repeated(path, megabytes, CRG % form.encode(), cells)


def _rpc(path: Path, megabytes: float, kind: type) -> None:
    """Write a history of four channels, of four bytes each for numbers and two for integers."""
    from rpc3 import rpc3

    count = int(megabytes * 1e6 / (16 if kind is float else 8))
    waves = np.resize(_waves(), count)
    channels = [rpc3.Channel(f"{point} z", "m/s^2", 0.005, waves) for point in ("seat", "floor", "back", "feet")]
    rpc3.write(str(path), channels, datatype=kind, overwrite=True)


def _repeated(path: Path, megabytes: float, header: bytes, piece: bytes) -> None:
    with path.open("wb") as file:
        file.write(header)
        for _ in range(max(1, int((megabytes * 1e6 - len(header)) / len(piece)))):
            file.write(piece)


def _waves() -> np.ndarray:
    """Return numbers (n,) of up to 0.01."""
    return 0.01 * np.sin(np.arange(_POINTS) * 0.37)


def main() -> None:
    """Print the table."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("megabytes", type=float, nargs="?", default=MEGABYTES)
    size = parser.parse_args().megabytes
    print(table({name: measured(kind, size) for name, kind in kinds().items()}))


if __name__ == "__main__":
    main()
