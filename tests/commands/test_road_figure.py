"""The picture of a measured road shows its numbers."""

import numpy as np

from suspension_ctrl import Iso8608Road, MeasuredRoad, international_roughness_index
from suspension_ctrl.commands.road_figure import road_figure


def test_profile_index_and_spectrum_are_drawn():
    profile = Iso8608Road("B").profile(400.0, 0.1, 1, (0.75, -0.75))
    index, measured = international_roughness_index(profile), MeasuredRoad.from_profile(profile)
    top, middle, bottom = road_figure(profile, index, 100.0, measured).axes
    np.testing.assert_array_equal(top.lines[1].get_ydata(), 1e3 * profile.height[:, 1])
    np.testing.assert_array_equal(
        middle.patches[0].get_data().values, index.by_segment(100.0)["IRI of track 1 [mm/m]"]
    )
    curve = bottom.lines[-1]
    np.testing.assert_array_equal(curve.get_ydata(), measured.density)
    for line, name in zip(bottom.lines, "ABCDEFG", strict=False):
        limit = Iso8608Road(name, level="upper")
        np.testing.assert_allclose(line.get_ydata(), limit.psd(line.get_xdata(), 1.0), rtol=1e-9)
    assert [axes.get_ylabel() for axes in (top, middle, bottom)] == ["elevation [mm]", "IRI [mm/m]", "PSD [m³]"]


def test_without_segments_and_spectrum_the_rest_is_drawn():
    profile = Iso8608Road("B").profile(20.0, 0.1, 1)
    _, middle, bottom = road_figure(profile, international_roughness_index(profile), None, None).axes
    assert not middle.patches
    assert len(bottom.lines) == 7
