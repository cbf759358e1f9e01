"""Struts of a load case as data of compiled loops, see `network_rows`."""

from collections.abc import Mapping, Sequence
from dataclasses import replace

import numpy as np
from scipy.linalg import block_diag

from ..quantities import Bool, Complex, Integer, Real
from ..vehicles.assembly import GRAVITY, Network, ResponseName
from ..vehicles.elements import MeasuredStiffness
from ..vehicles.feedback import has_states
from ..vehicles.networks import DAMPER, LAW, MEASURED, PARALLEL, SERIES, Program, elements_of
from ..vehicles.varied import Varied
from ..vehicles.vehicle import AssembledVehicle, Vehicle
from .any_struts import AnyStruts
from .blocks import Pairs, Variables, in_blocks
from .load_case import LoadCase
from .mean_position import STIFFNESS, fill_static
from .network_rows import (
    COEFFICIENT,
    DIRECT,
    LAW_OF,
    STATES,
    Networks,
    elements,
    fill_direct,
    fill_rows,
    stiffness_at,
)
from .ports import Ports
from .working_point import begin, linearise

_MIDDLE = 2.0  # Hz, at which the damping of nominal struts is taken
_ALIKE = 1e-9  # largest coupling of the halves of a symmetric vehicle


def any_struts(
    load_case: LoadCase,
    responses: Sequence[ResponseName],
    setting: Mapping[str, float],
    variables: Sequence[str],
    f: Real,
    weight: Real,
    densities: Real,
    pairs: Pairs,
) -> AnyStruts:
    """Return mean squares of responses (m,) at `f` (n,) [Hz] with quadrature weights (n,) and densities (m, n)."""
    vehicle, omega, roads = load_case.vehicle, 2 * np.pi * f, load_case.cross_spectrum(f)
    networks = networks_of(vehicle, setting, variables, f, pairs[0] != 0)
    gains, nominal = _nominal(networks, omega)
    ports = Ports.of(vehicle, f, responses, setting, gains)
    if not (_paired(vehicle.networks, pairs[0] != 0) and _alike(ports, roads, pairs)):
        pairs = np.eye(len(pairs[0])), np.eye(len(pairs[1]))
        networks = networks_of(vehicle, setting, variables, f, pairs[0] != 0)
        gains, nominal = _nominal(networks, omega)
    varied = Variables.of(vehicle.strut_coefficients, {name: setting[name] for name in variables})
    placed = np.array([np.diag(row) for row in networks.ports]).reshape(-1, *gains.shape[1:])
    both = varied._replace(gain=np.concatenate([varied.gain, placed]))
    struts = in_blocks(ports, omega, roads, densities, both, pairs)
    density = np.array([weight, omega**2 * weight])
    return AnyStruts(struts, networks, nominal, density, networks.ports.sum(axis=1).astype(float))


def _nominal(networks: Networks, omega: Real) -> tuple[Real, Real]:
    """Return gains (3, q, q), and stiffness and damping (t, 2), of nominal struts in place of the networks."""
    state, nodes = nominal_state(networks)
    middle = int(np.abs(omega - 2 * np.pi * _MIDDLE).argmin())
    w, measured = omega[middle : middle + 1], networks.measured[:, :, middle : middle + 1]
    direct, rows = np.empty((networks.row.size, DIRECT)), np.zeros((1 + networks.row.max(), 2, 1))
    fill_direct(networks, networks.setting, state, direct)
    fill_rows(networks._replace(measured=measured), w, networks.setting, direct, rows)
    loss = [stiffness_at(elements(direct, root), w[0], rows[networks.row[root]], 0)[1] for root in networks.root]
    nominal = np.column_stack([nodes[networks.root, STIFFNESS], np.array(loss) / w])
    gains = np.array([np.diag(one @ networks.ports) for one in (*nominal.T, np.zeros(len(nominal)))])
    return gains, nominal


def _paired(networks: Sequence[Network], partners: Bool) -> bool:
    """Whether each network has with a port also the opposite one, by partners (q, q)."""
    shares = [np.array(network.share) > 0 for network in networks]
    return not any(partners[share][:, ~share].any() for share in shares)


def _alike(ports: Ports, roads: Complex, pairs: Pairs) -> bool:
    """Whether sums and differences of left and right are not coupled."""
    struts, wheels = pairs
    h = struts @ ports.h[:, ports.m :] @ block_diag(wheels, struts).T
    anti, wheel = ((one < 0).any(axis=1) for one in pairs)
    return all(
        np.abs(matrix[:, odd][:, :, ~other]).max(initial=0.0) <= _ALIKE * np.abs(matrix).max()
        and np.abs(matrix[:, ~odd][:, :, other]).max(initial=0.0) <= _ALIKE * np.abs(matrix).max()
        for matrix, odd, other in ((h, anti, np.append(wheel, anti)), (wheels @ roads @ wheels.T, wheel, wheel))
    )


def networks_of(
    vehicle: Vehicle, setting: Mapping[str, float], variables: Sequence[str], f: Real, partners: Bool
) -> Networks:
    """Return the networks at `f` (n,) [Hz] around a setting; one for ports that are partners (q, q)."""
    names, q = list(setting), len(vehicle.struts)
    placed = [one for network in vehicle.networks for one in apart(network, partners)]
    program = Program.of(placed, names)
    by_name = {one.name: one for one in vehicle.strut_coefficients}
    shares = np.array([one.share for one in placed]).reshape(len(placed), q) > 0
    laws = [sum(program.kind[: root + 1] == LAW) for root in program.root]
    network = np.searchsorted(laws, np.arange(len(program.laws.of_rate)), side="right")
    flags = [program.laws.of_rate, _in_series(program), network]
    values = np.array(list(setting.values()), dtype=float)
    found = Networks(
        node=np.column_stack([program.kind, program.parts, program.coefficient, program.law]),
        ratio=program.ratio,
        row=_rows(program),
        root=program.root,
        measured=_measured(placed, f),
        laws=program.laws,
        law=np.column_stack([*flags, program.laws.power]).astype(np.int64),
        square=_totals(program)[program.law >= 0],
        setting=values,
        variable=np.array([names.index(name) for name in variables], dtype=np.int64),
        gain=np.array([by_name[name].gain for name in names]),
        order=np.array([by_name[name].order for name in names]),
        weight=np.array([GRAVITY * (isinstance(vehicle, Varied) and name in vehicle.loading) for name in names]),
        ports=shares,
        port=shares.argmax(axis=1),
        compliance=np.zeros((q, q)),
        nominal=np.zeros((q, q)),
        sag=np.zeros(q),
        same_damping=True,
    )
    found = found._replace(same_damping=_same_damping(found))
    return _statics(found, vehicle, setting, values)


def _same_damping(networks: Networks) -> bool:
    """Return whether no variable changes a curve, a damper or a part of a network."""
    variable, laws = networks.variable, networks.laws
    parts = np.concatenate([networks.node[:, COEFFICIENT:LAW_OF].ravel(), laws.by.ravel(), laws.power.ravel()])
    beside = (networks.order == DAMPER) & networks.gain.any(axis=(1, 2))
    return not (np.isin(variable, parts) | beside[variable]).any()


def _statics(networks: Networks, vehicle: Vehicle, setting: Mapping[str, float], values: Real) -> Networks:
    """Return the networks with static compliance, and deflections by payload."""
    _, nodes = nominal_state(networks)
    added = np.diag(nodes[networks.root, STIFFNESS] @ networks.ports)
    nominal = np.tensordot(values * (networks.order == 0), networks.gain, 1) + added
    own = vehicle.vehicle.struts if isinstance(vehicle, Varied) else vehicle.struts  # without ports of parameters
    if (slack := np.diag(nominal)[: len(own)] <= 0).any():
        got = f"none at {vehicle.struts[int(slack.argmax())] or 'the wheel'}"
        raise ValueError(f"struts must have a spring that carries the vehicle, got {got}")
    lowest = 0.0
    plant = vehicle.bare(vehicle.responses[:1])
    if not has_states(plant):
        lowest = plant.omega[0] / (2 * np.pi)
    gains = np.pad(added[None], ((0, 2), (0, 0), (0, 0)))
    ports = Ports.of(vehicle, np.array([lowest]), vehicle.responses[:1], setting, gains)
    compliance = np.ascontiguousarray(ports.h[0, ports.m :, ports.r :].real)
    return networks._replace(compliance=compliance, nominal=nominal, sag=_sag(vehicle, nominal))


def nominal_state(networks: Networks) -> tuple[Real, Real]:
    """Return the first state of laws (l, 8), and of nodes (m, 3) at 0 Hz, at the setting."""
    laws, values = networks.laws, networks.setting
    curve, state = np.empty(laws.number.shape[:3]), np.zeros((len(laws.most), STATES))
    nodes = np.empty((networks.ratio.size, 3))
    begin(networks.law, laws, values, curve, state)
    linearise(networks.law, laws.most, curve, values, state)
    fill_static(networks, values, state, nodes)
    return state, nodes


def _sag(vehicle: Vehicle, stiffness: Real) -> Real:
    """Return the deflections (q,) by the payload on springs of a stiffness (q, q)."""
    if not isinstance(vehicle, AssembledVehicle):
        return np.zeros(len(stiffness))
    assembly = vehicle.assembly
    load = assembly.weights - replace(assembly, payload=()).weights
    links = [*assembly.tyres, *assembly.supports]
    e, _ = assembly.elongations(links)
    p, _ = assembly.elongations(assembly.struts)
    tyre = e.T * [link.stiffness for link in links] @ e
    return np.asarray(p @ np.linalg.solve(tyre + p.T @ stiffness @ p, -GRAVITY * load))


def apart(network: Network, partners: Bool) -> list[Network]:
    """Return a network for each group of its ports that are partners (q, q), of each axle for left and right."""
    groups = (partners * np.array(network.share))[np.flatnonzero(network.share)]
    return [network._replace(share=share) for share in dict.fromkeys(map(tuple, groups.tolist()))]


def _measured(networks: Sequence[Network], f: Real) -> Real:
    """Return storage and loss stiffness (x, 2, n) of measured elements at frequencies (n,)."""
    found = np.empty((0, 2, f.size))
    for _, one in elements_of(networks, MeasuredStiffness):
        rows = np.array([np.interp(f, one.frequency, one.storage), np.interp(f, one.frequency, one.loss)])
        found = np.concatenate([found, rows[None]])
    return found


def _in_series(program: Program) -> Bool:
    """Return whether each law (l,) is part of a series."""
    series = [any(program.kind[above] == SERIES for above in _chain(program, i)) for i in range(len(program.kind))]
    return np.array(series, dtype=bool)[program.law >= 0]


def _rows(program: Program) -> Integer:
    """Return the row (m,) of each node: of its own for parts in series or by a table, 0 without any."""
    own = np.isin(program.kind, (MEASURED, SERIES))
    for i in np.flatnonzero(program.kind == PARALLEL):
        own[i] = own[program.parts[i]].any()
    return np.where(own, np.cumsum(own), 0)


def _totals(program: Program) -> Real:
    """Return the product (m,) of the squared installation ratios of each node and all above."""
    totals = [np.prod(program.ratio[_chain(program, i)]) ** 2 for i in range(len(program.kind))]
    return np.array(totals, dtype=float)


def _chain(program: Program, node: int) -> list[int]:
    """Return a node and all above it."""
    chain = [node]
    for above in range(node + 1, len(program.kind)):
        if chain[-1] in program.parts[above]:
            chain.append(above)
    return chain
