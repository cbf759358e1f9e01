"""Human exposure to measured histories of acceleration, printed and written as CSV."""

from pathlib import Path
from typing import TYPE_CHECKING

from . import options as o
from .ride import given

if TYPE_CHECKING:
    import pandas as pd

    from ..response.human_exposure import ExposureByAxis


def exposure(
    file: o.Histories,
    columns: o.HistoryColumns = None,
    axes: o.Axes = None,
    step: o.Step = None,
    duration: o.Duration = None,
    settling: o.Settling = None,
    out: o.Out = None,
) -> None:
    """Print the exposure to a measured history.

    Weighted accelerations, total values and daily exposure of a person, by ISO 2631-1 and Directive
    2002/44/EC. The file is CSV with even times and a column for each axis with its unit: 'time [s]', 'x
    [m/s^2]', 'z [g]' of a seat, 'back x', 'feet z', 'floor z', 'hand x', 'seat roll [rad/s^2]'; or RPC III
    with such channels. Means such as gravity are removed. Writes exposure.csv, total_values.csv and daily.csv
    to a folder; its path is the last line printed.
    """
    import pandas as pd

    from ..response.history_files import read_accelerations
    from ..response.human_exposure import exposure_by_axis
    from ..tables import write_csv
    from . import results, terminal

    histories, time_step = read_accelerations(file, _axes(axes), step, columns and o.names(columns))
    found = exposure_by_axis(histories, time_step, **given({"duration": duration, "settling": settling}))
    totals = pd.DataFrame(found.total_values.items(), columns=["point", "a_v [m/s^2]"])
    tables = {
        "exposure": found.to_frame().reset_index(),
        "total_values": totals,
        "daily": found.daily().reset_index(),
    }
    folder = results.results_folder(out)
    for name, table in tables.items():
        write_csv(folder / f"{name}.csv", table)
    show(file, time_step, found, tables)
    terminal.end(folder)


def show(file: Path, time_step: float, found: "ExposureByAxis", tables: "dict[str, pd.DataFrame]") -> None:
    """Print the tables."""
    from . import terminal

    seconds = next(iter(found.axes.values())).duration
    terminal.note(f"{file}: {seconds:g} s in steps of {1e3 * time_step:g} ms.")
    rotations = ", rotations in rad" * any(len(name.split()[1]) > 1 for name in found.axes)
    terminal.show(f"Weighted accelerations{rotations}, offsets removed", tables["exposure"])
    terminal.show("Vibration total values", tables["total_values"])
    daily = tables["daily"]
    if len(daily):
        hours = f"{found.duration / 3600:g} h"
        terminal.show(f"Daily exposure, {hours} a day, and values of 2002/44/EC", daily, keys=2)


def _axes(text: str | None) -> dict[str, str]:
    """Return the axes by column of a text such as ``body_acceleration=z,pitch_acceleration=seat pitch``."""
    pairs = [part.partition("=") for part in (text or "").split(",") if part]
    if not all(sign for _, sign, _ in pairs):
        raise ValueError(f"axes must be like body_acceleration=z,roll_acceleration=seat roll, got {text!r}")
    return {column.strip(): axis.strip() for column, _, axis in pairs}
