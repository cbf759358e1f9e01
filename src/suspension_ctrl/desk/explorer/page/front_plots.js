// The front as linked projections and in 3-D: designs, candidates, the present design and the one at hand.

import { byId, choice, element, headed, later } from "./elements.js";
import { drawLayers, styleOf } from "./layers.js";
import { FAINT, MARKS, SCALE } from "./palette.js";

/** @typedef {import("./explorer.js").Explorer} Explorer */
/** @typedef {import("./explorer.js").Column} Column */
/** @typedef {import("./explorer.js").Point} Point */

const CONFIG = { displaylogo: false, responsive: true, modeBarButtonsToRemove: ["sendDataToCloud"] };
const MOST = 4; // projections
const FRONT = 1; // among the traces
const FONT = { size: 14, color: "#111111" };
const ROOM = 0.5; // of an axis beyond the designs, in their range, for fronts to compare with

/** @param {Explorer} explorer put choices of axes and all plots into the page */
export function drawFront(explorer) {
  const measures = explorer.columns.filter((column) => column.kind !== "variable");
  const last = explorer.columns.length - 1, space = [0, 1, 2].map((i) => Math.min(i, last));
  const axes = { across: 0, colour: Math.min(2, last), space };
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
    panels.forEach((panel, i) => projection(explorer, panel, explorer.columns[axes.across], up[i], axes.colour, !i));
    inSpace(explorer, axes.space.map((i) => explorer.columns[i]), axes.colour);
  };
  const move = () => {
    const up = measures.filter((column) => column !== explorer.columns[axes.across]);
    panels.forEach((panel, i) => moved(explorer, panel, [explorer.columns[axes.across], up[i]], ["x", "y"]));
    moved(explorer, byId("space"), axes.space.map((i) => explorer.columns[i]), ["x", "y", "z"]);
  };
  drawLayers(explorer);
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
  const above = coordinates.length < 3 ? { zorder: 2 } : {};
  const numbers = candidates.map(({ name }) => name.split(" ")[0]);
  const texts = { mode: "markers+text", text: numbers, textposition: "top center", textfont: { weight: 700 }, ...above };
  const ofGroup = (/** @type {Point["group"]} */ group) => shown.filter((point) => point.group === group);
  return [
    trace("others", front.filter((point) => !marked(point)), { size: 4, color: FAINT }),
    trace("front", lit, shades),
    trace("candidates", candidates, { size: 9, color: MARKS.candidate, symbol: "circle-open", line: { width: 2 } }, texts),
    trace("kept", ofGroup("kept"), { size: 10, color: MARKS.kept, symbol: "square-open" }, above),
    trace("present design", ofGroup("present"), { size: 9, color: MARKS.present, symbol: "square" }, above),
    ...otherFronts(explorer, columns, coordinates, style),
    here(explorer, columns, coordinates, style),
  ];
}

/** @param {Explorer} explorer @param {Column[]} columns @param {string[]} coordinates @param {any} style */
function otherFronts(explorer, columns, coordinates, style) {
  if (columns.some(({ kind }) => kind !== "objective")) return [];
  return explorer.others.flatMap((layer, i) => !layer.shown ? [] : [{
    name: layer.name, mode: "markers", hoverinfo: "skip", ...style, ...styleOf(layer, i, coordinates.length > 2),
    ...Object.fromEntries(coordinates.map((axis, k) =>
      [axis, layer.objectives.map((row) => row[columns[k].place] * columns[k].factor)])),
  }]);
}

/** @param {Explorer} explorer @param {Column[]} columns @param {string[]} coordinates @param {any} style */
function here(explorer, columns, coordinates, style) {
  const marker = { size: 11, color: MARKS.here, symbol: "diamond" }, place = placeOfDesign(explorer, columns);
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
  const scene = coordinates.length > 2 ? "scene." : "";
  const ends = coordinates.map((axis, i) => [`${scene}${axis}axis.autorangeoptions`, clipped(explorer, columns[i])]);
  Plotly.update(panel, Object.fromEntries(own), Object.fromEntries(ends), [last]);
}

/** @param {Explorer} explorer @param {Column} column @returns {any} the title of an axis and the ends of its range */
function axisOf(explorer, column) {
  return { title: { text: headed(column) }, autorangeoptions: clipped(explorer, column) };
}

/**
 * Return the ends of an axis: the range of designs, and room beyond it for fronts to compare with.
 * @param {Explorer} explorer
 * @param {Column} column
 */
function clipped(explorer, column) {
  const values = explorer.points.map((point) => explorer.valueAt(column, point)), own = explorer.valueHere(column);
  const known = [...values, own ?? NaN].filter(Number.isFinite);
  const [least, largest] = [Math.min(...known), Math.max(...known)], room = ROOM * (largest - least);
  return room ? { clipmin: least - room, clipmax: largest + room } : {};
}

/**
 * Draw a projection.
 * @param {Explorer} explorer
 * @param {HTMLElement} panel
 * @param {Column} x
 * @param {Column} y
 * @param {number} colour
 * @param {boolean} first whether the scale of colours stands beside
 */
function projection(explorer, panel, x, y, colour, first) {
  const layout = {
    margin: { l: 65, r: 10, t: 10, b: 50 }, showlegend: false, dragmode: "select", hovermode: "closest", font: FONT,
    xaxis: axisOf(explorer, x), yaxis: axisOf(explorer, y), uirevision: x.name + y.name,
    shapes: [...limitLines(x, "x"), ...limitLines(y, "y")],
  };
  const drawn = traces(explorer, [x, y], ["x", "y"], colour, { type: "scatter" });
  drawn[FRONT].marker.showscale = first;
  Plotly.react(panel, drawn, layout, CONFIG);
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
  const [x, y, z] = columns.map((column) => axisOf(explorer, column));
  const layout = {
    margin: { l: 0, r: 0, t: 0, b: 0 }, showlegend: true, font: FONT, legend: { orientation: "h" }, scene: {
      xaxis: x, yaxis: y, zaxis: z, uirevision: columns.map((column) => column.name).join(),
      camera: { eye: { x: 1.5, y: 1.5, z: 0.9 } },
    },
  };
  const drawn = traces(explorer, columns, ["x", "y", "z"], colour, { type: "scatter3d" });
  drawn[FRONT].marker.showscale = !byId("projections").children.length;
  Plotly.react(byId("space"), drawn, layout, CONFIG);
}
