"""Fixtures shared by the tests: the paper's problem, and where the checkout is."""

import gc
import os
import signal
import subprocess
import sys
import warnings
from collections.abc import Callable, Sequence
from pathlib import Path

import pytest
from hypothesis import settings
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.backends.backend_pdf import FigureCanvasPdf
from matplotlib.figure import Figure

from suspension_ctrl import RideProblem, commands
from suspension_ctrl.commands import drawing
from suspension_ctrl.paper import experiment as paper

Script = Callable[..., subprocess.CompletedProcess]

os.environ["SUSPENSION_CTRL_CACHE"] = ""  # tests take no reference front that other commands have kept

# Examples are drawn from a fixed stream, so that a failure can be had again; timings of examples say nothing here.
settings.register_profile("suspension_ctrl", deadline=None, derandomize=True, max_examples=50)
settings.load_profile("suspension_ctrl")


# All that is imported and collected is there to the end: the garbage collector need not look through it.
def pytest_configure() -> None:
    gc.disable()


def pytest_collection_finish() -> None:
    gc.freeze()
    gc.enable()


@pytest.fixture(scope="session")
def checkout() -> Path:
    return Path(__file__).parents[1]


@pytest.fixture(scope="session")
def table1_problem() -> RideProblem:
    return paper.ride_problem()


@pytest.fixture(scope="session")
def script(checkout: Path, tmp_path_factory) -> Script:
    """Run a script of the project as its user does, in a folder of its own."""

    def run(
        name: str, *arguments: object, cwd: Path | None = None, warnings: str = "error"
    ) -> subprocess.CompletedProcess:
        command = [sys.executable, str(next(checkout.glob(f"*/{name}.py"))), *map(str, arguments)]
        folder = cwd or tmp_path_factory.mktemp(name)
        return subprocess.run(
            command, capture_output=True, text=True, cwd=folder, env=os.environ | {"PYTHONWARNINGS": warnings}
        )

    return run


@pytest.fixture
def called(monkeypatch, capsys, tmp_path, request) -> Script:
    """Run a script of the project in this process, which saves seconds of imports, in the test's folder.

    Figures are made here and not rendered, which takes a second each, but in tests with the mark ``drawn``.
    """
    monkeypatch.setattr(drawing, "started", lambda: None)
    if request.node.get_closest_marker("drawn") is None:
        for draws in ((Figure, "savefig"), (FigureCanvasAgg, "print_png"), (FigureCanvasPdf, "print_pdf")):
            monkeypatch.setattr(*draws, lambda _self, path, **_options: Path(path).touch())

    def run(name: str | None, *arguments: object) -> subprocess.CompletedProcess:
        command = [str(name), *map(str, arguments)]
        monkeypatch.setattr(sys, "argv", command)
        monkeypatch.setattr(warnings, "showwarning", warnings.showwarning)
        monkeypatch.setattr(sys, "unraisablehook", sys.unraisablehook)
        monkeypatch.chdir(tmp_path)
        handlers = {number: signal.getsignal(number) for number in (signal.SIGINT, signal.SIGTERM)}
        with pytest.raises(SystemExit) as ended:
            commands.main(*filter(None, [name]))
        for number, handler in handlers.items():
            signal.signal(number, handler)
        return subprocess.CompletedProcess(command, ended.value.code or 0, *capsys.readouterr())

    return run


@pytest.fixture
def refused(called, tmp_path) -> Callable[..., None]:
    """Check that a command refuses its arguments in one line on stderr, and writes nothing."""

    def check(name: str, arguments: Sequence[object], message: str, status: int) -> None:
        before = set(tmp_path.iterdir())
        done = called(name, *arguments)
        assert (done.returncode, done.stdout) == (status, "")
        assert done.stderr.startswith("error: ")
        assert done.stderr.count("\n") == 1
        assert message in done.stderr
        assert set(tmp_path.iterdir()) == before

    return check
