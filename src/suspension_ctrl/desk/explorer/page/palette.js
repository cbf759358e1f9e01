// Colours of the page, of Okabe and Ito: told apart with any colour vision, on screens, projectors and in print.

/** @type {{here: string, present: string, candidate: string, kept: string, front: string}} */
export const MARKS = { here: "#d55e00", present: "#000000", candidate: "#000000", kept: "#009e73", front: "#0072b2" };

/** @type {string} of what is not marked */
export const FAINT = "#bbbbbb";

/** @type {string} even in lightness */
export const SCALE = "Cividis";

/** @type {string[]} of fronts to compare with */
export const LAYERS = ["#e69f00", "#56b4e9", "#cc79a7", "#666666"];
