import importlib
import os
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import pytest

from suspension_ctrl import terminal

Script = Callable[..., subprocess.CompletedProcess]


@pytest.fixture(scope="session")
def script(checkout: Path, tmp_path_factory) -> Script:
    """Run a script of the project as its user does, in a folder of its own."""

    def run(
        name: str, *arguments: object, cwd: Path | None = None, warnings: str = "error"
    ) -> subprocess.CompletedProcess:
        command = [sys.executable, str(checkout / "scripts" / f"{name}.py"), *map(str, arguments)]
        folder = cwd or tmp_path_factory.mktemp(name)
        return subprocess.run(
            command, capture_output=True, text=True, cwd=folder, env=os.environ | {"PYTHONWARNINGS": warnings}
        )

    return run


@pytest.fixture
def called(monkeypatch, capsys, tmp_path) -> Script:
    """Run a script of the project in this process, which saves seconds of imports, in the test's folder."""

    def run(name: str, *arguments: object) -> subprocess.CompletedProcess:
        command = [name, *map(str, arguments)]
        monkeypatch.setattr(sys, "argv", command)
        monkeypatch.chdir(tmp_path)
        with pytest.raises(SystemExit) as ended:
            terminal.run_script(importlib.import_module(name).main)
        return subprocess.CompletedProcess(command, ended.value.code or 0, *capsys.readouterr())

    return run
