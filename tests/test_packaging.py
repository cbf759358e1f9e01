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

BUILT = ("docs/api/", "docs/gallery/")  # by `make docs`
FOLDERS = {"benchmarks", "data", "docs", "examples", "scripts", "src", "tests"}
FILES = {
    *("CHANGELOG.md", "CITATION.cff", "CONTRIBUTING.md", "LICENSE", "Makefile", "README.md", "constraints.txt"),
    *("jsconfig.json", "package.json"),
}  # fmt: skip

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
def install(distributions, checkout, tmp_path_factory):
    """Install the wheel with extras in an environment, empty at first, and return a runner of its commands."""
    folder = tmp_path_factory.mktemp("environment")
    venv.create(folder)
    commands = folder / ("Scripts" if sys.platform == "win32" else "bin")
    outside = {name: value for name, value in os.environ.items() if name != "PYTHONPATH"}
    pip = [sys.executable, "-m", "pip", "--python", commands / "python", "install", "--quiet", "--no-compile"]

    def run(command: str, *arguments: object, cwd: Path = folder) -> subprocess.CompletedProcess:
        done = [commands / command, *map(str, arguments)]
        return subprocess.run(done, capture_output=True, text=True, cwd=cwd, env=outside)

    def install(extras: str = ""):
        wheel = f"{distributions[1]}{extras}"
        subprocess.run(
            [*pip, "--constraint", checkout / "constraints.txt", wheel],
            check=True,
            capture_output=True,
            cwd=folder,
        )
        return run

    return install


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
    sources = {path.relative_to(checkout).as_posix() for path in files if path.is_file()}
    assert {name for name in sources if not name.startswith(BUILT)} <= names
    assert {*FILES, ".ci/run"} <= names


def test_the_core_alone_runs_the_readmes_program(install, checkout):
    readme = (checkout / "README.md").read_text(encoding="utf-8")
    program, expected = (re.search(rf"```{kind}\n(.*?)```", readme, re.DOTALL)[1] for kind in ("python", "text"))
    done = install()("python", "-c", program)
    assert done.stdout.splitlines()[0] == expected.splitlines()[0], done.stderr


def test_a_missing_extra_is_named_in_one_line(install):
    core = install()
    assert core("python", "-c", WITHOUT_EXTRAS).stdout.splitlines() == [
        f'{name} must be installed, by: pip install "suspension-ctrl[study]"'
        for name in ("distributed", "statsmodels", "threadpoolctl")
    ]
    done = core("suspension-ctrl", "compare")
    assert done.returncode == 1
    assert done.stderr == 'error: typer must be installed, by: pip install "suspension-ctrl[cli]"\n'


def test_with_all_extras_the_commands_work_in_an_empty_folder(install, tmp_path):
    done = install("[all]")("suspension-ctrl", "compare", "--quick", cwd=tmp_path)
    assert done.returncode == 0, done.stderr
    (results,) = (tmp_path / "results").iterdir()
    assert done.stdout.splitlines()[-1] == str(results.relative_to(tmp_path))
    names = {path.name for path in results.iterdir()}
    assert {"runs.csv", "environment.json", "table2.md", "table4.tex", "figure5.png", "fronts"} <= names
