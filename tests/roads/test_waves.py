"""Waves along the road: amplitudes, ends and wavenumbers."""

import numpy as np

import suspension_ctrl as sc


def test_waves_have_their_amplitude_and_end_at_zero():
    sine = sc.Sine(height=0.01, length=2.0, waves=1.5)
    np.testing.assert_allclose(sine.height_at([0.5, 1.5, 2.5, 3.5]), [0.01, -0.01, 0.01, 0.0], atol=1e-15)
    chirp = sc.Chirp(height=0.01, longest=4.0, shortest=1.0, waves=10.0)
    x = np.linspace(0.0, chirp.places[-1], 100_001)
    height = chirp.height_at(x)
    assert chirp.places[-1] == 16.0
    crossings = x[:-1][np.diff(np.sign(height[:-1]), append=0) != 0]
    local = 2 * np.diff(crossings)  # the wave around the middle of two crossings
    middle = (crossings[1:] + crossings[:-1]) / 2
    np.testing.assert_allclose(1 / local, 0.25 + 0.75 * middle / 16.0, rtol=0.01)  # of neighbouring crossings
