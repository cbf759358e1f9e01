// Networks of struts: dynamic stiffness of their nodes, and the share of a force law in the deflection.
//
// The dynamic stiffness of a node is that of its direct elements plus a row of its elements in series, and of those
// known by a table, see response/network_rows.py.

import { rowsIn } from "./packed.js";
import { complexRows, zeroRow } from "./rows.js";

/** @typedef {import("./rows.js").Row} Row */
/** @typedef {import("./gaussian.js").Curve} Curve */
/** @typedef {[number, number, number, number]} Direct stiffness, damping, inertance and loss stiffness */
/** @typedef {{kind: number, parts: number[], coefficient: number[], law: number, ratio: number, row: number}} Node */
/** @typedef {{ofRate: boolean, inSeries: boolean, network: number, power: number[], square: number}} Law */
/**
 * Working point of a law, see `STATES` in response/network_rows.py.
 * @typedef {Record<"deviation" | "mean" | "force" | "slope" | "change" | "before" | "step" | "next", number>} State
 */
/**
 * Networks with q ports, t networks and c coefficients.
 * @typedef {object} Networks
 * @property {Node[]} nodes
 * @property {Law[]} laws
 * @property {any} curves packed numbers of the curves of the laws
 * @property {number[]} root (t,) last node of each network
 * @property {Row[]} measured
 * @property {ArrayLike<number>} setting (c,)
 * @property {ArrayLike<number>} variable (v,) the coefficient of each variable
 * @property {ArrayLike<number>[]} gain (c) of (q q)
 * @property {ArrayLike<number>} order (c,)
 * @property {ArrayLike<number>} weight (c,) [N]
 * @property {ArrayLike<number>[]} ports (t) of (q,)
 * @property {ArrayLike<number>} port (t,)
 * @property {ArrayLike<number>[]} compliance (q) of (q,)
 * @property {ArrayLike<number>[]} nominal (q) of (q,)
 * @property {ArrayLike<number>} sag (q,)
 */

// Kinds of nodes, see `Program` in vehicles/networks.py.
export const SPRING = 0, DAMPER = 1, INERTER = 2, RUBBER = 3, MEASURED = 4, LAW = 5, PARALLEL = 6, SERIES = 7;

/**
 * Return networks of their packed fields.
 * @param {any} packed
 * @returns {Networks}
 */
export function networksOf(packed) {
  const nodes = rowsIn(packed.node).map(([kind, one, other, first, second, law], i) => ({
    kind, parts: [one, other], coefficient: [first, second], law,
    ratio: packed.ratio.data[i], row: packed.row.data[i],
  }));
  const laws = rowsIn(packed.law).map(([ofRate, chained, network, factor, exponent], i) => ({
    ofRate: ofRate > 0, inSeries: chained > 0, network, power: [factor, exponent], square: packed.square.data[i],
  }));
  return {
    nodes, laws, curves: packed.laws, root: Array.from(packed.root.data), measured: complexRows(packed.measured),
    setting: packed.setting.data, variable: packed.variable.data, gain: rowsIn(packed.gain),
    order: packed.order.data, weight: packed.weight.data, ports: rowsIn(packed.ports), port: packed.port.data,
    compliance: rowsIn(packed.compliance), nominal: rowsIn(packed.nominal), sag: packed.sag.data,
  };
}

/**
 * Return the coefficients (c,) of a design (v,).
 * @param {Networks} networks
 * @param {ArrayLike<number>} design
 * @returns {Float64Array}
 */
export function valuesOf(networks, design) {
  const values = Float64Array.from(networks.setting);
  for (let v = 0; v < networks.variable.length; v++) values[networks.variable[v]] = design[v];
  return values;
}

/**
 * Return the curve of each law at these coefficients.
 * @param {Networks} networks
 * @param {ArrayLike<number>} values
 * @returns {Curve[]}
 */
export function curvesAt({ laws, curves }, values) {
  const width = curves.number.shape[2];
  const numbers = rowsIn(curves.number), by = rowsIn(curves.by);
  return laws.map((_, law) => {
    const [knots, slopes, jumps] = [0, 1, 2].map((part) =>
      Float64Array.from({ length: width }, (_unused, i) => {
        const at = 2 * (part * width + i);
        let factor = numbers[law][at + 1];
        for (const which of by[law].subarray(at, at + 2)) if (which >= 0) factor *= values[which];
        return numbers[law][at] + factor;
      }),
    );
    return { count: curves.most.data[law], knots, slopes, jumps };
  });
}

/**
 * Return the direct elements of every node, as its deflection is at the node above it.
 * @param {Networks} networks
 * @param {ArrayLike<number>} values
 * @param {State[]} states
 * @returns {Direct[]}
 */
export function directOf({ nodes, laws }, values, states) {
  /** @type {Direct[]} */
  const direct = [];
  for (const { kind, parts, coefficient, law, ratio } of nodes) {
    /** @type {Direct} */
    const own = [0, 0, 0, 0];
    if (kind === PARALLEL) own.forEach((_, j) => (own[j] = direct[parts[0]][j] + direct[parts[1]][j]));
    else if (kind === LAW) own[laws[law].ofRate ? DAMPER : SPRING] = states[law].slope;
    else if (kind === RUBBER) [own[0], own[3]] = [values[coefficient[0]], values[coefficient[1]]];
    else if (kind <= INERTER) own[kind] = values[coefficient[0]];
    direct.push(/** @type {Direct} */ (own.map((value) => ratio * ratio * value)));
  }
  return direct;
}

/**
 * Return the row of every node by the direct elements; null of a node with direct elements alone.
 * @param {Networks} networks
 * @param {ArrayLike<number>} omega
 * @param {ArrayLike<number>} values
 * @param {Direct[]} direct
 * @returns {(Row | null)[]}
 */
export function rowsOfNodes({ nodes, measured }, omega, values, direct) {
  /** @type {(Row | null)[]} */
  const rows = [];
  for (const { kind, parts, coefficient, ratio, row } of nodes) {
    const square = ratio * ratio, [one, other] = parts;
    if (row === 0) rows.push(null);
    else if (kind === MEASURED) rows.push(scaled(square * values[coefficient[0]], measured[coefficient[1]]));
    else if (kind === PARALLEL) rows.push(sum(square, rows[one], rows[other], omega.length));
    else rows.push(inSeries(square, omega, [direct[one], rows[one]], [direct[other], rows[other]]));
  }
  return rows;
}

/** @param {number} factor @param {Row} row @returns {Row} the row times a factor */
function scaled(factor, row) {
  return { re: row.re.map((value) => factor * value), im: row.im.map((value) => factor * value) };
}

/** @param {number} factor @param {Row | null} one @param {Row | null} other @param {number} n @returns {Row} */
function sum(factor, one, other, n) {
  const total = zeroRow(n);
  for (const row of [one, other]) {
    for (let t = 0; row && t < n; t++) {
      total.re[t] += factor * row.re[t];
      total.im[t] += factor * row.im[t];
    }
  }
  return total;
}

/**
 * Return real and imaginary part of the dynamic stiffness of a node at a frequency w, the t-th.
 * @param {Direct} direct
 * @param {Row | null} row
 * @param {number} w
 * @param {number} t
 * @returns {[number, number]}
 */
export function stiffnessAt([k, c, b, h], row, w, t) {
  return [k - b * (w * w) + (row ? row.re[t] : 0), h + c * w + (row ? row.im[t] : 0)];
}

/**
 * Return a b/(a + b) of two nodes in series, times the square of an installation ratio.
 * @param {number} square
 * @param {ArrayLike<number>} omega
 * @param {[Direct, Row | null]} one
 * @param {[Direct, Row | null]} other
 * @returns {Row}
 */
function inSeries(square, omega, one, other) {
  const row = zeroRow(omega.length);
  for (let t = 0; t < omega.length; t++) {
    const [a, b] = stiffnessAt(...one, omega[t], t), [c, d] = stiffnessAt(...other, omega[t], t);
    const real = a + c, imaginary = b + d, re = a * c - b * d, im = a * d + b * c;
    const factor = square / (real * real + imaginary * imaginary);
    row.re[t] = factor * (re * real + im * imaginary);
    row.im[t] = factor * (im * real - re * imaginary);
  }
  return row;
}

/**
 * Return |own deflection over deflection of the port|^2 (n,) of a law.
 * @param {Networks} networks
 * @param {ArrayLike<number>} omega
 * @param {number} law
 * @param {Direct[]} direct
 * @param {(Row | null)[]} rows
 * @returns {Float64Array}
 */
export function shareOf({ nodes, laws }, omega, law, direct, rows) {
  const share = new Float64Array(omega.length).fill(laws[law].square);
  if (!laws[law].inSeries) return share;
  let own = nodes.findIndex((node) => node.law === law);
  for (let i = own + 1; i < nodes.length; i++) {
    const [one, other] = nodes[i].parts;
    if (own !== one && own !== other) continue;
    const beside = own === one ? other : one;
    for (let t = 0; nodes[i].kind === SERIES && t < omega.length; t++) {
      const [a, b] = stiffnessAt(direct[own], rows[own], omega[t], t);
      const [c, d] = stiffnessAt(direct[beside], rows[beside], omega[t], t);
      share[t] *= (c * c + d * d) / ((a + c) * (a + c) + (b + d) * (b + d));
    }
    own = i;
  }
  return share;
}
