// Curves of force laws, and the design whose curve goes through a point.

/** @typedef {import("./gaussian.js").Curve} Curve */

const STEP = 1e-6; // of a variable by its range, for a slope
const MOST = 30, NEAR = 1e-9; // steps, and the change by the range at which they end

/**
 * Return the force of a curve and of a power `factor |x|^exponent` beside it [N].
 * @param {Curve} curve
 * @param {[number, number] | null} power factor and exponent
 * @param {number} x
 * @returns {number}
 */
export function forceAt({ count, knots, slopes, jumps }, power, x) {
  let force = slopes[0] * x;
  for (let i = 0; i < count; i++) {
    const knot = knots[i], above = x > knot ? 1 : x < knot ? 0 : 0.5;
    force += (slopes[i + 1] - slopes[i]) * (Math.max(x - knot, 0) - Math.max(-knot, 0));
    force += jumps[i] * (above - 0.5 + 0.5 * Math.sign(knot)); // the force at 0 is 0
  }
  return power ? force + power[0] * Math.abs(x) ** power[1] * Math.sign(x) : force;
}

/**
 * Return the design within its bounds for which a point of a curve is nearest to another, by Gauss and Newton.
 *
 * Of all steps the shortest is taken, with variables by their ranges and the point by the size of the curve.
 * @param {(design: Float64Array) => [number, number]} pointOf the point by a design
 * @param {[number, number]} wanted
 * @param {[number, number]} size of the curve
 * @param {ArrayLike<number>} design to begin with
 * @param {{place: number, low: number, high: number}[]} moving the variables that move the point
 * @returns {Float64Array}
 */
export function designThrough(pointOf, wanted, size, design, moving) {
  const found = Float64Array.from(design);
  for (let step = 0; step < MOST; step++) {
    const here = pointOf(found), missing = [0, 1].map((k) => (wanted[k] - here[k]) / size[k]);
    const slopes = moving.map(({ place, low, high }) => {
      const own = found[place], change = (high - low) * STEP * (own + (high - low) * STEP > high ? -1 : 1);
      found[place] = own + change;
      const there = pointOf(found);
      found[place] = own;
      return [0, 1].map((k) => ((there[k] - here[k]) / size[k]) * ((high - low) / change));
    });
    const shares = leastNorm(slopes, missing);
    let largest = 0;
    moving.forEach(({ place, low, high }, v) => {
      const before = found[place];
      found[place] = Math.min(high, Math.max(low, before + (high - low) * shares[v]));
      largest = Math.max(largest, Math.abs(found[place] - before) / (high - low));
    });
    if (!(largest > NEAR)) break;
  }
  return found;
}

/**
 * Return x of least norm for which |A x - b| is least, slightly damped: A^T (A A^T + e)^-1 b with two rows.
 * @param {number[][]} columns of A
 * @param {number[]} b
 * @returns {number[]}
 */
function leastNorm(columns, b) {
  const product = (/** @type {number} */ i, /** @type {number} */ j) =>
    columns.reduce((sum, column) => sum + column[i] * column[j], 0);
  const [a, c, d] = [product(0, 0), product(0, 1), product(1, 1)], damping = 1e-6 * (a + d) + 1e-12;
  const [p, q] = [a + damping, d + damping], determinant = p * q - c * c;
  const [x, y] = [(q * b[0] - c * b[1]) / determinant, (p * b[1] - c * b[0]) / determinant];
  return columns.map((column) => column[0] * x + column[1] * y);
}
