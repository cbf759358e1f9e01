"""Files of a finished campaign, spoilt in many ways: each is named, and what it held is made again."""

import json
import os
import shutil
import warnings
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import numpy as np

from suspension_ctrl.study.store import SpoiltRunWarning

from . import campaign
from .counts import Counts

Spoil = Callable[[Path], object]


def _bytes(change: Callable[[bytes], bytes]) -> Spoil:
    return lambda path: path.write_bytes(change(path.read_bytes()))


def _replaced(put: Spoil) -> Spoil:
    def spoil(path: Path) -> None:
        path.unlink()
        put(path)

    return spoil


def _json(change: Callable[[dict[str, Any]], Any]) -> Spoil:
    return lambda path: path.write_bytes(json.dumps(change(json.loads(path.read_bytes()))).encode())


def _flipped(content: bytes) -> bytes:
    middle = len(content) // 2
    return content[:middle] + bytes([content[middle] ^ 1]) + content[middle + 1 :]


def _swapped(path: Path) -> None:
    other = next(one for one in sorted(path.parent.glob("*.csv")) if one.read_bytes() != path.read_bytes())
    path.write_bytes(other.read_bytes())


ANY: dict[str, Spoil] = {
    "empty": _bytes(lambda _: b""),
    "cut to half": _bytes(lambda content: content[: len(content) // 2]),
    "last bytes cut": _bytes(lambda content: content[:-3]),
    "a bit flipped": _bytes(_flipped),
    "zeros": _bytes(lambda content: bytes(len(content))),
    "zeros at the end": _bytes(lambda content: content[:-40] + bytes(40)),
    "noise": _bytes(lambda content: np.random.default_rng(0).bytes(len(content))),
    "a folder": _replaced(lambda path: path.mkdir()),
    "a pipe": _replaced(os.mkfifo),
    "a link to nothing": _replaced(lambda path: path.symlink_to("nowhere")),
    "a link to itself": _replaced(lambda path: path.symlink_to(path)),
    "a link to a device": _replaced(lambda path: path.symlink_to("/dev/zero")),
}
TABLE: dict[str, Spoil] = {
    "absent": Path.unlink,
    "a row cut": _bytes(lambda content: content[: content[:-1].rindex(b"\n") + 1]),
    "a row doubled": _bytes(lambda content: content + content[content[:-1].rindex(b"\n") + 1 :]),
    "a number changed": _bytes(
        lambda content: content[:-2] + (b"1" if content[-2:-1] != b"1" else b"2") + content[-1:]
    ),
    "another column": _bytes(lambda content: b"x" + content),
    "other line ends": _bytes(lambda content: content.replace(b"\n", b"\r\n")),
    "a header alone": _bytes(lambda content: content[: content.index(b"\n") + 1]),
    "a number missing": _bytes(lambda content: content[: content.rindex(b",") + 1] + b"nan\n"),
    "another encoding": _bytes(lambda content: content.decode().encode("utf-16")),
    "a byte order mark": _bytes(lambda content: b"\xef\xbb\xbf" + content),
    "of another run": _swapped,
}
RECORD: dict[str, Spoil] = {
    "absent": Path.unlink,
    "a list": _json(lambda record: [record]),
    "null": _json(lambda _: None),
    "not a number": _json(lambda record: record | {"runs": float("nan")}),
    "deep": lambda path: path.write_text("[" * 100_000, encoding="utf-8"),
    "another number of rows": _json(lambda record: record | {"runs": record["runs"] | {"rows": 7}}),
    "another digest": _json(lambda record: record | {"final": record["final"] | {"sha256": "0" * 64}}),
    "without a table": _json(lambda record: {"runs": record["runs"]}),
}
PLAN: dict[str, Spoil] = {
    "a list": _json(lambda plan: [plan]),
    "null": _json(lambda _: None),
    "not a number": _json(lambda plan: plan | {"seeds": float("nan")}),
    "deep": lambda path: path.write_text('{"a":' * 100_000, encoding="utf-8"),
    "of another study": _json(lambda plan: plan | {"seeds": 7}),
}
FILES: dict[str, dict[str, Spoil]] = {
    "quality/final/*sobol*.csv": ANY | TABLE,
    "timed/runs/*nsga2*.csv": ANY | TABLE,
    "quality/records/*.json": ANY | RECORD,
    "reference/final/front.csv": ANY | {name: spoil for name, spoil in TABLE.items() if spoil is not _swapped},
    "quality/plan.json": ANY | PLAN,
}


def kinds(some: int | None = None) -> Iterator[tuple[str, str, Spoil]]:
    """Yield files and ways to spoil them, every `some`-th alone if given."""
    every = [(pattern, name, spoil) for pattern, ways in FILES.items() for name, spoil in ways.items()]
    yield from every[::some]


def spoilt(folder: Path, some: int | None = None) -> Counts:
    """Spoil files of copies of a finished campaign, one at a time, and carry it out again."""
    counts = Counts("spoilt files")
    wanted = campaign.made(folder / "whole")
    for number, (pattern, name, spoil) in enumerate(kinds(some)):
        place = folder / f"spoilt{number}"
        shutil.copytree(folder / "whole", place)
        path = sorted(place.glob(pattern))[0]
        spoil(path)
        said, again = "", None
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always", SpoiltRunWarning)
            try:
                again = campaign.made(place)
            except ValueError as error:  # a plan is not made again: its runs cannot be told from others'
                said = str(error)
        said += " ".join(str(one.message) for one in caught)
        named = str(path) in said or path.stem in said
        whole = path.name == "plan.json" if again is None else again.equals(wanted)
        counts.judge(f"{path.relative_to(place)} {name}: {said}", unnamed=not named, differing=not whole)
        shutil.rmtree(place)
    return counts
