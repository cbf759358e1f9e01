"""Roughness, spectrum and class of a measured road, printed, drawn and written as CSV."""

from typing import TYPE_CHECKING, Any

from . import options as o

if TYPE_CHECKING:
    import pandas as pd

    from ..roads.measured import MeasuredRoad
    from ..roads.profiles import Profile

SEGMENTS = "100,20,10"  # m


def road(
    file: o.ProfileFile,
    columns: o.Columns = None,
    step: o.RowStep = None,
    track_width: o.TrackWidth = None,
    tracks: o.Tracks = None,
    segments: o.Segments = SEGMENTS,
    smoothed: o.Smoothed = False,
    out: o.Out = None,
) -> None:
    """Print roughness, spectrum and class of a measured road.

    A table as text, ERD or OpenCRG. Writes roughness.csv, roughness_100m.csv and so on by segments, spectrum.csv
    and road (PNG, PDF) to a folder; its path is the last line printed.
    """
    import pandas as pd

    from ..response.roughness import international_roughness_index
    from ..roads.profile_files import load_profile
    from ..tables import write_csv, write_figure
    from . import results, terminal
    from .road_figure import road_figure

    lengths = o.lengths("segments", segments)
    given: dict[str, Any] = {
        "columns": columns and o.names(columns),
        "tracks": tracks and o.lengths("tracks", tracks),
    }
    profile = load_profile(file, step=step, track_width=track_width, **given)
    index = international_roughness_index(profile, average=not smoothed)
    parts = {length: index.by_segment(length) for length in lengths if length <= index.length}
    measured, told = spectrum_of(profile, str(file))
    folder = results.results_folder(out)
    rows = {"track [m]": [*profile.tracks, "mean"], "IRI [mm/m]": [*index.tracks, index.mean]}
    tables = {"roughness": pd.DataFrame(rows), **{f"roughness_{length:g}m": one for length, one in parts.items()}}
    tables |= {} if measured is None else {"spectrum": spectrum_table(measured)}
    for name, table in tables.items():
        write_csv(folder / f"{name}.csv", table)
    with terminal.waiting("drawing"):
        write_figure(folder / "road", road_figure(profile, index, max(parts, default=None), measured))
    terminal.note(f"{file}: {profile.distance.size} points in steps of {profile.step:g} m.")
    terminal.show("International Roughness Index", tables["roughness"], {"IRI [mm/m]": 2})
    if parts:
        terminal.show("By segments: least, mean and largest", spread(parts), keys=1)
    terminal.note(told)
    terminal.end(folder)


def spectrum_of(profile: "Profile", source: str) -> "tuple[MeasuredRoad | None, str]":
    """Return the spectrum of a profile, None if it is too short, and the class of ISO 8608 in words."""
    from ..roads.classes import REFERENCE, fitted_class
    from ..roads.coherence import Constant
    from ..roads.measured import MeasuredRoad

    try:
        measured = MeasuredRoad.from_profile(profile, coherence=Constant(1.0), source=source)
    except ValueError as error:
        return None, f"No spectrum: {error}."
    try:
        found = fitted_class(measured)
    except ValueError as error:
        return measured, f"No class of ISO 8608: {error}."
    line = f"Gd({REFERENCE:g} cycle/m) = {1e6 * found.roughness:.3g}e-6 m^3, waviness {found.waviness:.2f}"
    fit = f"fitted from {found.band[0]:.3g} to {found.band[1]:.3g} cycle/m"
    return measured, f"ISO 8608 class {found.road_class}: {line}, {fit}."


def spectrum_table(measured: "MeasuredRoad") -> "pd.DataFrame":
    """Return the spectrum as a table that `load_road` reads."""
    import pandas as pd

    return pd.DataFrame({"wavenumber [cycle/m]": measured.wavenumber, "psd [m^3]": measured.density})


def spread(parts: "dict[float, pd.DataFrame]") -> "pd.DataFrame":
    """Return the least, mean and largest index of segments by length, means of tracks."""
    import pandas as pd

    means = {length: part.iloc[:, 2:].mean(axis=1) for length, part in parts.items()}
    rows = [(length, len(one), one.min(), one.mean(), one.max()) for length, one in means.items()]
    headers = ["length [m]", "segments", "least [mm/m]", "mean [mm/m]", "largest [mm/m]"]
    return pd.DataFrame(rows, columns=headers).round(2)
