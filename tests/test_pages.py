"""Programs of README and docs print what stands there, commands run, and names of files and modules are real."""

import contextlib
import io
import re
from pathlib import Path

import pytest

import suspension_ctrl as sc

CHECKOUT = Path(__file__).parents[1]
PAGES = [CHECKOUT / "README.md", *sorted((CHECKOUT / "docs").glob("*.md"))]
NUMBER = re.compile(r"-?\d+(?:\.\d+)?(?:e[+-]\d+)?")
SHORT = {
    r"data/": f"{CHECKOUT}/data/",
    r" --(populations|iterations|repeats|jobs) \S+": "",
    r"(--algorithms [\w-]+,[\w-]+),\S+": r"\1",
    r"^(compare.*)": r"\1 --quick",
    r"^(compare --study .*) --quick": r"\1 --populations 20 --iterations 1 --repeats 1",
    r"^(optimum --vehicle.*|report .*)": r"\1 --population 40 --iterations 2",
}
"""Replacements that make a command short: its work is tested elsewhere, here that it is a command."""


def blocks(page: Path, language: str) -> list[tuple[str, str]]:
    """Return the blocks of a language, each with the block of text that follows it, if one does."""
    pattern = rf"```{language}\n(.*?)```\n(?:\n```text\n(.*?)```)?"
    return re.findall(pattern, page.read_text(encoding="utf-8"), re.DOTALL)


def commands() -> list[str]:
    """Return the commands of all pages, in blocks and within a text; a scheduler is tested with `compare`."""
    found = []
    for page in PAGES:
        text = page.read_text(encoding="utf-8")
        lines = [line for block, _ in blocks(page, "sh") for line in block.splitlines()]
        found += [line for line in lines if line.startswith("suspension-ctrl ")]
        found += [" ".join(code.split()) for code in re.findall(r"`(suspension-ctrl [a-z]+ --[^`]+)`", text)]
    return sorted({command for command in found if "--scheduler" not in command})


PROGRAMS = {
    f"{page.stem}-{n}": block
    for page in PAGES
    if page.stem != "extending"
    for n, block in enumerate(blocks(page, "python"), start=1)
}


@pytest.mark.parametrize("name", PROGRAMS)
def test_a_program_prints_what_stands_there(name, tmp_path, monkeypatch):
    """Numbers within 1 %: on another processor a search may take another path from the last bit of a sum on."""
    program, expected = PROGRAMS[name]
    monkeypatch.chdir(tmp_path)
    printed = io.StringIO()
    with contextlib.redirect_stdout(printed):
        exec(compile(program, name, "exec"), {"__name__": "__main__"})
    assert printed.getvalue()
    if expected:
        texts, numbers = ([], []), ([], [])
        for n, text in enumerate((printed.getvalue(), expected)):
            lines = [line.rstrip() for line in text.splitlines()]
            texts[n].extend(NUMBER.sub("#", line) for line in lines)
            numbers[n].extend(float(number) for line in lines for number in NUMBER.findall(line))
        assert texts[0] == texts[1]
        assert numbers[0] == pytest.approx(numbers[1], rel=0.01)


@pytest.mark.parametrize("command", commands())
def test_a_command_runs(command, called, tmp_path):
    sc.save_profile(tmp_path / "survey.csv", sc.Iso8608Road("B").profile(200.0, 0.1, 1))
    (tmp_path / "optimum").mkdir()
    sc.save_vehicle(tmp_path / "optimum" / "design.toml", sc.load_vehicle("yuen_ramli_2010"))
    _, short = command.split(" ", 1)
    for pattern, replacement in SHORT.items():
        short = re.sub(pattern, replacement, short)
    name, *arguments = short.split()
    done = called(name, *arguments)
    assert done.returncode == 0, done.stderr
    assert Path(done.stdout.splitlines()[-1]).exists()


def test_named_files_and_targets_exist():
    for page in PAGES:
        text = page.read_text(encoding="utf-8")
        for name in re.findall(r"\]\(([^)#\s]+)|`((?:scripts|benchmarks)/\w+\.py)`", text):
            if not name[0].startswith("http"):
                assert ((page.parent / name[0]) if name[0] else (CHECKOUT / name[1])).exists(), (page, name)
        for target in re.findall(r"make (\w+)(?: |`|$)", "".join(re.findall(r"`[^`]+`", text))):
            assert f"\n{target}: " in (CHECKOUT / "Makefile").read_text(), (page, target)


def test_the_readme_is_short():
    assert len((CHECKOUT / "README.md").read_text(encoding="utf-8").splitlines()) <= 100


def test_the_table_of_the_code_names_every_package():
    table = (CHECKOUT / "docs" / "code.md").read_text(encoding="utf-8")
    package = CHECKOUT / "src" / "suspension_ctrl"
    modules = {
        path.stem for path in package.glob("[!_]*") if path.suffix == ".py" or (path / "__init__.py").exists()
    }
    assert modules <= set(re.findall(r"`(\w+)`", table))


def test_the_reference_lists_every_exported_name_once():
    listed = re.findall(r"^   (\w+)$", (CHECKOUT / "docs" / "api.md").read_text(encoding="utf-8"), re.MULTILINE)
    assert sorted(listed) == sc.__all__
