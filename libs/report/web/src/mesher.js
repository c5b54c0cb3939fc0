// SPDX-License-Identifier: BSD-3-Clause
// Greedy meshing: faces between two cells left out, faces of one class in one plane joined to rectangles.
import { TILE } from "./octree.js";

/** Bytes that grow. */
class Bytes {
  array = new Uint8Array(4096);
  length = 0;

  push(a, b, c, d) {
    if (this.length + 4 > this.array.length) {
      const larger = new Uint8Array(2 * this.array.length);
      larger.set(this.array);
      this.array = larger;
    }
    this.array[this.length++] = a;
    this.array[this.length++] = b;
    this.array[this.length++] = c;
    this.array[this.length++] = d;
  }
}

const CORNERS = [[[0, 1], [1, 1], [1, 0], [0, 0]], [[0, 0], [1, 0], [1, 1], [0, 1]]];

/**
 * A cube of cells whose surface is wanted, 2^bits (<= 128) a side.
 * A rectangle is four vertices, counter-clockwise from outside, each x, y, z (cells) and
 * direction | class << 3 | corner << 6; direction: 2 axis + (1 if it looks up that axis); corner: which of the
 * four, bit 0 along the next axis, bit 1 along the one after.
 */
class Cube {
  constructor(bits) {
    this.bits = bits;
    this.n = 1 << bits;
    this.cells = new Uint8Array(1 << (3 * bits)); // class + 1, 0: empty
    this.faces = new Uint8Array(1 << (3 * bits)); // of one direction, slice by slice
    this.touched = new Uint8Array(this.n); // slices with faces
    this.rows = new Uint8Array(this.n * this.n);
    this.list = [];
  }

  /** Fills a cell (x | y << bits | z << 2 bits); the larger class stays. */
  fill(cell, kind) {
    if (!this.cells[cell]) this.list.push(cell);
    if (this.cells[cell] <= kind) this.cells[cell] = kind + 1;
  }

  clear() {
    for (const cell of this.list) this.cells[cell] = 0;
    this.list = [];
  }

  /**
   * Adds the faces that look in a direction and have nothing before them.
   * @param {Uint8Array} [beyond] what is filled beyond that side of the cube: row (axis + 2) n + column (axis + 1).
   *   Faces before it are walls
   */
  addFaces(direction, out, walls, beyond) {
    const { bits, n, cells } = this;
    const axis = direction >> 1;
    const side = direction & 1;
    const border = side ? n - 1 : 0;
    const [along, right, up] = [0, 1, 2].map((k) => ((axis + k) % 3) * bits);
    const step = side ? 1 << along : -(1 << along);
    const hidden = [];
    for (const cell of this.list) {
      const slice = (cell >> along) & (n - 1);
      const row = (cell >> up) & (n - 1);
      const column = (cell >> right) & (n - 1);
      if (slice === border) {
        if (beyond?.[(row << bits) | column]) {
          hidden.push(cell);
          continue;
        }
      } else if (cells[cell + step]) {
        continue;
      }
      this.#mark(slice, row, column, cells[cell]);
    }
    this.#join(direction, out);
    for (const cell of hidden) this.#mark(border, (cell >> up) & (n - 1), (cell >> right) & (n - 1), cells[cell]);
    this.#join(direction, walls);
  }

  #mark(slice, row, column, kind) {
    this.faces[(((slice << this.bits) | row) << this.bits) | column] = kind;
    this.touched[slice] = 1;
    this.rows[(slice << this.bits) | row] = 1;
  }

  /** Joins the marked faces to rectangles. */
  #join(direction, out) {
    const { n, faces, touched, rows } = this;
    for (let slice = 0; slice < n; ++slice) {
      if (!touched[slice]) continue;
      touched[slice] = 0;
      for (let row = 0; row < n; ++row) {
        if (!rows[slice * n + row]) continue;
        rows[slice * n + row] = 0;
        const begin = (slice * n + row) * n;
        for (let column = 0; column < n; ++column) {
          const kind = faces[begin + column];
          if (!kind) continue;
          let width = 1;
          while (column + width < n && faces[begin + column + width] === kind) ++width;
          let height = 1;
          for (let full = true; row + height < n; ++height) {
            const next = begin + height * n + column;
            for (let i = 0; i < width && full; ++i) full = faces[next + i] === kind;
            if (!full) break;
          }
          for (let j = 0; j < height; ++j) faces.fill(0, begin + j * n + column, begin + j * n + column + width);
          this.#rectangle(direction, slice, row, column, width, height, kind - 1, out);
        }
      }
    }
  }

  #rectangle(direction, slice, row, column, width, height, kind, out) {
    const axis = direction >> 1;
    const vertex = [0, 0, 0];
    vertex[axis] = slice + (direction & 1);
    for (const [a, b] of CORNERS[direction & 1]) {
      vertex[(axis + 1) % 3] = column + a * width;
      vertex[(axis + 2) % 3] = row + b * height;
      out.push(vertex[0], vertex[1], vertex[2], direction | (kind << 3) | (a << 6) | (b << 7));
    }
  }
}

const tileCube = new Cube(Math.log2(TILE));
const freeCube = new Cube(7);

/** The cells of a neighbouring tile that touch this one, which it stands beside in a direction. */
function touching(tile, direction) {
  const [along, right, up] = [0, 1, 2].map((k) => 6 * (((direction >> 1) + k) % 3));
  const near = direction & 1 ? 0 : TILE - 1;
  const plane = new Uint8Array(TILE * TILE);
  for (const cell of tile.cells) {
    if (((cell >> along) & 63) === near) plane[((cell >> up) & 63) * TILE + ((cell >> right) & 63)] = 1;
  }
  return plane;
}

// Faces come in this order, so that what an eye above can see of a tile is mostly one run of three directions.
const ORDER = [0, 2, 5, 1, 3, 4];

/**
 * The surface of a tile (octree.js).
 * @param neighbours tiles of the same level beside it, by direction
 * @returns {{vertices: Uint8Array, runs: {direction, begin, end}[]}} rectangles of every direction; those after the last run are
 *   walls: faces that lie against neighbours, to be drawn where one is shown in another level, so that nothing shines through
 */
export function meshTile(tile, neighbours = []) {
  const faces = new Bytes();
  const walls = new Bytes();
  const runs = [];
  for (const cell of tile.cells) tileCube.fill(cell & 0x3ffff, cell >>> 18);
  for (const direction of ORDER) {
    const begin = faces.length / 16;
    tileCube.addFaces(direction, faces, walls, neighbours[direction] && touching(neighbours[direction], direction));
    runs.push({ direction, begin, end: faces.length / 16 });
  }
  tileCube.clear();
  const vertices = new Uint8Array(faces.length + walls.length);
  vertices.set(faces.array.subarray(0, faces.length));
  vertices.set(walls.array.subarray(0, walls.length), faces.length);
  return { vertices, runs };
}

/** The surface of the space that free leaves take up, in cells of `edge` voxels from `origin` (keys) on. */
export function meshFree(free, origin, edge) {
  const n = freeCube.n;
  for (let i = 0; i < free.length; i += 4) {
    const from = [0, 1, 2].map((k) => Math.floor((free[i + k] - origin[k]) / edge));
    const to = [0, 1, 2].map((k) => Math.ceil((free[i + k] + free[i + 3] - origin[k]) / edge));
    for (let z = Math.max(0, from[2]); z < Math.min(n, to[2]); ++z) {
      for (let y = Math.max(0, from[1]); y < Math.min(n, to[1]); ++y) {
        for (let x = Math.max(0, from[0]); x < Math.min(n, to[0]); ++x) freeCube.fill(x | (y << 7) | (z << 14), 0);
      }
    }
  }
  const faces = new Bytes();
  for (let direction = 0; direction < 6; ++direction) freeCube.addFaces(direction, faces, faces);
  freeCube.clear();
  return faces.array.slice(0, faces.length);
}
