// Statistical linearisation: a force law whose deflection or rate is Gaussian, see response/gaussian.py.

const SMALL = 3; // share above: a series up to here, a continued fraction beyond
const LAST = 9; // less than 1e-18 lies above

/**
 * Return the share above z and the density at z of the standard normal distribution.
 *
 * Abramowitz and Stegun, Handbook of Mathematical Functions, 26.2.11 and 26.2.14.
 * @param {number} z
 * @returns {[number, number]}
 */
export function normal(z) {
  const size = Math.abs(z);
  if (!(size < LAST)) return [0.5 - 0.5 * Math.sign(z), 0];
  const density = Math.exp((-z * z) / 2) / Math.sqrt(2 * Math.PI);
  const above = size < SMALL ? 0.5 - density * between(size) : density / fraction(size);
  return [z >= 0 ? above : 1 - above, density];
}

/** @param {number} z @returns {number} the share between 0 and z over the density */
function between(z) {
  let term = z, total = z;
  for (let k = 3; term > 1e-17 * total; k += 2) {
    term *= (z * z) / k;
    total += term;
  }
  return total;
}

/** @param {number} z @returns {number} the density over the share above */
function fraction(z) {
  let value = z;
  for (let k = 100; k > 0; k--) value = z + k / value;
  return value;
}

/**
 * A curve of k knots: knots and jumps there (k,), slopes between them (k + 1,).
 * @typedef {{count: number, knots: Float64Array, slopes: Float64Array, jumps: Float64Array}} Curve
 */

/**
 * Return mean force [N], mean slope, and its change with ln s, of a curve.
 * @param {Curve} curve
 * @param {number} mean
 * @param {number} s
 * @returns {[number, number, number]}
 */
export function ofLines({ count, knots, slopes, jumps }, mean, s) {
  let force = slopes[0] * mean, slope = slopes[0], change = 0;
  for (let i = 0; i < count; i++) {
    const knot = knots[i], step = slopes[i + 1] - slopes[i], jump = jumps[i];
    const z = (knot - mean) / s, [above, density] = normal(z);
    force += step * (s * (density - z * above) - Math.max(-knot, 0));
    slope += step * above;
    change += step * z * density;
    if (jump > 0) {
      force += jump * (above - 0.5 + 0.5 * Math.sign(knot)); // the force at 0 is 0
      slope += (jump * density) / s;
      change += (jump * density * (z * z - 1)) / s;
    }
  }
  return [force, slope, change];
}

/**
 * Return mean slope, and its change with ln s, of `force |v|^exponent sign(v)` about a mean of 0.
 * @param {number} force
 * @param {number} exponent
 * @param {number} s
 * @returns {[number, number]}
 */
export function ofPower(force, exponent, s) {
  const root = (Math.SQRT2 * s) ** (exponent - 1);
  const slope = (force * exponent * root * gamma(exponent / 2)) / Math.sqrt(Math.PI);
  return [slope, (exponent - 1) * slope];
}

/**
 * Return the gamma function of x > 0, by Stirling's series at x + 10 and recurrence: within 1e-13.
 * @param {number} x
 * @returns {number}
 */
export function gamma(x) {
  let product = 1, y = x;
  for (; y < x + 10; y++) product *= y;
  const inverse = 1 / (y * y);
  const series = (1 - inverse * (1 / 30 - inverse * (1 / 105 - inverse * (1 / 140 - inverse / 99)))) / (12 * y);
  return (Math.sqrt((2 * Math.PI) / y) * y ** y * Math.exp(series - y)) / product;
}
