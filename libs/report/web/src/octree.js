// SPDX-License-Identifier: BSD-3-Clause
// The octree of a node, as libs/report/src/VoxelBytes.h describes it, taken apart into chunks.

const LEVELS = 16; // of an OctoMap tree: keys run from 0 to 65535, the origin is at 32768
export const ORIGIN = 32768;
export const CHUNK = 64; // voxels a side
const CHUNK_DEPTH = LEVELS - 6;

class Growing {
  constructor(Type) {
    this.Type = Type;
    this.array = new Type(1024);
    this.length = 0;
  }
  push(value) {
    if (this.length === this.array.length) {
      const larger = new this.Type(2 * this.length);
      larger.set(this.array);
      this.array = larger;
    }
    this.array[this.length++] = value;
  }
}

/**
 * @returns {{chunks: {x, y, z, voxels: Uint32Array}[], free: Int32Array}}
 *   chunks of occupied voxels: key of the lowest corner, and x | y << 6 | z << 12 | probability << 18 of each
 *   voxel in it (probability times 255); free leaves: x, y, z of the lowest corner and the edge, in voxels.
 */
export function decodeOctree(bytes) {
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  const inner = view.getUint32(0, true);
  let at = 4;
  let leaf = 4 + 2 * inner;
  const voxels = new Growing(Uint32Array);
  const free = new Growing(Int32Array);
  const ranges = [];

  function addVoxels(x, y, z, size, probability) {
    for (let k = 0; k < size; ++k) {
      for (let j = 0; j < size; ++j) {
        for (let i = 0; i < size; ++i) {
          voxels.push((x + i) | ((y + j) << 6) | ((z + k) << 12) | (probability << 18));
        }
      }
    }
  }

  function addChunk(x, y, z, fill) {
    const begin = voxels.length;
    fill();
    if (voxels.length > begin) ranges.push({ x, y, z, begin, end: voxels.length });
  }

  function addLeaf(x, y, z, size, probability) {
    if (size <= CHUNK) {
      addVoxels(x % CHUNK, y % CHUNK, z % CHUNK, size, probability);
      return;
    }
    for (let k = 0; k < size; k += CHUNK) {
      for (let j = 0; j < size; j += CHUNK) {
        for (let i = 0; i < size; i += CHUNK) {
          addChunk(x + i, y + j, z + k, () => addVoxels(0, 0, 0, CHUNK, probability));
        }
      }
    }
  }

  function descend(depth, x, y, z) {
    const bits = view.getUint16(at, true);
    at += 2;
    const size = 1 << (LEVELS - depth - 1);
    for (let i = 0; i < 8; ++i) {
      const kind = (bits >> (2 * i)) & 3;
      if (kind === 0) continue;
      const cx = x + (i & 1 ? size : 0);
      const cy = y + (i & 2 ? size : 0);
      const cz = z + (i & 4 ? size : 0);
      if (kind === 1) {
        for (const value of [cx, cy, cz, size]) free.push(value);
        continue;
      }
      const enter = kind === 3 ? () => descend(depth + 1, cx, cy, cz) : () => addLeaf(cx, cy, cz, size, bytes[leaf++]);
      if (depth + 1 === CHUNK_DEPTH) addChunk(cx, cy, cz, enter);
      else enter();
    }
  }

  if (inner > 0) descend(0, 0, 0, 0);
  const chunks = ranges.map(({ x, y, z, begin, end }) => ({ x, y, z, voxels: voxels.array.slice(begin, end) }));
  return { chunks, free: free.array.slice(0, free.length) };
}
