// Elements of the page: made with text alone, never with markup.

const REST = 250; // ms

/**
 * Return an element with properties and children; texts become text nodes.
 * @template {keyof HTMLElementTagNameMap} T
 * @param {T} tag
 * @param {Record<string, any>} [properties]
 * @param {...(Node | string)} children
 * @returns {HTMLElementTagNameMap[T]}
 */
export function element(tag, properties = {}, ...children) {
  const made = Object.assign(document.createElement(tag), properties);
  made.append(...children);
  return made;
}

/**
 * Return the element of the page with an id.
 * @param {string} id
 * @returns {HTMLElement}
 */
export function byId(id) {
  const found = document.getElementById(id);
  if (!found) throw new Error(`page must have an element ${id}`);
  return found;
}

/**
 * Return a labelled choice among texts that calls `chosen` with the index.
 * @param {string} label
 * @param {string[]} texts
 * @param {number} index
 * @param {(index: number) => void} chosen
 * @returns {HTMLLabelElement}
 */
export function choice(label, texts, index, chosen) {
  const options = texts.map((text, i) => element("option", { value: String(i), selected: i === index }, text));
  const select = element("select", {}, ...options);
  select.addEventListener("change", () => chosen(Number(select.value)));
  return element("label", {}, `${label} `, select);
}

/** @param {{name: string, unit: string}} column @returns {string} its name with its unit */
export function headed({ name, unit }) {
  return unit ? `${name} [${raised(unit)}]` : name;
}

/** @param {string} text @returns {string} with raised powers and signs of limits */
export function raised(text) {
  return text.replaceAll("^2", "²").replaceAll("^3", "³").replaceAll("<=", "≤").replaceAll(">=", "≥");
}

/** @param {number | null} value @returns {string} four digits; a dash for what is not known */
export function digits(value) {
  return value === null || Number.isNaN(value) ? "–" : String(Number(value.toPrecision(4)));
}

/**
 * Return a function that calls another once before the next picture, however often it is called itself.
 * @param {() => void} view
 * @returns {() => void}
 */
export function later(view) {
  let waiting = false;
  return () => {
    if (waiting) return;
    waiting = true;
    requestAnimationFrame(() => {
      waiting = false;
      view();
    });
  };
}

/**
 * Return an element of a drawing with attributes.
 * @param {string} tag
 * @param {Record<string, any>} attributes
 * @returns {SVGElement}
 */
export function svg(tag, attributes) {
  const made = /** @type {SVGElement} */ (document.createElementNS("http://www.w3.org/2000/svg", tag));
  Object.entries(attributes).forEach(([name, value]) => made.setAttribute(name, String(value)));
  return made;
}

/**
 * Return a row of a table.
 * @param {"th" | "td"} tag
 * @param {string[]} cells
 * @returns {HTMLTableRowElement}
 */
export function tableRow(tag, cells) {
  return element("tr", {}, ...cells.map((cell) => element(tag, {}, cell)));
}

/**
 * Return a function that calls another once it has not been called itself for a moment.
 * @param {() => void} view
 * @returns {() => void}
 */
export function rested(view) {
  let waiting = 0;
  return () => {
    clearTimeout(waiting);
    waiting = setTimeout(view, REST);
  };
}
