"""The distributions: what they hold, and that the wheel works in an empty environment, in any folder."""

import os
import re
import subprocess
import sys
import tarfile
import venv
import zipfile
from pathlib import Path

import pytest

FOLDERS = {"benchmarks", "data", "docs", "examples", "scripts", "src", "tests"}
FILES = {"CHANGELOG.md", "CITATION.cff", "CONTRIBUTING.md", "LICENSE", "Makefile", "README.md", "constraints.txt"}

WITHOUT_EXTRAS = """
import sys
from suspension_ctrl.study import inference, machine, workers

def message(use):
    try:
        use()
    except ImportError as error:
        return str(error)

print(message(lambda: workers.scheduler_at("tcp://127.0.0.1:1").__enter__()))
print(message(lambda: inference.holm([0.1])))
print(message(lambda: machine.single_thread().__enter__()))
"""


@pytest.fixture(scope="module")
def distributions(checkout, tmp_path_factory) -> tuple[Path, Path]:
    """The source distribution, and the wheel that is built from it."""
    folder = tmp_path_factory.mktemp("distributions")
    build = [sys.executable, "-m", "build", "--no-isolation", "--outdir", str(folder), str(checkout)]
    subprocess.run(build, check=True, capture_output=True)
    return next(folder.glob("*.tar.gz")), next(folder.glob("*.whl"))


@pytest.fixture(scope="module")
def run(distributions, checkout, tmp_path_factory):
    """Run a command of an environment in which the wheel with these extras alone is installed."""
    folder = tmp_path_factory.mktemp("environment")
    venv.create(folder, with_pip=True)
    commands = folder / ("Scripts" if sys.platform == "win32" else "bin")
    outside = {name: value for name, value in os.environ.items() if name != "PYTHONPATH"}

    def run(command: str, *arguments: object, cwd: Path = folder) -> subprocess.CompletedProcess:
        done = subprocess.run(
            [commands / command, *map(str, arguments)], capture_output=True, text=True, cwd=cwd, env=outside
        )
        assert done.returncode == 0, done.stderr
        return done

    def installed(extras: str = ""):
        wheel = f"{distributions[1]}{extras}"
        run("python", "-m", "pip", "install", "--quiet", "--constraint", checkout / "constraints.txt", wheel)
        return run

    return installed


def test_wheel_holds_the_data_and_the_types(distributions):
    names = set(zipfile.ZipFile(distributions[1]).namelist())
    assert "suspension_ctrl/data/standards/iso8041_wk_wb_table.csv" in names
    assert {"suspension_ctrl/py.typed", "suspension_ctrl/__init__.pyi"} <= names
    assert {name.split("/")[0].split("-")[0] for name in names} == {"suspension_ctrl"}


def test_source_distribution_holds_all_that_a_checkout_does(distributions, checkout):
    with tarfile.open(distributions[0]) as archive:
        names = {name.partition("/")[2] for name in archive.getnames()}
    folders = [path for path in checkout.iterdir() if path.is_dir() and path.name in FOLDERS]
    files = [path for folder in folders for path in folder.rglob("*.*") if "cache" not in str(path)]
    assert {path.relative_to(checkout).as_posix() for path in files if path.is_file()} <= names
    assert {*FILES, ".ci/run"} <= names


def test_the_core_alone_runs_the_readmes_program(run, checkout):
    readme = (checkout / "README.md").read_text(encoding="utf-8")
    program, expected = (re.search(rf"```{kind}\n(.*?)```", readme, re.DOTALL)[1] for kind in ("python", "text"))
    core = run()
    assert core("python", "-c", program).stdout.splitlines()[0] == expected.splitlines()[0]
    listed = core("python", "-m", "pip", "list", "--format", "freeze").stdout.casefold()
    for package in ("dask", "distributed", "jinja2", "rich", "statsmodels", "tabulate", "threadpoolctl", "typer"):
        assert f"\n{package}==" not in listed


def test_a_missing_extra_is_named_in_one_line(run):
    lines = run()("python", "-c", WITHOUT_EXTRAS).stdout.splitlines()
    assert lines == [
        f'{name} must be installed, by: pip install "suspension-ctrl[study]"'
        for name in ("distributed", "statsmodels", "threadpoolctl")
    ]
