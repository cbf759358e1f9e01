"""The plan of a results folder: the settings that its runs depend on, as JSON, compared key by key."""

import hashlib
import json
import math
import re
from collections.abc import Iterator, Mapping
from dataclasses import fields, is_dataclass
from pathlib import Path
from typing import Any

import numpy as np

from .. import tables
from . import lock

FILE = "plan.json"
"""Name of the file of a plan in its folder."""

_MOST = 1_000_000  # bytes of a plan
_SHOWN = 60  # characters of a value in a message


def described(value: object) -> Any:
    """Return settings as JSON: fields of records, digests of long arrays, names of functions."""
    if is_dataclass(value) and not isinstance(value, type):
        inner = {one.name: described(getattr(value, one.name)) for one in fields(value)}
        return {"type": type(value).__name__, **inner}
    if isinstance(value, Mapping):
        return {str(key): described(inner) for key, inner in value.items()}
    if isinstance(value, np.ndarray) and value.size > 100:
        return {"shape": list(value.shape), "digest": hashlib.sha256(value.tobytes()).hexdigest()}
    if isinstance(value, np.ndarray | np.generic):
        return described(value.tolist())
    if isinstance(value, list | tuple | range):
        return [described(inner) for inner in value]
    if value is None or isinstance(value, bool | int | str) or (isinstance(value, float) and math.isfinite(value)):
        return value
    return getattr(value, "__qualname__", None) or re.sub(r" at 0x\w+", "", repr(value))


def settle(path: Path, plan: Mapping[str, Any], *, started: bool) -> None:
    """Write a plan, or compare it with its file; ValueError if they differ, or if it is spoilt after a start."""
    wanted = json.loads(json.dumps(described(plan)))
    try:
        kept = read(path)
    except ValueError as error:
        if started:
            raise ValueError(f"{error}; without it its runs cannot be told from those of another plan") from None
        lock.set_aside(path)
        tables.write_json(path, wanted)
        return
    _compare(path, kept, wanted, "to resume there")


def agree(path: Path, part: Mapping[str, Any], purpose: str) -> None:
    """Raise ValueError, with the purpose of the comparison, unless the plan in a file has this part."""
    kept, wanted = read(path), json.loads(json.dumps(described(part)))
    _compare(path, {key: kept.get(key) for key in wanted}, wanted, purpose)


def _compare(path: Path, kept: Mapping[str, Any], wanted: Mapping[str, Any], purpose: str) -> None:
    """Raise ValueError about the first difference of two plans, if any."""
    if different := list(_differences(kept, wanted)):
        (key, old, new), *others = different
        more = [key for key, *_ in others[:4]] + ([f"{len(others) - 4} more"] if len(others) > 4 else [])
        also = f" (also another {', '.join(more)})" if others else ""
        old, new = _around_difference(repr(old), repr(new))
        raise ValueError(f"{key} must be {old} as in {str(path)!r} {purpose}, got {new}{also}")


def read(path: Path) -> dict[str, Any]:
    """Return the object in a JSON file; ValueError if the file is missing or spoilt, or a number is not finite."""
    if not (path.is_file() and path.stat().st_size <= _MOST):
        raise ValueError(f"{path}: must be a regular file of up to {_MOST} bytes")
    try:
        content = json.loads(path.read_bytes(), parse_constant=_refused)
    except (OSError, ValueError, RecursionError) as error:  # undecodable too
        raise ValueError(f"{path}: must be JSON, got {type(error).__name__}") from None
    if not isinstance(content, dict):
        raise ValueError(f"{path}: must be a JSON object, got {type(content).__name__}")
    return content


def _refused(constant: str) -> None:
    raise ValueError(f"must be finite, got {constant}")


def _differences(old: Any, new: Any, key: str = "") -> Iterator[tuple[str, Any, Any]]:
    """Yield dotted key, old and new value of each difference."""
    if isinstance(old, list) and isinstance(new, list) and len(old) == len(new):
        old, new = (dict(enumerate(value)) for value in (old, new))
    if not (isinstance(old, dict) and isinstance(new, dict)):
        if old != new:
            yield key, old, new
        return
    for name in new | old:
        yield from _differences(old.get(name), new.get(name), f"{key}.{name}".lstrip("."))


def _around_difference(*texts: str) -> list[str]:
    """Return the texts, long ones cut to the place of the first difference."""
    same = next((i for i, pair in enumerate(zip(*texts, strict=False)) if len(set(pair)) > 1), 0)
    start = max(0, same - _SHOWN // 2)
    cut = [text[start : start + _SHOWN] if len(text) > _SHOWN else text for text in texts]
    return [f"...{part}..." if part != text else text for part, text in zip(cut, texts, strict=True)]
