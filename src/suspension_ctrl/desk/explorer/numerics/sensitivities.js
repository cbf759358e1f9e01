// What 1 % more of each variable does to scores, by central differences; see desk/slope_table.py.

const STEP = 1e-4; // of a value: rounding of a working point has an effect of 1e-4, a curvature of 1 one of 1e-8
const SHARE = 0.01;

/**
 * Return the changes (v, s) of scores by 1 % more of each variable, of one at 0 by 1 % of its range.
 * @param {(design: Float64Array) => Float64Array} scoresOf
 * @param {ArrayLike<number>} design
 * @param {{low: number, high: number}[]} variables
 * @returns {Float64Array[]}
 */
export function changesOf(scoresOf, design, variables) {
  return variables.map(({ low, high }, v) => {
    const size = design[v] || high - low, step = STEP * size;
    const [above, below] = [step, -step].map((change) => {
      const there = Float64Array.from(design);
      there[v] += change;
      return scoresOf(there);
    });
    return above.map((value, s) => (SHARE * size * (value - below[s])) / (2 * step));
  });
}
