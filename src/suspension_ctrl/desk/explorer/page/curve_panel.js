// Curves over frequency of the design at hand in a load case, beside those of the present design.

import { byId, choice, later, raised } from "./elements.js";

/** @typedef {import("./explorer.js").Explorer} Explorer */
/** @typedef {{name: "magnitude" | "phase" | "density", title: string, scale: number}} Row */

const HERE = "#d55e00", PRESENT = "#000000";
const FONT = { size: 16, color: "#111111" }; // of which small digits of logarithmic axes have three quarters

/** @param {Explorer} explorer put the curves of a response into the page */
export function drawCurves(explorer) {
  let which = 0, present = explorer.presentCurves();
  const draw = later(() => drawResponse(explorer, which, present));
  const choose = () => {
    const { responses } = explorer.ports;
    [which, present] = [Math.min(which, responses.length - 1), explorer.presentCurves()];
    byId("responses").replaceChildren(choice("response", responses.map((/** @type {string} */ name) => name.replaceAll("_", " ")), which, (i) => { which = i; draw(); }));
    draw();
  };
  explorer.show("case", choose);
  explorer.show("design", draw);
}

/**
 * Draw magnitude, phase and spectrum of a response.
 * @param {Explorer} explorer
 * @param {number} which
 * @param {import("../numerics/frequency_responses.js").ResponseCurves[] | null} present
 */
function drawResponse(explorer, which, present) {
  const [given, factor] = explorer.ports.units[which], unit = raised(given), here = explorer.curves()[which];
  const rows = /** @type {Row[]} */ ([
    { name: "magnitude", title: `gain [(${unit})/m]`, scale: factor },
    { name: "phase", title: "phase [deg]", scale: 1 },
    { name: "density", title: `PSD [(${unit})²/Hz]`, scale: factor ** 2 },
  ]);
  const x = /** @type {number[]} */ (Array.from(explorer.ports.f.data)), dashed = { color: PRESENT, dash: "dash" };
  const lines = trace(rows, x, "this design", here, { color: HERE });
  if (present) lines.push(...trace(rows, x, "present design", present[which], dashed));
  Plotly.react(byId("curves"), lines, layoutOf(rows), { displaylogo: false, responsive: true });
}

/**
 * Return the lines of a design in each of the rows.
 * @param {Row[]} rows
 * @param {number[]} f
 * @param {string} name
 * @param {import("../numerics/frequency_responses.js").ResponseCurves} curves
 * @param {{color: string, dash?: string}} line
 */
function trace(rows, f, name, curves, line) {
  return rows.map((row, i) => ({
    name, mode: "lines", line: { width: 2, ...line }, showlegend: i === 0, yaxis: `y${i + 1}`, x: f,
    y: Array.from(curves[row.name], (value) => row.scale * value),
  }));
}

/** @param {Row[]} rows @returns {any} the layout of curves one above the other */
function layoutOf(rows) {
  const height = 1 / rows.length, gap = 0.04;
  const axes = rows.map(({ name, title }, i) => [`yaxis${i + 1}`, {
    title: { text: title }, type: name === "phase" ? "linear" : "log", exponentformat: "power",
    domain: [1 - (i + 1) * height + gap, 1 - i * height],
  }]);
  return {
    margin: { l: 80, r: 20, t: 30, b: 55 }, height: 620, font: FONT, legend: { orientation: "h", y: 1.06 },
    xaxis: { type: "log", title: { text: "frequency [Hz]" }, anchor: `y${rows.length}` }, ...Object.fromEntries(axes),
  };
}
