// Downloads: the designs that are shown as CSV, the design at hand as a study file that the commands read.

import { byId, element } from "./elements.js";

/** @typedef {import("./explorer.js").Explorer} Explorer */

/** @param {Explorer} explorer @param {{text: string, keys: string[]} | null} study put buttons into the page */
export function drawDownloads(explorer, study) {
  const button = (/** @type {string} */ text, /** @type {() => void} */ pressed) => {
    const made = element("button", { type: "button" }, text);
    made.addEventListener("click", pressed);
    return made;
  };
  byId("downloads").append(
    button("Keep beside others", () => explorer.keep()),
    button("Designs shown, CSV", () => save("designs.csv", designsAsCsv(explorer))),
  );
  if (study) {
    const pressed = () => save("study.toml", asStudy(explorer.design, study));
    byId("downloads").append(button("Study with this design, TOML", pressed));
  }
}

/** @param {string} name @param {string} text hand a file to the user */
function save(name, text) {
  const link = element("a", { download: name, href: URL.createObjectURL(new Blob([text])) });
  link.click();
  URL.revokeObjectURL(link.href);
}

/** @param {Explorer} explorer @returns {string} the designs shown in the units of the columns */
function designsAsCsv(explorer) {
  const header = ["design", ...explorer.columns.map((column) => column.csv)];
  const rows = explorer.shown().map((point) => [
    point.name.replace(/,/g, ""), ...explorer.columns.map((column) => explorer.valueAt(column, point)),
  ]);
  return [header, ...rows].map((row) => row.join()).join("\n") + "\n";
}

/**
 * Return the text of a study with a design in place of the present one.
 * @param {ArrayLike<number>} design
 * @param {{text: string, keys: string[]}} study text without the present design, and its keys
 */
function asStudy(design, { text, keys }) {
  const lines = keys.map((key, v) => {
    const value = String(design[v]);
    return `${key} = ${/[.e]/.test(value) ? value : `${value}.0`}`;
  });
  return [text.trimEnd(), "", "[present]", ...lines, ""].join("\n");
}
