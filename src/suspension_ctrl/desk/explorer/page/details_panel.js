// Details of the design at hand, once it rests: its modes, and what changes its measures most.

import { byId, digits, rested, tableRow } from "./elements.js";

/** @typedef {import("./explorer.js").Explorer} Explorer */
/** @typedef {import("../numerics/modes.js").Mode} Mode */

/** @param {Explorer} explorer put tables of modes and sensitivities into the page */
export function drawDetails(explorer) {
  let present = explorer.presentModes();
  explorer.show("case", () => (present = explorer.presentModes()));
  explorer.show("design", rested(() => {
    byId("modes").replaceChildren(...modeRows(explorer.modes(), present));
    byId("sensitivities").replaceChildren(...sensitivityRows(explorer));
    byId("sensitivities").dataset.shown = [explorer.number, ...explorer.design].join();
  }));
}

/**
 * Return the rows of the modes of a design, beside those of the present design by name.
 * @param {Mode[] | null} modes
 * @param {Mode[] | null} present
 */
function modeRows(modes, present) {
  if (!modes) return [tableRow("td", ["Not known: modes need masses, springs and dampers by their values."])];
  const own = ["mode", "undamped [Hz]", "damped [Hz]", "damping ratio"];
  const header = tableRow("th", present ? [...own, "present [Hz]", "present ratio"] : own);
  return [header, ...modes.map(({ name, frequency, damped, ratio }) => {
    const before = present?.find((one) => one.name === name);
    const beside = present ? [before?.frequency ?? null, before?.ratio ?? null] : [];
    const row = tableRow("td", [name, ...[frequency, damped, ratio, ...beside].map(digits)]);
    row.dataset.value = [frequency, damped, ratio].join();
    return row;
  })];
}

/** @param {Explorer} explorer @returns {HTMLElement[]} a row for each variable, the largest change first */
function sensitivityRows(explorer) {
  const measures = explorer.columns.filter((column) => column.kind !== "variable");
  const found = explorer.sensitivities().map((changes, v) => ({ name: explorer.variables[v].name, changes }));
  const largest = (/** @type {(number | null)[]} */ changes) =>
    Math.max(...changes.map((change) => Math.abs(change ?? 0)));
  found.sort((one, other) => largest(other.changes) - largest(one.changes));
  const header = tableRow("th", ["1 % more of", ...measures.map(({ name }) => `${name} [%]`)]);
  return [header, ...found.map(({ name, changes }) => {
    const row = tableRow("td", [name, ...changes.map(signed)]);
    row.dataset.value = changes.join();
    return row;
  })];
}

/** @param {number | null} change @returns {string} with its sign and two decimals; a dash for what is not known */
function signed(change) {
  if (change === null) return "–";
  const text = change.toFixed(2);
  return Number(text) === 0 ? "0.00" : change > 0 ? `+${text}` : text;
}
