"""Chains of sections: transfer functions by python-control and by zeros and poles."""

import control
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from suspension_ctrl import weighting
from suspension_ctrl.response.controllers.filters import Filter

S = 2j * np.pi * np.geomspace(0.01, 200.0, 40)
RATES = st.lists(st.floats(0.1, 500.0), min_size=1, max_size=6)


@pytest.mark.parametrize("name", ["Wk", "Wb", "Wd", "Wf"])
def test_a_weighting_is_the_filter_of_the_standard(name):
    system = weighting(name)
    for found in (Filter.of_quotient(system.num[0][0], system.den[0][0]), Filter.of_system(control.ss(system))):
        # Roots of polynomials of degree 8, of state space by an eigenvalue problem, are accurate to some 1e-10.
        np.testing.assert_allclose(found.response(S), system(S), rtol=1e-7)


@given(RATES, st.floats(0.05, 3.0))
@settings(max_examples=20, deadline=None)
def test_zeros_and_poles_are_those_given(rates, gain):
    poles = -np.array([*rates, 7.0 + 3j, 7.0 - 3j])
    zeros = poles[: len(rates)] * 1.3
    expected = gain * np.prod(S[:, None] - zeros, axis=1) / np.prod(S[:, None] - poles, axis=1)
    found = Filter.of(zeros, poles, gain)
    np.testing.assert_allclose(found.response(S), expected, rtol=1e-9)
    assert len(found.a) == len(poles)


@given(
    st.integers(0, 3), st.integers(0, 3), st.integers(0, 3), st.integers(0, 6), st.randoms(use_true_random=False)
)
@settings(max_examples=40, deadline=None)
def test_sections_have_all_zeros_and_poles_real_or_in_pairs(pairs, reals, zero_pairs, zero_reals, rng):
    def roots(count, single):
        both = [complex(-rng.uniform(0.1, 50), rng.uniform(0.1, 90)) for _ in range(count)]
        return np.array([*both, *np.conj(both), *(-rng.uniform(0.1, 90) for _ in range(single))])

    poles = roots(pairs, reals)
    zero_pairs = min(zero_pairs, poles.size // 2)
    zeros = roots(zero_pairs, min(zero_reals, poles.size - 2 * zero_pairs))
    expected = 2.5 * np.prod(S[:, None] - zeros, axis=1) / np.prod(S[:, None] - poles, axis=1)
    found = Filter.of(zeros, poles, 2.5)
    assert len(found.a) == poles.size
    # Each of six sections solves an equation of two unknowns that are of one size at its corner.
    np.testing.assert_allclose(found.response(S), expected, rtol=1e-9)


def test_filters_follow_one_another():
    first, second = Filter.of([-1.0], [-2.0], 3.0), Filter.of([], [-5.0, -50.0], 250.0)
    chain = first.before(second)
    np.testing.assert_allclose(chain.response(S), first.response(S) * second.response(S), rtol=1e-13)
    # The states of the first filter are the first of the chain.
    np.testing.assert_array_equal(chain.a[:1, :1], first.a)


def test_a_constant_has_no_states():
    found = Filter.of(np.empty(0), np.empty(0), 0.3)
    assert len(found.a) == 0
    np.testing.assert_array_equal(found.response(S), np.full(S.size, 0.3))
