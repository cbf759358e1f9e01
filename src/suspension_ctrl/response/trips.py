"""Trips: steady driving in time over one period of a random road with the spectrum of a load case."""

import warnings
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from ..quantities import Complex, Real
from ..roads.profiles import Profile
from ..vehicles.assembly import ResponseName, label
from ..vehicles.vehicle import Vehicle
from . import weightings
from .driving import simulate
from .lift_off import LiftOff, LiftOffWarning
from .linearisation import LinearisedVehicle
from .load_case import LoadCase
from .quadrature import middles

if TYPE_CHECKING:
    from .measures.terms import Term

_POINTS = 16  # of the profile in its shortest wave


class Trip(NamedTuple):
    """Histories (n,) of responses over one period."""

    time_step: float  # [s]
    speed: float  # [m/s]
    band: tuple[float, float]  # of the road [Hz]
    histories: Mapping[str, Real]
    lift_off: Mapping[str, LiftOff]  # of tyres that pull on the road or leave it

    @property
    def duration(self) -> float:
        """Period [s]."""
        return self.time_step * len(next(iter(self.histories.values())))

    def of(self, names: Sequence[ResponseName]) -> Real:
        """Return histories (w, n)."""
        return np.array([self.histories[label(name)] for name in names])

    def mean_square(self, term: "Term") -> float:
        """Return the mean square of a term about its mean, weighted by the lines of the period's spectrum."""
        f, power = self._lines(label(term.response))
        factor = weightings.by_name(term.weighting).factor(f) if term.weighting else 1.0
        return float((power * factor**2 * (2 * np.pi * f) ** term.moment).sum())

    def weighted(self, term: "Term") -> Real:
        """Return the history (n,) of a term about its mean behind its weighting, in the steady state."""
        history = self.histories[label(term.response)]
        lines = np.fft.rfft(history - history.mean())
        if term.weighting:
            f = np.arange(1, lines.size) / self.duration
            lines[1:] *= weightings.by_name(term.weighting).response(f)
        return term.factor * np.fft.irfft(lines, history.size)

    def spectra(self) -> tuple[Real, dict[str, Real]]:
        """Return the middles (k,) of parts of the band, and the mean spectra (k,) of all responses in them."""
        frequency = middles(self.band)
        edges, found = np.linspace(*self.band, frequency.size + 1), {}
        # lines on the ends of the band count
        edges[[0, -1]] += np.array([-0.5, 0.5]) / self.duration
        for name in self.histories:
            f, power = self._lines(name)
            found[name] = np.histogram(f, edges, weights=power)[0] / (frequency[1] - frequency[0])
        return frequency, found

    def _lines(self, name: str) -> tuple[Real, Real]:
        """Return the frequencies (k,) above 0 Hz and the power (k,) of the lines of a response."""
        history = self.histories[name]
        power = 2 * np.abs(np.fft.rfft(history)[1:] / history.size) ** 2
        if history.size % 2 == 0:
            power[-1] /= 2
        return np.arange(1, power.size + 1) / self.duration, power


def trip(
    vehicle: Vehicle,
    setting: Mapping[str, float],
    speed: float,
    profile: Profile,
    band: tuple[float, float],
    responses: Sequence[ResponseName],
    lift_off: bool = False,
) -> Trip:
    """Drive a vehicle over one period of a profile; travel counts from the static position."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", LiftOffWarning)
        options: Any = {"periodic": True, "responses": responses, "lift_off": lift_off}
        table = simulate(vehicle, setting, profile, speed, **options)
    histories = dict(zip(map(label, responses), table[table.columns[2:]].to_numpy().T, strict=True))
    if isinstance(vehicle, LinearisedVehicle):
        for name, meaning in vehicle.meanings.items():
            if meaning.kind == "travel" and name in histories:
                histories[name] = histories[name] + vehicle.mean_travel[str(meaning.where)]
    step, lifting = float(table["time [s]"].iloc[1]), table.attrs.get("lift_off", {})
    return Trip(step, speed, band, histories, lifting)


def random_profile(case: LoadCase, band: tuple[float, float], length: float, seed: int) -> Profile:
    """Return a Gaussian profile of a load case's spectrum in a band, with a track under every wheel.

    Its period is the length [m]. The lines k/T of the band have random amplitudes with the spectrum and the
    coherence of the tracks. They are raised by 1/sinc^2, as the road that is straight between the points of the
    profile lowers them.
    """
    from scipy.fft import next_fast_len

    tracks, period = tracks_of(case.vehicle.contact_points), length / case.speed
    points = next_fast_len(int(np.ceil(_POINTS * band[1] * period)), real=True)
    lines = np.arange(max(1, int(np.ceil(band[0] * period))), int(band[1] * period) + 1)
    waves = np.zeros((points // 2 + 1, len(tracks)), dtype=complex)
    waves[lines] = points / 2 * _amplitudes(case, tracks, lines / period, period, np.random.default_rng(seed))
    waves[lines] /= np.sinc(lines[:, None] / points) ** 2
    distance = length / points * np.arange(points, dtype=float)
    return Profile(distance, np.fft.irfft(waves, points, axis=0), tracks)


def _amplitudes(
    case: LoadCase, tracks: Sequence[float], f: Real, period: float, rng: np.random.Generator
) -> Complex:
    """Return complex amplitudes (n, t) of the elevation of tracks at the lines (n,) [m]."""
    normal = rng.standard_normal((f.size, len(tracks), 2)) @ np.array([1.0, 1j])
    if len(tracks) == 1:
        return np.sqrt(case.psd(f) / period)[:, None] * normal
    road: Any = case.road
    abreast = np.column_stack([np.zeros(len(tracks)), tracks])
    variance, direction = np.linalg.eigh(road.cross_spectrum(f, case.speed, abreast))
    return np.einsum("nij,nj->ni", direction, np.sqrt(np.maximum(variance, 0.0) / period) * normal)


def tracks_of(contact_points: Real) -> tuple[float, ...]:
    """Return the different places of wheels across the road [m]."""
    return tuple(np.unique(contact_points[:, 1]).tolist())
