// Filters: a least and a largest value for each column.

import { byId, digits, element, headed } from "./elements.js";

const NEAR = 1e-9; // share of a slider up to which it is at its end: browsers round its value

/** @param {import("./explorer.js").Explorer} explorer put two sliders for each column into the page */
export function drawFilters(explorer) {
  byId("filters").append(...explorer.columns.map((column, i) => {
    const values = explorer.points.map((point) => explorer.valueAt(column, point)).filter(Number.isFinite);
    const ends = [Math.min(...values), Math.max(...values)];
    const inputs = ends.map((end, k) => {
      const name = `${k ? "largest" : "least"} ${column.name}`;
      const input = element("input", { type: "range", min: String(ends[0]), max: String(ends[1]), step: "any" });
      input.setAttribute("aria-label", name);
      input.value = String(end);
      return input;
    });
    const output = element("output");
    const near = NEAR * (ends[1] - ends[0]), everything = [-Infinity, Infinity];
    inputs.forEach((input, k) => input.addEventListener("input", () => {
      const value = Number(input.value), range = explorer.filters[i].slice();
      range[k] = Math.abs(value - ends[k]) <= near ? everything[k] : value;
      explorer.filter(i, /** @type {[number, number]} */ (range));
    }));
    explorer.show("shown", () => {
      explorer.filters[i].forEach((end, k) => (inputs[k].value = String(Number.isFinite(end) ? end : ends[k])));
      output.textContent = inputs.map((input) => digits(Number(input.value))).join(" to ");
    });
    return element("div", { className: "filter" }, headed(column), ...inputs, output);
  }));
  const count = byId("count");
  explorer.show("shown", () => {
    const shown = explorer.shown().filter(({ group }) => group === "front").length;
    const all = explorer.points.filter(({ group }) => group === "front").length;
    count.textContent = `${shown} of ${all} designs of the front are shown.`;
  });
}
