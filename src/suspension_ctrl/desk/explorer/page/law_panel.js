// Curves of force laws: points that move with the mouse or the arrow keys, the distribution of the rate or the
// deflection below, and the ride height.

import { coefficientsOf } from "../numerics/formulas.js";
import { designThrough, forceAt } from "../numerics/law_curves.js";
import { curvesAt, valuesOf } from "../numerics/network_rows.js";
import { innerOf } from "../numerics/scores.js";
import { byId, digits, element, later, svg } from "./elements.js";

/** @typedef {import("./explorer.js").Explorer} Explorer */
/** @typedef {import("../numerics/network_rows.js").Networks} Networks */
/** @typedef {{x: number, y: number}} Size of the drawn half of the curve [m or m/s, N] */
/** @typedef {{point: number, size: Size}} Held point of a chart, -1 for none; the size stays while it moves */

const WIDTH = 420, CURVE = 260, BELL = 70, EDGE = 0.9; // px; share of the width at which the outer points stand
const LINES = 201;
/** @type {Record<string, [number, number]>} */
const ARROWS = { ArrowRight: [1, 0], ArrowLeft: [-1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };

/** @param {Explorer} explorer put the curves of all force laws of a load case into the page */
export function drawLaws(explorer) {
  const charts = /** @type {Map<number, HTMLElement[]>} */ (new Map()), height = element("p", { className: "note" });
  byId("laws").before(height);
  explorer.show("case", () => {
    const names = explorer.state.point ? /** @type {string[]} */ (explorer.ports.laws) : [];
    const own = charts.get(explorer.number) ?? names.map((name, i) => lawChart(explorer, name, i));
    charts.set(explorer.number, own);
    byId("laws").replaceChildren(...own);
  });
  explorer.show("design", () => {
    const positions = explorer.state.point?.positions ?? [];
    const texts = explorer.ports.struts.map((/** @type {string} */ strut, /** @type {number} */ q) =>
      `${strut || "strut"} ${digits(1e3 * positions[q])} mm`);
    height.textContent = `Ride height, change of the mean deflection by force laws: ${texts.join(", ")}.`;
  });
}

/**
 * Return the networks of the load case and their coefficients at a design.
 * @param {Explorer} explorer
 * @param {ArrayLike<number>} design
 * @returns {{networks: Networks, values: Float64Array}}
 */
function settingAt(explorer, design) {
  const own = explorer.kernel.cases[explorer.number], inner = innerOf(own);
  const coefficients = own.class === "Mapped" ? coefficientsOf(own.formulas, design) : design;
  return { networks: inner.networks, values: valuesOf(inner.networks, coefficients) };
}

/**
 * Return the curve of a law at a design: its knots, and its force at a place.
 * @param {Explorer} explorer
 * @param {ArrayLike<number>} design
 * @param {number} law
 */
function curveAt(explorer, design, law) {
  const { networks, values } = settingAt(explorer, design), curve = curvesAt(networks, values)[law];
  const [factor, exponent] = networks.laws[law].power;
  const power = factor < 0 ? null : /** @type {[number, number]} */ ([values[factor], values[exponent]]);
  const force = (/** @type {number} */ x) => forceAt(curve, power, x);
  return { knots: Array.from(curve.knots.subarray(0, curve.count)), force, ofRate: networks.laws[law].ofRate };
}

/** @param {Explorer} explorer @param {string} name @param {number} law @returns {HTMLElement} */
function lawChart(explorer, name, law) {
  const chart = svg("svg", { viewBox: `0 0 ${WIDTH} ${CURVE + BELL}`, width: WIDTH }), { number } = explorer;
  const caption = element("figcaption"), drawn = svg("g", {}), handles = svg("g", {});
  chart.append(drawn, handles);
  /** @type {Held} */
  const held = { point: -1, size: sizeOf(explorer, law) };
  const draw = () => {
    if (explorer.number !== number) return;
    if (held.point < 0) held.size = sizeOf(explorer, law);
    const { point } = explorer.state, { force } = curveAt(explorer, explorer.design, law);
    if (!point) return;
    const bars = point.reached ? bell(point.states[law], held.size) : [];
    drawn.replaceChildren(...curveLines(force, held.size), ...bars);
    caption.textContent = captionOf(explorer, name, law, held.size);
    pointsAt(explorer, law, held.size).forEach((place, i) => {
      const [left, top] = onChart(...place, held.size);
      handles.children[i]?.setAttribute("cx", String(left));
      handles.children[i]?.setAttribute("cy", String(top));
    });
  };
  handles.append(...pointsAt(explorer, law, held.size).map((_, i) =>
    handleOf(explorer, chart, { law, name: `point ${i + 1} of ${name}`, i }, held, draw)));
  draw();
  explorer.show("design", later(draw));
  return element("figure", { className: "law" }, chart, caption);
}

/**
 * Return the handle of a point, which the mouse and the arrow keys move.
 * @param {Explorer} explorer
 * @param {SVGElement} chart
 * @param {{law: number, name: string, i: number}} point
 * @param {Held} held
 * @param {() => void} draw
 * @returns {SVGElement}
 */
function handleOf(explorer, chart, { law, name, i }, held, draw) {
  const handle = svg("circle", { r: 7, class: "knot", tabindex: 0, role: "slider" });
  handle.setAttribute("aria-label", name);
  const moveTo = (/** @type {number} */ x, /** @type {number} */ y) => moved(explorer, law, i, [x, y], held.size);
  handle.addEventListener("pointerdown", (event) => {
    held.point = i;
    handle.setPointerCapture(event.pointerId);
  });
  handle.addEventListener("pointermove", (event) => {
    if (held.point === i) moveTo(...fromChart(event, chart, held.size));
  });
  handle.addEventListener("pointerup", () => {
    held.point = -1;
    draw();
  });
  handle.addEventListener("keydown", (event) => {
    const [right, up] = ARROWS[event.key] ?? [0, 0];
    if (!right && !up) return;
    event.preventDefault();
    const [x, y] = pointsAt(explorer, law, held.size)[i];
    moveTo(x + 0.02 * right * held.size.x, y + 0.02 * up * held.size.y);
  });
  return handle;
}

/** @param {Explorer} explorer @param {string} name @param {number} law @param {Size} size @returns {string} */
function captionOf(explorer, name, law, size) {
  const { point } = explorer.state, { ofRate } = curveAt(explorer, explorer.design, law);
  const unit = ofRate ? "m/s" : "mm", factor = ofRate ? 1 : 1e3;
  const shown = `${name}: ±${digits(size.x * factor)} ${unit} across, ±${digits(size.y / 1e3)} kN up; `;
  if (!point?.reached) return `${shown}no working point`;
  const { deviation, force } = point.states[law];
  return `${shown}standard deviation ${digits(factor * deviation)} ${unit}, mean force ${digits(force)} N`;
}

/** @param {Explorer} explorer @param {number} law @returns {Size} that shows all knots and three deviations */
function sizeOf(explorer, law) {
  const { knots, force } = curveAt(explorer, explorer.design, law);
  const { point } = explorer.state, deviation = point?.reached ? point.states[law].deviation : 0;
  const x = 1.2 * Math.max(3 * deviation, ...knots.map(Math.abs));
  return { x, y: 1.2 * Math.max(Math.abs(force(x)), Math.abs(force(-x)), 1) };
}

/**
 * Return the points of a curve that can be moved: knots beside 0, and a point near either end.
 * @param {Explorer} explorer
 * @param {number} law
 * @param {Size} size
 * @param {ArrayLike<number>} design
 * @returns {[number, number][]}
 */
function pointsAt(explorer, law, size, design = explorer.design) {
  const { knots, force } = curveAt(explorer, design, law);
  const places = [-EDGE * size.x, ...knots.filter((knot) => knot !== 0), EDGE * size.x];
  return places.map((x) => [x, force(x)]);
}

/**
 * Take the design whose curve has a point nearest to a place.
 * @param {Explorer} explorer
 * @param {number} law
 * @param {number} i the point
 * @param {[number, number]} wanted
 * @param {Size} size
 */
function moved(explorer, law, i, wanted, size) {
  const moving = explorer.variables.map((variable, place) => ({ ...variable, place })).filter(({ kind, low, high }) =>
    high > low && !["catalogue", "integer"].includes(kind));
  const own = moving.filter(({ place, low, high }) => {
    const there = Float64Array.from(explorer.design);
    there[place] = there[place] === high ? low : high;
    return pointsAt(explorer, law, size, there).some(([x, y], k) => {
      const here = pointsAt(explorer, law, size)[k];
      return x !== here[0] || y !== here[1];
    });
  });
  const pointOf = (/** @type {Float64Array} */ design) => pointsAt(explorer, law, size, design)[i];
  explorer.choose(designThrough(pointOf, wanted, [size.x, size.y], explorer.design, own));
}

/** @param {number} x @param {number} y @param {Size} size @returns {[number, number]} the place on the chart */
function onChart(x, y, size) {
  return [WIDTH / 2 * (1 + x / size.x), CURVE / 2 * (1 - y / size.y)];
}

/** @param {PointerEvent} event @param {SVGElement} chart @param {Size} size @returns {[number, number]} */
function fromChart(event, chart, size) {
  const { left, top, width } = chart.getBoundingClientRect(), scale = WIDTH / width;
  const x = (event.clientX - left) * scale, y = (event.clientY - top) * scale;
  return [size.x * (2 * x / WIDTH - 1), size.y * (1 - 2 * y / CURVE)];
}

/** @param {(x: number) => number} force @param {Size} size @returns {SVGElement[]} axes and the curve */
function curveLines(force, size) {
  const places = Array.from({ length: LINES }, (_, i) => size.x * (2 * i / (LINES - 1) - 1));
  const points = places.map((x) => onChart(x, force(x), size).join()).join(" ");
  const axis = { stroke: "#999", "stroke-width": 1 };
  return [
    svg("line", { x1: 0, x2: WIDTH, y1: CURVE / 2, y2: CURVE / 2, ...axis }),
    svg("line", { x1: WIDTH / 2, x2: WIDTH / 2, y1: 0, y2: CURVE + BELL, ...axis }),
    svg("polyline", { points, fill: "none", stroke: "#0072b2", "stroke-width": 2.5 }),
    sideOf("compression", { x: 4, "text-anchor": "start" }),
    sideOf("extension", { x: WIDTH - 4, "text-anchor": "end" }),
  ];
}

/** @param {string} name @param {Record<string, any>} place @returns {SVGElement} the name of a side of a curve */
function sideOf(name, place) {
  const text = svg("text", { y: CURVE - 6, "font-size": 14, ...place });
  text.textContent = name;
  return text;
}

/** @param {{deviation: number, mean: number}} state @param {Size} size @returns {SVGElement[]} a Gaussian in bars */
function bell({ deviation, mean }, size) {
  const bars = 41, width = WIDTH / bars;
  return Array.from({ length: bars }, (_, i) => {
    const x = size.x * ((2 * (i + 0.5)) / bars - 1), z = (x - mean) / deviation;
    const height = (BELL - 8) * Math.exp((-z * z) / 2);
    return svg("rect", { x: i * width, y: CURVE + BELL - height, width: width - 1, height, fill: "#56b4e9" });
  });
}
