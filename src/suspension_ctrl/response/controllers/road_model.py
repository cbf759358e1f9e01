"""Rational model of the roads under a vehicle: white noises, shaping filters, and delays from axle to axle.

Left and right tracks are the sum and the difference of uncorrelated halves in phase and out of phase, with the
spectra S (1 + gamma)/2 and S (1 - gamma)/2 by spectrum S and coherence gamma.
"""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from ...quantities import Complex, Real
from ..load_case import LoadCase
from .delays import delay, delay_error, delay_order
from .filters import Filter
from .shaping import Shaping, frequencies, shaping

FALLOFF = 10.0
"""End of the criterion's road as a multiple of the end of the band, where the rate of a road acts on a load."""
_LEAK = 0.1  # corner of leaking integrators, as a share of the least frequency
_NOTHING = 1e-9
_SAME_PLACE = 1e-6  # m


class RoadModel(NamedTuple):
    """Rates and displacements of r roads from t white noises of unit intensity: x' = A x + B w.

    Rates are ``rate x + direct w``; displacements ``displacement x`` are those of leaking integrators, zero unless
    asked for. The noises are known from the roads under the first axle: `source` and the filters' inverses.
    """

    a: Real  # (n, n)
    b: Real  # (n, t)
    rate: Real  # (r, n)
    direct: Real  # (r, t)
    displacement: Real  # (r, n)
    source: Real  # (t, r), halves of the tracks from the roads
    shapings: tuple[Shaping, ...]  # (t,)
    orders: tuple[int, ...]  # of the delays between successive axles
    delay_error: float  # largest within the band

    @classmethod
    def of(cls, case: LoadCase, band: tuple[float, float], *, falls: bool, displaced: bool) -> "RoadModel":
        """Model the roads of a load case; ValueError unless each axle has a wheel on every track.

        Their rates fall beyond the band if `falls`; displacements are known if `displaced`.
        """
        axle, side = _places(case)
        halves = _halves(case, side, frequencies(band))
        shapings = [shaping(frequencies(band), one, FALLOFF * band[1] if falls else None) for one in halves]
        first, t = axle == 0, len(halves)
        share = np.array([np.ones(side.size), side])[:t]  # of each half in each road
        delays = _delays(case, axle)
        orders = tuple(delay_order(time, band[1]) for time in delays)
        chain = [delay(time, order) for time, order in zip(delays, orders, strict=True)]
        a, b, rate, direct = _outputs([_along(one.filter, chain) for one in shapings], axle, share)
        off = [delay_error(*one, np.array([band[1]]))[0] for one in zip(delays, orders, strict=True)]
        model = cls(
            a, b, rate, direct, np.zeros_like(rate), np.where(first, share, 0.0) / first.sum(),
            tuple(shapings), orders, float(max(off, default=0.0)),
        )  # fmt: skip
        return model.integrated(2 * np.pi * _LEAK * frequencies(band)[0]) if displaced else model

    def states(self, s: Complex) -> Complex:
        """Return the states by the roads (k, n, r) at s (k,) [rad/s]."""
        inverse = np.array([1 / one.filter.response(s) for one in self.shapings])
        noise = (inverse * s).T[:, :, None] * self.source
        return np.asarray(np.linalg.solve(s[:, None, None] * np.eye(len(self.a)) - self.a, self.b @ noise))

    def integrated(self, leak: float) -> "RoadModel":
        """Return the model with leaking integrators of all rates."""
        n, r = len(self.a), len(self.rate)
        a = np.block([[self.a, np.zeros((n, r))], [self.rate, -leak * np.eye(r)]])
        return self._replace(
            a=a,
            b=np.vstack([self.b, self.direct]),
            rate=np.hstack([self.rate, np.zeros((r, r))]),
            displacement=np.hstack([np.zeros((r, n)), np.eye(r)]),
        )


def _places(case: LoadCase) -> tuple[np.ndarray, Real]:
    """Return the axle (r,), counted from the front, and the side (r,), 1, 0 or -1, of each wheel."""
    x, y = case.vehicle.contact_points.T
    starts = np.concatenate([[True], -np.diff(np.sort(x)[::-1]) > _SAME_PLACE])
    places = np.sort(x)[::-1][starts]
    axle = np.array([int(np.abs(places - one).argmin()) for one in x])
    side = np.where(np.abs(y) > _SAME_PLACE, np.sign(y), 0.0)
    sides = [sorted(set(side[axle == one].tolist())) for one in range(len(places))]
    if any(one != sides[0] for one in sides) or sides[0] not in ([0.0], [1.0], [-1.0], [-1.0, 1.0]):
        raise ValueError(f"contacts must be on one or two tracks with a wheel on each axle, got sides {sides}")
    return axle, side if len(sides[0]) == 2 else np.zeros(side.size)


def _halves(case: LoadCase, side: Real, f: Real) -> list[Real]:
    """Return the two-sided spectra (k,) of rates: of one track, or of two in phase and out of phase."""
    rate = (2 * np.pi * f) ** 2 / 2 * case.psd(f)
    if not side.any():
        return [rate]
    place, road = float(np.abs(case.vehicle.contact_points[:, 1]).mean()), case.road
    spectra = road.cross_spectrum(f, case.speed, [(0.0, place), (0.0, -place)])  # type: ignore[attr-defined]
    coherence = spectra[:, 0, 1].real / spectra[:, 0, 0].real
    halves = [rate * (1 + coherence) / 2, rate * (1 - coherence) / 2]
    return halves[:1] if (halves[1] <= _NOTHING * rate).all() else halves


def _delays(case: LoadCase, axle: np.ndarray) -> list[float]:
    """Return the times between successive axles [s]."""
    x = case.vehicle.contact_points[:, 0]
    places = [x[axle == one].mean() for one in range(axle.max() + 1)]
    return [float(time) for time in -np.diff(places) / case.speed]


def _along(first: Filter, chain: Sequence[Filter]) -> list[Filter]:
    """Return the filters to each axle of a track: one grows out of the other."""
    filters = [first]
    for one in chain:
        filters.append(filters[-1].before(one))
    return filters


def _outputs(tracks: Sequence[Sequence[Filter]], axle: np.ndarray, share: Real) -> tuple[Real, Real, Real, Real]:
    """Return A, B, C and D from the noises to the rates of the roads, by filters to each axle of each half."""
    from scipy.linalg import block_diag

    a = block_diag(*(one[-1].a for one in tracks))
    b = block_diag(*(one[-1].b[:, None] for one in tracks))
    rows = [np.array([np.pad(f.c, (0, len(one[-1].b) - len(f.c))) for f in one]) for one in tracks]
    rate = np.hstack([part * row[axle] for part, row in zip(share[:, :, None], rows, strict=True)])
    direct = np.array([[f.d for f in one] for one in tracks])[:, axle].T * share.T
    return np.asarray(a), np.asarray(b), rate, direct
