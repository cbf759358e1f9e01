"""Responses of a vehicle with its struts to a random road: frequency responses, spectra, root mean squares."""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING, Any

import numpy as np

from .. import checks
from ..quantities import Complex, Real
from ..vehicles.assembly import ResponseName, label
from ..vehicles.unit_slips import warn_of_slip
from ..vehicles.vehicle import Setting, Vehicle
from .bands import band_of
from .linearisation import linear_at
from .load_case import LoadCase, Road
from .measures.measure import MeasureLike, measure_of
from .measures.terms import CaseMeasure, Term
from .measures.vibration import RootSumSquare
from .ports import paths
from .scores import NODES, RESOLVED, Score, Scores
from .weightings import Weighting, checked

if TYPE_CHECKING:
    import control
    import pandas as pd

_ROUNDING = 1e-11  # of a sum over wheels, relative
_LOWEST = np.array([1e-3, 2e-3])  # Hz, between which a spectrum shows its power of frequency towards 0 Hz


def ride(
    vehicle: Vehicle,
    setting: Setting,
    road: Road,
    speed: float,
    *,
    weighting: "Weighting | control.LTI | None" = "Wk",
    band: tuple[float, float] | None = None,
    measures: Sequence[MeasureLike] = ("ACC", "SWS", "DTL"),
    events: Mapping[str, Any] | None = None,
) -> "pd.DataFrame":
    """Return the ride of a vehicle with its struts: measures, and the root mean square of every response.

    Parameters
    ----------
    vehicle : Vehicle
    setting : mapping of str to float or (float, float)
        Coefficients of its struts, as for ``vehicle.closed``; spring [N/m] and damper [N s/m] of a quarter car.
    road : Road
        Under one wheel any object with ``psd(f, speed)``.
    speed : float
        Vehicle speed V [m/s].
    weighting, band, measures, events
        As of `RideProblem`. Of a function of designs these are all coefficients, in the vehicle's order.

    Returns
    -------
    DataFrame
        By ``name`` the measures, then every response, unweighted; columns ``value``, ``unit`` and ``note``. A
        value whose integral diverges, or is not resolved, is NaN, and the note gives the reason.

    Examples
    --------
    >>> import suspension_ctrl as sc
    >>> file = sc.load_vehicle("yuen_ramli_2010")
    >>> road = sc.PowerLawRoad(roughness=5e-6, exponent=2.5)
    >>> table = sc.ride(file.vehicle, file.setting, road, speed=20.0)
    >>> print(table[["value", "unit"]].round(3).to_string(index_names=False))
                               value   unit
    ACC                        2.260  m/s^2
    SWS                        0.029      m
    DTL                     1365.255      N
    body_acceleration          2.991  m/s^2
    suspension_travel          0.029      m
    tyre_load               1365.255      N
    wheel_displacement           NaN      m
    wheel_velocity             0.464    m/s
    wheel_acceleration        23.632  m/s^2
    body_displacement            NaN      m
    body_velocity              0.325    m/s
    body_jerk                118.457  m/s^3
    suspension_travel_rate     0.473    m/s
    strut_force              949.774      N
    tyre_deflection            0.007      m

    From 0 Hz on the displacement on a road diverges:

    >>> table["note"]["body_displacement"]
    'diverges towards 0 Hz: begin the band above'

    Least discomfort asks for a softer damper than least tyre load:

    >>> for damper in (500.0, 1000.0, 2000.0, 3000.0):
    ...     value = sc.ride(file.vehicle, {"spring": 22e3, "damper": damper}, road, speed=20.0)["value"]
    ...     print(f"{damper:4.0f} N s/m: ACC {value['ACC']:.2f} m/s^2, DTL {value['DTL']:.0f} N")
     500 N s/m: ACC 2.17 m/s^2, DTL 2132 N
    1000 N s/m: ACC 2.08 m/s^2, DTL 1551 N
    2000 N s/m: ACC 2.50 m/s^2, DTL 1313 N
    3000 N s/m: ACC 2.99 m/s^2, DTL 1361 N
    """
    import pandas as pd

    checks.listed("measures", measures)
    checks.of_kind("vehicle", vehicle, Vehicle)
    case = LoadCase(vehicle=vehicle, road=road, speed=speed, events=events or {})
    vehicle, setting = vehicle.at(setting)
    case = replace(case, vehicle=vehicle)
    band = band_of(band, [(road, speed)])
    known = checked(weighting)
    judged = [measure_of(one) for one in measures]
    labels = {one.label for one in judged}
    judged += [RootSumSquare([Term(name)]) for name in vehicle.meanings if name not in labels]
    in_case = [one.in_case(case, known) for one in judged]
    warn_of_slip(vehicle, setting)
    signed = [Score((found,), False, one.sign) for found, one in zip(in_case, judged, strict=True)]
    scores = Scores([case], signed, [setting], list(setting), band)
    design = np.array([list(setting.values())])
    diverging = _diverging(case, setting, scores.terms[0]) if band[0] == 0 else set()
    nodes, off = _resolved(scores, design, diverging)
    notes = [_note(found, diverging, off, nodes) for found in in_case]
    values = np.where([bool(note) for note in notes], np.nan, scores.evaluate(design, nodes)[0])
    index = pd.Index([one.label for one in judged], name="name")
    return pd.DataFrame({"value": values, "unit": [one.unit for one in judged], "note": notes}, index=index)


def _diverging(case: LoadCase, setting: Setting, terms: Iterable[Term]) -> set[ResponseName]:
    """Return the responses whose spectrum rises towards 0 Hz as 1/f or faster."""
    responses = list(dict.fromkeys(term.response for term in terms))
    vehicle, setting = linear_at(case, setting, (_LOWEST[1], 20.0))
    integrals = vehicle.without_jerk(responses)
    closed = vehicle.closed(setting, responses=list(dict.fromkeys(integrals)))
    found = response_psds(closed, _LOWEST, case.cross_spectrum(_LOWEST))
    jerk = [name != one for name, one in zip(responses, integrals, strict=True)]
    spectra = np.array([found[label(one)] for one in integrals]) * np.where(jerk, _LOWEST[:, None] ** 2, 1.0).T
    rising = spectra[:, 0] >= spectra[:, 1] * _LOWEST[1] / _LOWEST[0]
    return {responses[i] for i in np.flatnonzero(rising & (spectra[:, 0] > 0))}


def _resolved(scores: Scores, design: Real, diverging: set[ResponseName]) -> tuple[int, dict[Term, float]]:
    """Return the least nodes that resolve every convergent term, and the error of each term."""
    kept = [term.response not in diverging for term in scores.terms[0]]
    for nodes in NODES:
        errors = scores.errors(design, nodes)[0]
        if (errors[kept] < RESOLVED).all():
            break
    return nodes, dict(zip(scores.terms[0], errors.tolist(), strict=True))


def _note(one: CaseMeasure, diverging: set[ResponseName], off: Mapping[Term, float], nodes: int) -> str:
    if any(term.response in diverging for term in one.terms):
        return "diverges towards 0 Hz: begin the band above"
    worst = max((off[term.integral] for term in one.terms), default=0.0)
    return "" if worst < RESOLVED else f"not resolved: {nodes} and {2 * nodes} nodes differ by {worst:.1g}"


def frequency_responses(closed: "control.LTI", f: Real, delays: Sequence[float] = (0.0,)) -> dict[str, Complex]:
    """Return H(w) (n,) by response [unit/m] to a road identical on all tracks, with r delays of the wheels [s].

    Sums below rounding are zero: the roll of a symmetric vehicle.
    """
    late = np.exp(-2j * np.pi * f[:, None] * np.asarray(delays))
    each = paths(closed, f) * late[:, None, :]
    h = each.sum(axis=2)
    h[abs(h) < _ROUNDING * abs(each).sum(axis=2)] = 0.0
    return dict(zip(closed.output_labels, h.T, strict=True))


def response_psds(closed: "control.LTI", f: Real, road: Real | Complex) -> dict[str, Real]:
    """Return the spectrum of every response, equation (3): under one wheel ``|H(w)|^2`` times the road's.

    Parameters
    ----------
    closed : control.StateSpace or control.FrequencyResponseData
        The vehicle with its struts, ``vehicle.closed(...)``.
    f : (n,) ndarray
        Frequencies in ascending order [Hz].
    road : (n,) or (n, r, r) ndarray
        One-sided spectrum of the road, under several wheels their cross-spectra [m^2/Hz].

    Returns
    -------
    dict of str to (n,) ndarray
        One-sided spectrum by response [response unit^2/Hz].

    Examples
    --------
    At the frequency (K_t/M_w)^0.5, here 10.35 Hz, the road accelerates the body by K_t/M_b per metre whatever
    the strut, an invariant point of the quarter car:

    >>> import numpy as np
    >>> import suspension_ctrl as sc
    >>> car = sc.QuarterCar(body_mass=317.5, wheel_mass=45.4, tyre_stiffness=192e3)
    >>> f = np.array([np.sqrt(192e3 / 45.4) / (2 * np.pi)])
    >>> road = sc.Iso8608Road("C").psd(f, speed=20.0)
    >>> for damper in (1000.0, 3000.0):
    ...     psd = sc.response_psds(car.closed(22e3, damper), f, road)["body_acceleration"]
    ...     print(np.sqrt(psd / road).round(2))
    [604.72]
    [604.72]
    >>> round(192e3 / 317.5, 2)
    604.72
    """
    import control

    checks.of_kind("closed", closed, control.LTI)
    f = checks.reals("f must be", f).reshape(-1)
    if not (isinstance(road, np.ndarray) and road.dtype.kind in "iufc" and road.shape[:1] == f.shape):
        raise ValueError(f"road must be an array of spectra with a row for each f, got {checks.shown(road)}")
    h = paths(closed, f)
    psd = np.einsum("nmi,nij,nmj->mn", h, road.reshape(len(f), h.shape[2], h.shape[2]), h.conj()).real
    return dict(zip(closed.output_labels, psd, strict=True))


def phase_degrees(h: Complex) -> Real:
    """Return the continuous phase (n,) [deg], beginning between -90 and 270: opposite to the road is 180."""
    phase = np.degrees(np.unwrap(np.angle(h)))
    return phase + 360 if phase[0] < -90 else phase
