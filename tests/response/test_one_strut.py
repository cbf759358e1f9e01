"""The ratio of polynomials of one strut beside the loop closed at every frequency."""

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from garage import DAMPED_QUARTER
from suspension_ctrl.response.one_strut import OneDesign, OneStrut
from suspension_ctrl.response.ports import Ports

F = np.linspace(0.3, 20.0, 40)
DENSITIES = np.random.default_rng(0).uniform(0.5, 1.5, (3, F.size))
PORTS = Ports.of(DAMPED_QUARTER, F, DAMPED_QUARTER.responses)
STRUT = OneStrut.around(PORTS, 2 * np.pi * F, DENSITIES)

springs, dampers = st.floats(1e3, 1e5), st.floats(100.0, 1e4)


@given(springs, dampers)
def test_mean_squares_are_those_of_the_closed_loop(spring, damper):
    stiffness = (spring + 2j * np.pi * F * damper)[:, None, None]
    h = PORTS.around(stiffness).h[:, :3, 0]
    expected = (DENSITIES.T * np.abs(h) ** 2).sum(axis=0)
    np.testing.assert_allclose(STRUT(np.array([[spring, damper]]))[0], expected, rtol=1e-9)


def test_each_of_an_odd_number_of_frequencies_counts_once():
    """Frequencies share a division two by two; the last of an odd number has its own."""
    design = np.array([[2e4, 1500.0]])
    for n in (1, 2, 3, 39):
        parts = [
            OneStrut.around(
                PORTS._replace(h=PORTS.h[i : i + 1]), 2 * np.pi * F[i : i + 1], DENSITIES[:, i : i + 1]
            )
            for i in range(n)
        ]
        together = OneStrut.around(PORTS._replace(h=PORTS.h[:n]), 2 * np.pi * F[:n], DENSITIES[:, :n])
        np.testing.assert_allclose(together(design), sum(part(design) for part in parts), rtol=1e-12)


@given(st.floats(1e3, 1e145), st.floats(1e2, 1e145))
def test_no_size_of_coefficients_overflows_before_its_square(spring, damper):
    """The product of two denominators holds the fourth power of a coefficient."""
    found = STRUT(np.array([[spring, damper]]))[0]
    assert np.isfinite(found).all()
    assert (found > 0).all()


@settings(max_examples=50)
@given(springs, dampers)
def test_the_compiled_loop_is_the_plain_one(spring, damper):
    """Sums and products are rounded otherwise; near a resonance of a light damper three digits cancel out."""
    design = np.array([[spring, damper]])
    plain = OneStrut.__call__.py_func(STRUT, design)
    np.testing.assert_allclose(STRUT(design), plain, rtol=1e-12)


def test_designs_are_worked_out_each_for_itself():
    designs = np.random.default_rng(1).uniform([1e3, 1e3], [1e5, 1e4], (20, 2))
    alone = np.vstack([STRUT(design[None]) for design in designs])
    for count in (20, 7, 2):
        np.testing.assert_array_equal(STRUT(designs[:count]), alone[:count])


def test_the_loop_for_one_design_after_the_other_finds_the_same_bits():
    """Of any number of numerators: it takes eight at a time."""
    designs = np.random.default_rng(2).uniform([1e3, 1e3], [1e5, 1e4], (9, 2))
    for k in (1, 2, 3):
        strut = OneStrut.around(
            PORTS._replace(h=np.delete(PORTS.h, range(k, 3), axis=1), m=k), 2 * np.pi * F, DENSITIES[:k]
        )
        np.testing.assert_array_equal(OneDesign(strut)(designs), strut(designs))


def test_a_response_that_never_moves_has_none():
    zero = PORTS._replace(h=np.concatenate([PORTS.h[:, :3] * [[[1], [0], [0]]], PORTS.h[:, 3:]], axis=1))
    strut = OneStrut.around(zero, 2 * np.pi * F, DENSITIES)
    found = strut(np.array([[2e4, 1500.0]]))[0]
    assert found[0] > 0
    np.testing.assert_array_equal(found[1:], 0.0)
