import os
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import pytest

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
