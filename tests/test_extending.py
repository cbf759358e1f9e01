"""Each diff of docs/extending.md applies to a copy of the code, touches one file, and its program works."""

import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

PAGE = (Path(__file__).parents[1] / "docs" / "extending.md").read_text(encoding="utf-8")
SECTIONS = re.findall(
    r"^## (.*?)\n.*?```diff\n(.*?)```\n\n```python\n(.*?)```\n\n```text\n(.*?)```", PAGE, re.DOTALL | re.MULTILINE
)


@pytest.fixture(scope="module")
def copy(checkout, tmp_path_factory) -> Path:
    folder = tmp_path_factory.mktemp("copy")
    for name in ("src", "data"):
        shutil.copytree(checkout / name, folder / name, ignore=shutil.ignore_patterns("__pycache__"))
    return folder


def test_the_page_shows_how_to_add_each_kind_of_thing():
    titles = [title for title, *_ in SECTIONS]
    assert titles == ["A vehicle", "A road", "A weighting", "A measure", "An algorithm"]


@pytest.mark.parametrize("section", SECTIONS, ids=[title for title, *_ in SECTIONS])
def test_one_file_adds_it(section, copy):
    _, diff, program, printed = section
    assert len(re.findall(r"^\+\+\+ b/", diff, re.MULTILINE)) == 1
    subprocess.run(["git", "apply", "-"], input=diff, text=True, cwd=copy, check=True)
    done = subprocess.run(
        [sys.executable, "-W", "error", "-c", program],
        env=os.environ | {"PYTHONPATH": str(copy / "src")}, cwd=copy, capture_output=True, text=True, check=False,
    )  # fmt: skip
    assert done.returncode == 0, done.stderr
    assert done.stdout == printed
