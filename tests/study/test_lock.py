"""Results folders held by one process, cleaned of old unfinished files alone."""

import json
import os
import signal
import subprocess
import sys
import time

import pytest

from suspension_ctrl.study import lock
from suspension_ctrl.tables.atomic import UNFINISHED

HOLDER = """
import sys, time
from pathlib import Path
from suspension_ctrl.study import lock
held = lock.hold(Path(sys.argv[1]))
print("held", flush=True)
time.sleep(60)
"""


def test_a_lock_ends_with_its_process_however_that_ends(tmp_path):
    holder = subprocess.Popen([sys.executable, "-c", HOLDER, str(tmp_path)], stdout=subprocess.PIPE, text=True)
    assert holder.stdout.readline() == "held\n"
    with pytest.raises(BlockingIOError, match=rf"is in use by process {holder.pid} on \S+ since 20\d\d-"):
        lock.hold(tmp_path)
    os.kill(holder.pid, getattr(signal, "SIGKILL", signal.SIGTERM))
    holder.wait()
    holder.stdout.close()
    held = lock.hold(tmp_path)
    note = json.loads((tmp_path / lock.HOLDER).read_text())
    assert note["process"] == os.getpid()
    del held
    assert not (tmp_path / lock.HOLDER).exists()


def test_old_unfinished_files_are_removed_in_all_of_the_folder_and_no_others(tmp_path):
    deep = tmp_path / "quality" / "runs"
    deep.mkdir(parents=True)
    old, young, other = deep / f"{UNFINISHED}1.csv", tmp_path / f"{UNFINISHED}2.csv", deep / ".mine"
    for path in (old, young, other):
        path.touch()
    for path in (old, other):
        os.utime(path, (0, time.time() - 2 * lock.OLD))
    lock.hold(tmp_path)
    assert [path.exists() for path in (old, young, other)] == [False, True, True]


def test_a_spoilt_note_of_the_holder_is_no_error(tmp_path):
    holder = subprocess.Popen([sys.executable, "-c", HOLDER, str(tmp_path)], stdout=subprocess.PIPE, text=True)
    assert holder.stdout.readline() == "held\n"
    (tmp_path / lock.HOLDER).write_text("[1]")
    with pytest.raises(BlockingIOError, match=r"is in use by another process$"):
        lock.hold(tmp_path)
    holder.kill()
    holder.communicate()


def test_what_is_set_aside_replaces_nothing(tmp_path):
    for _ in range(3):
        (tmp_path / "a").touch()
        lock.set_aside(tmp_path / "a")
    lock.set_aside(tmp_path / "a")
    assert sorted(path.name for path in tmp_path.iterdir()) == ["a.spoilt", "a.spoilt1", "a.spoilt2"]
