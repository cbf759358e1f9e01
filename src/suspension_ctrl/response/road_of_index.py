"""Roads of a given roughness index: the expected index of a Gaussian road in closed form."""

import math

import numpy as np

from .. import checks
from ..roads.coherence import Coherence, Isotropic
from ..roads.spectra import PowerLawRoad
from .roughness import BASE, SPEED, golden_car

_WAVINESS = (1.0, 4.0)
_NODES = np.geomspace(1e-4, 1e2, 20_001)  # cycle/m: beyond them less than 1e-6 of the mean square


def road_of_iri(index: float, *, waviness: float = 2.0, coherence: Coherence | None = None) -> PowerLawRoad:
    """Return the road, a power law, whose expected International Roughness Index is `index`.

    On a Gaussian road the travel of the golden car per distance is Gaussian: its mean magnitude is sqrt(2/pi)
    times its standard deviation, the root of an integral of the spectrum of slope, averaged over 250 mm, times the
    car's squared gain. The index of a finite road scatters about it. In steps of 0.1 m it is some percent lower,
    as the average is over 0.3 m there.

    Parameters
    ----------
    index : float
        In mm/m, which is m/km, > 0.
    waviness : float
        Exponent of the spectrum from 1 to 4 [-]; 2 as of the classes of ISO 8608. The index says nothing about it.
    coherence : Coherence, optional
        Model of the coherence of parallel tracks; `Isotropic` if not given.

    Examples
    --------
    An index of 2.5 mm/m is a road between class A and class B:

    >>> import suspension_ctrl as sc
    >>> road = sc.road_of_iri(2.5)
    >>> for one in (sc.Iso8608Road("A"), road, sc.Iso8608Road("B")):
    ...     print(f"{1e6 * one.psd(0.1, speed=1.0):.0f}e-6 m^3")
    16e-6 m^3
    21e-6 m^3
    64e-6 m^3
    """
    checks.positive("index", index, "mm/m")
    checks.within("waviness", waviness, *_WAVINESS)
    of_unit_road = expected_index(1.0, waviness)
    return PowerLawRoad(
        roughness=(index / of_unit_road) ** 2, exponent=float(waviness), coherence=coherence or Isotropic()
    )


def expected_index(roughness: float, waviness: float) -> float:
    """Return the expected index [mm/m] of a road of the spectrum ``roughness / n**waviness`` [m^3]."""
    n = _NODES
    gain = np.abs(golden_car()(2j * np.pi * SPEED * n)) * 2 * np.pi * n * np.sinc(n * BASE)
    mean_square = np.trapezoid(gain**2 * roughness / n**waviness * n, np.log(n))
    return 1e3 * math.sqrt(2 / math.pi * mean_square)
