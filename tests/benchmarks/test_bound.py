"""Random designs beside the bound in a short form: none is beyond it."""

import bound


def test_no_passive_design_is_beyond_the_bound():
    cases = bound.problems()
    assert len(cases) == 5
    for name in list(cases)[:2]:
        within, least = bound.least_ratios(*cases[name], designs=10_000, seed=2)
        assert 1.0 < least < within < 1.2
