"""Bumps with slopes of their own: energies and spectra in closed form."""

from itertools import pairwise

import numpy as np
import pytest
from scipy.integrate import quad

import suspension_ctrl as sc


def spectrum(shape, n: float) -> float:
    """Return the magnitude [m^2] of the Fourier integral of a shape at a wavenumber [cycle/m], by pieces."""

    def part(wave):
        def f(x):
            return shape.height_at(x) * wave(2 * np.pi * n * x)

        return sum(quad(f, *piece, epsabs=1e-12)[0] for piece in pairwise(shape.places))

    return float(np.hypot(part(np.cos), part(np.sin)))


def test_the_energy_and_the_spectrum_of_a_speed_bump_are_those_of_the_closed_forms():
    bump, n = sc.SpeedBump(height=0.05, length=2.0), 0.3
    energy = quad(lambda x: bump.height_at(x) ** 2, 0.0, 2.0, epsabs=1e-12)[0]
    assert energy == pytest.approx(3 / 8 * 0.05**2 * 2.0, rel=1e-9)
    # of h sin^2(pi x/l): h l/2 sinc(n l)/(1 - (n l)^2)
    assert spectrum(bump, n) == pytest.approx(0.05 * 1.0 * np.sinc(0.6) / (1 - 0.6**2), rel=1e-9)


def test_the_spectrum_of_a_trapezoidal_bump_is_that_of_a_rectangle_averaged_over_a_flank():
    table, n = sc.TrapezoidalBump(height=0.08, length=3.0, ramp=0.9), 0.3
    assert spectrum(table, n) == pytest.approx(0.08 * 2.1 * abs(np.sinc(n * 2.1) * np.sinc(n * 0.9)), rel=1e-9)
