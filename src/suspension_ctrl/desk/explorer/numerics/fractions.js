// Dynamic stiffness of networks as fractions of polynomials in s, see `fraction` in vehicles/struts.py.
//
// Coefficients of a polynomial rise with its powers.

import { DAMPER, INERTER, LAW, MEASURED, PARALLEL, RUBBER, SERIES } from "./network_rows.js";

/** @typedef {import("./network_rows.js").Networks} Networks */
/** @typedef {import("./network_rows.js").State} State */
/** @typedef {{numerator: number[], denominator: number[]}} Fraction */
/** @typedef {{direct: number[], rest: Fraction | null}} Parts stiffness, damping and inertance, and what remains */

const LEAST = 1e-9; // N/m or N s/m, slope of a law such as a stop out of reach

/** @param {Networks} networks @returns {boolean} whether all elements have fractions: none has a constant loss */
export function haveFractions({ nodes }) {
  return nodes.every(({ kind }) => kind !== RUBBER && kind !== MEASURED);
}

/**
 * Return the parts of each network (t,) with a share of the damping of all dampers.
 * @param {Networks} networks
 * @param {ArrayLike<number>} values
 * @param {State[]} states
 * @param {number} share
 * @returns {Parts[]}
 */
export function partsOf(networks, values, states, share) {
  /** @type {Fraction[]} */
  const found = [];
  for (const node of networks.nodes) {
    const [one, other] = node.parts.map((part) => found[part]);
    const own = node.kind === PARALLEL ? sum(one, other)
      : node.kind === SERIES ? inverse(sum(inverse(one), inverse(other)))
        : elementOf(networks, node, values, states, share);
    found.push({ ...own, numerator: own.numerator.map((value) => value * node.ratio ** 2) });
  }
  return networks.root.map((root) => divided(found[root]));
}

/**
 * Return the fraction of an element.
 * @param {Networks} networks
 * @param {import("./network_rows.js").Node} node
 * @param {ArrayLike<number>} values
 * @param {State[]} states
 * @param {number} share
 * @returns {Fraction}
 */
function elementOf({ laws }, { kind, coefficient, law }, values, states, share) {
  const isLaw = kind === LAW, damps = isLaw ? laws[law].ofRate : kind === DAMPER;
  const value = isLaw ? Math.max(states[law].slope, LEAST) : values[coefficient[0]];
  const order = damps ? 1 : kind === INERTER ? 2 : 0;
  return { numerator: [...Array(order).fill(0), damps ? share * value : value], denominator: [1] };
}

/** @param {Fraction} fraction @returns {Fraction} */
function inverse({ numerator, denominator }) {
  return { numerator: denominator, denominator: numerator };
}

/** @param {Fraction} one @param {Fraction} other @returns {Fraction} */
function sum(one, other) {
  const same = one.denominator.length === other.denominator.length &&
    one.denominator.every((value, i) => value === other.denominator[i]);
  if (same) return { numerator: added(one.numerator, other.numerator), denominator: one.denominator };
  return {
    numerator: added(product(one.numerator, other.denominator), product(other.numerator, one.denominator)),
    denominator: product(one.denominator, other.denominator),
  };
}

/** @param {number[]} one @param {number[]} other @returns {number[]} */
function added(one, other) {
  return Array.from({ length: Math.max(one.length, other.length) }, (_, i) => (one[i] ?? 0) + (other[i] ?? 0));
}

/** @param {number[]} one @param {number[]} other @returns {number[]} */
function product(one, other) {
  const total = Array(one.length + other.length - 1).fill(0);
  one.forEach((x, i) => other.forEach((y, j) => (total[i + j] += x * y)));
  return total;
}

/** @param {number[]} values @returns {number[]} without zeros at the end */
function trimmed(values) {
  let length = values.length;
  while (length > 1 && values[length - 1] === 0) length--;
  return values.slice(0, length);
}

/** @param {Fraction} fraction @returns {Parts} a polynomial, and a fraction that vanishes at high frequency */
function divided(fraction) {
  const denominator = trimmed(fraction.denominator), rest = trimmed(fraction.numerator), direct = [0, 0, 0];
  const last = denominator.length - 1;
  for (let i = rest.length - 1 - last; i >= 0; i--) {
    direct[i] = rest[i + last] / denominator[last];
    denominator.forEach((value, j) => (rest[i + j] -= direct[i] * value));
  }
  const numerator = rest.slice(0, last);
  return { direct, rest: numerator.some((value) => value !== 0) ? { numerator, denominator } : null };
}
