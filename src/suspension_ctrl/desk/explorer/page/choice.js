// The table of candidates at the top of the page: a button in each row takes its design.

import { byId, element } from "./elements.js";

/** @param {import("./explorer.js").Explorer} explorer put buttons in place of the numbers of candidates */
export function drawChoice(explorer) {
  const table = /** @type {HTMLTableElement} */ (byId("candidates")), rows = Array.from(table.tBodies[0].rows);
  const named = explorer.points.filter((point) => point.name);
  const points = rows.map((row) => {
    const number = row.cells[0].textContent;
    return named.find(({ group, name }) => (number ? name.split(" ")[0] === number : group === "present"));
  });
  rows.forEach((row, i) => {
    const point = points[i], text = row.cells[0].textContent || "0";
    if (!point) return;
    const button = element("button", { type: "button", title: "take this design" }, text);
    button.setAttribute("aria-label", `take design ${text}, ${row.cells[1].textContent}`);
    button.addEventListener("click", () => explorer.choose(point.design));
    row.cells[0].replaceChildren(button);
  });
  explorer.show("design", () => rows.forEach((row, i) => {
    row.setAttribute("aria-current", String(points[i] !== undefined && points[i] === explorer.stored));
  }));
}
