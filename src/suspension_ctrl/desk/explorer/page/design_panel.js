// The design at hand: a slider for each variable, and its measures beside the present ones.

import { byId, choice, digits, element, headed, raised, tableRow } from "./elements.js";

/** @typedef {import("./explorer.js").Explorer} Explorer */
/** @typedef {import("./explorer.js").Variable} Variable */

const STEPS = 1000; // of a slider
const NEAR = 1e-6; // share of a limit up to which a design at it is not beyond it

/** @param {Explorer} explorer put sliders, measures and curves into the page */
export function drawDesign(explorer) {
  const named = explorer.points.filter((point) => point.name);
  byId("sliders").append(
    choice("start from", named.map(({ name }) => name), named.findIndex((point) => point === explorer.stored), (i) =>
      explorer.choose(named[i].design),
    ),
    ...explorer.variables.map((variable, v) => slider(explorer, variable, v)),
  );
  explorer.show("design", () => {
    byId("measures").replaceChildren(...measures(explorer));
    byId("known").replaceChildren(...explorer.known.map((texts) => tableRow("td", texts.map(raised))));
  });
  const names = explorer.cases.map(({ name }) => raised(name));
  if (names.length > 1) byId("cases").append(choice("load case", names, explorer.number, (i) => explorer.inCase(i)));
}

/** @param {Explorer} explorer @param {Variable} variable @param {number} v @returns {HTMLElement} */
function slider(explorer, variable, v) {
  const last = variable.values.length ? variable.values.length - 1 : STEPS;
  const input = element("input", { type: "range", min: "0", max: String(last), step: "1" });
  input.disabled = variable.low === variable.high;
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
  const rows = columns.filter((column) => column.kind !== "variable").map((column) => {
    const here = explorer.valueHere(column), own = present && explorer.valueAt(column, present);
    const change = here === null || !own ? null : (100 * (here - own)) / Math.abs(own);
    const others = kept.map((point) => digits(explorer.valueAt(column, point)));
    const shown = here === null ? `– (${column.why_not})` : digits(here);
    const cells = [headed(column), shown, digits(own), change === null ? "–" : change.toFixed(1).replace(/^-0\.0$/, "0.0"), ...others];
    const row = tableRow("td", cells);
    row.dataset.value = String(here);
    const [least, largest] = column.limits.map((limit) => (limit === null ? NaN : limit * column.factor));
    const beyond = here !== null && Math.max(here - largest || 0, least - here || 0) > NEAR * Math.abs(here);
    row.className = beyond ? "beyond" : "";
    return row;
  });
  const header = ["measure", "this design", "present", "change [%]", ...kept.map(({ name }) => name)];
  return [tableRow("th", header), ...rows];
}
