"use strict";
// The surface of half a volume fraction of a grid of cubes as triangles, by surface nets (Gibson 1998,
// doi:10.1007/BFb0056277): a corner in each cube of eight neighbouring centres that it passes through, at the mean
// of where it cuts the cube's edges; four such corners around each edge that it cuts make two triangles. Outside of
// the grid there is no water, so that the surface is closed.
(function (viewer) {
  const edges = [];
  for (let a = 0; a < 8; ++a)
    for (const step of [1, 2, 4]) if (!(a & step)) edges.push([a, a | step]);

  // grid: {size, first, all, fraction, pressure, speed}; field: which of the values the corners take. Returns
  // {place, normal, value, triangles}, lengths over L.
  viewer.surfaceNets = function (grid, time, half, field) {
    const [nx, ny, nz] = grid.size, base = time * grid.all, level = 127.5;
    const inside = (i, j, k) => i >= 0 && j >= 0 && k >= 0 && i < nx && j < ny && k < nz;
    const index = (i, j, k) => base + (k * ny + j) * nx + i;
    const at = (plane, i, j, k) => (inside(i, j, k) ? plane[index(i, j, k)] : 0);
    // Cube (i, j, k) has its lowest centre at that of square (i - 1, j - 1, k - 1).
    const mx = nx + 1, my = ny + 1, mz = nz + 1;
    const corner = new Int32Array(mx * my * mz).fill(-1);
    const place = [], value = [], triangles = [], f = new Float32Array(8);
    for (let k = 0; k < mz; ++k)
      for (let j = 0; j < my; ++j)
        for (let i = 0; i < mx; ++i) {
          let wet = 0;
          for (let c = 0; c < 8; ++c) {
            f[c] = at(grid.fraction, i - 1 + (c & 1), j - 1 + ((c >> 1) & 1), k - 1 + (c >> 2)) - level;
            if (f[c] > 0) ++wet;
          }
          if (wet === 0 || wet === 8) continue;
          let x = 0, y = 0, z = 0, count = 0, sum = 0, weight = 0;
          for (const [a, b] of edges) {
            if (f[a] > 0 === f[b] > 0) continue;
            const part = f[a] / (f[a] - f[b]);
            const on = (bit) => ((a >> bit) & 1) + part * (((b >> bit) & 1) - ((a >> bit) & 1));
            x += on(0);
            y += on(1);
            z += on(2);
            ++count;
          }
          for (let c = 0; c < 8; ++c) {
            const q = [i - 1 + (c & 1), j - 1 + ((c >> 1) & 1), k - 1 + (c >> 2)];
            const w = at(grid.fraction, ...q);
            sum += w * at(grid[field], ...q);
            weight += w;
          }
          corner[(k * my + j) * mx + i] = value.length;
          const length = (axis, n, mean) => (2 * (grid.first[axis] + n - 1 + mean) + 1) * half;
          place.push(length(0, i, x / count), length(1, j, y / count), length(2, k, z / count));
          value.push(weight ? sum / weight : 0);
        }
    const turn = [1, mx, mx * my];
    for (let k = 0; k < mz; ++k)
      for (let j = 0; j < my; ++j)
        for (let i = 0; i < mx; ++i) {
          // Edges from the centre (i, j, k) towards +x, +y, +z; the cubes around one share its lowest corner.
          const here = at(grid.fraction, i - 1, j - 1, k - 1) > level;
          const n = (k * my + j) * mx + i;
          for (let axis = 0; axis < 3; ++axis) {
            const there = at(grid.fraction, i - 1 + (axis === 0), j - 1 + (axis === 1), k - 1 + (axis === 2)) > level;
            const low = [i, j, k], u = (axis + 1) % 3, v = (axis + 2) % 3;
            if (here === there || low[u] === 0 || low[v] === 0) continue;
            const quad = [n, n - turn[u], n - turn[u] - turn[v], n - turn[v]].map((q) => corner[q]);
            if (there) quad.reverse();
            triangles.push(quad[0], quad[1], quad[2], quad[0], quad[2], quad[3]);
          }
        }
    const normal = new Float32Array(place.length);
    for (let t = 0; t < triangles.length; t += 3) {
      const [a, b, c] = [3 * triangles[t], 3 * triangles[t + 1], 3 * triangles[t + 2]];
      const p = [0, 1, 2].map((d) => place[b + d] - place[a + d]), q = [0, 1, 2].map((d) => place[c + d] - place[a + d]);
      for (let d = 0; d < 3; ++d) {
        const e = (d + 1) % 3, g = (d + 2) % 3, part = p[e] * q[g] - p[g] * q[e];
        for (const corner of [a, b, c]) normal[corner + d] += part;
      }
    }
    return {place: new Float32Array(place), normal, value: new Uint8Array(value), triangles: new Uint32Array(triangles)};
  };
})(surgeViewer);
