// Answers of the explorer's numerics: argument is a file of records, output their scores and curves as JSON.

import { readFileSync } from "node:fs";
import { gamma, normal } from "../../../src/suspension_ctrl/desk/explorer/numerics/gaussian.js";
import { curvesOf, preparedPorts } from "../../../src/suspension_ctrl/desk/explorer/numerics/frequency_responses.js";
import { unpacked } from "../../../src/suspension_ctrl/desk/explorer/numerics/packed.js";
import { evaluated, prepared } from "../../../src/suspension_ctrl/desk/explorer/numerics/scores.js";

/** @param {any} record @returns {any} scores, milliseconds and positions of all designs, curves of the first */
function answer({ kernel, ports, designs }) {
  const ready = prepared(unpacked(kernel));
  designs.forEach((/** @type {number[]} */ design) => evaluated(ready, design)); // compiles
  const found = designs.map((/** @type {number[]} */ design) => {
    const start = performance.now(), evaluation = evaluated(ready, design);
    return { ...evaluation, milliseconds: performance.now() - start };
  });
  const { coefficients, point } = found[0].cases[0];
  const curves = curvesOf(preparedPorts(unpacked(ports)), coefficients, point).map(Object.entries);
  return {
    scores: found.map((/** @type {any} */ one) => [...one.scores]),
    milliseconds: found.map((/** @type {any} */ one) => one.milliseconds),
    positions: found.map((/** @type {any} */ one) => one.cases[0].point && [...one.cases[0].point.positions]),
    curves: curves.map((/** @type {any} */ one) => Object.fromEntries(one.map(([k, v]) => [k, [...v]]))),
  };
}

const { records, normals, gammas } = JSON.parse(readFileSync(process.argv[2], "utf-8"));
console.log(JSON.stringify({
  records: Object.fromEntries(Object.entries(records).map(([name, record]) => [name, answer(record)])),
  normals: normals.map(normal),
  gammas: gammas.map(gamma),
}));
