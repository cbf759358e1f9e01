// Parallel coordinates: a line for each design over an axis for each column. A drag along an axis filters by it.

import { byId, digits, headed, svg } from "./elements.js";
import { FAINT, MARKS } from "./palette.js";

/** @typedef {import("./explorer.js").Explorer} Explorer */
/** @typedef {{least: number, largest: number, x: number}} Axis */

const TOP = 40, BOTTOM = 300, HEIGHT = 330, ROOM = 160; // of an axis

/** @param {Explorer} explorer put parallel coordinates into the page */
export function drawLines(explorer) {
  const axes = explorer.columns.map((column, i) => {
    const values = explorer.points.map((point) => explorer.valueAt(column, point)).filter(Number.isFinite);
    return { least: Math.min(...values), largest: Math.max(...values), x: ROOM * (i + 0.5) };
  });
  const width = ROOM * axes.length, chart = svg("svg", { viewBox: `0 0 ${width} ${HEIGHT}`, width, height: HEIGHT });
  chart.setAttribute("role", "img");
  chart.setAttribute("aria-label", "Lines of designs over all measures and variables");
  const lines = svg("g", { fill: "none" }), ranges = svg("g", {});
  const here = svg("polyline", { fill: "none", stroke: MARKS.here, "stroke-width": 3, "pointer-events": "none" });
  chart.append(lines, here, ...axes.map((axis, i) => axisOf(explorer, axis, i)), ranges);
  byId("lines").append(chart);
  explorer.show("design", () => {
    const places = explorer.columns.map((column, i) => place(axes[i], explorer.valueHere(column) ?? NaN));
    here.setAttribute("points", places.filter(([, y]) => Number.isFinite(y)).join(" "));
  });
  explorer.show("shown", () => {
    lines.replaceChildren(...linesOf(explorer, axes));
    ranges.replaceChildren(...axes.flatMap((axis, i) => rangeOf(axis, explorer.filters[i])));
  });
  axes.forEach((axis, i) => draggable(explorer, chart, axis, i));
}

/** @param {Axis} axis @param {number} value @returns {number} its place from the top */
function placeOn({ least, largest }, value) {
  const share = largest > least ? (value - least) / (largest - least) : 0.5;
  return BOTTOM - Math.min(1, Math.max(0, share)) * (BOTTOM - TOP);
}

/** @param {Axis} axis @param {number} value @returns {[number, number]} */
function place(axis, value) {
  return [axis.x, placeOn(axis, value)];
}

/** @param {Explorer} explorer @param {Axis} axis @param {number} i @returns {SVGElement} line, name and ends */
function axisOf(explorer, axis, i) {
  const group = svg("g", { "font-size": 13, "text-anchor": "middle" });
  const texts = [[headed(explorer.columns[i]), 14], [digits(axis.largest), 32], [digits(axis.least), BOTTOM + 18]];
  group.append(svg("line", { x1: axis.x, x2: axis.x, y1: TOP, y2: BOTTOM, stroke: "#333" }));
  group.append(...texts.map(([text, y]) => {
    const label = svg("text", { x: axis.x, y });
    label.textContent = String(text).length > 22 ? `${String(text).slice(0, 21)}…` : String(text);
    return label;
  }));
  return group;
}

/** @param {Explorer} explorer @param {Axis[]} axes @returns {SVGElement[]} marked designs above all others */
function linesOf(explorer, axes) {
  const { brushed, columns } = explorer, marked = (/** @type {any} */ point) => !brushed || brushed.has(point);
  const rank = (/** @type {any} */ point) => (point.group === "front" ? Number(marked(point)) : 2);
  return explorer.shown().sort((a, b) => rank(a) - rank(b)).map((point) => {
    const places = columns.map((column, i) => place(axes[i], explorer.valueAt(column, point)));
    const line = svg("polyline", {
      points: places.join(" "), stroke: marked(point) ? MARKS[point.group] : FAINT,
      "stroke-width": point.group === "front" ? 1 : 2, "stroke-opacity": point.group === "front" ? 0.35 : 1,
      "stroke-dasharray": point.group === "present" ? "7 4" : "none",
    });
    line.addEventListener("click", () => explorer.choose(point.design));
    return line;
  });
}

/** @param {Axis} axis @param {[number, number]} range @returns {SVGElement[]} a box over the range of a filter */
function rangeOf(axis, range) {
  if (!range.some(Number.isFinite)) return [];
  const [low, high] = [placeOn(axis, range[0]), placeOn(axis, range[1])];
  const box = { x: axis.x - 7, width: 14, y: high, height: Math.max(1, low - high) };
  return [svg("rect", { ...box, fill: "#0072b2", "fill-opacity": 0.3, stroke: "#0072b2", "pointer-events": "none" })];
}

/** @param {Explorer} explorer @param {SVGElement} chart @param {Axis} axis @param {number} i */
function draggable(explorer, chart, axis, i) {
  const handle = svg("rect", { x: axis.x - 12, y: TOP, width: 24, height: BOTTOM - TOP, "fill-opacity": 0 });
  handle.setAttribute("class", "handle");
  chart.append(handle);
  const valueAt = (/** @type {PointerEvent} */ event) => {
    const { top, height } = chart.getBoundingClientRect();
    const share = (BOTTOM - ((event.clientY - top) * HEIGHT) / height) / (BOTTOM - TOP);
    return axis.least + Math.min(1, Math.max(0, share)) * (axis.largest - axis.least);
  };
  let start = NaN;
  handle.addEventListener("pointerdown", (event) => {
    start = valueAt(event);
    handle.setPointerCapture(event.pointerId);
  });
  handle.addEventListener("pointerup", (event) => {
    const end = valueAt(event);
    if (end !== start) explorer.filter(i, [Math.min(start, end), Math.max(start, end)]);
  });
  handle.addEventListener("dblclick", () => explorer.filter(i, [-Infinity, Infinity]));
}
