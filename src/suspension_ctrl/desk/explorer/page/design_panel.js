// The design at hand: a slider for each variable, its measures beside the present ones, its curves over frequency.

import { byId, choice, digits, element, headed, later } from "./elements.js";

/** @typedef {import("./explorer.js").Explorer} Explorer */
/** @typedef {import("./explorer.js").Variable} Variable */

const STEPS = 1000; // of a slider
const HERE = "#d55e00", PRESENT = "#000000";

/** @param {Explorer} explorer put sliders, measures and curves into the page */
export function drawDesign(explorer) {
  const named = explorer.points.filter((point) => point.name);
  byId("sliders").append(
    choice("start from", named.map(({ name }) => name), named.findIndex((point) => point === explorer.stored), (i) =>
      explorer.choose(named[i].design),
    ),
    ...explorer.variables.map((variable, v) => slider(explorer, variable, v)),
  );
  explorer.show("design", () => byId("measures").replaceChildren(...measures(explorer)));
  drawCurves(explorer);
}

/** @param {Explorer} explorer @param {Variable} variable @param {number} v @returns {HTMLElement} */
function slider(explorer, variable, v) {
  const last = variable.values.length ? variable.values.length - 1 : STEPS;
  const input = element("input", { type: "range", min: "0", max: String(last), step: "1" });
  const output = element("output");
  input.addEventListener("input", () => {
    const design = Float64Array.from(explorer.design);
    design[v] = valueAt(variable, Number(input.value));
    explorer.choose(design);
  });
  explorer.show("design", () => {
    const value = explorer.design[v];
    if (document.activeElement !== input) input.value = String(placeOf(variable, value));
    output.textContent = `${digits(value * variable.factor)} ${variable.unit}`;
    output.dataset.value = String(value);
  });
  return element("label", { className: "slider" }, variable.name, input, output);
}

/**
 * Return the value of a variable at a place of its slider.
 * @param {Variable} variable
 * @param {number} place
 */
export function valueAt({ kind, low, high, values }, place) {
  if (values.length) return values[place];
  const share = place / STEPS;
  if (kind === "log") return low * (high / low) ** share;
  const value = low + (high - low) * share;
  return kind === "integer" ? Math.round(value) : value;
}

/**
 * Return the place of a value on the slider of a variable.
 * @param {Variable} variable
 * @param {number} value
 */
export function placeOf({ kind, low, high, values }, value) {
  if (values.length) {
    const distance = values.map((one) => Math.abs(one - value));
    return distance.indexOf(Math.min(...distance));
  }
  const share = kind === "log" ? Math.log(value / low) / Math.log(high / low) : (value - low) / (high - low);
  return Math.round(STEPS * share);
}

/** @param {Explorer} explorer @returns {HTMLElement[]} rows of the measures of the design at hand */
function measures(explorer) {
  const { columns, present } = explorer, kept = explorer.points.filter(({ group }) => group === "kept");
  const line = (/** @type {"th" | "td"} */ tag, /** @type {string[]} */ cells) =>
    element("tr", {}, ...cells.map((cell) => element(tag, {}, cell)));
  const rows = columns.filter((column) => column.kind !== "variable").map((column) => {
    const here = explorer.valueHere(column), own = present && explorer.valueAt(column, present);
    const change = here === null || !own ? null : (100 * (here - own)) / Math.abs(own);
    const others = kept.map((point) => digits(explorer.valueAt(column, point)));
    const cells = [headed(column), digits(here), digits(own), change === null ? "–" : change.toFixed(1), ...others];
    const row = line("td", cells);
    row.dataset.value = String(here);
    const [least, largest] = column.limits.map((limit) => limit && limit * column.factor);
    row.className = here !== null && ((largest && here > largest) || (least && here < least)) ? "beyond" : "";
    return row;
  });
  return [line("th", ["measure", "this design", "present", "change [%]", ...kept.map(({ name }) => name)]), ...rows];
}

/** @param {Explorer} explorer put the curves of a response into the page */
function drawCurves(explorer) {
  const { responses, units, f } = explorer.ports, present = explorer.presentCurves();
  let which = 0;
  const draw = () => {
    const [unit, factor] = units[which], here = explorer.curves()[which];
    const rows = /** @type {{name: "magnitude" | "phase" | "density", title: string, scale: number}[]} */ ([
      { name: "magnitude", title: `[${unit}/m]`, scale: factor },
      { name: "phase", title: "phase [deg]", scale: 1 },
      { name: "density", title: `PSD [(${unit})²/Hz]`, scale: factor ** 2 },
    ]);
    const x = /** @type {number[]} */ (Array.from(f.data)), dashed = { color: PRESENT, dash: "dash" };
    const lines = trace(rows, x, "this design", here, { color: HERE });
    if (present) lines.push(...trace(rows, x, "present design", present[which], dashed));
    Plotly.react(byId("curves"), lines, curveLayout(rows), { displaylogo: false, responsive: true });
  };
  byId("responses").append(choice("response", responses, which, (i) => { which = i; draw(); }));
  explorer.show("design", later(draw));
}

/**
 * Return the lines of a design in each of the rows.
 * @param {{name: "magnitude" | "phase" | "density", scale: number}[]} rows
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

/** @param {{name: string, title: string}[]} rows @returns {any} the layout of curves one above the other */
function curveLayout(rows) {
  const height = 1 / rows.length, gap = 0.04;
  const axes = rows.map(({ name, title }, i) => [`yaxis${i + 1}`, {
    title: { text: title }, type: name === "phase" ? "linear" : "log", exponentformat: "power",
    domain: [1 - (i + 1) * height + gap, 1 - i * height],
  }]);
  return {
    margin: { l: 70, r: 10, t: 30, b: 45 }, height: 620, legend: { orientation: "h", y: 1.06 },
    xaxis: { type: "log", title: { text: "frequency [Hz]" }, anchor: `y${rows.length}` }, ...Object.fromEntries(axes),
  };
}
