"""Tables in files: strict reading of CSV columns by name; atomic writing of CSV, JSON, texts and figures."""

import csv
import json
import re
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from functools import partial
from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING, Any, TextIO

import numpy as np

from .. import checks, escaping
from ..documents import naming
from ..quantities import Real, quantity
from .atomic import write_together, write_whole
from .blocks import blocks
from .headers import name_and_unit
from .layouts import HEAD, Layout
from .rounding import rounded

if TYPE_CHECKING:
    import pandas as pd
    from matplotlib.figure import Figure

MEGABYTES = 100
"""Largest size of a file of numbers [MB]."""

ROWS = 10_000
"""Rows of a table that become text at a time."""

PAGE = 90
"""Characters across a page of Markdown or LaTeX."""

_DEVICES = r"(con|prn|aux|nul|com\d|lpt\d)(\.|$)"  # reserved names of Windows, with any ending


@contextmanager
def reading(path: str | PathLike[str]) -> Iterator[TextIO]:
    """Open a text file of moderate size; ValueError if it is none."""
    checks.regular(Path(path), MEGABYTES)
    try:
        with Path(path).open(encoding="utf-8-sig", newline="") as file:
            yield file
    except (UnicodeDecodeError, csv.Error) as error:
        got = "another encoding" if isinstance(error, UnicodeDecodeError) else "quotes that do not end"
        raise ValueError(f"the file must be CSV in UTF-8, got {got}") from None


def read_table(
    path: str | PathLike[str],
    columns: Sequence[str] | Callable[[Sequence[str]], Sequence[int]] | None = None,
    rows: int = 2,
    names: Sequence[str] | None = None,
) -> tuple[list[str], Real]:
    """Return the names of columns (c,), empty without a header, and finite values (n, c), n >= `rows`.

    Only the given `columns` are returned, by their names or by a function from all names to indices; the others
    may hold texts. `names` of all columns take the place of a header. A ValueError names the file.
    """
    with naming(path):
        with reading(path) as file:
            layout = Layout.of(file.readlines(HEAD)).renamed(names)
            wanted = layout.places(columns)
            values = layout.values(file, wanted)
        if len(values) < rows:
            raise ValueError(f"rows of numbers must be {rows} or more, got {len(values)}")
        return [layout.names[i] for i in wanted if layout.names], values


def read_texts(path: str | PathLike[str], column: str) -> list[str]:
    """Return the texts of a column of a table by `write_csv`; none if it has no such column."""
    with naming(path), reading(path) as file:
        return [escaping.from_csv(row[column]) for row in csv.DictReader(file) if row.get(column) is not None]


def read_columns(path: str | PathLike[str], units: Mapping[str, str], most: int) -> dict[str, Real]:
    """Return columns (n <= `most`,) by name in `units`, converted from the header's: ``velocity [mm/s]``.

    A number without unit (``""``) has the unit ``-`` or none in its header.
    """
    names, values = read_table(path)
    with naming(path):
        if len(values) > most:
            raise ValueError(f"rows of numbers must be {most} or less, got {len(values)}")
        headers = [name_and_unit(escaping.from_csv(name)) for name in names]
        found = {name: (i, unit) for i, (name, unit) in enumerate(headers)}
        columns: dict[str, Real] = {}
        for name, unit in units.items():
            i, given = found.get(name, (None, ""))
            if i is None or not (given or not unit):
                needed = f"with its unit in the header, as in '{name} [{unit or '-'}]'"
                got = checks.shown(names if i is None else names[i])
                raise ValueError(f"columns must include {name} {needed}, got {got}")
            numbers = values[:, i].tolist()
            given = "" if given == "-" else given
            columns[name] = np.array([quantity(name, f"{number!r} {given}", unit) for number in numbers])
    return columns


def file_name(text: str) -> str:
    """Return the text as a file name: letters, digits and ``._+-`` unchanged, ``_`` for other characters."""
    name = re.sub(r"[^\w.+-]", "_", text).strip(".") or "_"
    return f"_{name}" if re.match(_DEVICES, name, re.IGNORECASE) else name


def write_csv(path: Path, frame: "pd.DataFrame") -> None:
    """Write a table without its index; texts are escaped against formulas in spreadsheets."""
    write_whole(path, partial(_fill, frame))


def write_tables(folder: Path, frames: "Mapping[str, pd.DataFrame]") -> None:
    """Write tables by name as `write_csv`, all of them or none."""
    write_together({folder / f"{name}.csv": partial(_fill, frame) for name, frame in frames.items()})


def _fill(frame: "pd.DataFrame", temporary: Path) -> None:
    with temporary.open("w", encoding="utf-8", newline="") as file:
        file.writelines(csv_parts(frame))


def csv_parts(frame: "pd.DataFrame") -> Iterator[str]:
    """Yield the text of `write_csv` in parts, as by pandas; real numbers take two thirds of its time."""
    escaped = escaping.frame(frame, escaping.csv)
    yield escaped.iloc[:0].to_csv(index=False, lineterminator="\n")
    for start in range(0, len(escaped), ROWS):
        part = escaped.iloc[start : start + ROWS]
        if set(part.dtypes) == {np.dtype(float)} and not part.isna().to_numpy().any():
            yield "".join(f"{','.join(map(repr, row))}\n" for row in part.to_numpy().tolist())
        else:
            yield part.to_csv(index=False, header=False, lineterminator="\n")


def write_bytes(path: Path, content: bytes) -> None:
    """Write a file."""
    write_all({path: content})


def write_all(contents: Mapping[Path, bytes], *, flushed: bool = True) -> None:
    """Write files, see `write_together`."""

    def writes(content: bytes) -> Callable[[Path], object]:
        return lambda temporary: temporary.write_bytes(content)

    write_together({path: writes(content) for path, content in contents.items()}, flushed=flushed)


def write_text(path: Path, text: str) -> None:
    """Write a text file."""
    write_bytes(path, text.encode())


def write_json(path: Path, content: Mapping[str, Any]) -> None:
    """Write a JSON file, indented."""
    write_bytes(path, as_json(content))


def as_json(content: Mapping[str, Any]) -> bytes:
    """Return the content of `write_json`."""
    return (json.dumps(dict(content), indent=2) + "\n").encode()


def write_table(stem: Path, frame: "pd.DataFrame", keys: int = 1) -> None:
    """Write a table as CSV with all digits, and rounded as Markdown and LaTeX (booktabs) at the width of a page.

    The columns of a wide table stand in blocks, each with the first `keys` columns.
    """
    import pandas as pd

    texts = pd.DataFrame({str(name): rounded(frame[name].tolist()) for name in frame})
    sides = {str(name): "right" if frame[name].dtype.kind in "iuf" else "left" for name in frame}
    markdown, latex = (_page(texts, keys, medium) for medium in (escaping.markdown, escaping.latex))
    parts = [
        one.to_markdown(index=False, disable_numparse=True, colalign=[sides[name] for name in names])
        for names, one in markdown
    ]
    contents = {".csv": "".join(csv_parts(frame)), ".md": "\n\n".join(parts) + "\n"}
    parts = [_latex(one, "".join(sides[name][0] for name in names)) for names, one in latex]
    contents[".tex"] = "\n\\medskip\n\n".join(parts)
    write_all({stem.with_suffix(ending): text.encode() for ending, text in contents.items()})


def _page(
    texts: "pd.DataFrame", keys: int, medium: Callable[[str], str]
) -> "list[tuple[list[str], pd.DataFrame]]":
    """Return a table of texts in blocks of the width of a page: names of columns, and the block escaped."""
    widths = {str(name): max(map(len, [str(name), *texts[name]])) for name in texts}
    parts = blocks(list(widths), keys, widths, PAGE, gap=3)
    return [(names, escaping.frame(texts[names], medium)) for names in parts]


def _latex(table: "pd.DataFrame", alignment: str) -> str:
    """Return a table of texts as booktabs, as by pandas' Styler, which takes a sixth of a second to import."""
    lines = [" & ".join(row) + r" \\" for row in [list(table.columns), *table.to_numpy().tolist()]]
    rules = [rf"\begin{{tabular}}{{{alignment}}}", r"\toprule", lines[0], r"\midrule"]
    return "\n".join([*rules, *lines[1:], r"\bottomrule", r"\end{tabular}", ""])


def write_figure(stem: Path, figure: "Figure") -> None:
    """Write a figure as PNG and as PDF, named `stem` with the ending added."""
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.backends.backend_pdf import FigureCanvasPdf

    figure.set_dpi(160)
    pixels: Any = FigureCanvasAgg(figure)  # `savefig` draws each file twice, first without a result
    write_whole(stem.with_name(f"{stem.name}.png"), pixels.print_png)
    figure.set_layout_engine("none")  # where the first put its parts: a layout takes as long as the drawing
    page: Any = FigureCanvasPdf(figure)
    write_whole(stem.with_name(f"{stem.name}.pdf"), page.print_pdf)
