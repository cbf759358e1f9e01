// Arrays of a record, packed by Python as base64 of little-endian numbers.

/** @typedef {{shape: number[], data: Float64Array | Int32Array | Uint8Array}} Numbers an array in row order */

/** @type {Record<string, (bytes: ArrayBuffer) => Float64Array | Int32Array | Uint8Array>} */
const KINDS = {
  f8: (bytes) => new Float64Array(bytes),
  i4: (bytes) => new Int32Array(bytes),
  u1: (bytes) => new Uint8Array(bytes),
};

/**
 * Return a record with `Numbers` in place of packed arrays.
 * @param {any} value
 * @returns {any}
 */
export function unpacked(value) {
  if (Array.isArray(value)) return value.map(unpacked);
  if (value === null || typeof value !== "object") return value;
  if ("base64" in value) {
    const bytes = Uint8Array.from(atob(value.base64), (letter) => letter.charCodeAt(0));
    return { shape: value.shape, data: KINDS[value.kind](bytes.buffer) };
  }
  return Object.fromEntries(Object.entries(value).map(([key, one]) => [key, unpacked(one)]));
}

/**
 * Return the rows of an array (n, ...) as arrays of the other dimensions in one.
 * @param {Numbers} numbers
 * @returns {(Float64Array | Int32Array | Uint8Array)[]}
 */
export function rowsIn({ shape, data }) {
  const size = shape.slice(1).reduce((product, side) => product * side, 1);
  return Array.from({ length: shape[0] }, (_, i) => data.subarray(i * size, (i + 1) * size));
}
