// Mean squares of any number of struts: a solve of the strut loop at every frequency, (1 - P D) e = S.

import { rowsIn } from "./packed.js";
import { addProduct, complexRows, copyOf, invert, multiply, sumOfSquares, zeroRow } from "./rows.js";

/** @typedef {import("./rows.js").Row} Row */
/**
 * A block of q coupled struts with s sources and k terms at n frequencies, see response/many_struts.py.
 * @typedef {object} Block
 * @property {number} n
 * @property {number} q
 * @property {number} s
 * @property {Row[]} feedback (q q) deflections by tensions
 * @property {Row[]} sources (q s)
 * @property {Row[]} bySource (k s) terms
 * @property {Row[]} byStrut (k q)
 * @property {ArrayLike<number>} response (k,) the distinct mean square of each term
 * @property {ArrayLike<number>[]} gains (q q) of each variable, then of each network
 */

/**
 * Return the blocks of packed struts.
 * @param {any} struts
 * @returns {Block[]}
 */
export function blocksOf(struts) {
  const rows = complexRows(struts.rows), gains = rowsIn(struts.gain);
  let row = 0, entry = 0, output = 0;
  const n = struts.omega.data.length;
  const take = (/** @type {number} */ count) => rows.slice(row, (row += count));
  return rowsIn(struts.sizes).map(([q, s, k]) => {
    const [feedback, sources, bySource, byStrut] = [take(q * q), take(q * s), take(k * s), take(k * q)];
    const response = struts.response.data.subarray(output, (output += k));
    const own = gains.map((gain) => gain.subarray(entry, entry + q * q));
    entry += q * q;
    return { n, q, s, feedback, sources, bySource, byStrut, response, gains: own };
  });
}

/**
 * Return D (q q) of a block, sum of gain (jw)^order; null where it is zero.
 * @param {Block} block
 * @param {ArrayLike<number>} added (v,) values beyond those of the origin
 * @param {ArrayLike<number>} order (v,)
 * @param {ArrayLike<number>} omega (n,) [rad/s]
 * @returns {(Row | null)[]}
 */
export function stiffnessOf(block, added, order, omega) {
  return Array.from({ length: block.q * block.q }, (_, i) => {
    const byOrder = [0, 0, 0];
    for (let v = 0; v < added.length; v++) byOrder[order[v]] += block.gains[v][i] * added[v];
    const [k, c, b] = byOrder;
    if (k === 0 && c === 0 && b === 0) return null;
    const row = zeroRow(omega.length);
    for (let t = 0; t < omega.length; t++) {
      row.re[t] = k - b * (omega[t] * omega[t]);
      row.im[t] = c * omega[t];
    }
    return row;
  });
}

/**
 * Return the solved loop of a block: the deflections (q s) by its sources.
 * @param {Block} block
 * @param {(Row | null)[]} stiffness (q q)
 * @returns {Row[]}
 */
export function closed(block, stiffness) {
  const { n, q, s, feedback, sources } = block;
  const loop = Array.from({ length: q }, (_, i) => [
    ...Array.from({ length: q }, (_unused, j) => {
      const row = zeroRow(n);
      if (i === j) row.re.fill(1);
      for (let other = 0; other < q; other++) {
        const own = stiffness[other * q + j];
        if (own) addProduct(-1, feedback[i * q + other], own, row);
      }
      return row;
    }),
    ...sources.slice(i * s, (i + 1) * s).map(copyOf),
  ]);
  eliminate(loop, q);
  return loop.flatMap((line) => line.slice(q));
}

/**
 * Solve linear equations of q unknowns in place, without pivoting: solutions replace the right-hand sides.
 * @param {Row[][]} loop
 * @param {number} q
 */
function eliminate(loop, q) {
  const columns = q && loop[0].length;
  for (let c = 0; c < q; c++) {
    invert(loop[c][c]);
    for (let j = c + 1; j < columns; j++) multiply(loop[c][c], loop[c][j]);
    for (let i = c + 1; i < q; i++) {
      for (let j = c + 1; j < columns; j++) addProduct(-1, loop[i][c], loop[c][j], loop[i][j]);
    }
  }
  for (let c = q - 1; c > 0; c--) {
    for (let i = 0; i < c; i++) {
      for (let j = q; j < columns; j++) addProduct(-1, loop[i][c], loop[c][j], loop[i][j]);
    }
  }
}

/**
 * Add the integrals of the terms of a block to the distinct mean squares.
 * @param {Block} block
 * @param {(Row | null)[]} stiffness (q q)
 * @param {Row[]} loop (q s), solved
 * @param {Float64Array} found
 */
export function addTerms(block, stiffness, loop, found) {
  const { n, q, s, bySource, byStrut, response } = block;
  for (let source = 0; source < s; source++) {
    const tension = Array.from({ length: q }, (_, i) => {
      const row = zeroRow(n);
      for (let j = 0; j < q; j++) {
        const own = stiffness[i * q + j];
        if (own) addProduct(1, own, loop[j * s + source], row);
      }
      return row;
    });
    for (let i = 0; i < response.length; i++) {
      const value = copyOf(bySource[i * s + source]);
      tension.forEach((one, j) => addProduct(1, byStrut[i * q + j], one, value));
      found[response[i]] += sumOfSquares(value);
    }
  }
}

/**
 * Return the mean squares (m,) of all terms by the distinct ones.
 * @param {any} struts
 * @param {Float64Array} found
 * @returns {Float64Array}
 */
export function byChannel(struts, found) {
  return Float64Array.from(struts.channel.data, (channel) => found[channel]);
}

/**
 * Return the mean squares (m,) of a design (v,), see `ManyStruts`.
 * @param {any} struts its packed fields with its `blocks`
 * @param {ArrayLike<number>} design
 * @returns {Float64Array}
 */
export function squaresOfManyStruts(struts, design) {
  const added = Float64Array.from(struts.origin.data, (origin, v) => design[v] - origin);
  const found = new Float64Array(struts.channel.data.length);
  for (const block of struts.blocks) {
    const stiffness = stiffnessOf(block, added, struts.order.data, struts.omega.data);
    addTerms(block, stiffness, closed(block, stiffness), found);
  }
  return byChannel(struts, found);
}
