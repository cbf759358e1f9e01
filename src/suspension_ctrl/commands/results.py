"""Results on disk: a folder that held nothing before, and files that appear whole or not at all."""

from contextlib import suppress
from datetime import datetime
from itertools import chain, count
from pathlib import Path
from tempfile import NamedTemporaryFile
from typing import TYPE_CHECKING

from ..tables import write_csv, write_text, write_whole

if TYPE_CHECKING:
    import pandas as pd
    from matplotlib.figure import Figure


def results_folder(out: Path | None, resumed_by: str | None = None) -> Path:
    """Make and return the folder for the results of a command: `out`, or a new one ``results/<date-time>``.

    ValueError unless `out` is absent, empty, or holds the name `resumed_by`, and can be written.
    """
    folder = out or Path("results") / datetime.now().strftime("%Y-%m-%d_%H-%M-%S")
    try:
        if out is None:
            folder = _made_new(folder)
        folder.mkdir(parents=True, exist_ok=True)
        if any(folder.glob("[!.]*")) and not (resumed_by and (folder / resumed_by).exists()):
            raise ValueError(
                f"out must be a folder that is absent or empty, got {str(folder)!r}, which is not empty"
            )
        with NamedTemporaryFile(dir=folder, prefix="."):
            return folder
    except OSError as error:
        reason = f"got {str(folder)!r}: {error.strerror}"
        raise ValueError(f"out must be a folder that can be written, {reason}") from error


def _made_new(folder: Path) -> Path:
    """Make `folder`, or where that exists the first of folder_2, folder_3, ... that does not."""
    for path in chain([folder], (folder.with_name(f"{folder.name}_{number}") for number in count(2))):
        with suppress(FileExistsError):  # also when another command takes the name at this moment
            path.mkdir(parents=True)
            break
    return path


def write_table(stem: Path, frame: "pd.DataFrame") -> None:
    """Write a table as CSV in full, and as Markdown and LaTeX (booktabs) with six digits."""
    write_csv(stem.with_suffix(".csv"), frame)
    shown = frame.map(lambda value: f"{value:.6g}" if isinstance(value, float) else value)
    write_text(stem.with_suffix(".md"), shown.to_markdown(index=False, disable_numparse=True) + "\n")
    latex = shown.style.hide(axis="index").format(escape="latex").format_index(escape="latex", axis="columns")
    write_text(stem.with_suffix(".tex"), latex.to_latex(hrules=True))


def write_figure(stem: Path, figure: "Figure") -> None:
    """Write a figure as PNG and as PDF, named `stem` with the ending added."""
    for suffix in (".png", ".pdf"):
        write_whole(stem.with_name(stem.name + suffix), lambda temporary: figure.savefig(temporary, dpi=160))
