// SPDX-License-Identifier: BSD-3-Clause
// Parts of the report's page against brute force, without a browser. Usage: node --test units.mjs
import assert from "node:assert/strict";
import test from "node:test";
import { History } from "../../libs/report/web/src/history.js";
import { meshChunk, probabilityClass } from "../../libs/report/web/src/mesher.js";
import { decodeOctree, ORIGIN } from "../../libs/report/web/src/octree.js";
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

test("an octree gives back its voxels", () => {
  const next = random(1);
  const key = () => [0, 1, 2].map(() => ORIGIN + Math.floor(160 * next() - 80)).join(",");
  const occupied = new Map(Array.from({ length: 60 }, () => [key(), 128 + Math.floor(127 * next())]));
  const free = new Set(Array.from({ length: 40 }, key).filter((k) => !occupied.has(k)));
  const decoded = decodeOctree(encode(occupied, free));
  const found = new Map();
  for (const { x, y, z, voxels } of decoded.chunks) {
    for (const v of voxels) found.set(`${x + (v & 63)},${y + ((v >> 6) & 63)},${z + ((v >> 12) & 63)}`, v >>> 18);
  }
  assert.deepEqual(new Map([...found].sort()), new Map([...occupied].sort()));
  const freeFound = [];
  for (let i = 0; i < decoded.free.length; i += 4) freeFound.push(decoded.free.slice(i, i + 3).join(","));
  assert.deepEqual(freeFound.sort(), [...free].sort());
});

test("an empty octree has nothing", () => {
  const { chunks, free } = decodeOctree(new Uint8Array(4));
  assert.equal(chunks.length + free.length, 0);
});

test("the faces of a mesh cover what is exposed once, by direction and class", () => {
  for (const [seed, level, fill] of [[2, 0, 3000], [3, 1, 3000], [4, 3, 500], [5, 5, 20]]) {
    const next = random(seed);
    const n = 64 >> level;
    const cells = new Map();
    const voxels = Uint32Array.from({ length: fill }, () => {
      const p = [0, 1, 2].map(() => Math.floor(64 * next() ** 2));
      const probability = 128 + Math.floor(128 * next());
      const cell = p.map((k) => k >> level).join(",");
      cells.set(cell, Math.max(cells.get(cell) ?? 0, probabilityClass(probability)));
      return p[0] | (p[1] << 6) | (p[2] << 12) | (probability << 18);
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
    const mesh = meshChunk(voxels, level);
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

test("there is no wall between chunks", () => {
  const plane = (x) => Uint32Array.from({ length: 64 * 64 }, (_, i) => x | ((i & 63) << 6) | ((i >> 6) << 12) | (255 << 18));
  const directions = (mesh) => [...new Set([...mesh].filter((_, k) => k % 16 === 3).map((code) => code & 7))].sort();
  assert.deepEqual(directions(meshChunk(plane(63), 0)), [0, 1, 2, 3, 4, 5]);
  assert.deepEqual(directions(meshChunk(plane(63), 0, [undefined, plane(0)])), [0, 2, 3, 4, 5]);
  assert.deepEqual(directions(meshChunk(plane(0), 2, [plane(63)])), [1, 2, 3, 4, 5]);
  assert.deepEqual(directions(meshChunk(plane(63), 0, [undefined, plane(1)])), [0, 1, 2, 3, 4, 5], "a gap is a gap");
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
