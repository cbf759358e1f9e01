"""The README's program, and those of the pages it names, run and print what stands there; files exist."""

import re
import subprocess
import sys
from pathlib import Path


def blocks(text: str, language: str) -> list[str]:
    return re.findall(rf"```{language}\n(.*?)```", text, re.DOTALL)


def test_program_prints_what_the_readme_says(checkout: Path, tmp_path):
    readme = (checkout / "README.md").read_text()
    (program,), (output,) = blocks(readme, "python"), blocks(readme, "text")
    done = subprocess.run(
        [sys.executable, "-c", program], capture_output=True, text=True, cwd=tmp_path, check=True
    )
    printed, expected = done.stdout.splitlines(), output.splitlines()
    assert printed[0] == expected[0]
    assert len(printed) == len(expected)  # the search may end elsewhere on another processor
    assert int(printed[1].split()[0]) > 0


def test_example_of_a_study_runs(checkout: Path, tmp_path):
    (program,) = blocks((checkout / "docs" / "comparison.md").read_text(), "python")
    assert len([line for line in program.splitlines() if line]) <= 25
    done = subprocess.run(
        [sys.executable, "-c", program], capture_output=True, text=True, cwd=tmp_path, check=True
    )
    rows = done.stdout.splitlines()
    assert rows[0].split() == ["algorithm", "nsga2", "moead-dra"]
    assert len(rows) == 2 + 2 * 2


def test_example_of_roads_prints_what_stands_there(checkout: Path, tmp_path):
    text = (checkout / "docs" / "roads.md").read_text()
    (program,), (output,) = blocks(text, "python"), blocks(text, "text")
    done = subprocess.run(
        [sys.executable, "-c", program], capture_output=True, text=True, cwd=tmp_path, check=True
    )
    printed = done.stdout.splitlines()
    assert printed[:2] == output.splitlines()
    assert [line.split()[0] for line in printed[2:]] == ["IRI", "measured,"]


def test_example_of_vehicles_prints_what_stands_there(checkout: Path, tmp_path):
    text = (checkout / "docs" / "vehicles.md").read_text()
    (program,), (output,) = blocks(text, "python"), blocks(text, "text")
    done = subprocess.run(
        [sys.executable, "-c", program], capture_output=True, text=True, cwd=tmp_path, check=True
    )
    assert done.stdout == output


def test_named_files_and_targets_exist(checkout: Path):
    readme, makefile = (checkout / "README.md").read_text(), (checkout / "Makefile").read_text()
    for name in re.findall(r"\]\(([^)]+)\)|`((?:scripts|benchmarks)/\w+\.py)`", readme):
        assert (checkout / (name[0] or name[1])).exists(), name
    for target in re.findall(r"make (\w+)", readme.split("##")[0]):
        assert f"\n{target}: " in makefile


def test_table_of_modules_names_them_all(checkout: Path):
    readme = (checkout / "README.md").read_text().split("## Modules")[1]
    package = checkout / "src" / "suspension_ctrl"
    modules = {
        path.stem for path in package.glob("[!_]*") if path.suffix == ".py" or (path / "__init__.py").exists()
    }
    assert modules <= set(re.findall(r"`(\w+)`", readme))
