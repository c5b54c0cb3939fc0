// SPDX-License-Identifier: BSD-3-Clause
// The octree of a node, as libs/report/src/VoxelBytes.h describes it, taken apart into tiles of several levels of detail.

const DEPTH = 16; // of an OctoMap tree: keys run from 0 to 65535, the origin is at 32768
export const ORIGIN = 32768;
export const TILE = 64; // cells a side; a cell of level L is 2^L voxels a side
const COARSEST = 9; // eight tiles of this level are all that can be addressed
const MANY = 8000; // cells of a node that are joined to one tile at the coarsest level

/** Class of a probability (0..255): 0 at one half to 7 at one. */
export const probabilityClass = (p) => Math.max(0, Math.min(7, (p - 128) >> 4));

/**
 * A cube of 64 cells a side. Its cells, in the octree's order: x | y << 6 | z << 12 | class of probability << 18.
 * @typedef {{level, x, y, z, cells: Uint32Array, children: Tile[]}} Tile  x, y, z: key of the lowest corner
 */

/**
 * The occupied voxels and the free leaves.
 * @returns {{tiles: Tile[], free: number[]}} tiles of level 0; x, y, z of the lowest corner and the edge of each free leaf, in voxels
 */
function readOctree(bytes) {
  const inner = bytes[0] | (bytes[1] << 8) | (bytes[2] << 16) | (bytes[3] << 24);
  let at = 4;
  let leaf = 4 + 2 * inner;
  let cells = new Uint32Array(Math.max(64, bytes.length - leaf));
  let length = 0;
  const free = [];
  const ranges = [];

  function addLeaf(x, y, z, size, bits) {
    if (size > 1) {
      const half = size / 2;
      for (let i = 0; i < 8; ++i) enter(addLeaf, x + (i & 1 ? half : 0), y + (i & 2 ? half : 0), z + (i & 4 ? half : 0), half, bits);
      return;
    }
    if (length === cells.length) {
      const larger = new Uint32Array(2 * length);
      larger.set(cells);
      cells = larger;
    }
    cells[length++] = (x & 63) | ((y & 63) << 6) | ((z & 63) << 12) | bits;
  }

  function addInner(x, y, z, size) {
    const bits = bytes[at] | (bytes[at + 1] << 8);
    at += 2;
    const half = size / 2;
    for (let i = 0; i < 8; ++i) {
      const kind = (bits >> (2 * i)) & 3;
      if (kind === 0) continue;
      const cx = x + (i & 1 ? half : 0);
      const cy = y + (i & 2 ? half : 0);
      const cz = z + (i & 4 ? half : 0);
      if (kind === 1) free.push(cx, cy, cz, half);
      else if (kind === 2) enter(addLeaf, cx, cy, cz, half, probabilityClass(bytes[leaf++]) << 18);
      else enter(addInner, cx, cy, cz, half);
    }
  }

  function enter(add, x, y, z, size, bits) {
    const begin = length;
    add(x, y, z, size, bits);
    if (size === TILE && length > begin) ranges.push({ x, y, z, begin, end: length });
  }

  if (inner > 0) addInner(0, 0, 0, 1 << DEPTH);
  const tiles = ranges.map(({ x, y, z, begin, end }) => ({ level: 0, x, y, z, cells: cells.subarray(begin, end), children: [] }));
  return { tiles, free };
}

/** Tiles of the next level, of cells of eight: filled if one of them is, with the largest class.
 * @param origin corners are multiples of the size of a tile from here (keys) */
function coarser(tiles, origin = 0) {
  const level = tiles[0].level + 1;
  const span = TILE << level;
  const cells = new Uint32Array(tiles.reduce((sum, tile) => sum + tile.cells.length, 0));
  let length = 0;
  const parents = [];
  for (const tile of tiles) {
    const [x, y, z] = [tile.x, tile.y, tile.z].map((k) => Math.floor((k - origin) / span) * span + origin);
    let parent = parents.at(-1);
    if (!parent || parent.x !== x || parent.y !== y || parent.z !== z) {
      parent = { level, x, y, z, begin: length, children: [] };
      parents.push(parent);
    }
    parent.children.push(tile);
    const half = TILE / 2;
    const place = (tile.x > x ? half : 0) | (tile.y > y ? half << 6 : 0) | (tile.z > z ? half << 12 : 0);
    // In the octree's order the cells of one coarser cell follow each other.
    for (const cell of tile.cells) {
      const here = place | ((cell >> 1) & 0x1f7df); // x, y, z halved
      if (length > parent.begin && (cells[length - 1] & 0x3ffff) === here) {
        if (cells[length - 1] >>> 18 < cell >>> 18) cells[length - 1] = here | (cell & ~0x3ffff);
      } else {
        cells[length++] = here | (cell & ~0x3ffff);
      }
    }
    parent.end = length;
  }
  return parents.map(({ begin, end, ...parent }) => ({ ...parent, cells: cells.subarray(begin, end) }));
}

/** Whether all tiles are among the eight that meet at the origin. */
const atOrigin = (tiles) => tiles.every((tile) => [tile.x, tile.y, tile.z].every((k) => k === ORIGIN || k === ORIGIN - (TILE << tile.level)));

/** @returns {{root: Tile|null, free: number[]}} the coarsest tile, with finer ones below; free leaves (readOctree) */
export function decodeOctree(bytes) {
  const { tiles, free } = readOctree(bytes);
  if (tiles.length === 0) return { root: null, free };
  let level = tiles;
  const isMany = () => level.reduce((sum, tile) => sum + tile.cells.length, 0) > MANY;
  while (level[0].level < COARSEST && (!atOrigin(level) || isMany())) level = coarser(level);
  const [root] = coarser(level, ORIGIN - (TILE << level[0].level)); // what lies about the origin in one tile
  return { root, free };
}
