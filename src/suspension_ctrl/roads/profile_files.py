"""Files of profiles: tables of distance and heights as text, ERD and OpenCRG; and the table that we write.

Whatever a file leaves open is assumed and told by a `ProfileWarning`.
"""

import warnings
from collections.abc import Sequence
from os import PathLike
from pathlib import Path

import numpy as np

from .. import checks, escaping
from ..documents import naming
from ..quantities import Real
from ..tables import read_table, write_csv
from ..tables.layouts import LARGEST
from .columns import DISTANCE, HEIGHT, TRACK_COLUMN, TRACK_WIDTH, belonging, kind_of, scaled, tracks_of, unitless
from .erd import read_erd
from .opencrg import read_opencrg
from .profiles import Profile, is_even

ERD, OPENCRG = ".erd", ".crg"
ENDINGS = (".csv", ".txt", ".tsv", ".dat", ".asc", ERD, OPENCRG)
"""Endings of files of profiles; all but the last two are tables as text."""


class ProfileWarning(UserWarning):
    r"""A profile in a file was read with an assumption: a unit, the distance of the tracks, or even steps.

    Examples
    --------
    >>> import warnings
    >>> from pathlib import Path
    >>> import suspension_ctrl as sc
    >>> _ = Path("road.txt").write_text("distance elevation\n0 0\n0.2 0.001\n0.4 0.003\n")
    >>> with warnings.catch_warnings(record=True) as caught:
    ...     warnings.simplefilter("always")
    ...     profile = sc.load_profile("road.txt")
    >>> print(caught[0].message)
    road.txt: distance, elevation without a unit are taken in m
    """


def load_profile(
    path: str | PathLike[str],
    *,
    columns: Sequence[str] | None = None,
    step: float | None = None,
    track_width: float | None = None,
    tracks: Sequence[float] | None = None,
) -> Profile:
    r"""Read a profile from a file: a table as text, ERD (``.erd``) or OpenCRG (``.crg``).

    A table as text has a column of distance and one of heights, or ``left`` and ``right``, or columns such as
    ``height at y = 0.75 m [m]``, in any order beside others, in the spelling of people: ``Distance (ft)``,
    ``chainage [km]``, ``elevation,mm``, ``LWP``. Separator, decimal sign and comment sign are found. Two columns
    without names are distance and height in metres. Uneven steps are resampled along straight lines.

    Parameters
    ----------
    path : str or path-like
        At most 100 MB.
    columns : sequence of str, optional
        Names of all columns in place of the header, or of a file without one: ``["distance [ft]", "left [in]"]``.
    step : float, optional
        Distance between two rows of a table without distances [m].
    track_width : float, optional
        Distance of ``left`` and ``right``, also on the surface of an OpenCRG file [m]; 1.5 m with a warning if not
        given.
    tracks : sequence of float, optional
        Places across the surface of an OpenCRG file, positive to the left [m], in place of `track_width`.

    Returns
    -------
    Profile

    Raises
    ------
    ValueError
        Of one line with the file, the column or row and the value; OSError if the file cannot be read.

    Warns
    -----
    ProfileWarning
        If units or the track width are assumed or steps are uneven.

    Examples
    --------
    >>> from pathlib import Path
    >>> import suspension_ctrl as sc
    >>> _ = Path("road.csv").write_text("Distance (ft);Elevation (in)\n0;0\n0,5;0,02\n1;0,05\n")
    >>> sc.load_profile("road.csv").height.round(6).tolist()
    [[0.0], [0.000508], [0.00127]]
    """
    ending, source = Path(path).suffix.lower(), str(path)
    with naming(path):
        for name, value in (("columns", columns), ("step", step)):
            if ending in (ERD, OPENCRG) and value is not None:
                raise ValueError(f"{name} must not be given for an {ending} file, got {checks.shown(value)}")
        if ending != OPENCRG and tracks is not None:
            raise ValueError(f"tracks must be given for a {OPENCRG} file only, got {checks.shown(tracks)}")
    if ending == OPENCRG:
        return _surface(path, track_width, tracks)
    if ending == ERD:
        names, values, step = read_erd(Path(path))
        chosen = [i for i in belonging(names) if kind_of(names[i]) != "distance"]
        names, values = [names[i] for i in chosen], values[:, chosen]
    else:
        names, values = read_table(path, belonging, names=columns)
    with naming(path):
        return profile_of(source, names, values, step=step, track_width=track_width)


def profile_of(
    source: str, names: Sequence[str], values: Real, *, step: float | None = None, track_width: float | None = None
) -> Profile:
    """Return the profile of a table (n, c) of columns chosen by `belonging`; of `source` for warnings."""
    if not names and values.shape[1] == (2 if step is None else 1):
        names = [DISTANCE, HEIGHT][-values.shape[1] :]
    own = bool(names) and kind_of(names[0]) == "distance"
    if step is not None:
        checks.positive("step", step, "m")
        if step > LARGEST:
            raise ValueError(f"step must be up to {LARGEST:g} m, got {checks.shown(step)}")
    if own == (step is not None) or len(names) < 1 + own:
        needed = "a distance such as 'distance [m]' and heights such as 'height [m]'"
        given = "" if step is None else ", or heights alone with a step"
        raise ValueError(f"columns must be {needed}{given}, got {checks.shown(list(names))}")
    if track_width is not None:
        checks.positive("track width", track_width, "m")
    heights = names[own:]
    tracks = tracks_of(heights, TRACK_WIDTH if track_width is None else track_width)
    _tell(source, names, track_width, sided=len(tracks) > 1 and kind_of(heights[0]) != "place")
    values = scaled(names, values)
    distance = values[:, 0] if own else float(step or 0) * np.arange(len(values), dtype=float)
    return even_profile(source, distance, values[:, own:], tracks)


def even_profile(source: str, distance: Real, height: Real, tracks: Sequence[float]) -> Profile:
    """Return the profile, resampled with a warning if its distances (n,) are uneven."""
    if is_even(distance):
        return Profile(distance, height, tuple(tracks))
    profile = Profile.from_uneven(distance, height, tracks)
    steps = np.diff(distance)
    told = f"steps of {steps.min():.6g} to {steps.max():.6g} m are resampled to {profile.step:.6g} m"
    _warn(source, told)
    return profile


def _surface(path: str | PathLike[str], track_width: float | None, tracks: Sequence[float] | None) -> Profile:
    """Return the profile of tracks across the surface of an OpenCRG file."""
    with naming(path):
        if tracks is None:
            width = TRACK_WIDTH if track_width is None else track_width
            checks.positive("track width", width, "m")
            places: Sequence[float] = (width / 2, -width / 2)
        else:
            checks.listed("tracks", tracks)
            places = list(tracks)
            if track_width is not None or not places:
                raise ValueError(f"tracks must be one or more without a track width, got {checks.shown(places)}")
            for place in places:
                checks.within("tracks", place, -100.0, 100.0)
    distance, height, modifiers = read_opencrg(Path(path), places)
    if tracks is None and track_width is None:
        _warn(str(path), f"tracks are taken {TRACK_WIDTH} m apart, as neither they nor a width is given")
    if modifiers:
        _warn(str(path), f"modifiers are not used: {', '.join(modifiers)}")
    with naming(path):
        return Profile(distance, height, tuple(places))


def _warn(source: str, note: str) -> None:
    warnings.warn(escaping.terminal(f"{source}: {note}"), ProfileWarning, stacklevel=5)


def _tell(source: str, names: Sequence[str], track_width: float | None, *, sided: bool) -> None:
    """Warn of what the headers leave open."""
    notes = []
    if bare := unitless(names):
        notes.append(f"{', '.join(bare)} without a unit are taken in m")
    if sided and track_width is None:
        notes.append(f"left and right are taken {TRACK_WIDTH} m apart, as no track width is given")
    if not sided and track_width is not None:
        raise ValueError(f"a track width goes with columns left and right only, got {checks.shown(list(names))}")
    for note in notes:
        _warn(source, note)


def save_profile(path: str | PathLike[str], profile: Profile) -> None:
    """Write a profile as CSV that `load_profile` reads to the last bit; on an error no file is written.

    Examples
    --------
    >>> import suspension_ctrl as sc
    >>> profile = sc.Iso8608Road("B").profile(length=100.0, step=0.1, seed=1)
    >>> sc.save_profile("road.csv", profile)
    >>> sc.load_profile("road.csv") == profile
    True
    """
    import pandas as pd

    names = [TRACK_COLUMN.format(np.format_float_positional(y, trim="-")) for y in profile.tracks]
    headers = [DISTANCE, *([HEIGHT] if profile.tracks == (0.0,) else names)]
    write_csv(Path(path), pd.DataFrame(np.column_stack([profile.distance, profile.height]), columns=headers))
