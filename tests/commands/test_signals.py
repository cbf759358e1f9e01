"""Ctrl-C and SIGTERM end a command in one line and with the status of the signal: real processes, real signals."""

import os
import signal
import subprocess
import sys
import threading
import time
from pathlib import Path

import pytest

from suspension_ctrl.commands import signals

pytestmark = pytest.mark.skipif(os.name == "nt", reason="Windows sends no signals to processes")

PROGRAM = """
import sys, time
from pathlib import Path
from suspension_ctrl.commands import terminal

class Swallows:
    def __del__(self):  # an interrupt here cannot be raised
        Path("ready").touch()
        time.sleep(2)

def main(how: str):
    try:
        if how == "swallows":
            Swallows()
        Path("ready").touch()
        time.sleep(60)
    finally:
        if how == "slow":
            Path("closing").touch()
            time.sleep(60)
        Path("closed").touch()

terminal.run_script(main)
"""


@pytest.fixture(autouse=True)
def interruptible():
    """A job in the background of a shell ignores Ctrl-C, and with it all that it starts."""
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    yield
    signal.signal(signal.SIGINT, before)


def start(folder: Path, how: str, program: str = PROGRAM) -> subprocess.Popen:
    return subprocess.Popen([sys.executable, "-c", program, how], cwd=folder, stderr=subprocess.PIPE, text=True)


def wait_for(path: Path) -> None:
    while not path.exists():
        time.sleep(0.01)


@pytest.mark.parametrize(
    ("number", "how", "said"),
    [
        (signal.SIGINT, "sleeps", "error: interrupted\n"),
        (signal.SIGTERM, "sleeps", "error: terminated\n"),
        (signal.SIGINT, "swallows", "error: interrupted\n"),
    ],
)
def test_a_signal_lets_contexts_close_and_is_one_line(tmp_path, number, how, said):
    process = start(tmp_path, how)
    wait_for(tmp_path / "ready")
    process.send_signal(number)
    _, error = process.communicate(timeout=20)
    assert (process.returncode, error) == (128 + number, said)
    assert (tmp_path / "closed").exists()


def test_a_second_signal_does_not_wait_for_contexts(tmp_path):
    process = start(tmp_path, "slow")
    wait_for(tmp_path / "ready")
    process.send_signal(signal.SIGTERM)
    wait_for(tmp_path / "closing")
    process.send_signal(signal.SIGINT)
    _, error = process.communicate(timeout=20)
    assert (process.returncode, error) == (143, "error: terminated\n")
    assert not (tmp_path / "closed").exists()


def test_a_signal_during_imports_is_one_line(tmp_path):
    """A module of the same name, ahead on the path, stands for one that takes long to import."""
    (tmp_path / "typer.py").write_text(
        "from pathlib import Path; import time; Path('ready').touch(); time.sleep(60)"
    )
    program = "from suspension_ctrl.commands import main; main()"
    process = start(tmp_path, "--help", f"import sys; sys.path.insert(0, '.'); {program}")
    wait_for(tmp_path / "ready")
    process.send_signal(signal.SIGINT)
    _, error = process.communicate(timeout=20)
    assert (process.returncode, error) == (130, "error: interrupted\n")


def test_signals_that_a_process_ignores_stay_ignored(tmp_path):
    """As a shell has it for Ctrl-C of what runs in its background."""
    handlers = {number: signal.getsignal(number) for number in (signal.SIGINT, signal.SIGTERM)}
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    try:
        signals.end_at_once()
        assert signal.getsignal(signal.SIGINT) is signal.SIG_IGN
        assert signal.getsignal(signal.SIGTERM) is not handlers[signal.SIGTERM]
    finally:
        for number, handler in handlers.items():
            signal.signal(number, handler)


def test_another_thread_than_the_first_leaves_signals_alone():
    before = signal.getsignal(signal.SIGINT)
    thread = threading.Thread(target=signals.end_at_once)
    thread.start()
    thread.join()
    assert signal.getsignal(signal.SIGINT) is before
