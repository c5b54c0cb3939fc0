// SPDX-License-Identifier: BSD-3-Clause
// Parts of the report's page against brute force, without a browser. Usage: node --test units.mjs
import assert from "node:assert/strict";
import test from "node:test";
import { History } from "../../libs/report/web/src/history.js";
import { meshTile } from "../../libs/report/web/src/mesher.js";
import { decodeOctree, ORIGIN, probabilityClass, TILE } from "../../libs/report/web/src/octree.js";
import { parseCsv } from "../../libs/report/web/src/csv.js";

/** Numbers of a seed, in [0, 1). */
function random(seed) {
  return () => ((seed = (seed * 1664525 + 1013904223) >>> 0) / 2 ** 32);
}

/** As libs/report/src/VoxelBytes.h says, of voxels {key text: probability byte} and free voxels. */
function encode(occupied, free) {
  const inner = [];
  const probabilities = [];
  const within = (set, x, y, z, size) => [...set].some((key) => {
    const [a, b, c] = key.split(",").map(Number);
    return a >= x && a < x + size && b >= y && b < y + size && c >= z && c < z + size;
  });
  const descend = (x, y, z, size) => {
    const at = inner.push(0) - 1;
    for (let i = 0; i < 8; ++i) {
      const half = size / 2;
      const [cx, cy, cz] = [x + (i & 1 ? half : 0), y + (i & 2 ? half : 0), z + (i & 4 ? half : 0)];
      const key = `${cx},${cy},${cz}`;
      if (half === 1) {
        if (occupied.has(key)) probabilities.push(occupied.get(key));
        inner[at] |= (occupied.has(key) ? 2 : free.has(key) ? 1 : 0) << (2 * i);
      } else if (within(occupied.keys(), cx, cy, cz, half) || within(free, cx, cy, cz, half)) {
        inner[at] |= 3 << (2 * i);
        descend(cx, cy, cz, half);
      }
    }
  };
  descend(0, 0, 0, 65536);
  const bytes = new Uint8Array(4 + 2 * inner.length + probabilities.length);
  const view = new DataView(bytes.buffer);
  view.setUint32(0, inner.length, true);
  inner.forEach((bits, i) => view.setUint16(4 + 2 * i, bits, true));
  bytes.set(probabilities, 4 + 2 * inner.length);
  return bytes;
}

/** Cells of tiles as {corner in voxels: class}; those of the finest level, and of every level with its name. */
function cellsOf(root) {
  const levels = new Map();
  const walk = (tile) => {
    if (!levels.has(tile.level)) levels.set(tile.level, new Map());
    for (const cell of tile.cells) {
      const at = [tile.x, tile.y, tile.z].map((k, i) => k + (((cell >> (6 * i)) & 63) << tile.level));
      assert.ok(!levels.get(tile.level).has(at.join(",")), "each cell once");
      levels.get(tile.level).set(at.join(","), cell >>> 18);
    }
    for (const child of tile.children) {
      assert.equal(child.level, tile.level - 1);
      for (const k of ["x", "y", "z"]) assert.ok(child[k] === tile[k] || child[k] === tile[k] + (TILE << child.level));
      walk(child);
    }
  };
  if (root) walk(root);
  return levels;
}

test("an octree gives back its voxels, at every level those that are occupied in part", () => {
  for (const [seed, extent, count] of [[1, 160, 60], [2, 3000, 200], [3, 60000, 50], [4, 16, 400]]) {
    const next = random(seed);
    const key = () => [0, 1, 2].map(() => ORIGIN + Math.floor(extent * (next() - 0.5))).join(",");
    const occupied = new Map(Array.from({ length: count }, () => [key(), 128 + Math.floor(127 * next())]));
    const free = new Set(Array.from({ length: 40 }, key).filter((k) => !occupied.has(k)));
    const decoded = decodeOctree(encode(occupied, free));
    const levels = cellsOf(decoded.root);
    assert.ok(levels.size > 1);
    for (const [level, found] of levels) {
      const expected = new Map();
      for (const [text, probability] of occupied) {
        const cell = text.split(",").map((k) => (k >> level) << level).join(",");
        expected.set(cell, Math.max(expected.get(cell) ?? 0, probabilityClass(probability)));
      }
      assert.deepEqual(new Map([...found].sort()), new Map([...expected].sort()), `seed ${seed}, level ${level}`);
    }
    const freeFound = [];
    for (let i = 0; i < decoded.free.length; i += 4) freeFound.push(decoded.free.slice(i, i + 3).join(","));
    assert.deepEqual(freeFound.sort(), [...free].sort());
  }
});

test("coarse leaves are the voxels they cover", () => {
  // The root's last child is inner, and so on down to one occupied leaf of 128 voxels a side beside an inner node of nothing.
  const bytes = new Uint8Array(4 + 2 * 9 + 1);
  bytes[0] = 9;
  for (let i = 0; i < 8; ++i) bytes.set([0, 0xc0], 4 + 2 * i);
  bytes.set([2, 0], 4 + 2 * 8);
  bytes[22] = 255;
  const tiles = (tile) => (tile.level === 0 ? [tile] : tile.children.flatMap(tiles));
  const finest = tiles(decodeOctree(bytes).root);
  assert.equal(finest.length, 8);
  for (const tile of finest) assert.equal(new Set(tile.cells.map((cell) => cell & 0x3ffff)).size, 64 ** 3);
});

test("an empty octree has nothing", () => {
  const { root, free } = decodeOctree(new Uint8Array(4));
  assert.equal(root, null);
  assert.equal(free.length, 0);
});

test("the faces of a mesh cover what is exposed once, by direction and class", () => {
  for (const [seed, n, fill] of [[2, 64, 3000], [3, 32, 3000], [4, 8, 300], [5, 2, 6]]) {
    const next = random(seed);
    const cells = new Map();
    for (let i = 0; i < fill; ++i) {
      cells.set([0, 1, 2].map(() => Math.floor(n * next() ** 2)).join(","), Math.floor(8 * next()));
    }
    const packed = Uint32Array.from([...cells], ([cell, kind]) => {
      const [x, y, z] = cell.split(",").map(Number);
      return x | (y << 6) | (z << 12) | (kind << 18);
    });
    const expected = new Set();
    for (const [cell, kind] of cells) {
      const p = cell.split(",").map(Number);
      for (let direction = 0; direction < 6; ++direction) {
        const beside = [...p];
        beside[direction >> 1] += direction & 1 ? 1 : -1;
        if (!cells.has(beside.join(","))) expected.add(`${cell} ${direction} ${kind}`);
      }
    }
    const { vertices: mesh, runs } = meshTile({ cells: packed });
    assert.equal(runs.at(-1).end, mesh.length / 16, "no walls");
    for (const { direction, begin, end } of runs) {
      for (let i = begin; i < end; ++i) assert.equal(mesh[16 * i + 3] & 7, direction);
    }
    const covered = [];
    for (let i = 0; i < mesh.length; i += 16) {
      const corners = [0, 4, 8, 12].map((k) => [...mesh.subarray(i + k, i + k + 3)]);
      const code = mesh[i + 3];
      const axis = (code & 7) >> 1;
      const low = [0, 1, 2].map((k) => Math.min(...corners.map((c) => c[k])));
      const high = [0, 1, 2].map((k) => Math.max(...corners.map((c) => c[k])));
      const [u, v] = [(axis + 1) % 3, (axis + 2) % 3];
      for (let a = low[u]; a < high[u]; ++a) {
        for (let b = low[v]; b < high[v]; ++b) {
          const p = [0, 0, 0];
          [p[axis], p[u], p[v]] = [low[axis] - (code & 1), a, b];
          covered.push(`${p.join(",")} ${code & 7} ${(code >> 3) & 7}`);
        }
      }
      corners.forEach((corner, k) => {
        const which = mesh[i + 4 * k + 3] >> 6;
        assert.equal(corner[u] === high[u], Boolean(which & 1));
        assert.equal(corner[v] === high[v], Boolean(which & 2));
      });
      // Counter-clockwise from outside.
      const [e, f] = [1, 2].map((k) => corners[k].map((value, j) => value - corners[0][j]));
      const normal = [e[1] * f[2] - e[2] * f[1], e[2] * f[0] - e[0] * f[2], e[0] * f[1] - e[1] * f[0]];
      assert.ok(code & 1 ? normal[axis] > 0 : normal[axis] < 0);
    }
    assert.equal(covered.length, expected.size, "each once");
    assert.deepEqual(new Set(covered), expected);
    assert.ok(mesh.every((value, k) => k % 4 === 3 || value <= n));
  }
});

test("what lies against a neighbour is a wall, which can be left out", () => {
  const plane = (x) => ({ cells: Uint32Array.from({ length: 64 * 64 }, (_, i) => x | ((i & 63) << 6) | ((i >> 6) << 12)) });
  const directions = (tile, neighbours) => {
    const { vertices, runs } = meshTile(tile, neighbours);
    const of = (from, to) => [...new Set([...vertices.subarray(16 * from, 16 * to)].filter((_, k) => k % 16 === 3).map((code) => code & 7))].sort();
    return [of(0, runs.at(-1).end), of(runs.at(-1).end, vertices.length / 16)];
  };
  assert.deepEqual(directions(plane(63)), [[0, 1, 2, 3, 4, 5], []]);
  assert.deepEqual(directions(plane(63), [undefined, plane(0)]), [[0, 2, 3, 4, 5], [1]]);
  assert.deepEqual(directions(plane(0), [plane(63)]), [[1, 2, 3, 4, 5], [0]]);
  assert.deepEqual(directions(plane(63), [undefined, plane(1)]), [[0, 1, 2, 3, 4, 5], []], "a gap is a gap");
});

const IDENTITY = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1];
const at = (x, y, z) => IDENTITY.map((value, i) => ({ 3: x, 7: y, 11: z }[i] ?? value));
const node = (id, parent, place, more = {}) => ({ id, parent, label: "object", existence: 0.9, first_scan: 0, world_pose_matrix: at(...place), ...more });
const placeOf = (matrix) => matrix.elements.slice(12, 15).map((value) => Math.round(1000 * value) / 1000);

test("nodes come, go, move and take along what stands on them", () => {
  const history = new History({
    scans: 10,
    nodes: [node(0, null, [0, 0, 0]), node(1, 0, [2, 0, 0]), node(2, 1, [2, 0, 1])],
    removed: [node(3, 1, [9, 9, 9])],
    events: [
      { scan: 0, event: "created", node: 1, existence: 0.9 },
      { scan: 1, event: "created", node: 2, existence: 0.9 },
      { scan: 2, event: "created", node: 3, existence: 0.8 },
      { scan: 4, event: "removed", node: 3, existence: 0.3 },
      { scan: 5, event: "reidentified", node: 1, detail: "[1 0 0 0 0 0] score 0.9" },
      { scan: 7, event: "moved", node: 2, detail: "[0 0 0.5 0 0 0]" },
    ],
    existence: [[3, 3, 0, 9, 0, 0.4], [4, 3, 0, 9, 0, 0.3], [6, 1, 5, 0, 0, 0.97]],
  });
  assert.deepEqual([1, 2, 3, 4].map((scan) => history.isThere(3, scan)), [false, true, true, false]);
  assert.equal(history.isThere(2, 0), false);
  assert.deepEqual(placeOf(history.poseAt(1, 4)), [1, 0, 0]);
  assert.deepEqual(placeOf(history.poseAt(1, 5)), [2, 0, 0]);
  assert.deepEqual(placeOf(history.poseAt(2, 4)), [1, 0, 0.5]);
  assert.deepEqual(placeOf(history.poseAt(2, 6)), [2, 0, 0.5]);
  assert.deepEqual(placeOf(history.poseAt(2, 9)), [2, 0, 1]);
  assert.equal(history.existenceAt(3, 2), 0.8);
  assert.equal(history.existenceAt(3, 3), 0.4);
  assert.deepEqual(history.curve(3), [null, null, 0.8, 0.4, 0.3, null, null, null, null, null]);
});

test("a told motion is in the node's frame", () => {
  const turned = [0, -1, 0, 5, 1, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]; // by 90 degrees about z
  const history = new History({
    scans: 3, removed: [], existence: [],
    nodes: [node(0, null, [0, 0, 0]), { ...node(1, 0, [0, 0, 0]), world_pose_matrix: turned }],
    events: [{ scan: 0, event: "created", node: 1, existence: 0.9 }, { scan: 2, event: "moved", node: 1, detail: "[1 0 0 0 0 0]" }],
  });
  assert.deepEqual(placeOf(history.poseAt(1, 1)), [5, -1, 0]);
});

test("tables with quotes", () => {
  assert.deepEqual(parseCsv('a,b\n1,"x, ""y"""\n2,\n').rows, [{ a: "1", b: 'x, "y"' }, { a: "2", b: "" }]);
});
