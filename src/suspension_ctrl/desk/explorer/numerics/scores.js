// Objectives and limits of a design from the mean squares of every load case, see response/scores.py.

import { coefficientsOf } from "./formulas.js";
import { valueOf } from "./functions.js";
import { blocksOf, squaresOfManyStruts } from "./many_struts.js";
import { networksOf } from "./network_rows.js";
import { squaresOfAnyStruts, squaresOfOnePort } from "./networked.js";
import { squaresOfOneStrut } from "./one_strut.js";
import { rowsIn } from "./packed.js";
import { settingAt } from "./state_matrix.js";

/** @typedef {import("./networked.js").Point} Point */
/**
 * Scores of a design (s,), and by load case its coefficients and the working point of force laws.
 * @typedef {{scores: Float64Array, cases: {coefficients: ArrayLike<number>, point: Point | null}[]}} Evaluation
 */

/**
 * Return a packed kernel with blocks and networks ready for use.
 * @param {any} kernel
 * @param {any[]} functions of scores, null where mean squares are the score
 * @param {any[]} plants packed `PlantMatrices` of each load case, null where they are not known
 * @returns {any}
 */
export function prepared(kernel, functions, plants) {
  return { ...kernel, functions, plants, cases: kernel.cases.map(preparedCase) };
}

/** @param {any} one @returns {any} a load case ready for use */
function preparedCase(one) {
  if (one.class === "Mapped") return { ...one, case: preparedCase(one.case) };
  if (one.class === "ManyStruts") return { ...one, blocks: blocksOf(one) };
  if (one.class === "OnePort") return { ...one, networks: networksOf(one.networks) };
  if (one.class === "AnyStruts") {
    return { ...one, blocks: blocksOf(one.struts), networks: networksOf(one.networks) };
  }
  return one;
}

/**
 * Return the mean squares (k,) of a design (v,) in a load case, its coefficients and its working point.
 * @param {any} one
 * @param {ArrayLike<number>} design
 * @returns {{squares: Float64Array, coefficients: ArrayLike<number>, point: Point | null}}
 */
function squaresIn(one, design) {
  if (one.class === "Mapped") return squaresIn(one.case, coefficientsOf(one.formulas, design));
  if (one.class === "OneStrut") {
    return { squares: squaresOfOneStrut(one, design), coefficients: design, point: null };
  }
  if (one.class === "ManyStruts") {
    return { squares: squaresOfManyStruts(one, design), coefficients: design, point: null };
  }
  const found = one.class === "OnePort" ? squaresOfOnePort(one, design) : squaresOfAnyStruts(one, design);
  return { ...found, coefficients: design };
}

/**
 * Return the scores of a design (v,); those that only Python computes have no meaning.
 * @param {any} kernel prepared
 * @param {ArrayLike<number>} design
 * @returns {Evaluation}
 */
export function evaluated(kernel, design) {
  const count = kernel.scale.data.length, total = new Float64Array(count);
  const factors = rowsIn(kernel.squares), k = kernel.squares.shape[2];
  const found = kernel.cases.map((/** @type {any} */ one) => squaresIn(one, design));
  const cases = found.map((/** @type {any} */ { squares, coefficients, point }, /** @type {number} */ c) => {
    for (let s = 0; s < count; s++) {
      let value = 0;
      squares.forEach((/** @type {number} */ square, /** @type {number} */ i) => {
        const term = factors[c][s * k + i] * square;
        value = kernel.worst_term.data[s] ? Math.max(value, term) : value + term;
      });
      total[s] = kernel.worst_case.data[s] ? Math.max(total[s], value) : total[s] + kernel.shares.data[c] * value;
    }
    return { coefficients, point };
  });
  const scores = total.map((value, s) => kernel.scale.data[s] * Math.sqrt(value) + kernel.offset.data[s]);
  kernel.functions.forEach((/** @type {any} */ one, /** @type {number} */ s) => {
    if (one) scores[s] = kernel.scale.data[s] * ofFunction(kernel, one, s, found) + kernel.offset.data[s];
  });
  return { scores, cases };
}

/**
 * Return a measure by a function over load cases: the worst, or the mean of its power by their shares.
 * @param {any} kernel
 * @param {{word: string, power: number, cases: any[]}} measure
 * @param {number} s
 * @param {ReturnType<squaresIn>[]} found
 * @returns {number}
 */
function ofFunction(kernel, { word, power, cases }, s, found) {
  const values = cases.map((numbers, c) => {
    const plant = kernel.plants[c], networks = innerOf(kernel.cases[c]).networks ?? null;
    const setting = plant ? settingAt(plant, found[c].coefficients) : new Float64Array();
    return valueOf(word, numbers, { ...found[c], plant, networks, values: setting });
  });
  const sign = Math.sign(kernel.scale.data[s]);
  if (kernel.worst_case.data[s]) return sign * Math.max(...values.map((value) => sign * value));
  return values.reduce((sum, value, c) => sum + kernel.shares.data[c] * value ** power, 0) ** (1 / power);
}

/** @param {any} one @returns {any} a load case without formulas */
export function innerOf(one) {
  return one.class === "Mapped" ? one.case : one;
}
