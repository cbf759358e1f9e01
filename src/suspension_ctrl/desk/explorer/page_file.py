"""The page of a study as one file: template, style, scripts and record; its policy forbids all requests."""

import gzip
import json
import re
from base64 import b64encode
from collections.abc import Mapping, Sequence
from hashlib import sha256
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

from ... import checks, escaping
from ...response.certificates import Certificate
from ...tables.headers import readable
from ...tables.rounding import rounded
from ..advice import Advice
from ..candidate_texts import decimals_of
from ..decision import Decision
from ..study_files import StudyFile
from .bundling import bundled
from .choice_table import choice_table
from .choice_texts import choice_texts
from .layers import Layer
from .record import record_of

if TYPE_CHECKING:
    import pandas as pd

_HERE = Path(__file__).parent
_SIGNS = re.compile(r"\^[23]|<=|>=")
_PLOTLY = _HERE / "plotly" / "plotly-strict.min.js.gz"


class Opening(NamedTuple):
    """What stands before the choice of a design: title, sentences, of which the first is in bold, and tables."""

    title: str
    said: Sequence[str]
    tables: "Mapping[str, pd.DataFrame]"


def page_of(
    study: StudyFile,
    decision: Decision,
    said: Sequence[str],
    sections: "Mapping[str, Mapping[str, pd.DataFrame]]",
    layers: Sequence[Layer] = (),
    certificates: Sequence[Certificate] = (),
    opening: Opening | None = None,
) -> str:
    """Return the page of a study and its decision as HTML, with sentences `said` and sections of tables by title.

    Beside the front stands that without limits, if it was searched, and layers. Designs with certificates have
    their simulated values.

    The policy allows the scripts of the page alone, by their hashes: no request, no `eval`. The plotting library
    is compressed; the page itself makes it a script.
    """
    advice = Advice.of(decision.problem, decision.table)
    first = decision.table.index[decision.table.index > 0].get_loc(advice.number)
    limited = decision.free is not decision.run
    free = [Layer("front without limits", decision.free.front())] if limited else []
    with checks.installed("report"):
        from jinja2 import Environment
        from markupsafe import Markup
    environment = Environment(autoescape=True)
    environment.filters["html"] = lambda text: Markup(escaping.html(text))
    environment.filters["words"] = lambda text: Markup(escaping.html(_SIGNS.sub(_as_sign, text)))
    script, plotly = bundled(_HERE / "page" / "main.js"), _PLOTLY.read_bytes()
    return environment.from_string(_text("page.html.jinja")).render(
        title=study.name,
        said=said,
        advice=advice,
        conditions=" ".join(decision.problem.describe_cases()),
        choice=choice_table(decision.problem, decision.table),
        notes=choice_texts(decision.problem, decision.table.name.tolist(), present=bool(study.present)),
        opening=opening and opening._asdict() | {"tables": _tables(opening.tables)},
        sections={title: _tables(parts) for title, parts in sections.items()},
        record=_packed(record_of(study, decision, [*free, *layers], certificates) | {"first": first}),
        style=Markup(_text("page.css")),
        script=Markup(script),
        plotly=b64encode(plotly).decode("ascii"),
        hashes=Markup(f"{_hash(script.encode())} {_hash(gzip.decompress(plotly))}"),
    )


def _as_sign(found: re.Match[str]) -> str:
    return {"^2": "²", "^3": "³", "<=": "≤", ">=": "≥"}[found[0]]


def _text(name: str) -> str:
    return (_HERE / "page" / name).read_text(encoding="utf-8")


def _packed(record: Mapping[str, Any]) -> str:
    """Return a record as JSON, compressed, the same for the same record."""
    text = json.dumps(record, allow_nan=False)
    return b64encode(gzip.compress(text.encode(), mtime=0)).decode("ascii")


def _hash(script: bytes) -> str:
    """Return the source of a script in a content security policy."""
    return f"'sha256-{b64encode(sha256(script).digest()).decode('ascii')}'"


def _tables(parts: "Mapping[str, pd.DataFrame]") -> list[dict[str, Any]]:
    return [_table(*part) for part in parts.items()]


def _table(title: str, part: "pd.DataFrame") -> dict[str, Any]:
    """Return a table in mm and kN as texts, and which columns hold texts."""
    shown, digits = readable(part), decimals_of(part)
    columns = [rounded(shown[header].tolist(), digits.get(str(header))) for header in shown]
    rows = [list(row) for row in zip(*columns, strict=True)]
    texts = [column.dtype.kind not in "iuf" for _, column in shown.items()]
    return {"title": title, "header": list(map(str, shown)), "texts": texts, "rows": rows}
