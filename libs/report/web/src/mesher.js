// SPDX-License-Identifier: BSD-3-Clause
// Greedy meshing: faces between two cells left out, faces of one class in one plane joined to rectangles.

const grids = new Map(); // scratch, by size

function scratch(n) {
  if (!grids.has(n)) grids.set(n, { cells: new Uint8Array(n ** 3), faces: new Uint8Array(n ** 3) });
  return grids.get(n);
}

/** Class of a probability (0..255): 0 at one half to 7 at one. */
export const probabilityClass = (p) => Math.max(0, Math.min(7, ((p - 128) >> 4)));

/**
 * The surface of cells in a cube of n (<= 128) cells a side.
 * @param {Uint32Array|number[]} list the filled cells, x + n y + n n z
 * @param {Uint8Array} cells class + 1 of each cell of the cube; 0: empty
 * @param {Uint8Array[]} [beyond] for each direction what is filled beyond that side: row (axis + 2) n + column (axis + 1)
 * @returns {Uint8Array} four vertices a rectangle, counter-clockwise from outside, each x, y, z (cells) and
 *   direction | class << 3 | corner << 6; direction: 2 axis + (1 if it looks up that axis); corner: which of the
 *   four, bit 0 along the next axis, bit 1 along the one after
 */
function surface(n, list, cells, faces, beyond) {
  let out = new Uint8Array(4096);
  let length = 0;
  const stride = [1, n, n * n];
  const push = (vertex, code) => {
    if (length + 4 > out.length) {
      const larger = new Uint8Array(2 * out.length);
      larger.set(out);
      out = larger;
    }
    out[length++] = vertex[0];
    out[length++] = vertex[1];
    out[length++] = vertex[2];
    out[length++] = code;
  };
  const touched = new Uint8Array(n);
  const rowOf = new Uint8Array(n * n);
  const vertex = [0, 0, 0];
  for (let axis = 0; axis < 3; ++axis) {
    const u = (axis + 1) % 3;
    const v = (axis + 2) % 3;
    for (let side = 0; side < 2; ++side) {
      const step = side ? stride[axis] : -stride[axis];
      const border = side ? n - 1 : 0;
      touched.fill(0);
      rowOf.fill(0);
      for (const cell of list) {
        const p = [cell % n, ((cell / n) | 0) % n, (cell / (n * n)) | 0];
        if (p[axis] !== border ? cells[cell + step] : beyond?.[2 * axis + side]?.[p[v] * n + p[u]]) continue;
        faces[(p[axis] * n + p[v]) * n + p[u]] = cells[cell];
        touched[p[axis]] = 1;
        rowOf[p[axis] * n + p[v]] = 1;
      }
      for (let slice = 0; slice < n; ++slice) {
        if (!touched[slice]) continue;
        for (let row = 0; row < n; ++row) {
          if (!rowOf[slice * n + row]) continue;
          const begin = (slice * n + row) * n;
          for (let column = 0; column < n; ++column) {
            const kind = faces[begin + column];
            if (!kind) continue;
            let width = 1;
            while (column + width < n && faces[begin + column + width] === kind) ++width;
            let height = 1;
            for (; row + height < n; ++height) {
              const next = begin + height * n + column;
              let full = true;
              for (let i = 0; i < width && full; ++i) full = faces[next + i] === kind;
              if (!full) break;
            }
            for (let j = 0; j < height; ++j) faces.fill(0, begin + j * n + column, begin + j * n + column + width);
            const code = (2 * axis + side) | ((kind - 1) << 3);
            const corners = [[0, 0], [1, 0], [1, 1], [0, 1]];
            if (!side) corners.reverse();
            vertex[axis] = slice + side;
            for (const [a, b] of corners) {
              vertex[u] = column + a * width;
              vertex[v] = row + b * height;
              push(vertex, code | (a << 6) | (b << 7));
            }
          }
        }
      }
    }
  }
  return out.slice(0, length);
}

/** The cells of a neighbouring chunk that touch this one, which it stands beside in a direction. */
function touching(voxels, level, direction) {
  const n = 64 >> level;
  const axis = direction >> 1;
  const near = direction & 1 ? 0 : n - 1;
  const plane = new Uint8Array(n * n);
  for (const voxel of voxels) {
    const p = [0, 6, 12].map((shift) => ((voxel >> shift) & 63) >> level);
    if (p[axis] === near) plane[p[(axis + 2) % 3] * n + p[(axis + 1) % 3]] = 1;
  }
  return plane;
}

/**
 * The surface of a chunk's voxels (octree.js), in cells of 2^level voxels: of each the largest probability.
 * @param neighbours voxels of the chunks beside it by direction, so that there is no wall between them
 */
export function meshChunk(voxels, level, neighbours = []) {
  const n = 64 >> level;
  const beyond = neighbours.map((beside, direction) => beside && touching(beside, level, direction));
  const { cells, faces } = scratch(n);
  const list = [];
  for (const voxel of voxels) {
    const x = (voxel & 63) >> level;
    const y = ((voxel >> 6) & 63) >> level;
    const z = ((voxel >> 12) & 63) >> level;
    const cell = x + n * (y + n * z);
    const kind = probabilityClass(voxel >>> 18) + 1;
    if (!cells[cell]) list.push(cell);
    if (cells[cell] < kind) cells[cell] = kind;
  }
  const mesh = surface(n, list, cells, faces, beyond);
  for (const cell of list) cells[cell] = 0;
  return mesh;
}

/** The surface of the space that free leaves take up, in cells of `edge` voxels from `origin` (keys) on. */
export function meshFree(free, origin, edge) {
  const n = 128;
  const { cells, faces } = scratch(n);
  const list = [];
  for (let i = 0; i < free.length; i += 4) {
    const from = [0, 1, 2].map((k) => Math.floor((free[i + k] - origin[k]) / edge));
    const to = [0, 1, 2].map((k) => Math.ceil((free[i + k] + free[i + 3] - origin[k]) / edge));
    for (let z = Math.max(0, from[2]); z < Math.min(n, to[2]); ++z) {
      for (let y = Math.max(0, from[1]); y < Math.min(n, to[1]); ++y) {
        for (let x = Math.max(0, from[0]); x < Math.min(n, to[0]); ++x) {
          const cell = x + n * (y + n * z);
          if (!cells[cell]) list.push(cell);
          cells[cell] = 1;
        }
      }
    }
  }
  const mesh = surface(n, list, cells, faces);
  for (const cell of list) cells[cell] = 0;
  return mesh;
}
