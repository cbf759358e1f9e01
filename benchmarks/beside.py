"""The experiment of the paper and the campaign of its page, by this checkout and by another of this repository.

``python benchmarks/beside.py OTHER`` runs ``scripts/compare.py`` of both in turn, after a run of each that fills
numba's store, and prints a table: medians of wall-clock and processor time of whole processes, children included,
and the ratio to each. ``--campaign`` runs 31 seeds of five algorithms on two processes too, once. OTHER is a
folder, such as one by ``git worktree add --detach OTHER 3673b4d``. Both keep the reference front from one run to
the next: they are timed with it, and without it in rows of their own.
"""

import argparse
import os
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from tempfile import TemporaryDirectory
from time import perf_counter
from typing import Any

import pandas as pd

HERE = Path(__file__).resolve().parents[1]
ALGORITHMS = "nsga2,moead-dra,nsga2-gamultiobj,random,sobol"
BYTECODE = "PYTHONDONTWRITEBYTECODE"
"""Variable of the environment that is empty here: modules are translated by the first run alone."""
KEPT = "SUSPENSION_CTRL_CACHE"
"""Variable of the environment for the folder in which reference fronts are kept."""


def timed(checkout: Path, arguments: list[str], kept: Path) -> dict[str, float]:
    """Return wall-clock and processor time [s] of ``scripts/compare.py`` of a checkout in a folder of its own."""
    paths = {"PYTHONPATH": str(checkout / "src"), KEPT: str(kept), BYTECODE: ""}
    script = [sys.executable, str(checkout / "scripts" / "compare.py")]
    with TemporaryDirectory() as folder:
        before, begun = os.times(), perf_counter()
        settings: dict[str, Any] = {"cwd": folder, "env": os.environ | paths, "capture_output": True, "text": True}
        ended = subprocess.run([*script, *arguments], check=False, **settings)
        seconds, after = perf_counter() - begun, os.times()
    if ended.returncode:
        raise ValueError(f"{script[1]} must run, got: {ended.stderr.strip()[-200:]}")
    used = after.children_user + after.children_system - before.children_user - before.children_system
    return {"wall-clock [s]": seconds, "processor [s]": used}


def in_turn(other: Path, arguments: list[str], repeats: int, *, warm: bool = True) -> Iterator[dict[str, Any]]:
    """Yield a row per run: this checkout and the other, with a front that each kept, and without."""
    with TemporaryDirectory() as kept, TemporaryDirectory() as empty:
        sides = {"this": (HERE, kept), "other": (other, kept)}
        sides |= {f"{name}, nothing kept": (checkout, empty) for name, (checkout, _) in sides.items()}
        if warm:
            for checkout in (HERE, other):
                timed(checkout, arguments, Path(kept))
        for repeat in range(repeats):
            for name, (checkout, folder) in sides.items():
                own = Path(folder) / (f"{name} {repeat}" if folder == empty else "")
                yield {"side": name, "repeat": repeat, **timed(checkout, arguments, own)}


def compared(runs: pd.DataFrame) -> pd.DataFrame:
    """Return medians by side, and what this takes over each side."""
    medians = runs.drop(columns="repeat").groupby("side", sort=False).median()
    for kind in ("wall-clock", "processor"):
        times = medians[f"{kind} [s]"]
        medians[f"this / side, {kind}"] = times["this"] / times
    return medians


def main() -> None:
    """Print the tables."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("other", type=Path, help="folder of the other checkout")
    parser.add_argument("--repeats", type=int, default=3, help="runs of the experiment by each")
    parser.add_argument("--campaign", action="store_true", help="run the campaign too")
    parser.add_argument("--seeds", type=int, default=31, help="of the campaign")
    given = parser.parse_args()
    if not (given.other / "scripts" / "compare.py").is_file():
        parser.error(f"other must be a folder with scripts/compare.py, got {str(given.other)!r}")
    other = given.other.resolve()
    print(compared(pd.DataFrame(list(in_turn(other, [], given.repeats)))).to_markdown(floatfmt=".2f"), flush=True)
    if given.campaign:
        campaign = ["--quality", "--jobs", "2", "--algorithms", ALGORITHMS, "--seeds", str(given.seeds)]
        runs = pd.DataFrame(list(in_turn(other, campaign, 1, warm=False)))
        print("\n" + compared(runs).to_markdown(floatfmt=".2f"))


if __name__ == "__main__":
    main()
