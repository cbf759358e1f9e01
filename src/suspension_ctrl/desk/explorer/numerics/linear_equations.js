// Real linear equations.

/**
 * Return the solution X (n, k) of A X = B by elimination with pivoting; both are left as they are.
 * @param {ArrayLike<number>[]} matrix (n, n)
 * @param {ArrayLike<number>[]} right (n, k)
 * @returns {Float64Array[]}
 */
export function solved(matrix, right) {
  const n = matrix.length, lines = matrix.map((row, i) => Float64Array.of(...Array.from(row), ...Array.from(right[i])));
  for (let c = 0; c < n; c++) {
    let best = c;
    for (let i = c + 1; i < n; i++) if (Math.abs(lines[i][c]) > Math.abs(lines[best][c])) best = i;
    [lines[c], lines[best]] = [lines[best], lines[c]];
    const pivot = lines[c][c];
    for (let j = c; j < lines[c].length; j++) lines[c][j] /= pivot;
    for (let i = 0; i < n; i++) {
      const factor = lines[i][c];
      for (let j = c; i !== c && factor !== 0 && j < lines[i].length; j++) lines[i][j] -= factor * lines[c][j];
    }
  }
  return lines.map((line) => line.subarray(n));
}
