"""TOML files: an error lists all mistakes, each with the file, its line and its key."""

import re
import tomllib
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from os import PathLike
from os.path import realpath
from pathlib import Path
from typing import Any, NamedTuple

from . import checks, escaping

_LINES = 20  # mistakes in an error
_MEGABYTES, _DOTS = 1.0, 500  # of a file, and in a line: the time of tomllib for a key a.b.c. ... is quadratic
_QUOTED = re.compile(r"(character|declare|namespace|key) ['\"(].*(?=\(at )")  # what tomllib quotes of a file
_NUMBERS = re.compile(r"[\[,]\s*[-+]?\d+\.\d+(?:e[-+]?\d+)?(?=\s*[,\]])")  # in an array: their dots are of no key
_HEADER = re.compile(r"\s*(\[\[?)([^\[\]]{1,200})\]")
_KEY = re.compile(r"\s*([\w.\"'-]{1,200})\s*=")


class FileError(ValueError):
    """Mistakes in a file, one per line."""


class UnreadFileError(FileError, OSError):
    """Mistakes in a file, one per line; among them a file that it names and that cannot be read."""


def lines_of(error: ValueError) -> list[str]:
    """Return the mistakes that an error lists, each as one line."""
    return str(error).split("\n") if isinstance(error, FileError) else [" ".join(str(error).split())]


class Mistakes:
    """Collected mistakes in a file; a file that it names and that cannot be read is one."""

    def __init__(self) -> None:
        self._lines: dict[str, None] = {}
        self._unread: list[OSError] = []

    def __len__(self) -> int:
        return len(self._lines)

    def note(self, line: str) -> None:
        """Note a mistake."""
        self._lines[line] = None

    @contextmanager
    def noted(self, prefix: str = "") -> Iterator[None]:
        """Note the lines of an error of the block, each after the prefix, and suppress the error."""
        try:
            yield
        except (ValueError, OSError) as error:
            lines = [str(error)] if not isinstance(error, ValueError) else lines_of(error)
            self._unread += [error] if isinstance(error, OSError) else []
            self._lines |= dict.fromkeys(f"{prefix}{line}" for line in lines)

    def settle(self) -> None:
        """Raise a FileError with the mistakes, if any; an OSError that is the only one as it is."""
        if self._unread and len(self._lines) == 1:
            raise self._unread[0]
        if self._lines:
            raise (UnreadFileError if self._unread else FileError)("\n".join(self._lines))


@contextmanager
def naming(path: str | PathLike[str], numbers: Mapping[str, int] | None = None) -> Iterator[None]:
    """Name the file, and the line of the key by `numbers`, in errors about the content of a file."""
    try:
        yield
    except (ValueError, RecursionError, ArithmeticError, MemoryError) as error:
        far = "the file must have tables of moderate depth and numbers of moderate size, got a"
        lines = lines_of(error) if isinstance(error, ValueError) else [f"{far} {type(error).__name__}"]
        more = [f"{len(lines) - _LINES} further mistakes"] if len(lines) > _LINES else []
        named = [f"{path}{_place(line, numbers or {})}: {line}" for line in [*lines[:_LINES], *more]]
        kind = UnreadFileError if isinstance(error, UnreadFileError) else FileError
        raise kind("\n".join(map(escaping.terminal, named))) from None


@contextmanager
def keyed(prefix: str, names: Mapping[str, str]) -> Iterator[None]:
    """Name the file's key in a ValueError: "mass must be > 0 kg" becomes "seats[1].mass_kg must be > 0 kg"."""
    try:
        yield
    except ValueError as error:
        name, space, rest = str(error).partition(" ")
        key = prefix + names[name] if name in names else f"{prefix[:-1]}: {name}" if prefix else name
        raise ValueError(key + space + rest) from None


class Folder(NamedTuple):
    """The folder of a file that refers to other files."""

    path: Path = Path()
    allow_outside: bool = False

    def file(self, name: str) -> Path:
        """Return the path of a file; ValueError if it is outside of the folder and not allowed."""
        path = self.path / name
        if not (self.allow_outside or Path(realpath(path)).is_relative_to(realpath(self.path))):
            needed = "beside this file or below it, unless outside is allowed"
            raise ValueError(f"file must be {needed}, got {checks.shown(name)}")
        return path

    def named(self, text: str) -> str:
        """Return the path of a file named in this folder; a name without an ending is returned unchanged."""
        return str(self.path / text) if Path(text).suffix else text


class Table(NamedTuple):
    """A table of a file."""

    name: str  # prefix of its keys in errors: "struts.front."
    content: Mapping[str, Any]
    folder: Folder = Folder()

    def flat(self) -> "Table":
        """Return the table with the values of inner tables, at any depth, under dotted keys."""
        flat: dict[str, object] = {}
        for key, value in self.content.items():
            nested = Table("", value).flat().content if isinstance(value, dict) else {}
            flat |= {f"{key}.{inner}": one for inner, one in nested.items()} if nested else {key: value}
        return self._replace(content=flat)

    def inner(self, key: str, value: object) -> "Table":
        """Return the table under a key; ValueError if the value is not a table."""
        if not isinstance(value, dict):
            raise ValueError(f"{self.name}{key} must be a table, got {checks.shown(value)}")
        return Table(f"{self.name}{key}.", value, self.folder)


@contextmanager
def document(path: Path, allow_outside: bool = False) -> Iterator[Table]:
    """Yield the table of a TOML file in UTF-8; errors of the block name the file and the lines of keys."""
    numbers: dict[str, int] = {}
    with naming(path, numbers):
        checks.regular(path, _MEGABYTES)
        try:
            text = path.read_bytes().decode("utf-8-sig")
            if (dots := max(line.count(".") for line in _NUMBERS.sub("", text).split("\n"))) > _DOTS:
                raise ValueError(f"a line of {dots} dots, {_DOTS} are the most")
            content = tomllib.loads(text)
        except ValueError as error:  # quotes nothing of the file
            encoded = isinstance(error, UnicodeDecodeError)
            got = "another encoding" if encoded else _QUOTED.sub(r"\1 ", str(error))
            raise ValueError(f"the file must be TOML in UTF-8, got {got}") from None
        numbers |= line_numbers(text)
        yield Table("", content, Folder(path.parent, allow_outside))


def line_numbers(text: str) -> dict[str, int]:
    """Return the number of the line of each key and header in a TOML text: ``{"seats[1].mass_kg": 12}``."""
    numbers: dict[str, int] = {}
    lengths: dict[str, int] = {}  # of arrays of tables
    table, inside = "", False
    for number, line in enumerate(text.split("\n"), start=1):
        if not inside and (header := _HEADER.match(line)):
            table = ""
            for part in re.sub(r"[\s\"']", "", header[2]).split("."):
                table += f".{part}" if table else part
                if header[1] == "[[" and header[2].rstrip().endswith(part):
                    lengths[table] = lengths.get(table, 0) + 1
                table += f"[{lengths[table]}]" if table in lengths else ""
            numbers.setdefault(table, number)
            table += "."
        elif not inside and (key := _KEY.match(line)):
            numbers.setdefault(table + re.sub("[\"']", "", key[1]), number)
        inside ^= (line.count('"""') + line.count("'''")) % 2 == 1
    return numbers


def _place(message: str, numbers: Mapping[str, int]) -> str:
    """Return ``:12``, the line of the key that a message begins with, or of its table; ``""`` if unknown."""
    key = message.split(" ", 1)[0].rstrip(":")
    while key and key not in numbers:
        key = key[: max(key.rfind("."), key.rfind("["), 0)]
    return f":{numbers[key]}" if key else ""
