// What the page shows: designs, the one at hand, filters and the brush. Views are told of changes.

import { evaluated, prepared } from "../numerics/scores.js";
import { curvesOf, preparedPorts } from "../numerics/frequency_responses.js";
import { modesOf } from "../numerics/modes.js";
import { rowsIn } from "../numerics/packed.js";
import { changesOf } from "../numerics/sensitivities.js";

/**
 * @typedef {{name: string, csv: string, unit: string, factor: number, kind: string, place: number, scale: number,
 *   offset: number, computed: boolean, why_not: string, limits: (number | null)[]}} Column
 * @typedef {{name: string, unit: string, factor: number, low: number, high: number, kind: string,
 *   values: number[]}} Variable
 * @typedef {{group: "front" | "candidate" | "present" | "kept", name: string, design: ArrayLike<number>,
 *   scores: ArrayLike<number>, known: [string, string][]}} Point with titles and texts of what else is known
 * @typedef {{name: string, ports: any, matrices: any}} LoadCase
 * @typedef {"design" | "shown" | "case"} Change of the design at hand, of which designs are shown and marked, or of
 *   the load case
 */

/** @typedef {import("../numerics/modes.js").Mode} Mode */
/** @typedef {import("../numerics/scores.js").Evaluation} Evaluation */

const NEAR = 1e-6; // relative difference up to which a computed measure is that of Python

export class Explorer {
  /** @param {any} record unpacked */
  constructor(record) {
    /** @type {Column[]} */
    this.columns = record.columns;
    /** @type {Variable[]} */
    this.variables = record.variables;
    const plants = record.cases.map((/** @type {LoadCase} */ { matrices }) => matrices);
    this.kernel = prepared(record.kernel, record.functions, plants);
    /** @type {LoadCase[]} */
    this.cases = record.cases.map((/** @type {LoadCase} */ one) => ({
      ...one, ports: preparedPorts({ ...one.ports, h: record.plants[one.ports.h] }),
    }));
    this.number = 0; // of the load case that is shown
    this.points = [
      ...pointsOf(record.candidates, "candidate"),
      ...pointsOf(record.present, "present"),
      ...pointsOf(record.certified, "kept"),
      ...pointsOf(record.front, "front"),
    ];
    /** @type {import("./layers.js").Layer[]} fronts to compare with */
    this.others = record.others.map((/** @type {any} */ layer) => ({
      ...layer, objectives: rowsIn(layer.objectives).map((row) => Array.from(row)),
    }));
    this.present = this.points.find((point) => point.group === "present") ?? null;
    /** @type {[number, number][]} least and largest value of each column in its unit */
    this.filters = this.columns.map(() => [-Infinity, Infinity]);
    /** @type {Set<Point> | null} */
    this.brushed = null;
    /** @type {Map<Change, (() => void)[]>} */
    this.views = new Map([["case", []], ["design", []], ["shown", []]]);
    this.check();
    const first = this.points[record.first];
    this.design = Float64Array.from(first.design);
    this.evaluation = evaluated(this.kernel, this.design);
    /** @type {Point | null} the stored point that the design at hand is */
    this.stored = first;
  }

  /** Mark columns as not computed whose values at stored designs are not those of Python. */
  check() {
    const known = this.points.filter((point) => point.group !== "front");
    for (const { design, scores } of known) {
      const found = evaluated(this.kernel, design).scores;
      for (const column of this.columns) {
        const [own, given] = [found, scores].map((each) => (each[column.place] - column.offset) / column.scale);
        const near = Math.abs(own - given) <= NEAR * Math.abs(given);
        if (column.kind !== "variable" && !near) column.computed = false;
      }
    }
  }

  /** @param {Change} change @param {() => void} view called now and after each change */
  show(change, view) {
    this.views.get(change)?.push(view);
    view();
  }

  /** @param {Change} change */
  tell(change) {
    this.views.get(change)?.forEach((view) => view());
  }

  /** @param {ArrayLike<number>} design take a design at hand */
  choose(design) {
    this.design = Float64Array.from(design);
    this.evaluation = evaluated(this.kernel, this.design);
    this.stored = this.points.find((point) => this.design.every((value, i) => value === point.design[i])) ?? null;
    this.tell("design");
  }

  /**
   * Return the value of a column at a stored point, in its unit.
   * @param {Column} column
   * @param {Point} point
   */
  valueAt(column, point) {
    return valueOf(column, point.design, point.scores);
  }

  /**
   * Return the value of a column at the design at hand, in its unit; null if only Python can compute it.
   * @param {Column} column
   */
  valueHere(column) {
    if (column.computed) return valueOf(column, this.design, this.evaluation.scores);
    return this.stored && this.valueAt(column, this.stored);
  }

  /** Return the points within the filters. */
  shown() {
    return this.points.filter((point) =>
      this.columns.every((column, i) => {
        const value = this.valueAt(column, point), [least, largest] = this.filters[i];
        return !(value < least || value > largest);
      }),
    );
  }

  /** @param {number} column @param {[number, number]} range show designs within a range alone */
  filter(column, range) {
    this.filters[column] = range;
    this.tell("shown");
  }

  /** @param {Set<Point> | null} points mark some designs in all views, or none */
  brush(points) {
    this.brushed = points;
    this.tell("shown");
  }

  /** Keep the design at hand among the points; measures that only Python computes are unknown. */
  keep() {
    const scores = this.evaluation.scores.slice(), count = this.points.filter(({ group }) => group === "kept").length;
    for (const column of this.columns) if (!column.computed) scores[column.place] = NaN;
    this.points.push({ group: "kept", name: `kept ${count + 1}`, design: this.design, scores, known: [] });
    this.tell("shown");
    this.tell("design");
  }

  /** @param {number} number show another load case */
  inCase(number) {
    this.number = number;
    this.tell("case");
    this.tell("design");
  }

  /** Return the ports of the load case that is shown. */
  get ports() {
    return this.cases[this.number].ports;
  }

  /** Return the coefficients and the working point of the design at hand in the load case that is shown. */
  get state() {
    return this.evaluation.cases[this.number];
  }

  /** Return what else is known of the design at hand, by titles. */
  get known() {
    return this.points.filter(({ design }) => this.design.every((value, i) => value === design[i]))
      .flatMap(({ known }) => known);
  }

  /** Return the curves of the design at hand, by response. */
  curves() {
    return curvesOf(this.ports, this.state.coefficients, this.state.point);
  }

  /** Return the curves of the present design, null where it is unknown. */
  presentCurves() {
    if (!this.present) return null;
    const { coefficients, point } = evaluated(this.kernel, this.present.design).cases[this.number];
    return curvesOf(this.ports, coefficients, point);
  }

  /** @returns {Mode[] | null} modes of the design at hand, null where they are not known */
  modes() {
    return this.modesAt(this.state);
  }

  /** @returns {Mode[] | null} modes of the present design, null where it or they are not known */
  presentModes() {
    return this.present && this.modesAt(evaluated(this.kernel, this.present.design).cases[this.number]);
  }

  /** @param {Evaluation["cases"][number]} state @returns {Mode[] | null} */
  modesAt({ coefficients, point }) {
    const { matrices, ports } = this.cases[this.number];
    return matrices && point?.reached !== false ? modesOf(matrices, coefficients, ports.networks, point) : null;
  }

  /**
   * Return by variable the changes of all measures by 1 % more of it [%]; null of a measure that is not computed.
   * @returns {(number | null)[][]}
   */
  sensitivities() {
    const scoresOf = (/** @type {Float64Array} */ design) => evaluated(this.kernel, design).scores;
    const measures = this.columns.filter(({ kind }) => kind !== "variable"), { scores } = this.evaluation;
    return changesOf(scoresOf, this.design, this.variables).map((changes) =>
      measures.map(({ computed, place, offset }) => {
        const change = (100 * changes[place]) / Math.abs(scores[place] - offset);
        return computed && Number.isFinite(change) ? change : null;
      }));
  }
}

/**
 * Return the value of a column in its unit.
 * @param {Column} column
 * @param {ArrayLike<number>} design
 * @param {ArrayLike<number>} scores
 */
function valueOf(column, design, scores) {
  if (column.kind === "variable") return design[column.place] * column.factor;
  return ((scores[column.place] - column.offset) / column.scale) * column.factor;
}

/** @param {any} designs packed, or null @param {Point["group"]} group @returns {Point[]} */
function pointsOf(designs, group) {
  if (!designs) return [];
  const scores = rowsIn(designs.scores);
  return rowsIn(designs.designs).map((design, i) => ({
    group, name: designs.names[i] ?? "", design, scores: scores[i], known: designs.known[i] ?? [],
  }));
}
