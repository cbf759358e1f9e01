// Static loads of tyres, and the lean of the body in a steady curve; see vehicles/handling.py.

import { solved } from "./linear_equations.js";
import { staticsOf } from "./mean_position.js";
import { curvesAt } from "./network_rows.js";
import { rowsIn } from "./packed.js";
import { matricesAt, numbersAt } from "./state_matrix.js";

/** @typedef {import("./network_rows.js").Networks} Networks */
/** @typedef {{tyres: number[], wheels: number[], track: number, height: number}} Axle its left and right */
/** @typedef {{roll: number, arm: number, wheel: number, axles: Axle[]}} Cornering heights [m] */
/**
 * A vehicle's packed `PlantMatrices`, coefficients (c,) and networks.
 * @typedef {{plant: any, values: Float64Array, networks: Networks | null}} Vehicle
 */

const GRAVITY = 9.80665; // m/s^2
const TOPPLED = 180; // deg/g

/** @param {Vehicle} vehicle @returns {number[]} load (t,) of each tyre on level ground [N] */
export function staticLoads(vehicle) {
  const weights = numbersAt(vehicle.plant, "weights", vehicle.values);
  const places = solved(stiffnessOf(vehicle), Array.from(weights, (mass) => [-GRAVITY * mass]));
  return tensionsOf(vehicle, places).map((tension) => -tension);
}

/** @param {Vehicle} vehicle @param {Float64Array[]} places (n, 1) @returns {number[]} tensions */
function tensionsOf({ plant, values }, places) {
  const loads = rowsIn({ shape: plant.loads.shape, data: numbersAt(plant, "loads", values) });
  return loads.map((row) => places.reduce((sum, [place], i) => sum + row[i] * place, 0));
}

/** @param {Vehicle} vehicle @returns {Float64Array[]} stiffness (n, n), of force laws by their slopes at 0 */
function stiffnessOf({ plant, values, networks }) {
  const { stiffness } = matricesAt(plant, values, null, null, 1), ends = rowsIn(plant.struts);
  if (!networks) return stiffness;
  const states = curvesAt(networks, values).map((curve) => ({
    deviation: 1, mean: 0, force: 0, slope: slopeAtOrigin(curve), change: 0, before: 0, step: 0, next: 0,
  }));
  const statics = staticsOf(networks, values, states);
  networks.root.forEach((root, t) => ends.forEach((own, port) => {
    const added = networks.ports[t][port] ? statics[root].stiffness : 0;
    stiffness.forEach((row, i) => row.forEach((_, j) => (row[j] += added * own[i] * own[j])));
  }));
  return stiffness;
}

/** @param {import("./gaussian.js").Curve} curve @returns {number} slope at 0, on a knot the mean of both sides */
function slopeAtOrigin({ count, knots, slopes }) {
  const own = knots.subarray(0, count);
  const below = own.filter((knot) => knot < 0).length, upTo = own.filter((knot) => knot <= 0).length;
  return (slopes[below] + slopes[upTo]) / 2;
}

/** @param {Vehicle} vehicle @param {Cornering} cornering @returns {number} roll angle [deg/g], 180 if it topples */
export function rollGradient(vehicle, cornering) {
  const { stiffness, places } = leanOf(vehicle, cornering);
  const lean = (places[cornering.roll][0] * 180) / Math.PI;
  return isPositive(stiffness) ? Math.min(lean, TOPPLED) : TOPPLED;
}

/** @param {Vehicle} vehicle @param {Cornering} cornering @returns {number} share of the front axle */
export function frontLoadTransfer(vehicle, cornering) {
  const tensions = tensionsOf(vehicle, leanOf(vehicle, cornering).places);
  const [front, rear] = cornering.axles.map(({ tyres: [left] }) => tensions[left]);
  return front / (front + rear);
}

/**
 * Return the stiffness less the moment of the leaning weight, and the places (n, 1) at 1 g to the left.
 * @param {Vehicle} vehicle
 * @param {Cornering} cornering
 * @returns {{stiffness: Float64Array[], places: Float64Array[]}}
 */
function leanOf(vehicle, { roll, arm, wheel, axles }) {
  const { plant, values } = vehicle, [sprung] = numbersAt(plant, "sprung", values);
  const weights = numbersAt(plant, "weights", values), loads = staticLoads(vehicle);
  const stiffness = stiffnessOf(vehicle), moment = sprung * GRAVITY * arm, right = stiffness.map(() => [0]);
  stiffness[roll][roll] -= moment;
  right[roll][0] = moment;
  for (const { tyres, wheels: [one, other], track, height } of axles) {
    const own = 2 * weights[one] * GRAVITY, body = loads[tyres[0]] + loads[tyres[1]] - own;
    right[one][0] = (body * height + own * wheel) / track;
    right[other][0] = -right[one][0];
  }
  return { stiffness, places: solved(stiffness, right) };
}

/** @param {Float64Array[]} matrix symmetric @returns {boolean} whether its eigenvalues are above 0, by its pivots */
function isPositive(matrix) {
  const lines = matrix.map((row) => row.slice());
  return lines.every((line, c) => {
    for (let i = c + 1; i < lines.length; i++) {
      const factor = lines[i][c] / line[c];
      for (let j = c; j < line.length; j++) lines[i][j] -= factor * line[j];
    }
    return line[c] > 0;
  });
}
