// Frequency responses and spectra of a design, by closing the struts around the plant's strut-port responses.

import { rowsOfNodes, directOf, networksOf, stiffnessAt } from "./network_rows.js";
import { rowsIn } from "./packed.js";

/** @typedef {import("./networked.js").Point} Point */

const ROUNDING = 1e-11; // of a sum over wheels, relative

/**
 * Curves (n,) of a response: magnitude [unit/m] and phase [deg] to a road common to all tracks, spectrum on the road.
 * @typedef {{magnitude: Float64Array, phase: Float64Array, density: Float64Array}} ResponseCurves
 */

/**
 * Return packed ports ready for use.
 * @param {any} ports
 * @returns {any}
 */
export function preparedPorts(ports) {
  return { ...ports, networks: ports.networks && networksOf(ports.networks) };
}

/**
 * Return the curves of each response of a design with these coefficients (v,) at a working point.
 * @param {any} ports prepared
 * @param {ArrayLike<number>} coefficients
 * @param {Point | null} point
 * @returns {ResponseCurves[]}
 */
export function curvesOf(ports, coefficients, point) {
  const { m, r } = ports, n = ports.omega.data.length;
  const stiffness = stiffnessOver(ports, coefficients, point);
  /** @type {ResponseCurves[]} */
  const found = Array.from({ length: m }, () => ({
    magnitude: new Float64Array(n), phase: new Float64Array(n), density: new Float64Array(n),
  }));
  for (let t = 0; t < n; t++) {
    const closed = closedAt(ports, stiffness(t), t);
    for (let i = 0; i < m; i++) {
      const own = closed.subarray(2 * i * r, 2 * (i + 1) * r);
      const [re, im] = toCommonRoad(own, ports.delays.data, ports.omega.data[t]);
      found[i].magnitude[t] = Math.hypot(re, im);
      found[i].phase[t] = (Math.atan2(im, re) * 180) / Math.PI;
      found[i].density[t] = densityOf(own, ports.roads.data.subarray(2 * t * r * r, 2 * (t + 1) * r * r));
    }
  }
  found.forEach((one) => unwrap(one.phase));
  return found;
}

/**
 * Return a function to D (q q) at a frequency, real and imaginary parts in turn.
 * @param {any} ports
 * @param {ArrayLike<number>} coefficients
 * @param {Point | null} point
 * @returns {(t: number) => Float64Array}
 */
function stiffnessOver(ports, coefficients, point) {
  const { q, networks } = ports, omega = ports.omega.data, gains = rowsIn(ports.gain);
  const added = Float64Array.from(ports.origin.data, (origin, v) => coefficients[v] - origin);
  const direct = point ? directOf(networks, point.values, point.states) : [];
  const rows = point ? rowsOfNodes(networks, omega, point.values, direct) : [];
  const nominal = rowsIn(ports.nominal);
  return (t) => {
    const w = omega[t], powers = [[1, 0], [0, w], [-w * w, 0]], d = new Float64Array(2 * q * q);
    gains.forEach((gain, v) => {
      const [re, im] = powers[ports.order.data[v]];
      for (let i = 0; i < q * q; i++) {
        d[2 * i] += gain[i] * added[v] * re;
        d[2 * i + 1] += gain[i] * added[v] * im;
      }
    });
    (point ? networks.root : []).forEach((/** @type {number} */ root, /** @type {number} */ which) => {
      const [re, im] = stiffnessAt(direct[root], rows[root], w, t);
      for (let j = 0; j < q; j++) {
        if (!networks.ports[which][j]) continue;
        d[2 * (j * q + j)] += re - nominal[which][0];
        d[2 * (j * q + j) + 1] += im - w * nominal[which][1];
      }
    });
    return d;
  };
}

/**
 * Return H (m r) = P11 + P12 (1 - D P22)^-1 D P21 at a frequency.
 * @param {any} ports
 * @param {Float64Array} d (q q)
 * @param {number} t
 * @returns {Float64Array}
 */
function closedAt({ h, m, r, q }, d, t) {
  const width = r + q, own = h.data.subarray(2 * t * (m + q) * width, 2 * (t + 1) * (m + q) * width);
  const at = (/** @type {number} */ i, /** @type {number} */ j) => 2 * (i * width + j);
  // Equations (q, q + r): 1 - D P22 beside D P21.
  const lines = Array.from({ length: q }, (_, i) => {
    const line = new Float64Array(2 * (q + r));
    for (let j = 0; j < q + r; j++) {
      const [column, sign] = j < q ? [r + j, -1] : [j - q, 1];
      for (let k = 0; k < q; k++) accumulate(line, 2 * j, sign, d, 2 * (i * q + k), own, at(m + k, column));
    }
    line[2 * i] += 1;
    return line;
  });
  solve(lines, q);
  const found = new Float64Array(2 * m * r);
  for (let i = 0; i < m; i++) {
    for (let j = 0; j < r; j++) {
      const to = 2 * (i * r + j), from = at(i, j);
      [found[to], found[to + 1]] = [own[from], own[from + 1]];
      for (let k = 0; k < q; k++) accumulate(found, to, 1, own, at(i, r + k), lines[k], 2 * (q + j));
    }
  }
  return found;
}

/**
 * Add the product of two complex numbers, times a sign, to a third; each at a place of an array.
 * @param {Float64Array} total
 * @param {number} i
 * @param {number} sign
 * @param {ArrayLike<number>} left
 * @param {number} j
 * @param {ArrayLike<number>} right
 * @param {number} k
 */
function accumulate(total, i, sign, left, j, right, k) {
  total[i] += sign * (left[j] * right[k] - left[j + 1] * right[k + 1]);
  total[i + 1] += sign * (left[j] * right[k + 1] + left[j + 1] * right[k]);
}

/** @param {Float64Array[]} lines solve linear equations in place with pivoting @param {number} q */
function solve(lines, q) {
  for (let c = 0; c < q; c++) {
    const size = (/** @type {number} */ i) => Math.hypot(lines[i][2 * c], lines[i][2 * c + 1]);
    let best = c;
    for (let i = c + 1; i < q; i++) if (size(i) > size(best)) best = i;
    [lines[c], lines[best]] = [lines[best], lines[c]];
    const [re, im] = [lines[c][2 * c], lines[c][2 * c + 1]], square = re * re + im * im;
    for (let j = 0; j < lines[c].length; j += 2) {
      const [x, y] = [lines[c][j], lines[c][j + 1]];
      [lines[c][j], lines[c][j + 1]] = [(x * re + y * im) / square, (y * re - x * im) / square];
    }
    for (let i = 0; i < q; i++) {
      if (i === c) continue;
      const factor = lines[i].slice(2 * c, 2 * c + 2);
      for (let j = 0; j < lines[i].length; j += 2) accumulate(lines[i], j, -1, factor, 0, lines[c], j);
    }
  }
}

/**
 * Return the response to a road identical on all tracks, with delays of the wheels [s].
 * @param {Float64Array} own (r,)
 * @param {ArrayLike<number>} delays (r,)
 * @param {number} w
 * @returns {[number, number]}
 */
function toCommonRoad(own, delays, w) {
  const total = new Float64Array(2);
  let size = 0;
  for (let j = 0; j < delays.length; j++) {
    accumulate(total, 0, 1, own, 2 * j, [Math.cos(w * delays[j]), -Math.sin(w * delays[j])], 0);
    size += Math.hypot(own[2 * j], own[2 * j + 1]);
  }
  return Math.hypot(total[0], total[1]) < ROUNDING * size ? [0, 0] : [total[0], total[1]];
}

/** @param {Float64Array} own (r,) @param {ArrayLike<number>} roads (r r) @returns {number} H G H* */
function densityOf(own, roads) {
  const r = own.length / 2, total = new Float64Array(2), line = new Float64Array(2);
  for (let j = 0; j < r; j++) {
    line.fill(0);
    for (let i = 0; i < r; i++) accumulate(line, 0, 1, own, 2 * i, roads, 2 * (i * r + j));
    accumulate(total, 0, 1, line, 0, [own[2 * j], -own[2 * j + 1]], 0);
  }
  return total[0];
}

/** @param {Float64Array} phase make it continuous, beginning between -90 and 270 [deg] */
function unwrap(phase) {
  for (let t = 1; t < phase.length; t++) {
    phase[t] -= 360 * Math.round((phase[t] - phase[t - 1]) / 360);
  }
  const turn = phase[0] < -90 ? 360 : 0;
  for (let t = 0; t < phase.length; t++) phase[t] += turn;
}
