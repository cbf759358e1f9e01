"""Driving in time beside Runge and Kutta, python-control on a common grid, lines of a spectrum and random roads."""

from dataclasses import replace

import control
import numpy as np
import pytest
from hypothesis import given
from hypothesis import settings as hypothesis_settings
from hypothesis import strategies as st
from scipy import stats
from scipy.integrate import solve_ivp

from suspension_ctrl import FullCar, HalfCar, Iso8608Road, QuarterCar, Seat, simulate
from suspension_ctrl.coherence import Constant
from suspension_ctrl.environment import single_thread
from suspension_ctrl.profiles import Profile

ROAD = Iso8608Road("C")
SPEED = 20.0
STEP = 0.1
SEAT = Seat(mass=70.0, spring=15e3, damper=700.0, position=(0.15, 0.35), name="driver")

QUARTER = QuarterCar(body_mass=317.5, wheel_mass=45.4, tyre_stiffness=192e3)
HALF = HalfCar(
    body_mass=700.0, pitch_inertia=1100.0, front_wheel_mass=40.0, rear_wheel_mass=44.0, front_tyre_stiffness=190e3,
    rear_tyre_stiffness=200e3, cg_to_front=1.13, cg_to_rear=1.44,
)  # fmt: skip
FULL = FullCar(
    body_mass=1350.0, roll_inertia=520.0, pitch_inertia=2100.0, front_wheel_mass=40.0, rear_wheel_mass=44.0,
    front_tyre_stiffness=190e3, rear_tyre_stiffness=200e3, cg_to_front=1.13, cg_to_rear=1.44, front_track=1.52,
    rear_track=1.46,
)  # fmt: skip
TYRES = {"front_tyre_damping": 150.0, "rear_tyre_damping": 120.0}
STRUTS = {"front": (20e3, 1500.0), "rear": (24e3, 1700.0)}
BAR = {"front_antiroll": 9e3}
CASES = {
    "quarter": (SEAT.on(QUARTER), {"spring": 22e3, "damper": 1500.0}),
    "quarter, damped tyre": (SEAT.on(replace(QUARTER, tyre_damping=150.0)), {"spring": 22e3, "damper": 1500.0}),
    "half": (SEAT.on(HALF), STRUTS),
    "half, damped tyres": (SEAT.on(replace(HALF, **TYRES)), STRUTS),
    "full": (SEAT.on(FULL), STRUTS),
    "full, damped tyres and a bar": (SEAT.on(replace(FULL, **TYRES)), STRUTS | BAR),
}
RESPONSES = sum(len(vehicle.responses) for vehicle, _ in CASES.values())


@pytest.fixture(autouse=True)
def _one_thread():
    with single_thread():
        yield


def tracks_of(vehicle) -> tuple[float, ...]:
    return tuple(np.unique(vehicle.contact_points[:, 1]))


def passed_on(closed: control.StateSpace, f: np.ndarray, x: np.ndarray, ahead: np.ndarray, images: int = 0) -> np.ndarray:
    """Lines (n, m, r) of sampled responses by those of the profile under wheels at x, `ahead` [m] of a point.

    What goes through the states: H(jw) sinc^2(f dt) exp(jw x/V) at f and at its images f + i/dt. What goes straight
    through, the road under the wheel and its slope, is sampled itself, straight between the points.
    """
    dt, r = STEP / SPEED, len(x)
    d, e = closed.D[:, :r], closed.D[:, r:] if closed.ninputs > r else 0 * closed.D
    total = 0
    for image in range(-images, images + 1):
        s = 2j * np.pi * (f + image / dt)
        s = np.where(s == 0, 1e-9, s)[:, None, None]
        h = np.array([closed(one, squeeze=False) for one in s.ravel()])
        h = h[:, :, :r] + (s * h[:, :, r:] if closed.ninputs > r else 0) - d - s * e
        total = total + h * np.sinc(dt * (f + image / dt))[:, None, None] ** 2 * np.exp(s * x / SPEED)
    share = np.round(ahead / STEP % 1, 9) % 1
    w = 2j * np.pi * f[:, None] * dt
    rise = np.where(share == 0, np.sinh(w), np.exp(-share * w) * (np.exp(w) - 1)) / dt
    elevation = (1 - share) * np.exp(-share * w) + share * np.exp((1 - share) * w)
    return total + (d * elevation[:, None] + e * rise[:, None]) * np.exp(w * x / STEP)[:, None]


def values(table) -> np.ndarray:
    """Responses (k, m)."""
    return table.iloc[:, 2:].to_numpy()


def heights_under(profile: Profile, vehicle) -> np.ndarray:
    """The track of each wheel (n, r), in the order of the contact points."""
    return profile.height[:, [profile.tracks.index(y) for y in vehicle.contact_points[:, 1]]]


@pytest.mark.parametrize("damping", [0.0, 300.0])
def test_single_wheel_beside_runge_and_kutta(damping):
    """The equations of motion written out, integrated to 1e-10 from point to point, where the slope is constant."""
    car = replace(QUARTER, tyre_damping=damping)
    m_b, m_w, k_t, k, c = 317.5, 45.4, 192e3, 22e3, 1500.0
    profile = ROAD.profile(6.0, STEP, 1)
    h, dt = profile.height[:, 0], STEP / SPEED
    slope = np.append(np.diff(h), np.nan) / dt
    at_kinks = (slope + np.append(0.0, slope[:-1])) / 2  # before the first point the road is level

    def motion(t, z, start, i):
        road = h[i] + slope[i] * (t - start)
        strut = k * (z[2] - z[0]) + c * (z[3] - z[1])
        tyre = k_t * (z[0] - road) + damping * (z[1] - slope[i])
        return [z[1], (strut - tyre) / m_w, z[3], -strut / m_b]

    z, expected = np.array([h[0], 0.0, h[0], 0.0]), []
    for i in range(h.size - 1):
        strut = k * (z[2] - z[0]) + c * (z[3] - z[1])
        load = k_t * (z[0] - h[i]) + damping * (z[1] - at_kinks[i])
        expected.append([-strut / m_b, z[2] - z[0], load])
        z = solve_ivp(motion, (i * dt, (i + 1) * dt), z, rtol=1e-10, atol=1e-12, args=(i * dt, i)).y[:, -1]
    found = simulate(car.closed(k, c), profile, SPEED)
    np.testing.assert_allclose(values(found)[:-1], expected, rtol=1e-6, atol=1e-8)
    assert list(found) == [
        *("time [s]", "distance [m]", "body_acceleration [m/s^2]", "suspension_travel [m]", "tyre_load [N]")
    ]
    np.testing.assert_allclose(found["time [s]"], dt * np.arange(60), rtol=1e-14)
    np.testing.assert_allclose(found["distance [m]"], profile.distance, atol=1e-14)


@pytest.mark.parametrize("damped", [False, True])
def test_several_wheels_beside_python_control_on_a_common_grid(damped):
    """Axles 10.25 and 14.5 steps from the origin pass points of a grid four times as fine together.

    There elevations, straight in between, go through ``control.forced_response``, rates, held in between, through
    the zero-order hold of ``control.sample_system``: both exact, so that rounding alone is left.
    """
    car = replace(HALF, cg_to_front=1.025, cg_to_rear=1.45, **(TYRES if damped else {}))
    closed = car.closed(STRUTS)
    profile = ROAD.profile(12.0, STEP, 2)
    found = simulate(closed, profile, SPEED, car.contact_points)
    leads, dt = [99, 0], STEP / SPEED / 4
    fine = profile.at(np.minimum(np.arange(4 * 120) * STEP / 4, profile.distance[-1]))[:, 0]
    k = 4 * (len(found) - 1) + 1
    z = np.array([fine[lead : lead + k] for lead in leads])
    rates = np.array([np.diff(fine, append=fine[-1])[lead : lead + k] for lead in leads]) / dt
    elevations = closed[:, :2]
    at_rest = -np.linalg.solve(closed.A, elevations.B @ z[:, 0])
    answer = control.forced_response(elevations, dt * np.arange(k), z, at_rest).outputs
    if damped:
        held = control.sample_system(closed[:, 2:], dt, "zoh")
        answer = answer + control.forced_response(held, inputs=rates).outputs
        kinks = 4 * np.arange(1, k // 4)
        at_kink = np.zeros_like(rates)
        at_kink[1, kinks] = (rates[1, kinks - 1] - rates[1, kinks]) / 2  # the rear wheel is on points, the front is not
        answer = answer + closed.D[:, 2:] @ at_kink
    expected = answer[:, ::4].T
    inner = slice(1, -1)
    error = np.abs(values(found) - expected)[inner].max(axis=0) / np.abs(expected).max(axis=0)
    assert error.max() < 1e-9
    assert len(found) == 120 - 25  # the axles are 24.75 steps apart
    assert found["distance [m]"].iloc[0] == pytest.approx(1.45)  # the rear axle on the first point


def test_lines_are_those_of_the_hold_to_rounding():
    """Over a period, line by line, a wheel's response is that of python-control's first-order hold times the road's."""
    closed, profile = QUARTER.closed(22e3, 1500.0), ROAD.profile(51.2, STEP, 3)
    found = np.fft.rfft(values(simulate(closed, profile, SPEED, periodic=True)), axis=0)
    road = np.fft.rfft(profile.height, axis=0)
    z = np.exp(2j * np.pi * np.arange(len(road)) / 512)
    h = control.sample_system(closed, STEP / SPEED, "foh")(z, squeeze=False)[:, 0].T
    np.testing.assert_allclose(found, h * road, atol=1e-10 * np.abs(found).max(axis=0).min())


def lines(closed, vehicle, profile: Profile, images: int = 0) -> np.ndarray:
    """Lines (n, m) of the responses to a profile, without that at zero."""
    road, x = np.fft.rfft(heights_under(profile, vehicle), axis=0)[1:], vehicle.contact_points[:, 0]
    f = np.arange(1, len(road) + 1) * SPEED / (STEP * profile.distance.size)
    return np.einsum("nmr,nr->nm", passed_on(closed, f, x, x, images), road)


def test_lines_are_those_of_the_frequency_response():
    """With 1/w^2 at high frequency and sinc^2 the images beyond the 12th leave out some 12^-3 of what the first has."""
    vehicle, settings = CASES["full"]
    closed, profile = vehicle.closed(settings | BAR), ROAD.profile(12.8, STEP, 4, tracks_of(vehicle))
    found = np.fft.rfft(values(simulate(closed, profile, SPEED, vehicle.contact_points, periodic=True)), axis=0)[1:]
    size = np.abs(found).max(axis=0)
    few, many = (np.abs(lines(closed, vehicle, profile, n) - found).max(axis=0) / size for n in (3, 12))
    assert many.max() < 1e-5
    assert (many < few / 10).all()


def with_damper(settings, factor: float):
    """The settings with all dampers of the axles times a factor."""
    def changed(name, value):
        if isinstance(value, tuple):
            return (value[0], factor * value[1])
        return factor * value if name == "damper" else value

    return {name: changed(name, value) for name, value in settings.items()}


@pytest.mark.parametrize("name", CASES)
def test_rms_of_a_realisation_is_that_of_its_own_lines(name):
    """Parseval over the lines of this very road: without images what is left is far below a damper wrong by 3 %."""
    vehicle, settings = CASES[name]
    profile = ROAD.profile(51.2, STEP, 5, tracks_of(vehicle))
    found = values(simulate(vehicle.with_struts(settings), profile, SPEED, vehicle.contact_points, periodic=True))
    rms = np.sqrt((found**2).mean(axis=0))
    error, error_if_wrong = (
        np.sqrt(2 * (np.abs(lines(vehicle.with_struts(s), vehicle, profile)) ** 2).sum(axis=0)) / 512 / rms - 1
        for s in (settings, with_damper(settings, 1.03))
    )
    assert np.abs(error).max() < 3e-4
    assert np.abs(error_if_wrong).max() > 8e-3


def line_powers(vehicle, settings, road, length: float) -> np.ndarray:
    """Expected mean square (n, m) of every response in each line of a profile of this length."""
    f, x = np.arange(1, (round(length / STEP) + 1) // 2) * SPEED / length, vehicle.contact_points[:, 0]
    h = passed_on(vehicle.with_struts(settings), f, np.zeros(len(x)), x)  # the lead is in the cross-spectra
    spectra = road.cross_spectrum(f, SPEED, vehicle.contact_points) * SPEED / length
    return np.einsum("nmi,nij,nmj->nm", h, spectra, h.conj()).real


def deviation(mean_squares: np.ndarray, powers: np.ndarray) -> np.ndarray:
    """Probability (m,) of a mean of mean squares (R, m) so far or farther from the expectation, on either side.

    Amplitudes are complex normal, so that each line has an exponential mean square, whose standard deviation is
    its mean, and R realisations of all lines the variance sum p^2/R. The distribution is taken as that chi-square
    over its degrees of freedom which has this variance (Welch and Satterthwaite).
    """
    freedom = 2 * len(mean_squares) * powers.sum(axis=0) ** 2 / (powers**2).sum(axis=0)
    quotient = mean_squares.mean(axis=0) / powers.sum(axis=0) * freedom
    return 2 * np.minimum(stats.chi2.cdf(quotient, freedom), stats.chi2.sf(quotient, freedom))


LENGTH, REALISATIONS = 102.4, 24


@pytest.fixture(scope="module")
def driven() -> dict[str, np.ndarray]:
    """Mean squares (R, m) of every response, by case."""
    found = {}
    with single_thread():
        for i, (name, (vehicle, settings)) in enumerate(CASES.items()):
            rng, closed = np.random.default_rng([7, i]), vehicle.with_struts(settings)
            profiles = (ROAD.profile(LENGTH, STEP, rng, tracks_of(vehicle)) for _ in range(REALISATIONS))
            tables = (simulate(closed, p, SPEED, vehicle.contact_points, periodic=True) for p in profiles)
            found[name] = np.array([(values(table) ** 2).mean(axis=0) for table in tables])
    return found


@pytest.mark.parametrize("name", CASES)
def test_rms_over_realisations_is_that_of_the_spectrum(name, driven):
    """Every response of every vehicle, all at once at a level of 1 % (Bonferroni)."""
    vehicle, settings = CASES[name]
    powers = line_powers(vehicle, settings, ROAD, LENGTH)
    assert deviation(driven[name], powers).min() > 0.01 / RESPONSES
    scatter = driven[name].std(axis=0, ddof=1) / np.sqrt((powers**2).sum(axis=0))
    assert ((scatter > 0.4) & (scatter < 2.0)).all()  # of 24 numbers, rather skewed ones: about 1 to a quarter


WRONG = {
    "no coherence": ("full", lambda v, s, road: (v, s, replace(road, coherence=Constant(0.0)))),
    "full coherence": ("full", lambda v, s, road: (v, s, replace(road, coherence=Constant(1.0)))),
    "wheelbase": ("half", lambda v, s, road: (SEAT.on(replace(HALF, cg_to_rear=1.0)), s, road)),
    "damper": ("half", lambda v, s, road: (v, with_damper(s, 1.4), road)),
    "undamped tyre": ("quarter, damped tyre", lambda v, s, road: (CASES["quarter"][0], s, road)),
    "no bar": ("full, damped tyres and a bar", lambda v, s, road: (v, STRUTS, road)),
    "speed": ("quarter", lambda v, s, road: (v, s, replace(road, waviness=2.1))),
}


@pytest.mark.parametrize("wrong", WRONG)
def test_a_wrong_model_is_found(wrong, driven):
    name, changed = WRONG[wrong]
    powers = line_powers(*changed(*CASES[name], ROAD), LENGTH)
    print(wrong, deviation(driven[name], powers).min(), 0.01/RESPONSES)
    assert deviation(driven[name], powers).min() < 0.01 / RESPONSES
