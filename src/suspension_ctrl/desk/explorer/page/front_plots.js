// The front as linked projections and in 3-D: designs, candidates, the present design and the one at hand.

import { byId, choice, element, headed, later } from "./elements.js";

/** @typedef {import("./explorer.js").Explorer} Explorer */
/** @typedef {import("./explorer.js").Column} Column */
/** @typedef {import("./explorer.js").Point} Point */

const SCALE = "Cividis"; // even in lightness, told apart by all
const HERE = "#d55e00", PRESENT = "#000000", KEPT = "#009e73", FAINT = "#bbbbbb"; // of Okabe and Ito
const OTHERS = ["#999999", "#cc79a7", "#56b4e9", "#009e73"];
const CONFIG = { displaylogo: false, responsive: true, modeBarButtonsToRemove: ["sendDataToCloud"] };
const MOST = 4; // projections

/** @param {Explorer} explorer put choices of axes and all plots into the page */
export function drawFront(explorer) {
  const measures = explorer.columns.filter((column) => column.kind !== "variable");
  const axes = { across: 0, colour: Math.min(2, explorer.columns.length - 1), space: [0, 1, 2] };
  const names = explorer.columns.map(headed);
  const redraw = () => explorer.tell("shown");
  /** @type {(label: string, first: number, set: (index: number) => void) => HTMLElement} */
  const chooser = (label, first, set) => choice(label, names, first, (index) => { set(index); redraw(); });
  byId("axes").append(
    chooser("across", axes.across, (i) => (axes.across = i)),
    chooser("colour", axes.colour, (i) => (axes.colour = i)),
    ...["x", "y", "z"].map((name, k) => chooser(`3-D ${name}`, axes.space[k], (i) => (axes.space[k] = i))),
  );
  const count = Math.min(MOST, measures.length - 1);
  const panels = Array.from({ length: count }, () => element("div", { className: "plot" }));
  byId("projections").append(...panels);
  const draw = () => {
    const up = measures.filter((column) => column !== explorer.columns[axes.across]);
    panels.forEach((panel, i) => projection(explorer, panel, explorer.columns[axes.across], up[i], axes.colour));
    inSpace(explorer, axes.space.map((i) => explorer.columns[i]), axes.colour);
  };
  const move = () => {
    const up = measures.filter((column) => column !== explorer.columns[axes.across]);
    panels.forEach((panel, i) => moved(explorer, panel, [explorer.columns[axes.across], up[i]], ["x", "y"]));
    moved(explorer, byId("space"), axes.space.map((i) => explorer.columns[i]), ["x", "y", "z"]);
  };
  explorer.show("shown", draw);
  explorer.show("design", later(move));
  panels.forEach((panel) => linked(explorer, panel));
  linked(explorer, byId("space"));
}

/** @param {Explorer} explorer @param {HTMLElement} panel clicks choose a design, boxes and lassos mark designs */
function linked(explorer, panel) {
  const plot = /** @type {any} */ (panel);
  const pointsOf = (/** @type {any} */ event) =>
    event.points.map((/** @type {any} */ one) => explorer.points[one.customdata]).filter(Boolean);
  plot.on("plotly_click", (/** @type {any} */ event) => {
    const [point] = pointsOf(event);
    if (point) explorer.choose(point.design);
  });
  plot.on("plotly_selected", (/** @type {any} */ event) => event && explorer.brush(new Set(pointsOf(event))));
  plot.on("plotly_deselect", () => explorer.brush(null));
}

/**
 * Return the traces of all designs over these columns, the names of their coordinates given.
 * @param {Explorer} explorer
 * @param {Column[]} columns
 * @param {string[]} coordinates
 * @param {number} colour
 * @param {Record<string, any>} style
 */
function traces(explorer, columns, coordinates, colour, style) {
  const shown = explorer.shown(), { brushed } = explorer;
  const marked = (/** @type {Point} */ point) => !brushed || brushed.has(point);
  /** @type {(name: string, points: Point[], marker: any, extra?: any) => any} */
  const trace = (name, points, marker, extra = {}) => ({
    name, mode: "markers", ...style, ...extra, marker,
    customdata: points.map((point) => explorer.points.indexOf(point)),
    ...Object.fromEntries(coordinates.map((axis, i) => [axis, points.map((p) => explorer.valueAt(columns[i], p))])),
  });
  const front = shown.filter((point) => point.group === "front");
  const lit = front.filter(marked), candidates = shown.filter((point) => point.group === "candidate");
  const by = explorer.columns[colour];
  const shades = {
    size: 5, color: lit.map((point) => explorer.valueAt(by, point)), colorscale: SCALE, showscale: true,
    colorbar: { title: { text: headed(by), side: "right" }, thickness: 10 },
  };
  const numbers = candidates.map(({ name }) => name.split(" ")[0]);
  const texts = { mode: "markers+text", text: numbers, textposition: "top center" };
  const ofGroup = (/** @type {Point["group"]} */ group) => shown.filter((point) => point.group === group);
  return [
    trace("others", front.filter((point) => !marked(point)), { size: 4, color: FAINT }),
    trace("front", lit, shades),
    trace("candidates", candidates, { size: 9, color: PRESENT, symbol: "circle-open" }, texts),
    trace("kept", ofGroup("kept"), { size: 10, color: KEPT, symbol: "square-open" }),
    trace("present design", ofGroup("present"), { size: 9, color: PRESENT, symbol: "square" }),
    ...otherFronts(explorer, columns, coordinates, style),
    here(explorer, columns, coordinates, style),
  ];
}

/** @param {Explorer} explorer @param {Column[]} columns @param {string[]} coordinates @param {any} style */
function otherFronts(explorer, columns, coordinates, style) {
  if (columns.some(({ kind }) => kind !== "objective")) return [];
  return explorer.others.map(({ name, objectives }, i) => ({
    name, mode: "markers", hoverinfo: "skip", ...style,
    marker: { size: 4, color: OTHERS[i % OTHERS.length], symbol: "diamond-open" },
    ...Object.fromEntries(coordinates.map((axis, k) =>
      [axis, objectives.map((row) => row[columns[k].place] * columns[k].factor)])),
  }));
}

/** @param {Explorer} explorer @param {Column[]} columns @param {string[]} coordinates @param {any} style */
function here(explorer, columns, coordinates, style) {
  const marker = { size: 11, color: HERE, symbol: "diamond" }, place = placeOfDesign(explorer, columns);
  const own = coordinates.map((axis, i) => [axis, place.map((values) => values[i])]);
  return { name: "design at hand", mode: "markers", hoverinfo: "skip", ...style, marker, ...Object.fromEntries(own) };
}

/** @param {Explorer} explorer @param {Column[]} columns @returns {number[][]} none if a value is not known */
function placeOfDesign(explorer, columns) {
  const values = columns.map((column) => explorer.valueHere(column));
  return values.some((value) => value === null) ? [] : [/** @type {number[]} */ (values)];
}

/** @param {Explorer} explorer @param {HTMLElement} panel @param {Column[]} columns @param {string[]} coordinates */
function moved(explorer, panel, columns, coordinates) {
  const place = placeOfDesign(explorer, columns), last = /** @type {any} */ (panel).data.length - 1;
  const own = coordinates.map((axis, i) => [axis, [place.map((values) => values[i])]]);
  Plotly.restyle(panel, Object.fromEntries(own), [last]);
}

/**
 * Draw a projection.
 * @param {Explorer} explorer
 * @param {HTMLElement} panel
 * @param {Column} x
 * @param {Column} y
 * @param {number} colour
 */
function projection(explorer, panel, x, y, colour) {
  const layout = {
    margin: { l: 60, r: 10, t: 10, b: 50 }, showlegend: false, dragmode: "select", hovermode: "closest",
    xaxis: { title: { text: headed(x) } }, yaxis: { title: { text: headed(y) } }, uirevision: x.name + y.name,
    shapes: [...limitLines(x, "x"), ...limitLines(y, "y")],
  };
  Plotly.react(panel, traces(explorer, [x, y], ["x", "y"], colour, { type: "scatter" }), layout, CONFIG);
}

/** @param {Column} column @param {"x" | "y"} axis @returns {any[]} dashed lines at the limits of a column */
function limitLines(column, axis) {
  const other = axis === "x" ? "y" : "x";
  return column.limits.filter((limit) => limit !== null).map((limit) => {
    const at = Number(limit) * column.factor;
    return {
      type: "line", [`${axis}0`]: at, [`${axis}1`]: at, [`${other}ref`]: "paper", [`${other}0`]: 0, [`${other}1`]: 1,
      line: { dash: "dash", width: 1 },
    };
  });
}

/** @param {Explorer} explorer @param {Column[]} columns @param {number} colour */
function inSpace(explorer, columns, colour) {
  const [x, y, z] = columns.map((column) => ({ title: { text: headed(column) } }));
  const layout = {
    margin: { l: 0, r: 0, t: 0, b: 0 }, showlegend: true, legend: { orientation: "h" }, scene: {
      xaxis: x, yaxis: y, zaxis: z, uirevision: columns.map((column) => column.name).join(),
    },
  };
  const drawn = traces(explorer, columns, ["x", "y", "z"], colour, { type: "scatter3d" });
  Plotly.react(byId("space"), drawn, layout, CONFIG);
}
