// Measures that are functions of a design, by their words; see response/measures.

import { normal } from "./gaussian.js";
import { energiesOf, polesOf } from "./modes.js";
import { frontLoadTransfer, rollGradient, staticLoads } from "./statics.js";
import { matricesAt } from "./state_matrix.js";

/** @typedef {import("./statics.js").Vehicle} Vehicle */
/** @typedef {import("./networked.js").Point} Point */
/**
 * A design in a load case: its vehicle, mean squares (k,) and working point.
 * @typedef {Vehicle & {squares: ArrayLike<number>, point: Point | null}} State
 */

const EULER = 0.5772156649015329;
const KM = 1000; // m

/** @type {Record<string, (numbers: any, state: State) => number>} */
const OF_WORD = {
  VDV: ({ terms, factors }, { squares }) =>
    largest(terms, (term, i) => factors.data[i] * Math.sqrt(squares[term])),
  SEAT: ({ terms: [seat, floor] }, { squares }) => Math.sqrt(squares[seat] / squares[floor]),
  DLC: (numbers, state) => largest(ofTyres(numbers, state), (share) => share),
  lift: (numbers, state) => largest(ofTyres(numbers, state), (share) => normal(1 / share)[0]),
  largest: ({ terms, seconds }, { squares }) => largest(pairsOf(terms, squares), ([deviation, rate]) => {
    const crossings = (rate / (2 * Math.PI * deviation)) * seconds;
    const g = Math.sqrt(2 * Math.log(Math.max(crossings, Math.E)));
    return deviation * (g + EULER / g);
  }),
  bottoming: strikes,
  topping: strikes,
  damper_power: ({ terms, struts, dampers }, { squares, values, networks, point }) => largest(terms, (term, i) => {
    const damping = values.reduce((sum, value, c) => sum + value * dampers.data[c * terms.length + i], 0);
    const laws = (point ? networks?.laws ?? [] : []).map(({ ofRate, network }, law) => {
      const { slope, deviation } = /** @type {Point} */ (point).states[law];
      return ofRate && networks?.ports[network][struts[i]] ? slope * deviation ** 2 : 0;
    });
    return damping * squares[term] + laws.reduce((sum, own) => sum + own, 0);
  }),
  frequency: ({ motion }, state) => {
    const { poles, chosen } = modeOf(state, 0, (shape, mass) => shareOf(state, motion, shape, mass));
    return Math.hypot(...poles[chosen]) / (2 * Math.PI);
  },
  damping_ratio: ({ motion }, state) => {
    const { poles, chosen } = modeOf(state, 1, (shape, mass) => shareOf(state, motion, shape, mass));
    return -poles[chosen][0] / Math.hypot(...poles[chosen]);
  },
  roll_damping: ({ roll }, state) => {
    const { poles, chosen } = modeOf(state, 1, (shape, mass) => {
      const energy = mass.map((row, i) => row[i] * (shape[2 * i] ** 2 + shape[2 * i + 1] ** 2));
      return energy[roll] / energy.reduce((sum, own) => sum + own, 0);
    });
    return -poles[chosen][0] / Math.hypot(...poles[chosen]);
  },
  roll_gradient: (numbers, state) => rollGradient(state, numbers),
  front_load_transfer: (numbers, state) => frontLoadTransfer(state, numbers),
};

/**
 * Return the value of a measure in a load case; `numbers` are those of `functions.py`.
 * @param {string} word
 * @param {any} numbers
 * @param {State} state
 * @returns {number}
 */
export function valueOf(word, numbers, state) {
  return OF_WORD[word](numbers, state);
}

/**
 * Return the largest of values.
 * @template T
 * @param {T[]} each
 * @param {(one: T, i: number) => number} value
 */
function largest(each, value) {
  return Math.max(...each.map(value));
}

/** @param {{terms: number[], tyres: number[]}} numbers @param {State} state @returns {number[]} shares */
function ofTyres({ terms, tyres }, state) {
  const loads = staticLoads(state);
  return terms.map((term, i) => Math.sqrt(state.squares[term]) / loads[tyres[i]]);
}

/** @param {number[]} terms @param {ArrayLike<number>} squares @returns {[number, number][]} deviations, of rates too */
function pairsOf(terms, squares) {
  const count = terms.length / 2;
  return terms.slice(0, count).map((term, i) => [Math.sqrt(squares[term]), Math.sqrt(squares[terms[count + i]])]);
}

/** @param {any} numbers @param {State} state @returns {number} strikes of the stop that is met most [1/km] */
function strikes({ terms, struts, side, speed, gap, gaps, ratios }, { squares, values, point }) {
  return largest(pairsOf(terms, squares), ([deviation, rate], i) => {
    const free = gap ?? values[gaps[i]] / ratios[i], mean = point?.positions[struts[i]] ?? 0;
    const left = Math.max(free - side * mean, 0);
    return ((KM / speed) * rate * Math.exp(-(left ** 2) / (2 * deviation ** 2))) / (2 * Math.PI * deviation);
  });
}

/**
 * Return the poles at a share of damping, and which has the largest share of its kinetic energy in a motion.
 * @param {State} state
 * @param {number} damping
 * @param {(shape: Float64Array, mass: Float64Array[]) => number} share
 */
function modeOf({ plant, values }, damping, share) {
  const matrices = matricesAt(plant, values, null, null, damping), { poles, shapes } = polesOf(matrices);
  const shares = shapes.map((shape) => share(shape, matrices.mass));
  return { poles, chosen: shares.indexOf(Math.max(...shares)) };
}

/**
 * Return the share of a motion in the kinetic energy of a shape (n,).
 * @param {State} state
 * @param {number} motion
 * @param {Float64Array} shape
 * @param {Float64Array[]} mass
 */
function shareOf({ plant, values }, motion, shape, mass) {
  let total = 0;
  mass.forEach((row, i) => row.forEach((own, j) => {
    total += own * (shape[2 * i] * shape[2 * j] + shape[2 * i + 1] * shape[2 * j + 1]);
  }));
  return energiesOf(plant, values, shape)[motion] / total;
}
