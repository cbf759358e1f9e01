"""Driving in time beside Runge and Kutta, python-control on a common grid, lines of spectra and random roads."""

from dataclasses import replace

import control
import numpy as np
import pytest
from hypothesis import given
from hypothesis import settings as hypothesis_settings
from hypothesis import strategies as st
from scipy import stats
from scipy.integrate import solve_ivp

from garage import FULL, HALF, QUARTER
from suspension_ctrl import Iso8608Road, Seat, load_vehicle, simulate
from suspension_ctrl.roads.coherence import Constant
from suspension_ctrl.roads.profiles import Profile
from suspension_ctrl.study.machine import single_thread

ROAD = Iso8608Road("C")
SPEED = 20.0
STEP = 0.1
SEAT = Seat(mass=70.0, spring=15e3, damper=700.0, position=(0.15, 0.35), name="driver")

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


def passed_on(
    closed: control.StateSpace, f: np.ndarray, x: np.ndarray, ahead: np.ndarray, images: int = 0
) -> np.ndarray:
    """Lines (n, m, r) of sampled responses by those of the profile under wheels at x, `ahead` [m] of a point.

    What goes through the states: H(jw) sinc^2(f dt) exp(jw x/V) at f and at its images f + i/dt. What goes
    straight through, the road under the wheel and its slope, is sampled itself, straight between the points.
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
    """The equations of motion written out, integrated to 1e-10 from point to point, the slope being constant."""
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
        at_kink[1, kinks] = (
            rates[1, kinks - 1] - rates[1, kinks]
        ) / 2  # the rear wheel is on points, the front is not
        answer = answer + closed.D[:, 2:] @ at_kink
    expected = answer[:, ::4].T
    inner = slice(1, -1)
    error = np.abs(values(found) - expected)[inner].max(axis=0) / np.abs(expected).max(axis=0)
    assert error.max() < 1e-9
    assert len(found) == 120 - 25  # the axles are 24.75 steps apart
    assert found["distance [m]"].iloc[0] == pytest.approx(1.45)  # the rear axle on the first point


def test_lines_are_those_of_the_hold_to_rounding():
    """Over a period, line by line, a response is python-control's first-order hold times the road."""
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
    """With 1/w^2 at high frequency and sinc^2 the images beyond the 12th are some 12^-3 of the first."""
    vehicle, settings = CASES["full"]
    closed, profile = vehicle.closed(settings | BAR), ROAD.profile(12.8, STEP, 4, tracks_of(vehicle))
    found = np.fft.rfft(values(simulate(closed, profile, SPEED, vehicle.contact_points, periodic=True)), axis=0)[
        1:
    ]
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
    """Parseval over the lines of this very road; images are far below what a damper wrong by 3 % does."""
    vehicle, settings = CASES[name]
    profile = ROAD.profile(51.2, STEP, 5, tracks_of(vehicle))
    found = values(simulate(vehicle.closed(settings), profile, SPEED, vehicle.contact_points, periodic=True))
    rms = np.sqrt((found**2).mean(axis=0))
    error, error_if_wrong = (
        np.sqrt(2 * (np.abs(lines(vehicle.closed(s), vehicle, profile)) ** 2).sum(axis=0)) / 512 / rms - 1
        for s in (settings, with_damper(settings, 1.03))
    )
    assert np.abs(error).max() < 3e-4
    assert np.abs(error_if_wrong).max() > 8e-3


def line_powers(vehicle, settings, road, length: float) -> np.ndarray:
    """Expected mean square (n, m) of every response in each line of a profile of this length."""
    f, x = np.arange(1, (round(length / STEP) + 1) // 2) * SPEED / length, vehicle.contact_points[:, 0]
    h = passed_on(vehicle.closed(settings), f, np.zeros(len(x)), x)  # the lead is in the cross-spectra
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
            rng, closed = np.random.default_rng([7, i]), vehicle.closed(settings)
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
    "damper": ("half", lambda v, s, road: (v, with_damper(s, 1.2), road)),
    "waviness": ("quarter", lambda v, s, road: (v, s, replace(road, waviness=2.1))),
}


@pytest.mark.parametrize("wrong", WRONG)
def test_a_wrong_model_is_found(wrong, driven):
    """Also by the scatter of 24 realisations; what is less wrong, only by the realisation's own lines."""
    name, changed = WRONG[wrong]
    powers = line_powers(*changed(*CASES[name], ROAD), LENGTH)
    assert deviation(driven[name], powers).min() < 0.01 / RESPONSES


def repeated(profile: Profile, times: int) -> Profile:
    height = np.tile(profile.height, (times, 1))
    return Profile(STEP * np.arange(len(height)), height, profile.tracks)


def test_going_round_settles_to_the_periodic_steady_state():
    """After eight rounds of 1.28 s the start has died away as the slowest mode does in that time."""
    vehicle, settings = CASES["full, damped tyres and a bar"]
    closed, profile = vehicle.closed(settings), ROAD.profile(25.6, STEP, 6, tracks_of(vehicle))
    driven_on = simulate(closed, repeated(profile, 10), SPEED, vehicle.contact_points)
    begin = driven_on["distance [m]"].iloc[0]
    assert begin == pytest.approx(1.5)
    moved = vehicle.contact_points + np.array([begin, 0.0])  # so that samples are taken at the same places
    steady = values(simulate(closed, profile, SPEED, moved, periodic=True))
    left = np.exp(closed.poles().real.max() * 8 * 1.28)
    error = np.abs(values(driven_on)[8 * 256 : 9 * 256] - steady).max(axis=0)
    assert left < 1e-7
    assert (error / np.abs(steady).max(axis=0)).max() < 100 * left


def test_finer_samples_of_the_same_road():
    """The road is straight between its points: points in between change nothing where there were some before."""
    vehicle, settings = CASES["full, damped tyres and a bar"]
    closed, profile = vehicle.closed(settings), ROAD.profile(12.8, STEP, 9, tracks_of(vehicle))
    at = np.arange(4 * 127 + 1) * STEP / 4
    fine = Profile(at, profile.at(np.minimum(at, profile.distance[-1])), profile.tracks)
    coarse, finer = (values(simulate(closed, p, SPEED, vehicle.contact_points)) for p in (profile, fine))
    size = np.abs(coarse).max(axis=0)
    np.testing.assert_allclose(finer[::4][: len(coarse)][1:] / size, coarse[1:] / size, atol=1e-9)


@given(st.integers(0, 127), st.floats(-5, 5), st.integers(0, 2**32 - 1))
@hypothesis_settings(max_examples=20)
def test_a_profile_that_is_turned_turns_the_response(points, lead, seed):
    """The steady state has no beginning, and a wheel ahead by whole steps meets the road so much earlier."""
    closed, profile = QUARTER.closed(22e3, 1500.0), ROAD.profile(12.8, STEP, seed)
    turned = Profile(profile.distance, np.roll(profile.height, -points, axis=0))
    here, there, ahead = (
        values(simulate(closed, p, SPEED, [[x, 0.0]], periodic=True))
        for p, x in ((profile, lead), (turned, lead), (profile, lead + points * STEP))
    )
    size = np.abs(here).max(axis=0)
    np.testing.assert_allclose(np.roll(here, -points, axis=0) / size, there / size, atol=1e-9)
    np.testing.assert_allclose(ahead / size, there / size, atol=1e-6)


def test_left_and_right_exchanged():
    """On the mirror image of a road a symmetric car heaves and pitches alike and rolls to the other side."""
    closed = FULL.closed(STRUTS)
    profile = ROAD.profile(25.6, STEP, 7, tracks_of(FULL))
    mirror = Profile(profile.distance, profile.height[:, ::-1], profile.tracks)
    here, there = (simulate(closed, p, SPEED, FULL.contact_points) for p in (profile, mirror))
    for name, sign in (("body", 1), ("pitch", 1), ("roll", -1)):
        column = next(c for c in here if c.startswith(f"{name}_acceleration"))
        np.testing.assert_allclose(sign * here[column], there[column], atol=1e-10)
    assert [c for c in here if "acceleration" in c] == [
        *("body_acceleration [m/s^2]", "roll_acceleration [rad/s^2]", "pitch_acceleration [rad/s^2]")
    ]


def test_rest_until_the_bump():
    """A vehicle on a level stretch at whatever height is settled, and stays so until a wheel meets the bump."""
    vehicle, settings = CASES["half, damped tyres"]
    x = STEP * np.arange(200)
    height = 3.0 + np.where((x > 10) & (x < 10.5), 0.05, 0.0)
    table = simulate(vehicle.closed(settings), Profile(x, height[:, None]), SPEED, vehicle.contact_points)
    before = table["distance [m]"] + vehicle.contact_points[:, 0].max() < 10.0 - STEP
    size = np.abs(values(table)).max(axis=0)
    assert np.abs(values(table)[before] / size).max() < 1e-9
    assert size[0] > 1.0
    assert before.sum() > 50


def test_points_of_the_body_and_other_outputs():
    closed = HALF.closed(STRUTS, responses=[("acceleration", 0.5, 0.0), "front_tyre_load"])
    profile = ROAD.profile(12.8, STEP, 8)
    columns = list(simulate(closed, profile, SPEED, HALF.contact_points))[2:]
    assert columns == ["acceleration_at_500_0_mm [m/s^2]", "front_tyre_load [N]"]
    closed.update_names(outputs=["one", "two"])
    assert list(simulate(closed, profile, SPEED, HALF.contact_points))[2:] == ["one", "two"]


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"speed": 0.0}, "speed must be finite and > 0 m/s, got 0.0"),
        ({"profile": ROAD.profile(2.5, STEP, 1)}, "profile must be longer by a step than the wheelbase of 2.7 m"),
        ({"profile": ROAD}, "profile must be a Profile or an event"),
        (
            {"profile": ROAD.profile(64.0, STEP, 1, (0.75, 0.5))},
            r"profile must reach across to y = 0 m, as by road.profile\(..., tracks=\(0,\)\), got tracks at ",
        ),
        (
            {"contact_points": [[0.0, 0.0]]},
            r"contact_points must be finite, x and y \[m\] for each of front_road, rear_road, got \[\[0.0, 0",
        ),
        ({"contact_points": [[0.0, 0.0], [np.nan, 0.0]]}, "contact_points must be finite"),
        (
            {"closed": control.tf([1], [1, 1])},
            "vehicle must be a Vehicle or StateSpace, got TransferFunction",
        ),
        (
            {"closed": control.ss(-1, 1, 1, 0, 0.1)},
            "closed must be a state-space model in continuous time, got StateSp",
        ),
        (
            {"closed": control.ss(-1, [[1, 1]], 1, 0, inputs=["a_rate", "b"])},
            r"closed must be driven by roads and their rates, got \['a_rate', 'b'\]",
        ),
        ({"closed": HALF.plant()}, "contact_points must be finite, .* front_strut"),
    ],
)
def test_rejects_what_cannot_be_driven(change, message):
    usual = {"closed": HALF.closed(STRUTS), "profile": ROAD.profile(64.0, STEP, 1), "speed": SPEED}
    with pytest.raises(ValueError, match=rf"^{message}[^\n]*$"):
        simulate(**{**usual, "contact_points": HALF.contact_points, **change})


@pytest.mark.parametrize("name", CASES)
@pytest.mark.parametrize("periodic", [False, True])
def test_a_vehicle_knows_its_contact_points(name, periodic):
    vehicle, setting = CASES[name]
    profile = ROAD.profile(12.8, STEP, 3, tracks_of(vehicle))
    here = simulate(vehicle, setting, profile, SPEED, periodic=periodic)
    there = simulate(vehicle.closed(setting), profile, SPEED, vehicle.contact_points, periodic=periodic)
    assert here.equals(there)


@pytest.mark.parametrize("periodic", [False, True])
def test_a_coarse_profile_is_refined_by_straight_interpolation(periodic):
    """To at least four points in a wave of wheel hop, some 11 Hz: six parts of half a metre at 4 m/s."""
    coarse = ROAD.profile(64.0, 0.5, 1)
    found = simulate(QUARTER, (22e3, 1500.0), coarse, 4.0, periodic=periodic)
    step = found["distance [m]"].diff().iloc[1]
    poles = np.abs(QUARTER.closed(22e3, 1500.0).poles()).max() / (2 * np.pi)
    assert step <= 4.0 / (4 * poles) < step * 7 / 6
    height = np.vstack([coarse.height, coarse.height[:1]])[:, 0]
    x = found["distance [m]"].to_numpy()
    straight = np.interp(x, 0.5 * np.arange(129), height)
    expected = simulate(QUARTER, (22e3, 1500.0), Profile(x, straight[:, None]), 4.0, periodic=periodic)
    np.testing.assert_allclose(values(found), values(expected), atol=1e-9 * np.abs(values(expected)).max())


def test_a_road_under_other_wheels_says_how_to_give_tracks():
    message = r"^profile must reach across to y = 0.75, -0.75, 0.73, -0.73 m, as by "
    with pytest.raises(ValueError, match=message) as caught:
        simulate(FULL, STRUTS, ROAD.profile(64.0, STEP, 1), SPEED)
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize("tracks", [(0.75, -0.75), (1.0, -1.0), (-0.8, 0.9, 0.4)])
def test_a_banked_road_rolls_a_car_of_two_track_widths_without_deflection(tracks):
    """It rolls with the road, also where that is rough; nearest tracks would twist it by some mm and 200 N."""
    profile = ROAD.profile(64.0, STEP, 1, tracks)
    banked = replace(profile, height=np.tile(0.05 * np.array(tracks), (len(profile.distance), 1)))
    rest = simulate(FULL, STRUTS | BAR, banked, SPEED)
    np.testing.assert_allclose(values(rest), 0, atol=1e-6)
    rough = replace(profile, height=profile.height + banked.height)
    found, expected = (values(simulate(FULL, STRUTS | BAR, one, SPEED)) for one in (rough, profile))
    assert (np.abs(found - expected).max(axis=0) <= 1e-11 * np.abs(expected).max(axis=0)).all()


@pytest.mark.parametrize("speed", [SPEED, [(0.0, 10.0), (2.0, 20.0)]], ids=["steady", "faster"])
def test_a_road_that_twists_is_met_between_its_tracks(speed):
    """Roll and height of a random road change along it: two tracks give what its values under the wheels give."""
    wide = ROAD.profile(64.0, STEP, 2, (0.9, -0.9))
    height, roll = wide.height.mean(axis=1), -np.diff(wide.height, axis=1)[:, 0] / 1.8
    own = tracks_of(FULL)
    under = Profile(wide.distance, height[:, None] + roll[:, None] * np.array(own), own)
    found, expected = (values(simulate(FULL, STRUTS | BAR, one, speed)) for one in (wide, under))
    assert (np.abs(found - expected).max(axis=0) <= 1e-11 * np.abs(expected).max(axis=0)).all()


def test_a_measured_road_of_two_tracks_is_given_to_every_track_of_a_truck():
    """A wheel on each side meets the column of its side, however far from it: as on tracks 0.1 m further out."""
    truck, measured = load_vehicle("trucksim_cab_over"), Iso8608Road("A").profile(64.0, STEP, 1, (0.9, -0.9))
    with pytest.raises(
        ValueError, match=r"y = 1.015, -1.015, 0.9443, -0.9443 m, as by .*, got tracks at \[0.9, -0.9\] m$"
    ):
        simulate(truck.vehicle, truck.setting, measured, SPEED)
    x, y = truck.vehicle.contact_points.T
    sides = sorted(set(y.tolist()))
    height = measured.height[:, [0 if side > 0 else 1 for side in sides]]
    found = simulate(truck.vehicle, truck.setting, Profile(measured.distance, height, tracks=sides), SPEED)
    at_tracks = np.column_stack([x, 0.9 * np.sign(y)])
    expected = simulate(truck.vehicle.closed(truck.setting), measured, SPEED, at_tracks)
    np.testing.assert_array_equal(found, expected)
