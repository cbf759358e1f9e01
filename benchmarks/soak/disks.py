"""Full disks, and two processes on one folder."""

import os
import signal
import subprocess
import sys
from pathlib import Path

from . import campaign
from .counts import Counts

WRITER = """
import sys, time
from pathlib import Path
import pandas as pd
from suspension_ctrl.study.store import FolderStore, StoredRun
folder, name, runs = Path(sys.argv[1]), sys.argv[2], int(sys.argv[3])
told = folder.with_name("told")
run = StoredRun(pd.DataFrame({"evaluations": range(20)}), pd.DataFrame({"f1": [0.5] * 20}))
refused = failed = 0
end = time.monotonic() + 60
while True:
    try:
        store = FolderStore(folder, {"plan": 1})
        break
    except BlockingIOError as error:
        if "is in use by process" in str(error):
            refused += 1
            told.touch()
        time.sleep(0.05)
for number in range(runs):
    try:
        store[f"{name}{number}"] = run
    except Exception:
        failed += 1
while not (told.exists() or time.monotonic() > end):  # a machine under load may start the other one late
    time.sleep(0.05)
print(refused, failed, flush=True)
"""


def two_writers(folder: Path, writes: int) -> Counts:
    """Let two processes write runs to one folder at a time: one of them waits, none fails."""
    counts = Counts(f"two processes, {writes:,} writes to one folder")
    command = [sys.executable, "-c", WRITER, str(folder / "shared")]
    both = [
        subprocess.Popen([*command, name, str(writes // 2)], stdout=subprocess.PIPE, text=True) for name in "ab"
    ]
    refused, failed = zip(
        *(map(int, process.communicate(timeout=600)[0].split()) for process in both), strict=True
    )
    stored = len(list((folder / "shared" / "records").glob("*.json")))
    counts.judge("writes", lost=writes // 2 * 2 - stored, differing=sum(failed), unnamed=not any(refused))
    return counts


def full(folder: Path, *, mounted: bool, sizes: int = 2) -> list[Counts]:
    """Fill the disk of a campaign at several sizes, then make room: one line says where and how to go on."""
    undisturbed = folder / "roomy"
    undisturbed.mkdir(parents=True)
    campaign.finish(undisturbed)
    wanted = campaign.table_of(undisturbed)
    largest = max(path.stat().st_size for path in (undisturbed / campaign.RESULTS).rglob("*.csv"))
    rows = [_limited(folder, wanted, [largest // 2, largest - 1][:sizes])]
    return [*rows, _mounted(folder, wanted, [60, 120, 240])] if mounted else rows


def _limited(folder: Path, wanted: bytes, sizes: list[int]) -> Counts:
    """Limit the size of a file: writing fails as on a full disk."""
    import resource

    counts = Counts("full disk, by a limit of file size")
    for size in sizes:
        place = folder / f"limited{size}"
        place.mkdir()

        def limit(size: int = size) -> None:
            signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
            resource.setrlimit(resource.RLIMIT_FSIZE, (size, resource.RLIM_INFINITY))

        _judge(counts, place, campaign.finish(place, preexec_fn=limit), wanted, f"{size} bytes")
    return counts


def _mounted(folder: Path, wanted: bytes, sizes: list[int]) -> Counts:
    """Mount a small file system in memory, which takes root, and enlarge it."""
    counts = Counts("full disk, a small file system")
    for size in sizes:
        place = folder / f"mounted{size}"
        place.mkdir()
        subprocess.run(["mount", "-t", "tmpfs", "-o", f"size={size}k", "tmpfs", place], check=True)
        try:
            ended = campaign.finish(place)
            subprocess.run(["mount", "-o", "remount,size=50M", place], check=True)
            _judge(counts, place, ended, wanted, f"{size} kB")
        finally:
            subprocess.run(["umount", place], check=True)
    return counts


def _judge(counts: Counts, place: Path, ended: tuple[int, str], wanted: bytes, what: str) -> None:
    status, error = ended
    said = status == 1 and error.count("\n") == 1 and str(place) in error and "finished runs are kept" in error
    before, left = campaign.records(place), len(campaign.left_over(place))
    again = campaign.finish(place)
    repeated = sum(campaign.records(place)[path] != moment for path, moment in before.items())
    differs = again[0] != 0 or campaign.table_of(place) != wanted
    counts.judge(f"{what}: {error!r}, {again}", unnamed=not said, repeated=repeated, differing=differs, left=left)


def may_mount() -> bool:
    """Whether this process may mount a file system, by trying it."""
    if not hasattr(os, "geteuid") or os.geteuid() != 0:
        return False
    try:
        found = subprocess.run(["unshare", "-m", "mount", "-t", "tmpfs", "tmpfs", "/mnt"], capture_output=True)
    except OSError:
        return False
    return found.returncode == 0
