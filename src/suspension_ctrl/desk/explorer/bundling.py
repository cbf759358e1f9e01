"""Modules of JavaScript joined to one script, each in a scope of its own."""

import re
from collections.abc import Iterator
from pathlib import Path

_IMPORT = re.compile(r'^import \{([^}]*)\} from "([^"]+)";\n', re.MULTILINE)
_EXPORT = re.compile(r"^export (?=(?:function|class|const) )", re.MULTILINE)
_CONSTANT = re.compile(r"(?:^|, )(\w+) = ")
_NAME = re.compile(r"^export (?:function|class) (\w+)|^export const (.*);", re.MULTILINE)


def bundled(entry: Path) -> str:
    """Return one script of a module and all that it imports, each before its users.

    Imports are lines ``import { a, b } from "./file.js";``, exports stand before ``function``, ``class`` and
    ``const``; file names differ.
    """
    modules = dict.fromkeys(_in_order(entry.resolve()))
    return "\n".join(['"use strict";', "const modules = {};", *map(_scoped, modules)])


def _in_order(path: Path) -> Iterator[Path]:
    """Yield the modules that one needs, some several times, itself last."""
    for name in _imported(path):
        yield from _in_order(name)
    yield path


def _imported(path: Path) -> Iterator[Path]:
    for _, name in _IMPORT.findall(path.read_text(encoding="utf-8")):
        yield (path.parent / name).resolve()


def _scoped(path: Path) -> str:
    """Return a module as a function that is called, its exports as the fields of what it returns."""
    text = path.read_text(encoding="utf-8")
    exported = [name for one in _NAME.finditer(text) for name in _names(one)]
    body = _EXPORT.sub("", _IMPORT.sub(_from_module, text))
    return f"modules.{path.stem} = (() => {{\n{body}return {{ {', '.join(exported)} }};\n}})();"


def _names(found: re.Match[str]) -> list[str]:
    """Return the names of an exported function or class, or of constants ``A = 1, B = [2, 3]``."""
    return [found[1]] if found[1] else _CONSTANT.findall(found[2])


def _from_module(found: re.Match[str]) -> str:
    return f"const {{{found[1]}}} = modules.{Path(found[2]).stem};\n"
