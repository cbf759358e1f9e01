// Coefficients of struts as sums of products of the variables of a design.

/** @typedef {import("./packed.js").Numbers} Numbers */

/**
 * Return the coefficients (w,) of a design (v,) by formulas, see `Formulas` in vehicles/formulas.py.
 * @param {Record<"start" | "target" | "factor" | "base" | "power" | "result", Numbers>} formulas
 * @param {ArrayLike<number>} design
 * @returns {Float64Array}
 */
export function coefficientsOf(formulas, design) {
  const slots = Float64Array.from(formulas.start.data);
  for (let v = 0; v < design.length; v++) slots[v] = design[v];
  const width = formulas.base.shape[1];
  for (let t = 0; t < formulas.target.data.length; t++) {
    let product = formulas.factor.data[t];
    for (let j = t * width; j < (t + 1) * width; j++) {
      const base = formulas.base.data[j];
      if (base >= 0) product *= slots[base] ** formulas.power.data[j];
    }
    slots[formulas.target.data[t]] += product;
  }
  return Float64Array.from(formulas.result.data, (slot) => slots[slot]);
}
