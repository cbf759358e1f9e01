"""The tree is the data flow; import-linter holds its layers, and would see one that is broken."""

import shutil
import subprocess
import sys
from pathlib import Path

import pytest

import suspension_ctrl

ROOMS = {
    *("checks", "datafiles", "documents", "quantities", "tables"),
    *("commands", "paper", "response", "roads", "search", "study", "vehicles"),
}


@pytest.mark.parametrize(
    ("module", "line"),
    [
        ("roads/road.py", "from ..response import measures"),
        ("search/operators.py", "from suspension_ctrl.vehicles import cars"),
        ("study/lenses.py", "import suspension_ctrl.paper.experiment"),
    ],
)
def test_a_broken_layer_is_seen(checkout, tmp_path, module, line):
    shutil.copytree(checkout / "src", tmp_path / "src", ignore=shutil.ignore_patterns("__pycache__"))
    shutil.copy(checkout / "pyproject.toml", tmp_path)
    program = (
        "import sys; sys.path.insert(0, 'src'); from importlinter.cli import lint_imports; "
        "sys.exit(lint_imports(no_cache=True))"
    )
    lint = [sys.executable, "-c", program]
    before = subprocess.run(lint, cwd=tmp_path, capture_output=True, text=True)
    assert before.returncode == 0, before.stdout
    with (tmp_path / "src" / "suspension_ctrl" / module).open("a") as file:
        file.write(f"\n{line}\n")
    after = subprocess.run(lint, cwd=tmp_path, capture_output=True, text=True)
    assert after.returncode == 1, after.stdout
    assert "BROKEN" in after.stdout


def test_rooms_are_those_of_the_design():
    package = Path(suspension_ctrl.__file__).parent
    found = {path.stem for path in package.iterdir() if path.suffix == ".py" or (path / "__init__.py").exists()}
    assert found == ROOMS | {"__init__"}


def test_public_names():
    assert all(hasattr(suspension_ctrl, name) for name in suspension_ctrl.__all__)
    assert dir(suspension_ctrl) == suspension_ctrl.__all__
