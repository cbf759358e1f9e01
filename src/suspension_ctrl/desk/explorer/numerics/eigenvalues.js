// Eigenvalues and eigenvectors of a real matrix: rotations to Hessenberg form, then to triangular form by the QR
// algorithm with Wilkinson's shifts (G. H. Golub and C. F. Van Loan, Matrix Computations, chapter 7).
//
// Lines and vectors hold real and imaginary parts in turn.

const EPSILON = 2 ** -52;
const MOST = 60; // steps for an eigenvalue
const UNUSUAL = 10; // steps after which a shift of another kind breaks a cycle

/**
 * Eigenvalues (n,), and an eigenvector (n,) of norm 1 for each.
 * @typedef {{values: Float64Array, vectors: Float64Array[]}} Eigen
 */
/** @typedef {[number, number]} Complex */
/** @typedef {[number, number, number, number]} Rotation real and imaginary parts of a and b, |a|^2 + |b|^2 = 1 */

/**
 * Return the eigenvalues and eigenvectors of a real matrix.
 * @param {ArrayLike<number>[]} matrix (n, n)
 * @returns {Eigen}
 */
export function eigenOf(matrix) {
  const n = matrix.length, lines = matrix.map((row) => Float64Array.from({ length: 2 * n }, (_, j) =>
    j % 2 ? 0 : row[j / 2]));
  const basis = matrix.map((_, i) => Float64Array.from({ length: 2 * n }, (_unused, j) => Number(j === 2 * i)));
  toHessenberg(lines, basis);
  toTriangular(lines, basis);
  const values = new Float64Array(2 * n);
  for (let i = 0; i < n; i++) values.set(at(lines, i, i), 2 * i);
  pairUp(values);
  return { values, vectors: lines.map((_, k) => vectorOf(lines, basis, k)) };
}

/** @param {Float64Array[]} lines @param {number} i @param {number} j @returns {Complex} */
function at(lines, i, j) {
  return [lines[i][2 * j], lines[i][2 * j + 1]];
}

/** @param {Float64Array[]} lines @param {Float64Array[]} basis make all entries below the first subdiagonal zero */
function toHessenberg(lines, basis) {
  const n = lines.length;
  for (let j = 0; j < n - 2; j++) {
    for (let i = n - 1; i > j + 1; i--) {
      const rotation = rotationOf(at(lines, i - 1, j), at(lines, i, j));
      if (!rotation) continue;
      rotateRows(lines, i - 1, rotation, j);
      rotateColumns(lines, i - 1, rotation, n);
      rotateColumns(basis, i - 1, rotation, n);
    }
  }
}

/** @param {Float64Array[]} lines @param {Float64Array[]} basis make all entries below the diagonal zero */
function toTriangular(lines, basis) {
  const norm = Math.sqrt(lines.reduce((sum, line) => sum + line.reduce((own, x) => own + x * x, 0), 0));
  let last = lines.length - 1, steps = 0;
  while (last > 0) {
    const first = firstOfBlock(lines, last, norm);
    if (first === last) [last, steps] = [last - 1, 0];
    else if (++steps > MOST) throw new Error("eigenvalues are not found");
    else stepOf(lines, basis, first, last, shiftOf(lines, last, steps));
  }
}

/** @param {Float64Array[]} lines @param {number} last @param {number} norm @returns {number} first row of its block */
function firstOfBlock(lines, last, norm) {
  for (let i = last; i > 0; i--) {
    const size = Math.hypot(...at(lines, i, i)) + Math.hypot(...at(lines, i - 1, i - 1));
    if (Math.hypot(...at(lines, i, i - 1)) <= EPSILON * (size || norm)) {
      lines[i].fill(0, 2 * i - 2, 2 * i);
      return i;
    }
  }
  return 0;
}

/**
 * Return the eigenvalue of the last 2 x 2 block that is nearer to its last entry.
 * @param {Float64Array[]} lines
 * @param {number} last
 * @param {number} steps
 * @returns {Complex}
 */
function shiftOf(lines, last, steps) {
  const [a, b] = [at(lines, last - 1, last - 1), at(lines, last - 1, last)];
  const [c, d] = [at(lines, last, last - 1), at(lines, last, last)];
  if (steps % UNUSUAL === 0) return [d[0] + Math.hypot(...c), d[1]];
  const half = /** @type {Complex} */ ([(a[0] - d[0]) / 2, (a[1] - d[1]) / 2]), product = times(b, c);
  const square = times(half, half), root = rootOf([square[0] + product[0], square[1] + product[1]]);
  const sign = half[0] * root[0] + half[1] * root[1] >= 0 ? 1 : -1; // the larger divisor
  const divisor = /** @type {Complex} */ ([half[0] + sign * root[0], half[1] + sign * root[1]]);
  if (divisor[0] === 0 && divisor[1] === 0) return d;
  const change = quotient(product, divisor);
  return [d[0] - change[0], d[1] - change[1]];
}

/**
 * Take a step of the QR algorithm in the block of rows `first` to `last`.
 * @param {Float64Array[]} lines
 * @param {Float64Array[]} basis
 * @param {number} first
 * @param {number} last
 * @param {Complex} shift
 */
function stepOf(lines, basis, first, last, [re, im]) {
  const shifted = (/** @type {number} */ sign) => {
    for (let i = first; i <= last; i++) {
      lines[i][2 * i] += sign * re;
      lines[i][2 * i + 1] += sign * im;
    }
  };
  shifted(-1);
  /** @type {(Rotation | null)[]} */
  const rotations = [];
  for (let i = first; i < last; i++) {
    const rotation = rotationOf(at(lines, i, i), at(lines, i + 1, i));
    if (rotation) rotateRows(lines, i, rotation, i);
    rotations.push(rotation);
  }
  rotations.forEach((rotation, k) => {
    if (!rotation) return;
    rotateColumns(lines, first + k, rotation, Math.min(first + k + 2, last + 1));
    rotateColumns(basis, first + k, rotation, basis.length);
  });
  shifted(1);
}

/** @param {Complex} x @param {Complex} y @returns {Rotation | null} that makes y zero, null where it is */
function rotationOf([a, b], [c, d]) {
  const size = Math.hypot(a, b, c, d);
  return c === 0 && d === 0 ? null : [a / size, b / size, c / size, d / size];
}

/**
 * Rotate a row and the next: x' = conj(a) x + conj(b) y, y' = a y - b x, from a column on.
 * @param {Float64Array[]} lines
 * @param {number} i
 * @param {Rotation} rotation
 * @param {number} from
 */
function rotateRows(lines, i, [a, b, c, d], from) {
  const x = lines[i], y = lines[i + 1];
  for (let j = 2 * from; j < x.length; j += 2) {
    const p = x[j], q = x[j + 1], r = y[j], s = y[j + 1];
    x[j] = a * p + b * q + c * r + d * s;
    x[j + 1] = a * q - b * p + c * s - d * r;
    y[j] = a * r - b * s - c * p + d * q;
    y[j + 1] = a * s + b * r - c * q - d * p;
  }
}

/**
 * Rotate a column and the next by the inverse, x' = x a + y b, y' = y conj(a) - x conj(b), in the first rows.
 * @param {Float64Array[]} lines
 * @param {number} j
 * @param {Rotation} rotation
 * @param {number} rows
 */
function rotateColumns(lines, j, [a, b, c, d], rows) {
  const k = 2 * j;
  for (let i = 0; i < rows; i++) {
    const line = lines[i], p = line[k], q = line[k + 1], r = line[k + 2], s = line[k + 3];
    line[k] = a * p - b * q + c * r - d * s;
    line[k + 1] = a * q + b * p + c * s + d * r;
    line[k + 2] = a * r + b * s - c * p - d * q;
    line[k + 3] = a * s - b * r - c * q + d * p;
  }
}

/** @param {Float64Array} values make them real or exactly conjugate in pairs, as those of a real matrix are */
function pairUp(values) {
  const left = new Set(Array.from({ length: values.length / 2 }, (_, i) => 2 * i));
  for (const i of left) {
    left.delete(i);
    const apart = (/** @type {number} */ j) => Math.hypot(values[i] - values[j], values[i + 1] + values[j + 1]);
    const nearest = [...left].reduce((best, j) => (apart(j) < apart(best) ? j : best), i);
    left.delete(nearest);
    if (nearest === i) values[i + 1] = 0;
    else {
      const re = (values[i] + values[nearest]) / 2, im = (values[i + 1] - values[nearest + 1]) / 2;
      values.set([re, im], i);
      values.set([re, -im], nearest);
    }
  }
}

/**
 * Return an eigenvector by those of the triangular matrix.
 * @param {Float64Array[]} lines
 * @param {Float64Array[]} basis
 * @param {number} k
 * @returns {Float64Array}
 */
function vectorOf(lines, basis, k) {
  const n = lines.length, own = new Float64Array(2 * n), value = at(lines, k, k);
  const least = EPSILON * (Math.hypot(...value) || 1); // in place of the difference to an equal eigenvalue
  own[2 * k] = 1;
  for (let i = k - 1; i >= 0; i--) {
    let re = 0, im = 0;
    for (let j = i + 1; j <= k; j++) {
      const [x, y] = times(at(lines, i, j), [own[2 * j], own[2 * j + 1]]);
      [re, im] = [re + x, im + y];
    }
    const [p, q] = at(lines, i, i), difference = /** @type {Complex} */ ([value[0] - p, value[1] - q]);
    own.set(quotient([re, im], Math.hypot(...difference) > least ? difference : [least, 0]), 2 * i);
  }
  const found = new Float64Array(2 * n);
  for (let i = 0; i < n; i++) {
    for (let j = 0; j <= k; j++) {
      const [x, y] = times(at(basis, i, j), [own[2 * j], own[2 * j + 1]]);
      found[2 * i] += x;
      found[2 * i + 1] += y;
    }
  }
  const norm = Math.hypot(...found);
  return found.map((x) => x / norm);
}

/** @param {Complex} x @param {Complex} y @returns {Complex} */
function times([a, b], [c, d]) {
  return [a * c - b * d, a * d + b * c];
}

/** @param {Complex} x @param {Complex} y @returns {Complex} */
function quotient([a, b], [c, d]) {
  const size = c * c + d * d;
  return [(a * c + b * d) / size, (b * c - a * d) / size];
}

/** @param {Complex} x @returns {Complex} its root with a real part of at least 0 */
function rootOf([a, b]) {
  const re = Math.sqrt((Math.hypot(a, b) + Math.abs(a)) / 2), im = re && b / (2 * re);
  return a >= 0 ? [re, im] : [Math.abs(im), b < 0 ? -re : re];
}
