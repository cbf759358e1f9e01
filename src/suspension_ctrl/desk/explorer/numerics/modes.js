// Modes of a vehicle with its struts: undamped, and followed to its dampers; see vehicles/modes.py.

import { assigned } from "./assignment.js";
import { eigenOf } from "./eigenvalues.js";
import { haveFractions } from "./fractions.js";
import { rowsIn } from "./packed.js";
import { matricesAt, numbersAt, settingAt, stateMatrix } from "./state_matrix.js";

/** @typedef {import("./eigenvalues.js").Eigen} Eigen */
/** @typedef {{name: string, frequency: number, damped: number, ratio: number}} Mode undamped and damped [Hz] */
/** @typedef {[number, number]} Complex */
/** @typedef {{poles: Complex[], shapes: Float64Array[]}} Found poles [rad/s], and shapes (n,) of the coordinates */

const STEPS = 60; // of the share of damping
const LIKE = 0.01; // of a pole, cost of a shape without likeness

/**
 * Return the modes of a vehicle by rising frequency; null where an element has a loss that no damper has.
 * @param {any} plant packed `PlantMatrices`
 * @param {ArrayLike<number>} coefficients (w,)
 * @param {import("./network_rows.js").Networks | null} networks
 * @param {import("./networked.js").Point | null} point
 * @returns {Mode[] | null}
 */
export function modesOf(plant, coefficients, networks, point) {
  if (networks && !haveFractions(networks)) return null;
  const values = settingAt(plant, coefficients);
  const at = (/** @type {number} */ share) => polesOf(matricesAt(plant, values, networks, point, share));
  const undamped = at(0), pairs = pairsOf(undamped.poles);
  const names = namesOf(plant, values, pairs.map(([first]) => undamped.shapes[first]));
  const damped = followed(undamped, pairs, at);
  const found = pairs.map(([first], i) => {
    const [one, other] = damped[i], product = Math.hypot(...one) * Math.hypot(...other);
    return {
      name: names[i], frequency: Math.hypot(...undamped.poles[first]) / (2 * Math.PI),
      damped: Math.abs(one[1]) / (2 * Math.PI), ratio: -(one[0] + other[0]) / (2 * Math.sqrt(product)),
    };
  });
  return found.sort((one, other) => one.frequency - other.frequency);
}

/** @param {import("./state_matrix.js").Matrices} matrices @returns {Found} */
export function polesOf(matrices) {
  const { matrix, frequency, scale } = stateMatrix(matrices), { values, vectors } = eigenOf(matrix);
  const poles = vectors.map((_, i) => {
    const [re, im] = values.subarray(2 * i, 2 * i + 2);
    return /** @type {Complex} */ ([frequency * re, frequency * im]);
  });
  const shapes = vectors.map((vector) => Float64Array.from({ length: 2 * scale.length }, (_, i) =>
    vector[i] / scale[i >> 1]));
  return { poles, shapes };
}

/** @param {Complex[]} poles @returns {[number, number][]} pairs by index: conjugates, upper first, or two real ones */
function pairsOf(poles) {
  const index = poles.map((_, i) => i);
  const [upper, lower] = [1, -1].map((sign) => index.filter((i) => sign * poles[i][1] > 0)
    .sort((i, j) => sign * (poles[i][1] - poles[j][1]) || poles[i][0] - poles[j][0]));
  const real = index.filter((i) => poles[i][1] === 0).sort((i, j) => poles[j][0] - poles[i][0]);
  const pairs = upper.map((i, k) => /** @type {[number, number]} */ ([i, lower[k]]));
  for (let k = 0; k + 1 < real.length; k += 2) pairs.push([real[k], real[k + 1]]);
  return pairs;
}

/**
 * Return the pairs of damped poles to which undamped pairs lead.
 * @param {Found} undamped
 * @param {[number, number][]} pairs
 * @param {(share: number) => Found} at
 * @returns {[Complex, Complex][]}
 */
function followed(undamped, pairs, at) {
  const start = pairs.flat();
  let poles = start.map((i) => undamped.poles[i]), shapes = start.map((i) => undamped.shapes[i]), before = poles;
  for (let step = 1; step <= STEPS; step++) {
    const found = at(step / STEPS);
    const costs = poles.map((pole, i) => found.poles.map(([re, im], j) => {
      const ahead = [2 * pole[0] - before[i][0], 2 * pole[1] - before[i][1]];
      return Math.hypot(re - ahead[0], im - ahead[1]) +
        LIKE * Math.hypot(...pole) * (1 - likeness(shapes[i], found.shapes[j]));
    }));
    const chosen = assigned(costs);
    [before, poles] = [poles, chosen.map((j) => found.poles[j])];
    shapes = chosen.map((j) => found.shapes[j]);
  }
  return repaired(poles);
}

/** @param {Float64Array} one @param {Float64Array} other @returns {number} from 0 to 1 of the same shape */
function likeness(one, other) {
  let re = 0, im = 0;
  for (let i = 0; i < one.length; i += 2) {
    re += one[i] * other[i] + one[i + 1] * other[i + 1];
    im += one[i] * other[i + 1] - one[i + 1] * other[i];
  }
  return Math.hypot(re, im) / (Math.hypot(...one) * Math.hypot(...other));
}

/**
 * Return pairs of conjugates or of real poles: those of two modes may have met on the real axis and left it together.
 * @param {Complex[]} given of two for each mode
 * @returns {[Complex, Complex][]}
 */
function repaired(given) {
  const poles = given.map((pole) => /** @type {Complex} */ ([...pole]));
  poles.forEach(([re, im], i) => { // a real pole has met that of elements in series, which is of no mode
    const alone = im !== 0 && !poles.some((other) => other[0] === re && other[1] === -im);
    if (alone) poles[i ^ 1] = [re, -im];
  });
  const pairs = Array.from({ length: poles.length / 2 }, (_, i) => [2 * i, 2 * i + 1]);
  const broken = pairs.filter(([i, j]) => (poles[i][1] !== 0 || poles[j][1] !== 0) &&
    (poles[i][0] !== poles[j][0] || poles[i][1] !== -poles[j][1]));
  const mixed = broken.flat();
  pairsOf(mixed.map((i) => poles[i])).forEach(([one, other], k) => broken[k].splice(0, 2, mixed[one], mixed[other]));
  return pairs.map(([i, j]) => [poles[i], poles[j]]);
}

/**
 * Return a name of its own for each shape: the motions with most of the kinetic energy, all at once.
 * @param {any} plant
 * @param {ArrayLike<number>} values
 * @param {Float64Array[]} shapes
 * @returns {string[]}
 */
function namesOf(plant, values, shapes) {
  const motions = /** @type {string[]} */ (plant.names), names = /** @type {string[]} */ ([]);
  const shares = shapes.map((shape) => {
    const energy = energiesOf(plant, values, shape);
    const total = energy.reduce((sum, own) => sum + own, 0);
    return energy.map((own) => own / total);
  });
  if (shapes.length <= motions.length) {
    assigned(shares.map((row) => row.map((share) => -share))).forEach((k, i) => (names[i] = motions[k]));
  } else { // of an inerter in series
    const costs = motions.map((_, k) => shares.map((row) => -row[k]));
    assigned(costs).forEach((i, k) => (names[i] = motions[k]));
  }
  return shares.map((row, i) => names[i] ?? `${motions[row.indexOf(Math.max(...row))]} ${i + 1}`);
}

/**
 * Return twice the kinetic energy of a shape (n,) in each motion (k,).
 * @param {any} plant
 * @param {ArrayLike<number>} values
 * @param {Float64Array} shape
 * @returns {number[]}
 */
export function energiesOf(plant, values, shape) {
  const inertia = numbersAt(plant, "inertia", values), displacements = rowsIn(plant.displacements);
  const [re, im] = [0, 1].map((part) => displacements.map((row) =>
    dot(row, Array.from(row, (_, i) => shape[2 * i + part]))));
  return rowsIn(plant.motions).map((motion) => {
    const momentum = inertia.map((own, i) => own * motion[i]);
    return (dot(momentum, re) ** 2 + dot(momentum, im) ** 2) / dot(momentum, motion);
  });
}

/** @param {ArrayLike<number>} one @param {ArrayLike<number>} other @returns {number} */
function dot(one, other) {
  let sum = 0;
  for (let i = 0; i < one.length; i++) sum += one[i] * other[i];
  return sum;
}
