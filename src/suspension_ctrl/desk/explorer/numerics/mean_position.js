// Mean positions of struts: static equilibrium with the mean forces of force laws, see response/mean_position.py.

import { ofLines, ofPower } from "./gaussian.js";
import { solved } from "./linear_equations.js";
import { INERTER, LAW, MEASURED, PARALLEL, RUBBER, SPRING } from "./network_rows.js";

/** @typedef {import("./network_rows.js").Networks} Networks */
/** @typedef {import("./network_rows.js").State} State */
/** @typedef {import("./gaussian.js").Curve} Curve */
/** @typedef {{force: number, stiffness: number, position: number}} Static of a node at 0 Hz, force at deflection 0 */

const MOST = 100, QUICK = 10; // steps, and those before shorter ones
const NEAR = 1e-10; // change of a mean by the deviation
const ODD = 1e-6; // N, mean force up to which a law is odd

/**
 * Fill in force, slope and change of every law at its deviation and mean.
 * @param {Networks} networks
 * @param {Curve[]} curves
 * @param {ArrayLike<number>} values
 * @param {State[]} states
 */
function linearise({ laws }, curves, values, states) {
  states.forEach((state, i) => {
    const [factor, exponent] = laws[i].power;
    [state.force, state.slope, state.change] = ofLines(curves[i], state.mean, state.deviation);
    if (factor >= 0) {
      const [slope, change] = ofPower(values[factor], values[exponent], state.deviation);
      state.slope += slope;
      state.change += change;
    }
  });
}

/**
 * Linearise the laws at the means of static equilibrium; return the mean deflections (q,) of the ports [m].
 * @param {Networks} networks
 * @param {Curve[]} curves
 * @param {ArrayLike<number>} values
 * @param {State[]} states
 * @returns {Float64Array}
 */
export function balance(networks, curves, values, states) {
  /** @type {Float64Array} */
  let positions = new Float64Array(networks.sag.length);
  for (let step = 0; step < MOST; step++) {
    linearise(networks, curves, values, states);
    const nodes = staticsOf(networks, values, states);
    positions = positionsOf(networks, values, nodes);
    networks.root.forEach((root, t) => (nodes[root].position = positions[networks.port[t]]));
    const error = place(networks, nodes, states, step < QUICK ? 1 : 0.3);
    if (!(error >= NEAR)) break;
  }
  return positions;
}

/**
 * Hand the mean deflections down to the laws, which take a share of their change; return the largest.
 * @param {Networks} networks
 * @param {Static[]} statics
 * @param {State[]} states
 * @param {number} share
 * @returns {number}
 */
function place({ nodes, laws }, statics, states, share) {
  let error = 0;
  for (let i = nodes.length - 1; i >= 0; i--) {
    const { kind, parts, law, ratio } = nodes[i], own = ratio * statics[i].position;
    if (kind >= PARALLEL) {
      const [one, other] = parts.map((part) => statics[part]);
      one.position = other.position = own;
      if (kind !== PARALLEL) divide(statics[i], ratio, one, other);
    } else if (kind === LAW && !laws[law].ofRate) {
      const state = states[law];
      error = Math.max(error, Math.abs(own - state.mean) / state.deviation);
      state.mean += share * (own - state.mean);
    }
  }
  return error;
}

/**
 * Divide the mean deflection of two parts in series, by the force in the stiffer one.
 * @param {Static} whole
 * @param {number} ratio
 * @param {Static} one
 * @param {Static} other
 */
function divide(whole, ratio, one, other) {
  const own = ratio * whole.position;
  const [stiff, soft] = one.stiffness > other.stiffness ? [one, other] : [other, one];
  if (stiff.stiffness > 0) {
    const force = whole.force / ratio + (whole.stiffness / ratio ** 2) * own;
    stiff.position = (force - stiff.force) / stiff.stiffness;
    soft.position = own - stiff.position;
  }
}

/**
 * Return force at deflection 0 and stiffness of every node at 0 Hz, as seen by the node above.
 * @param {Networks} networks
 * @param {ArrayLike<number>} values
 * @param {State[]} states
 * @returns {Static[]}
 */
export function staticsOf({ nodes, laws, measured }, values, states) {
  /** @type {Static[]} */
  const statics = [];
  for (const { kind, parts, coefficient, law, ratio } of nodes) {
    let force = 0, stiffness = 0;
    if (kind >= PARALLEL) {
      const [one, other] = parts.map((part) => statics[part]);
      [force, stiffness] = [one.force + other.force, one.stiffness + other.stiffness];
      if (kind !== PARALLEL && stiffness > 0) {
        force = (one.force * other.stiffness + other.force * one.stiffness) / stiffness;
        stiffness = (one.stiffness * other.stiffness) / stiffness;
      } else if (kind !== PARALLEL) {
        // nothing holds the end between: beside an inerter the mean force is 0
        force = parts.some((part) => nodes[part].kind === INERTER) || Math.abs(force) < ODD ? 0 : NaN;
      }
    } else if (kind === LAW) {
      stiffness = laws[law].ofRate ? 0 : states[law].slope;
      force = states[law].force - stiffness * (stiffness ? states[law].mean : 0);
    } else if (kind === SPRING || kind === RUBBER || kind === MEASURED) {
      stiffness = values[coefficient[0]] * (kind === MEASURED ? measured[coefficient[1]].re[0] : 1);
    }
    statics.push({ force: ratio * force, stiffness: ratio * ratio * stiffness, position: 0 });
  }
  return statics;
}

/**
 * Return the mean deflections (q,) of the ports: (1 - C (K - K0)) d = sag + C F(0), near the identity.
 * @param {Networks} networks
 * @param {ArrayLike<number>} values
 * @param {Static[]} statics
 * @returns {Float64Array}
 */
function positionsOf(networks, values, statics) {
  const { sag, compliance, nominal, gain, order, weight, ports, root } = networks, q = sag.length;
  const change = nominal.map((row) => Float64Array.from(row, (value) => -value)), force = new Float64Array(q);
  gain.forEach((own, i) => {
    for (let j = 0; j < q; j++) {
      for (let k = 0; order[i] === 0 && k < q; k++) change[j][k] += values[i] * own[j * q + k];
      if (order[i] !== 0 && weight[i] !== 0) force[j] += weight[i] * values[i] * own[j * q + j];
    }
  });
  ports.forEach((present, t) => {
    for (let j = 0; j < q; j++) {
      if (!present[j]) continue;
      change[j][j] += statics[root[t]].stiffness;
      force[j] += statics[root[t]].force;
    }
  });
  const found = Float64Array.from(sag);
  const matrix = change.map((_, i) => Float64Array.from({ length: q }, (_unused, j) => (i === j ? 1 : 0)));
  for (let i = 0; i < q; i++) {
    for (let j = 0; j < q; j++) {
      found[i] += compliance[i][j] * force[j];
      for (let k = 0; k < q; k++) matrix[i][k] -= compliance[i][j] * change[j][k];
    }
  }
  return Float64Array.from(solved(matrix, Array.from(found, (x) => [x])), ([x]) => x);
}
