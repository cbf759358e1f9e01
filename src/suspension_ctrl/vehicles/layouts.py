"""Layouts of struts as texts: ``spring | (damper - mount)``.

``|`` joins parts in parallel, ``-`` in series and before ``|``; ``0.8*(...)`` is an installation ratio of a group.
"""

import re
from collections import deque
from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace

from .. import checks
from .struts import Element, Parallel, Series, Strut, parallel, series

_MOST = 200  # characters
_NAME, _RATIO = r"[^\W\d]\w*", r"\d{1,20}(?:\.\d{1,20})?(?:e[+-]?\d{1,2})?\s*\*"
_TOKEN = re.compile(rf"\s*({_NAME}|{_RATIO}|[|()-])\s*")
_NEEDED = "elements joined by | (parallel) and - (series) with parentheses"
_JOINS: tuple[tuple[str, Callable[..., Strut]], ...] = (("|", parallel), ("-", series))


def names(layout: str) -> list[str]:
    """Return the names of the elements in a layout, from left to right."""
    return re.findall(_NAME, re.sub(_RATIO, "", layout)) if len(layout) <= _MOST else []


def strut_of(layout: str, elements: Mapping[str, Element]) -> Strut:
    """Return the strut of a layout; ValueError about `layout` if it is none."""
    tokens = deque[str]()
    place = 0
    while (found := _TOKEN.match(layout, place)) and place < _MOST:
        tokens.append(found[1])
        place = found.end()
    try:
        if place < len(layout):
            raise IndexError
        strut = _joined(tokens, elements, _JOINS)
        if tokens:
            raise IndexError
    except IndexError:
        needed = f"a text of {_NEEDED}, up to {_MOST} characters"
        raise ValueError(f"layout must be {needed}, got {checks.shown(layout)}") from None
    return strut


def _joined(
    tokens: deque[str], elements: Mapping[str, Element], joins: Sequence[tuple[str, Callable[..., Strut]]]
) -> Strut:
    """Return the part at the first tokens, which are taken away; IndexError if they make none."""
    if not joins:
        return _part(tokens, elements)
    (sign, join), *inner = joins
    parts = [_joined(tokens, elements, inner)]
    while tokens and tokens[0] == sign:
        tokens.popleft()
        parts.append(_joined(tokens, elements, inner))
    return join(*parts) if len(parts) > 1 else parts[0]


def _part(tokens: deque[str], elements: Mapping[str, Element]) -> Strut:
    token, ratio = tokens.popleft(), 1.0
    if token in elements:
        return elements[token]
    if token.endswith("*"):
        token, ratio = tokens.popleft(), float(token[:-1])
    if token != "(":
        raise IndexError
    strut = _joined(tokens, elements, _JOINS)
    if tokens.popleft() != ")":
        raise IndexError
    return replace(strut, installation_ratio=strut.installation_ratio * ratio)


def layout_of(strut: Strut) -> str:
    """Return the layout that `strut_of` reads."""
    text = _inner(strut)
    return text[1:-1] if text.startswith("(") else text


def _inner(strut: Strut) -> str:
    if not isinstance(strut, Parallel):
        return ", ".join(element.name for element in strut.elements)
    joined = (" - " if isinstance(strut, Series) else " | ").join(map(_inner, strut.parts))
    return f"({joined})" if strut.installation_ratio == 1 else f"{strut.installation_ratio!r}*({joined})"
