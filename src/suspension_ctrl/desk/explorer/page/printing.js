// Plots on paper: of its width while the page is printed, of the window's width afterwards.

const PAPER = 700; // px, A4 or Letter upright between margins

/** Fit the plots to paper before printing, and to the window after it. */
export function fitToPaper() {
  const sized = (/** @type {(plot: Element) => any} */ layoutOf) => {
    document.querySelectorAll(".js-plotly-plot:not(#space)").forEach((plot) => Plotly.relayout(plot, layoutOf(plot)));
  };
  window.addEventListener("beforeprint", () => sized((plot) => ({ width: plot.id === "curves" ? PAPER : PAPER / 2 })));
  window.addEventListener("afterprint", () => sized(() => ({ autosize: true })));
}
