"""Fuzzed files for every reader: whatever a file holds, it is read, or refused in a line for each mistake.

``python -m soak.fuzz 10000`` in the folder ``benchmarks`` prints a table of counts, of one reader with
``--readers "profile in ERD"``.
"""

import argparse
import sys
import tempfile
import time
import warnings
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import NamedTuple

import numpy as np

from suspension_ctrl import ProfileWarning
from suspension_ctrl.documents import FileError

from .readers import Reader, profiles_as_text, readers

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
    b"{", b"=", b"#", b"%", b"[" * 5000, b" " * 5000, b"a." * 400, b"../", b"\xef\xbb\xbf",
)  # fmt: skip


class Outcome(NamedTuple):
    """Counts of fuzzed files."""

    files: int
    read: int
    refused: int
    slowest: float  # processor time of a file [s]
    memory: float  # peak of the process beyond that before [MB]
    failures: tuple[str, ...]  # exceptions of other kinds, errors of several lines, files that took too long


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
        (Path(folder) / "good.csv").write_bytes(profiles_as_text()[0])
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
    known = readers()
    parser.add_argument("--readers", nargs="+", metavar="NAME", choices=known, default=list(known))
    options = parser.parse_args()
    outcomes = {name: fuzz(known[name], options.count, options.seed) for name in options.readers}
    print(table(outcomes))
    failures = [f"{name} {failure}" for name, o in outcomes.items() for failure in o.failures]
    print(*failures, sep="\n")
    sys.exit(bool(failures))


if __name__ == "__main__":
    main()
