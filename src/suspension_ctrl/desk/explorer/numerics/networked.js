// Mean squares of struts with networks, of one port and of any number, at the working point of their force laws.

import { addTerms, byChannel, closed, stiffnessOf } from "./many_struts.js";
import { balance } from "./mean_position.js";
import { curvesAt, directOf, rowsOfNodes, shareOf, stiffnessAt, valuesOf } from "./network_rows.js";
import { rowsIn } from "./packed.js";
import { weightedSquare, zeroRow } from "./rows.js";
import { MOST, NEAR, dampingBeside, firstStates, improve } from "./working_point.js";

/** @typedef {import("./rows.js").Row} Row */
/** @typedef {import("./network_rows.js").Direct} Direct */
/** @typedef {import("./network_rows.js").State} State */
/**
 * Coefficients (c,), states of the laws, mean deflections (q,) of ports, and whether the point is reached.
 * @typedef {{values: Float64Array, states: State[], positions: Float64Array, reached: boolean}} Point
 */

/**
 * Find the working point of a design (v,): `close` closes the loop with the nodes, `square` gives the mean square of
 * the deflection or rate of a network's port times a share (n,).
 * @template Loop
 * @param {import("./network_rows.js").Networks} networks
 * @param {ArrayLike<number>} omega
 * @param {ArrayLike<number>} design
 * @param {(values: Float64Array, direct: Direct[], rows: (Row | null)[]) => Loop} close
 * @param {(loop: Loop, law: import("./network_rows.js").Law, share: Float64Array) => number} square
 * @returns {{point: Point, loop: Loop}}
 */
function settled(networks, omega, design, close, square) {
  const values = valuesOf(networks, design), states = firstStates(networks);
  const curves = curvesAt(networks, values), damping = dampingBeside(networks, values);
  for (let iteration = 0; ; iteration++) {
    const positions = balance(networks, curves, values, states);
    const direct = directOf(networks, values, states), rows = rowsOfNodes(networks, omega, values, direct);
    const loop = close(values, direct, rows);
    networks.laws.forEach((law, i) => {
      states[i].next = Math.sqrt(square(loop, law, shareOf(networks, omega, i, direct, rows)));
    });
    const reached = improve(networks, damping, states, iteration) < NEAR;
    if (reached || iteration === MOST - 1) return { point: { values, states, positions, reached }, loop };
  }
}

/**
 * Return the mean squares (k,) of a design around one port, see `OnePort` in response/one_port.py.
 * @param {any} port its packed fields with its `networks`
 * @param {ArrayLike<number>} design
 * @returns {{squares: Float64Array, point: Point}}
 */
export function squaresOfOnePort(port, design) {
  const omega = port.omega.data, excitation = rowsIn(port.excitation), { networks } = port;
  const root = networks.root[0];
  const { point, loop } = settled(
    networks, omega, design,
    (values, direct, rows) => gains(port, besideOf(networks, values, direct[root]), rows[root]),
    ([gain], law, share) => gain.reduce((sum, one, t) => sum + one * excitation[+law.ofRate][t] * share[t], 0),
  );
  const squares = new Float64Array(port.terms).fill(point.reached ? 0 : NaN);
  rowsIn(port.numerators).forEach((numerator, q) => {
    const gain = loop[port.power.data[q]];
    let total = 0;
    for (let t = 0; t < omega.length; t++) total += gain[t] * numerator[t];
    squares[port.term.data[q]] += total;
  });
  return { squares, point };
}

/**
 * Return direct elements with the springs, dampers and inerters beside the network of the one port.
 * @param {import("./network_rows.js").Networks} networks
 * @param {ArrayLike<number>} values
 * @param {Direct} direct
 * @returns {Direct}
 */
function besideOf({ gain, order }, values, direct) {
  /** @type {Direct} */
  const total = [...direct];
  gain.forEach((own, c) => (total[order[c]] += own[0] * values[c]));
  return total;
}

/**
 * Return |1 + c D|^-2 times 1, Re D, Im D and |D|^2, (n,) each.
 * @param {any} port
 * @param {Direct} direct
 * @param {Row | null} row
 * @returns {Float64Array[]}
 */
function gains(port, direct, row) {
  const omega = port.omega.data, [one, byRe, byIm, bySquare] = rowsIn(port.denominator);
  const found = [0, 1, 2, 3].map(() => new Float64Array(omega.length));
  for (let t = 0; t < omega.length; t++) {
    const [re, im] = stiffnessAt(direct, row, omega[t], t), size = re * re + im * im;
    const gain = 1 / (one[t] + byRe[t] * re + byIm[t] * im + bySquare[t] * size);
    [1, re, im, size].forEach((factor, i) => (found[i][t] = gain * factor));
  }
  return found;
}

/**
 * Return the mean squares (k,) of a design around any struts, see `AnyStruts` in response/any_struts.py.
 * @param {any} any its packed fields with its `networks` and the `blocks` of its struts
 * @param {ArrayLike<number>} design
 * @returns {{squares: Float64Array, point: Point}}
 */
export function squaresOfAnyStruts(any, design) {
  const { struts, networks, blocks } = any, omega = struts.omega.data, density = rowsIn(any.density);
  const added = Float64Array.from(struts.origin.data, (origin, v) => design[v] - origin);
  const { point, loop } = settled(
    networks, omega, design,
    (_, direct, rows) => {
      const own = stiffnessOfNetworks(any, direct, rows);
      return blocks.map((/** @type {any} */ block) => {
        const stiffness = stiffnessOf(block, added, struts.order.data, omega);
        own.forEach((row, t) => addNetwork(block.gains[added.length + t], row, stiffness));
        return { block, stiffness, deflections: closed(block, stiffness) };
      });
    },
    (parts, law, share) => squareAtPort(any, parts, law.network, density[+law.ofRate], share),
  );
  const found = new Float64Array(struts.channel.data.length).fill(point.reached ? 0 : NaN);
  for (const { block, stiffness, deflections } of loop) addTerms(block, stiffness, deflections, found);
  return { squares: byChannel(struts, found), point };
}

/**
 * Return the dynamic stiffness of each network beyond its nominal one.
 * @param {any} any
 * @param {Direct[]} direct
 * @param {(Row | null)[]} rows
 * @returns {Row[]}
 */
function stiffnessOfNetworks(any, direct, rows) {
  const omega = any.struts.omega.data, nominal = rowsIn(any.nominal);
  return any.networks.root.map((/** @type {number} */ root, /** @type {number} */ t) => {
    const [k, c, b, h] = direct[root], row = zeroRow(omega.length);
    /** @type {Direct} */
    const beyond = [k - nominal[t][0], c - nominal[t][1], b, h];
    for (let i = 0; i < omega.length; i++) {
      [row.re[i], row.im[i]] = stiffnessAt(beyond, rows[root], omega[i], i);
    }
    return row;
  });
}

/** @param {ArrayLike<number>} gain @param {Row} row @param {(Row | null)[]} stiffness add a row by gains (q q,) */
function addNetwork(gain, row, stiffness) {
  for (let i = 0; i < gain.length; i++) {
    if (gain[i] === 0) continue;
    const total = (stiffness[i] ??= zeroRow(row.re.length));
    for (let t = 0; t < row.re.length; t++) {
      total.re[t] += gain[i] * row.re[t];
      total.im[t] += gain[i] * row.im[t];
    }
  }
}

/**
 * Return the mean square of the deflection of a network's port, times a share (n,), with a density (n,).
 * @param {any} any
 * @param {any[]} parts
 * @param {number} network
 * @param {ArrayLike<number>} density
 * @param {Float64Array} share
 * @returns {number}
 */
function squareAtPort(any, parts, network, density, share) {
  let total = 0;
  for (const { block, deflections } of parts) {
    const gain = block.gains[any.struts.origin.data.length + network];
    for (let i = 0; i < block.q; i++) {
      const member = gain[i * block.q + i];
      for (let source = 0; member !== 0 && source < block.s; source++) {
        total += member * weightedSquare(deflections[i * block.s + source], density, share);
      }
    }
  }
  return total / any.wheels.data[network];
}
