// Answers of the explorer's numerics: argument is a file of records, output their scores and curves as JSON.

import { readFileSync } from "node:fs";
import { assigned } from "../../../src/suspension_ctrl/desk/explorer/numerics/assignment.js";
import { eigenOf } from "../../../src/suspension_ctrl/desk/explorer/numerics/eigenvalues.js";
import { gamma, normal } from "../../../src/suspension_ctrl/desk/explorer/numerics/gaussian.js";
import { curvesOf, preparedPorts } from "../../../src/suspension_ctrl/desk/explorer/numerics/frequency_responses.js";
import { forceAt } from "../../../src/suspension_ctrl/desk/explorer/numerics/law_curves.js";
import { curvesAt, networksOf } from "../../../src/suspension_ctrl/desk/explorer/numerics/network_rows.js";
import { modesOf } from "../../../src/suspension_ctrl/desk/explorer/numerics/modes.js";
import { placeOf, valueAt } from "../../../src/suspension_ctrl/desk/explorer/page/design_panel.js";
import { unpacked } from "../../../src/suspension_ctrl/desk/explorer/numerics/packed.js";
import { evaluated, innerOf, prepared } from "../../../src/suspension_ctrl/desk/explorer/numerics/scores.js";

/** @param {any} record @returns {any} scores, milliseconds and positions of all designs, curves of the first */
function answer({ kernel, ports, matrices, functions, designs }) {
  const plants = unpacked(matrices), ready = prepared(unpacked(kernel), unpacked(functions), plants);
  designs.forEach((/** @type {number[]} */ design) => evaluated(ready, design)); // compiles
  const found = designs.map((/** @type {number[]} */ design) => {
    const start = performance.now(), evaluation = evaluated(ready, design);
    return { ...evaluation, milliseconds: performance.now() - start };
  });
  const { coefficients, point } = found[0].cases[0];
  const curves = curvesOf(preparedPorts(unpacked(ports)), coefficients, point).map(Object.entries);
  return {
    modes: modesOf(plants[0], coefficients, innerOf(ready.cases[0]).networks ?? null, point),
    scores: found.map((/** @type {any} */ one) => [...one.scores]),
    milliseconds: found.map((/** @type {any} */ one) => one.milliseconds),
    positions: found.map((/** @type {any} */ one) => one.cases[0].point && [...one.cases[0].point.positions]),
    curves: curves.map((/** @type {any} */ one) => Object.fromEntries(one.map(([k, v]) => [k, [...v]]))),
  };
}

/** @param {any} record @returns {number[][]} forces of the laws of a case at rates or deflections */
function forces({ networks, values, places }) {
  const ready = networksOf(unpacked(networks)), curves = curvesAt(ready, values);
  return ready.laws.map(({ power: [factor, exponent] }, law) => {
    const power = factor < 0 ? null : /** @type {[number, number]} */ ([values[factor], values[exponent]]);
    return places.map((/** @type {number} */ x) => forceAt(curves[law], power, x));
  });
}

/** @param {any} variable @param {number} place @returns {number[]} value at a place of the slider, and its own place */
function slid(variable, place) {
  const whole = { kind: "", low: 0, high: 10, values: [], ...variable }, value = valueAt(whole, place);
  return [value, placeOf(whole, value)];
}

/** @param {number[][]} matrix @returns {number[][]} eigenvalues, then eigenvectors, parts in turn */
function eigen(matrix) {
  const { values, vectors } = eigenOf(matrix);
  return [values, ...vectors].map((one) => Array.from(one));
}

const { records, laws, normals, gammas, matrices, costs } = JSON.parse(readFileSync(process.argv[2], "utf-8"));
console.log(JSON.stringify({
  records: Object.fromEntries(Object.entries(records).map(([name, record]) => [name, answer(record)])),
  laws: Object.fromEntries(Object.entries(laws).map(([name, record]) => [name, forces(record)])),
  normals: normals.map(normal),
  gammas: gammas.map(gamma),
  eigen: matrices.map(eigen),
  assigned: costs.map(assigned),
  sliders: [
    slid({ kind: "integer" }, 640), slid({ kind: "log", low: 10, high: 40 }, 500),
    slid({ kind: "catalogue", values: [10, 15, 40] }, 1), slid({}, 300),
  ],
}));
