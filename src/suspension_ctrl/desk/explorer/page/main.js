// The page: unpacks the plotting library and its record, and draws its parts.

import { unpacked } from "../numerics/packed.js";
import { drawChoice } from "./choice.js";
import { drawCurves } from "./curve_panel.js";
import { drawDesign } from "./design_panel.js";
import { drawDetails } from "./details_panel.js";
import { drawDownloads } from "./downloads.js";
import { byId, element } from "./elements.js";
import { Explorer } from "./explorer.js";
import { drawFilters } from "./filters.js";
import { drawFront } from "./front_plots.js";
import { drawLaws } from "./law_panel.js";
import { drawLines } from "./lines.js";
import { fitToPaper } from "./printing.js";

/**
 * Return the compressed text of an element of the page.
 * @param {string} id
 * @returns {Promise<string>}
 */
async function textOf(id) {
  const bytes = Uint8Array.from(atob(byId(id).dataset.gzip ?? ""), (letter) => letter.charCodeAt(0));
  return new Response(new Blob([bytes]).stream().pipeThrough(new DecompressionStream("gzip"))).text();
}

/** Draw all parts of the page. */
async function draw() {
  const plotly = await textOf("plotly"); // whose hash the policy knows
  document.head.append(element("script", { textContent: plotly }));
  const record = unpacked(JSON.parse(await textOf("record")));
  const explorer = new Explorer(record);
  drawChoice(explorer);
  drawFront(explorer);
  drawLines(explorer);
  drawFilters(explorer);
  drawDesign(explorer);
  drawLaws(explorer);
  drawCurves(explorer);
  drawDetails(explorer);
  drawDownloads(explorer, record.study);
  fitToPaper();
  document.body.classList.add("drawn");
}

draw().catch((error) => {
  byId("failure").textContent = `The plots cannot be shown: ${error.message}`;
  throw error;
});
