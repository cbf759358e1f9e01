"""The package on other systems: nothing of Unix alone is needed, every text file names its encoding."""

import ast
import os
import subprocess
import sys
from pathlib import Path

import pytest

import suspension_ctrl

ELSEWHERE = """
import importlib.abc, io, os, signal, sys, warnings

class Absent(importlib.abc.MetaPathFinder):
    def find_spec(self, name, path=None, target=None):
        if name in {"fcntl", "resource"}:
            raise ModuleNotFoundError(f"No module named {name!r}", name=name)

sys.meta_path.insert(0, Absent())
del signal.SIGHUP, os.O_DIRECTORY

def fsync(descriptor, _fsync=os.fsync):  # of files that are open for writing alone
    os.write(descriptor, b"")
    _fsync(descriptor)

os.fsync = fsync
warnings.filterwarnings("error", category=EncodingWarning, module=r"suspension_ctrl\\..*|__main__")
"""

STUDY = """
from pathlib import Path
import numpy as np
from suspension_ctrl import Nsga2, Problem, Study
from suspension_ctrl.study.store import FolderStore

problem = Problem(
    evaluate=lambda x: np.stack([x[:, 0], 1 - x[:, 0] + x[:, 1]], axis=1),
    lower=(0, 0), upper=(1, 1), objectives=("f1", "f2"),
)
study = Study(problems={"p": problem}, algorithms={"nsga2": Nsga2(population=20)}, seeds=[1], budgets=[40])
store = FolderStore(Path("store"), {"plan": 1})
assert [failure for _, failure in study.carry_out(store)] == [None]
assert len(study.table(store)) == 3
"""


def elsewhere(program: str, folder: Path, *arguments: str) -> subprocess.CompletedProcess:
    """Run a program as if on another system, whose terminal knows the letters of Western Europe alone."""
    command = [sys.executable, "-X", "warn_default_encoding", "-c", ELSEWHERE + program, *arguments]
    environment = os.environ | {"PYTHONIOENCODING": "cp1252"}
    return subprocess.run(command, capture_output=True, encoding="cp1252", cwd=folder, env=environment)


def test_a_study_runs_without_what_only_unix_has(tmp_path):
    done = elsewhere(STUDY, tmp_path)
    assert done.returncode == 0, done.stderr


def test_a_comparison_runs_without_what_only_unix_has(checkout, tmp_path):
    program = "import runpy; del sys.argv[0]; runpy.run_path(sys.argv[0], run_name='__main__')"
    done = elsewhere(program, tmp_path, str(checkout / "scripts" / "compare.py"), "--quick", "--out", "results")
    assert done.returncode == 0, done.stderr
    assert (tmp_path / "results" / "runs.csv").exists()


def opened(call: ast.Call) -> bool:
    """Whether a call opens a text file; functions of `tables` that are called alike do so themselves."""
    match call.func:
        case ast.Attribute(attr="open" | "read_text" | "write_text", value=value):
            ours = isinstance(value, ast.Name) and value.id in ("files", "tables", "results", "os")
        case ast.Name(id="open"):
            ours = False
        case _:
            return False
    modes = [argument.value for argument in call.args if isinstance(argument, ast.Constant)]
    return not ours and not any("b" in str(mode) for mode in modes)


@pytest.mark.parametrize("room", ["src/suspension_ctrl", "scripts", "benchmarks"])
def test_every_text_file_is_opened_with_its_encoding(checkout, room):
    found = []
    for path in (checkout / room).rglob("*.py"):
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            if isinstance(node, ast.Call) and opened(node) and "encoding" not in {k.arg for k in node.keywords}:
                found.append(f"{path.relative_to(checkout)}:{node.lineno}")
    assert found == []


def test_the_package_names_nothing_that_only_unix_has():
    text = "".join(
        path.read_text(encoding="utf-8") for path in Path(suspension_ctrl.__file__).parent.rglob("*.py")
    )
    for name in ("fcntl", "import resource", "SIGHUP", "SIGKILL", "O_DIRECTORY", "geteuid", "os.fork", "/tmp"):
        assert name not in text
