// The assignment of rows to columns of least cost, by shortest augmenting paths.

/**
 * Return the column of each row, all different, for which the sum of costs is least; as many columns or more.
 *
 * Of each new row a shortest path leads over assigned rows to a free column, as in D. F. Crouse, "On implementing 2D
 * rectangular assignment algorithms", IEEE Trans. Aerospace and Electronic Systems 52(4), 2016.
 * @param {ArrayLike<number>[]} costs (n, m)
 * @returns {number[]} (n,)
 */
export function assigned(costs) {
  const n = costs.length, m = n && costs[0].length;
  const u = new Float64Array(n), v = new Float64Array(m); // prices of rows and columns
  const rowOf = new Int32Array(m).fill(-1), columnOf = new Int32Array(n).fill(-1);
  for (let row = 0; row < n; row++) {
    const distance = new Float64Array(m).fill(Infinity), from = new Int32Array(m).fill(-1);
    const seen = new Uint8Array(m);
    let i = row, length = 0, sink = -1;
    while (sink < 0) {
      let best = -1;
      for (let j = 0; j < m; j++) {
        if (seen[j]) continue;
        const own = length + costs[i][j] - u[i] - v[j];
        if (own < distance[j]) [distance[j], from[j]] = [own, i];
        if (best < 0 || distance[j] < distance[best]) best = j;
      }
      [length, seen[best]] = [distance[best], 1];
      if (rowOf[best] < 0) sink = best;
      else i = rowOf[best];
    }
    u[row] += length;
    for (let j = 0; j < m; j++) {
      if (!seen[j]) continue;
      if (rowOf[j] >= 0) u[rowOf[j]] += length - distance[j];
      v[j] -= length - distance[j];
    }
    for (let j = sink; j >= 0; ) {
      const next = columnOf[from[j]];
      [rowOf[j], columnOf[from[j]]] = [from[j], j];
      j = from[j] === row ? -1 : next;
    }
  }
  return Array.from(columnOf);
}
