"""Headers of profiles: which column is what, in which unit, and where its track lies."""

import numpy as np
import pytest

from suspension_ctrl.roads.columns import (
    TRACK_COLUMN,
    Column,
    belonging,
    column,
    kind_of,
    scaled,
    tracks_of,
    unitless,
)


@pytest.mark.parametrize(
    ("header", "kind", "factor"),
    [
        ("distance [m]", "distance", 1.0),
        ("Distance (ft)", "distance", 0.3048),
        ("chainage, km", "distance", 1000.0),
        ("S", "distance", None),
        ("elevation [mm]", "height", 1e-3),
        ("Z_in", "height", 0.0254),
        ("road profile", "height", None),
        ("LWP", "left", None),
        ("Left wheelpath elevation (in)", "left", 0.0254),
        ("RElev. [in]", "right", 0.0254),
        ("rightprofile_mm", "right", 1e-3),
        ("height at y = -0.75 m [cm]", "place", 1e-2),
        ("height at y = 1e-5 m", "place", None),
    ],
)
def test_a_header_says_kind_and_unit(header, kind, factor):
    found = column(header)
    assert found[:3] == (kind, factor or 1.0, factor is not None)


@pytest.mark.parametrize(
    "header", ["time [s]", "IRI left [mm/m]", "speed", "", "[m]", "distance [kg]", "remark (x)"]
)
def test_other_columns_belong_to_no_profile(header):
    assert column(header) is None
    assert kind_of(header) == ""


def test_the_columns_of_a_profile_are_its_distance_and_then_its_heights():
    assert belonging(["LWP [m]", "time [s]", "x [m]", "z [m]", "RWP [m]", "distance [ft]"]) == [2, 0, 4]
    assert belonging(["z [m]", "x [m]"]) == [1, 0]
    assert belonging([]) == []
    assert unitless(["x [m]", "z", "speed"]) == ["z"]


def test_places_of_tracks():
    assert tracks_of(["right", "left"], 1.6) == (-0.8, 0.8)
    assert tracks_of(["left"], 1.6) == tracks_of(["z"], 1.6) == (0.0,)
    names = [TRACK_COLUMN.format(y) for y in (1.5, -0.25, 0.0)]
    assert tracks_of(names, 1.6) == (1.5, -0.25, 0.0)
    assert tracks_of(names[:1], 1.6) == (1.5,)
    for names in (["left", "z"], ["z", "z"], ["left", "right", "left"], [], ["left", "height at y = 1 m"]):
        with pytest.raises(
            ValueError, match=r"^columns of heights must be one of height, or left and right, or all"
        ):
            tracks_of(names, 1.6)


def test_values_are_scaled_column_by_column():
    assert scaled(["x [km]", "z [m]"], np.ones((2, 2))).tolist() == [[1000, 1], [1000, 1]]
    assert Column("height", 1.0, True).place == 0.0
