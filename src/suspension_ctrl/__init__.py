"""Ride optimisation of vehicle suspensions: linear ride models, ISO 2631 comfort, NSGA-II and MOEA/D-DRA.

``__init__.pyi`` lists the public names with their modules; each is imported when it is first used (PEP 562). A
parameter that is not as its description says raises a ValueError, which names it, what is allowed and the value.
"""

import re
from importlib import import_module
from pathlib import Path
from typing import Any

_NAMES = Path(__file__).with_suffix(".pyi").read_text(encoding="utf-8")
_MODULES = {name: module for module, name in re.findall(r"^from (\S+) import (\w+) as", _NAMES, re.MULTILINE)}

__all__ = sorted(_MODULES)


def __getattr__(name: str) -> Any:
    if name not in _MODULES:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    value = getattr(import_module(_MODULES[name], __name__), name)
    globals()[name] = value
    return value


def __dir__() -> list[str]:
    return list(__all__)
