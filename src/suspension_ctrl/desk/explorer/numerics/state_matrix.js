// The state matrix of a vehicle with its struts, at any share of the damping of all dampers.

import { partsOf } from "./fractions.js";
import { solved } from "./linear_equations.js";
import { rowsIn } from "./packed.js";

/** @typedef {import("./network_rows.js").Networks} Networks */
/** @typedef {import("./networked.js").Point} Point */
/** @typedef {Float64Array[]} Matrix */
/** @typedef {{ends: ArrayLike<number>, numerator: number[], denominator: number[]}} Filter of a strut with ends (n,) */
/** @typedef {{stiffness: Matrix, damping: Matrix, mass: Matrix, filters: Filter[]}} Matrices (n, n) each */

/**
 * Return all coefficients (c,) of the struts by those that vary (w,).
 * @param {any} plant packed `PlantMatrices`
 * @param {ArrayLike<number>} coefficients
 * @returns {Float64Array}
 */
export function settingAt(plant, coefficients) {
  const values = Float64Array.from(plant.setting.data);
  plant.variable.data.forEach((/** @type {number} */ place, /** @type {number} */ v) => {
    values[place] = coefficients[v];
  });
  return values;
}

/**
 * Return numbers (...,) of a vehicle by their name, with what coefficients (c,) add to them.
 * @param {any} plant packed `PlantMatrices`
 * @param {"inertia" | "weights" | "loads" | "sprung"} name
 * @param {ArrayLike<number>} values
 * @returns {Float64Array}
 */
export function numbersAt(plant, name, values) {
  const total = Float64Array.from(plant[name].data);
  rowsIn(plant[`${name}_by`]).forEach((row, c) => row.forEach((x, i) => (total[i] += values[c] * x)));
  return total;
}

/**
 * Return the matrices of a vehicle with coefficients (c,), its networks at a working point.
 * @param {any} plant packed `PlantMatrices`
 * @param {ArrayLike<number>} values
 * @param {Networks | null} networks
 * @param {Point | null} point
 * @param {number} share of the damping of all dampers
 * @returns {Matrices}
 */
export function matricesAt(plant, values, networks, point, share) {
  const by = rowsIn(plant.by), ends = rowsIn(plant.struts);
  const [stiffness, damping, mass] = ["stiffness", "damping", "mass"].map((name, order) => {
    const total = Float64Array.from(plant[name].data);
    by.forEach((row, c) => plant.order.data[c] === order && row.forEach((x, i) => (total[i] += values[c] * x)));
    const scaled = order === 1 ? total.map((x) => share * x) : total;
    return /** @type {Matrix} */ (rowsIn({ shape: plant[name].shape, data: scaled }));
  });
  const totals = [stiffness, damping, mass], filters = /** @type {Filter[]} */ ([]);
  const parts = networks && point ? partsOf(networks, point.values, point.states, share) : [];
  parts.forEach(({ direct, rest }, t) => ends.forEach((own, port) => {
    if (!networks?.ports[t][port]) return;
    totals.forEach((total, order) => total.forEach((row, i) => row.forEach((_, j) => {
      row[j] += direct[order] * own[i] * own[j];
    })));
    if (rest) filters.push({ ends: own, ...rest });
  }));
  return { stiffness, damping, mass, filters };
}

/**
 * Return the matrix of states: coordinates (n,), their rates over a frequency w0, and states of the filters.
 *
 * Coordinates are scaled by the roots of their masses and time by w0, which keeps all entries of like size.
 * @param {Matrices} matrices
 * @returns {{matrix: Matrix, frequency: number, scale: Float64Array}} over w0, w0 [rad/s], and factors of coordinates
 */
export function stateMatrix({ stiffness, damping, mass, filters }) {
  const n = mass.length, scale = Float64Array.from(mass, (row, i) => Math.sqrt(row[i]));
  const [byPlace, byRate] = [stiffness, damping].map((own) => solved(mass, own));
  const frequency = Math.sqrt(Math.max(...byPlace.map((row, i) => Math.abs(row[i])))) || 1;
  const size = 2 * n + filters.reduce((sum, { denominator }) => sum + denominator.length - 1, 0);
  const matrix = Array.from({ length: size }, () => new Float64Array(size));
  for (let i = 0; i < n; i++) {
    matrix[i][n + i] = 1;
    for (let j = 0; j < n; j++) {
      matrix[n + i][j] = (-scale[i] * byPlace[i][j]) / (scale[j] * frequency ** 2);
      matrix[n + i][n + j] = (-scale[i] * byRate[i][j]) / (scale[j] * frequency);
    }
  }
  let first = 2 * n;
  for (const filter of filters) {
    addFilter(matrix, first, filter, mass, scale, frequency);
    first += filter.denominator.length - 1;
  }
  return { matrix, frequency, scale };
}

/**
 * Add the states of a filter in controllable form, driven by the deflection of its strut.
 * @param {Matrix} matrix
 * @param {number} first of its states
 * @param {Filter} filter
 * @param {Matrix} mass
 * @param {Float64Array} scale
 * @param {number} frequency
 */
function addFilter(matrix, first, { ends, numerator, denominator }, mass, scale, frequency) {
  const n = mass.length, order = denominator.length - 1, highest = denominator[order] * frequency ** order;
  const moved = solved(mass, Array.from(ends, (x) => [x])); // accelerations by a tension of -1
  for (let k = 0; k < order; k++) {
    if (k < order - 1) matrix[first + k][first + k + 1] = 1;
    matrix[first + order - 1][first + k] = (-denominator[k] * frequency ** k) / highest;
    for (let i = 0; i < n; i++) {
      const tension = ((numerator[k] ?? 0) * frequency ** k) / highest;
      matrix[n + i][first + k] = (-scale[i] * moved[i][0] * tension) / frequency ** 2;
    }
  }
  for (let j = 0; j < n; j++) matrix[first + order - 1][j] = ends[j] / scale[j];
}
