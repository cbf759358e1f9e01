// Mean squares of one spring and one damper: integrands are ratios of polynomials in both.

import { rowsIn } from "./packed.js";

/**
 * Return the mean squares (k,) of a design (K, C), see `OneStrut` in response/one_strut.py.
 * @param {any} strut its packed fields
 * @param {ArrayLike<number>} design
 * @returns {Float64Array}
 */
export function squaresOfOneStrut(strut, design) {
  const [k, c] = [design[0], design[1]];
  const scale = 1 / (1 + k * k + c * c); // keeps the gains in range
  const powers = [scale, scale * k, scale * c, scale * k * k, scale * c * c];
  const lines = rowsIn(strut.denominator);
  const gain = new Float64Array(strut.denominator.shape[1]);
  for (let i = 0; i < gain.length; i++) {
    let sum = powers[0];
    for (let j = 0; j < 4; j++) sum += lines[j][i] * powers[j + 1];
    gain[i] = 1 / sum;
  }
  const found = new Float64Array(strut.terms);
  rowsIn(strut.numerators).forEach((numerator, q) => {
    let integral = 0;
    for (let i = 0; i < gain.length; i++) integral += gain[i] * numerator[i];
    found[strut.term.data[q]] += integral * powers[strut.power.data[q]];
  });
  return found;
}
