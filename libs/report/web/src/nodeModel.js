// SPDX-License-Identifier: BSD-3-Clause
// The voxels of one node, as meshes of tiles in several levels of detail.
import { Box3, BufferAttribute, BufferGeometry, Group, Mesh, Sphere, Vector3 } from "three";
import { decodeOctree, ORIGIN, TILE } from "./octree.js";
import { meshFree, meshTile } from "./mesher.js";
import { EDGES_FROM, voxelMaterial } from "./material.js";

const indices = new Map();
/** Two triangles a rectangle, shared by all meshes of like size. */
function sharedIndex(rectangles) {
  let size = 1024;
  while (size < rectangles) size *= 2;
  if (!indices.has(size)) {
    const index = new Uint32Array(6 * size);
    for (let i = 0; i < size; ++i) index.set([0, 1, 2, 0, 2, 3].map((k) => 4 * i + k), 6 * i);
    indices.set(size, new BufferAttribute(index, 1));
  }
  return indices.get(size);
}

function meshOf(vertices, material, cells) {
  const geometry = new BufferGeometry();
  geometry.setAttribute("cell", new BufferAttribute(vertices, 4));
  geometry.setIndex(sharedIndex(vertices.length / 16));
  geometry.setDrawRange(0, (vertices.length / 16) * 6);
  geometry.boundingSphere = new Sphere(new Vector3().setScalar(cells / 2), (cells / 2) * Math.sqrt(3));
  const mesh = new Mesh(geometry, material);
  mesh.matrixAutoUpdate = false;
  return mesh;
}

export class NodeModel {
  /** @param node as in the page's data */
  constructor(node) {
    this.node = node;
    this.group = new Group();
    this.group.matrixAutoUpdate = false;
    this.material = voxelMaterial();
    this.coarseMaterial = this.material.clone(); // the same, but cells of several voxels have no edges
    this.coarseMaterial.uniforms = { ...this.material.uniforms, edges: { value: false } };
    this.root = null;
    this.free = [];
    this.shown = [];
  }

  /** @param bytes the node's octree */
  load(bytes) {
    const { root, free } = decodeOctree(bytes);
    this.free = free;
    this.places = new Map();
    if (root) {
      this.#prepare(root);
      this.build(root);
    }
    this.root = root;
  }

  #place = (level, x, y, z) => `${level} ${x} ${y} ${z}`;

  #prepare(tile) {
    tile.edge = this.node.resolution * 2 ** tile.level;
    tile.corner = new Vector3(tile.x, tile.y, tile.z).subScalar(ORIGIN).multiplyScalar(this.node.resolution);
    tile.box = new Box3(tile.corner, tile.corner.clone().addScalar(TILE * tile.edge));
    this.places.set(this.#place(tile.level, tile.x, tile.y, tile.z), tile);
    for (const child of tile.children) this.#prepare(child);
  }

  /** Tiles of the same level beside one, by direction (mesher.js). */
  #neighbours(tile) {
    tile.neighbours ??= [0, 1, 2, 3, 4, 5].map((direction) => {
      const place = [tile.x, tile.y, tile.z];
      place[direction >> 1] += (direction & 1 ? TILE : -TILE) << tile.level;
      return this.places.get(this.#place(tile.level, ...place));
    });
    return tile.neighbours;
  }

  setPose(matrix) {
    this.group.matrix.copy(matrix);
    this.group.matrixWorldNeedsUpdate = true;
  }

  /** Makes the mesh of a tile. */
  build(tile) {
    const { vertices, runs } = meshTile(tile, this.#neighbours(tile));
    tile.runs = runs;
    tile.all = vertices.length / 16;
    tile.mesh = meshOf(vertices, tile.level === 0 ? this.material : this.coarseMaterial, TILE);
    tile.mesh.matrix.makeScale(tile.edge, tile.edge, tile.edge).setPosition(tile.corner);
    tile.mesh.visible = false;
    this.group.add(tile.mesh);
  }

  /** Range of the rectangles of a tile that may be seen from a place (both in the node's frame). */
  inSight(tile, eye) {
    const range = { begin: 0, end: 0 };
    for (const { direction, begin, end } of tile.runs) {
      const axis = "xyz"[direction >> 1];
      const faces = direction & 1 ? eye[axis] > tile.box.min[axis] : eye[axis] < tile.box.max[axis];
      if (!faces || begin === end) continue;
      if (range.end === 0) range.begin = begin;
      range.end = end;
    }
    return range;
  }

  /** Shows these tiles and no others. @param entries {tile, range, pixels}[]: what is in sight, and the size of a cell on the screen */
  show(entries) {
    this.material.uniforms.edges.value = entries.some(({ pixels }) => pixels > EDGES_FROM);
    for (const tile of this.shown) tile.mesh.visible = false;
    this.shown = entries.map(({ tile }) => tile);
    for (const tile of this.shown) tile.mesh.visible = true;
    for (const { tile, range } of entries) {
      const hasWalls = tile.all > tile.runs.at(-1).end;
      const alone = hasWalls && tile.neighbours.some((other) => other && !other.mesh?.visible);
      tile.mesh.geometry.setDrawRange(6 * range.begin, 6 * ((alone ? tile.all : range.end) - range.begin));
    }
  }

  /** The free space as a translucent shape, made when it is first wanted; null if there is none. */
  freeSpace() {
    if (this.freeMesh !== undefined || this.free.length === 0) return this.freeMesh ?? null;
    const low = [Infinity, Infinity, Infinity];
    const high = [-Infinity, -Infinity, -Infinity];
    for (let i = 0; i < this.free.length; i += 4) {
      for (let k = 0; k < 3; ++k) {
        low[k] = Math.min(low[k], this.free[i + k]);
        high[k] = Math.max(high[k], this.free[i + k] + this.free[i + 3]);
      }
    }
    const extent = Math.max(...high.map((h, k) => h - low[k]));
    let edge = 1;
    while (extent / edge > 98) edge *= 2; // as fine as it is kept (VoxelBytes.h)
    const origin = low.map((l) => Math.floor(l / edge) * edge);
    this.freeMaterial = voxelMaterial({ transparent: true });
    this.freeMaterial.uniforms.edges.value = true;
    this.freeMesh = meshOf(meshFree(this.free, origin, edge), this.freeMaterial, 128);
    const cell = edge * this.node.resolution;
    const corner = new Vector3(...origin).subScalar(ORIGIN).multiplyScalar(this.node.resolution);
    this.freeMesh.matrix.makeScale(cell, cell, cell).setPosition(corner);
    this.freeMesh.renderOrder = 2;
    this.group.add(this.freeMesh);
    return this.freeMesh;
  }
}
