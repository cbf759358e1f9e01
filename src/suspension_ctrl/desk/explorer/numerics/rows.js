// Complex rows: real and imaginary parts of a value at n frequencies.

import { rowsIn } from "./packed.js";

/** @typedef {{re: Float64Array, im: Float64Array}} Row */

/**
 * Return a row of zeros.
 * @param {number} n
 * @returns {Row}
 */
export function zeroRow(n) {
  return { re: new Float64Array(n), im: new Float64Array(n) };
}

/**
 * Return a copy of a row.
 * @param {Row} row
 * @returns {Row}
 */
export function copyOf(row) {
  return { re: row.re.slice(), im: row.im.slice() };
}

/**
 * Return the rows of an array (l, 2, n).
 * @param {import("./packed.js").Numbers} numbers
 * @returns {Row[]}
 */
export function complexRows(numbers) {
  const n = numbers.shape[2];
  return rowsIn(numbers).map((both) => ({
    re: /** @type {Float64Array} */ (both.subarray(0, n)),
    im: /** @type {Float64Array} */ (both.subarray(n)),
  }));
}

/**
 * Replace a row by its reciprocal.
 * @param {Row} row
 */
export function invert({ re, im }) {
  for (let t = 0; t < re.length; t++) {
    const size = re[t] * re[t] + im[t] * im[t];
    re[t] /= size;
    im[t] /= -size;
  }
}

/**
 * Multiply a row by a factor in place.
 * @param {Row} factor
 * @param {Row} row
 */
export function multiply(factor, { re, im }) {
  for (let t = 0; t < re.length; t++) {
    const real = factor.re[t] * re[t] - factor.im[t] * im[t];
    im[t] = factor.re[t] * im[t] + factor.im[t] * re[t];
    re[t] = real;
  }
}

/**
 * Add the product of two rows, times `sign`, to a third.
 * @param {number} sign
 * @param {Row} left
 * @param {Row} right
 * @param {Row} total
 */
export function addProduct(sign, left, right, total) {
  const a = left.re, b = left.im, x = right.re, y = right.im, re = total.re, im = total.im;
  for (let t = 0; t < re.length; t++) {
    re[t] += sign * (a[t] * x[t] - b[t] * y[t]);
    im[t] += sign * (a[t] * y[t] + b[t] * x[t]);
  }
}

/**
 * Return the sum of the squared magnitudes of a row.
 * @param {Row} row
 * @returns {number}
 */
export function sumOfSquares({ re, im }) {
  let total = 0;
  for (let t = 0; t < re.length; t++) total += re[t] * re[t] + im[t] * im[t];
  return total;
}

/**
 * Return the sum of the squared magnitudes of a row times a density and a share (n,).
 * @param {Row} row
 * @param {ArrayLike<number>} density
 * @param {ArrayLike<number>} share
 * @returns {number}
 */
export function weightedSquare({ re, im }, density, share) {
  let total = 0;
  for (let t = 0; t < re.length; t++) total += (re[t] * re[t] + im[t] * im[t]) * density[t] * share[t];
  return total;
}
