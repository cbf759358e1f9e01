"""Figure 2: the ISO 2631 weightings Wk and Wb, as filters and as the standard's table.

Writes figure2.png and figure2.pdf, and figure2.csv with the factors at the table's frequencies, to a folder
whose path is the last line printed.
"""

from pathlib import Path
from typing import Annotated

import pandas as pd
from matplotlib.figure import Figure
from typer import Option

from .. import tables as files
from ..response import figures, weightings
from . import results


def main(out: Annotated[Path | None, Option(help="Folder for the results, absent or empty.")] = None) -> None:
    """Draw the frequency weightings of vertical vibration."""
    folder = results.results_folder(out)
    factors = {
        f"{name} [-]": weightings.by_name(name).factor(weightings.BANDS)
        for name in weightings.FILTERS + weightings.TABLES
    }
    files.write_csv(folder / "figure2.csv", pd.DataFrame({"frequency [Hz]": weightings.BANDS, **factors}))
    figure = Figure(figsize=(7, 4.6), layout="constrained")
    figures.weighting_factors(figure.add_subplot(), ("Wk", "Wb"), ("Wk-table", "Wb-table"))
    results.write_figure(folder / "figure2", figure)
    print(folder)
