// Fronts to compare with, which can be switched on and off: their marks and their boxes to tick.

import { byId, element } from "./elements.js";
import { LAYERS } from "./palette.js";

/** @typedef {import("./explorer.js").Explorer} Explorer */
/** @typedef {{name: string, kind: string, shown: boolean, objectives: number[][]}} Layer */

const SYMBOLS = ["circle-open", "square-open", "diamond-open"]; // of fronts, the next where colours are used up
/** @type {Record<string, string>} */
const OF_KIND = { reference: "cross", attainable: "x" };
/** @type {Record<string, string>} */
const GLYPHS = { "circle-open": "○", "square-open": "□", "diamond-open": "◇", cross: "✚", x: "✕" };

/** @param {Layer} layer @param {number} i its number @returns {{symbol: string, color: string, size: number}} */
function markOf({ kind }, i) {
  const symbol = OF_KIND[kind] ?? SYMBOLS[Math.floor(i / LAYERS.length) % SYMBOLS.length];
  return { symbol, color: LAYERS[i % LAYERS.length], size: kind in OF_KIND ? 5 : 6 };
}

/** @type {Record<string, string>} in three dimensions, where fonts lack others */
const IN_SPACE = { cross: "diamond", x: "diamond-open" };

/**
 * Return the style of a layer in a plot: below the front, but for runs of algorithms.
 * @param {Layer} layer
 * @param {number} i its number
 * @param {boolean} inSpace
 */
export function styleOf(layer, i, inSpace) {
  const marker = markOf(layer, i);
  if (!inSpace) return { marker, zorder: layer.kind === "run" ? 1 : -1 };
  return { marker: { ...marker, symbol: IN_SPACE[marker.symbol] ?? marker.symbol, size: 3 } };
}

/** @param {Explorer} explorer put a box to tick for each layer into the page */
export function drawLayers(explorer) {
  byId("layers").append(...explorer.others.map((layer, i) => {
    const { symbol, color } = markOf(layer, i), mark = element("span", {}, GLYPHS[symbol]);
    mark.style.color = color;
    mark.setAttribute("aria-hidden", "true");
    const input = element("input", { type: "checkbox", checked: layer.shown });
    input.addEventListener("change", () => {
      layer.shown = input.checked;
      explorer.tell("shown");
    });
    return element("label", {}, input, " ", mark, ` ${layer.name}`);
  }));
}
