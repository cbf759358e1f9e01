"""Figure 2: the ISO 2631 weightings Wk and Wb, as filters and as the standard's table."""

from . import options as o


def weighting(out: o.Out = None) -> None:
    """Draw the weightings Wk and Wb of ISO 2631: Figure 2.

    As filters and as tables. Writes figure2 (PNG, PDF) and figure2.csv, the factors at the frequencies of the
    tables, to a folder; its path is the last line printed.
    """
    import pandas as pd
    from matplotlib.figure import Figure

    from ..paper import figures
    from ..response import weightings
    from ..tables import write_csv, write_figure
    from . import results, terminal

    f = weightings.BANDS
    every = weightings.filters() + weightings.TABLES
    factors = {f"{name} [-]": weightings.by_name(name).factor(f) for name in every}
    folder = results.results_folder(out)
    write_csv(folder / "figure2.csv", pd.DataFrame({"frequency [Hz]": f, **factors}))
    figure = Figure(figsize=(7, 4.6), layout="constrained")
    figures.weighting_factors(figure.add_subplot(), ("Wk", "Wb"), ("Wk-table", "Wb-table"))
    write_figure(folder / "figure2", figure)
    terminal.end(folder)
