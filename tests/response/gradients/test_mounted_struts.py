"""Derivatives of blocks of two struts with linear networks beside numpy's solver at each frequency."""

import numpy as np

import struts_by_numpy
from suspension_ctrl.response.gradients import mounted_struts
from suspension_ctrl.response.gradients.wanted import Wanted

VALUES = np.array([0.7, 1.2, 0.3, 0.4])
STRUTS = struts_by_numpy.random_struts([(2, 1, 3), (2, 2, 2)], [False, False])


def test_derivatives_are_those_of_numpy():
    """A sum of mean squares, and the largest; a variable acts by its gains and by its share in the network."""
    case, (network, *changes) = struts_by_numpy.on_mounts(STRUTS, VALUES)
    wanted = Wanted(np.array([[1.0, 0.5, 0.0, 2.0], [1.0, 0.0, 3.0, 0.1]]), np.array([False, True]))
    squares, found = mounted_struts.with_slopes(case, wanted, VALUES[None])
    expected, by_network = struts_by_numpy.with_slopes(case.struts, VALUES, [network])
    slopes = by_network[:, :4].copy()
    for v, change in enumerate(changes):  # the network stands in place, and its change does not
        struts = case.struts._replace(gain=np.vstack([case.struts.gain, case.struts.gain[-1]]))
        slopes[:, v] += slope_along(struts, network, change)
    np.testing.assert_allclose(squares[0], expected, rtol=1e-12)
    products = wanted.factor[1] * expected
    largest = wanted.factor[1] * (np.arange(4) == products.argmax())
    np.testing.assert_allclose(found[0], [wanted.factor[0] @ slopes, largest @ slopes], rtol=1e-11)


def slope_along(struts, network, change):
    """Return the derivatives (k,) along a change of the network, by its factor beside that of nothing."""
    tiny = 1e-12  # changes squares by less than rounding of the derivatives
    _, slopes = struts_by_numpy.with_slopes(struts, VALUES, [network, tiny * change])
    return slopes[:, 5] / tiny


def test_laws_and_crossed_struts_have_other_ways():
    case, _ = struts_by_numpy.on_mounts(STRUTS, VALUES)
    assert mounted_struts.fits(case)
    crossed = struts_by_numpy.random_struts([(2, 1, 3), (2, 2, 2)], [True, False])
    assert not mounted_struts.fits(struts_by_numpy.on_mounts(crossed, VALUES)[0])
