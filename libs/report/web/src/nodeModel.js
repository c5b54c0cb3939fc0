// SPDX-License-Identifier: BSD-3-Clause
// The voxels of one node, as meshes of chunks in several levels of detail.
import { BufferAttribute, BufferGeometry, Group, Matrix4, Mesh, Sphere, Vector3 } from "three";
import { CHUNK, decodeOctree, ORIGIN } from "./octree.js";
import { meshChunk, meshFree } from "./mesher.js";
import { voxelMaterial } from "./material.js";

const LEVELS = 6; // cells of 1, 2, ... 32 voxels

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

/** The coarsest level whose cells are at most `pixels` large on the screen. */
const levelOf = (chunk, pixels) => Math.max(0, Math.min(LEVELS - 1, Math.floor(Math.log2(pixels / chunk.voxelPixels))));

export class NodeModel {
  /** @param node as in the page's data  @param bytes its octree */
  constructor(node, bytes) {
    this.node = node;
    this.group = new Group();
    this.group.matrixAutoUpdate = false;
    this.material = voxelMaterial();
    const { chunks, free } = decodeOctree(bytes);
    this.free = free;
    this.chunks = chunks.map((chunk) => ({
      ...chunk,
      meshes: new Array(LEVELS),
      shown: null,
      centre: new Vector3(chunk.x, chunk.y, chunk.z).addScalar(CHUNK / 2 - ORIGIN).multiplyScalar(node.resolution),
    }));
  }

  setPose(matrix) {
    this.group.matrix.copy(matrix);
    this.group.matrixWorldNeedsUpdate = true;
  }

  /** Finds how large a voxel of each chunk is on the screen, in pixels, and which chunks are in the picture. */
  measure(camera, frustum, pixelsPerRadian) {
    const toNode = new Matrix4().copy(this.group.matrixWorld).invert();
    const eye = camera.position.clone().applyMatrix4(toNode);
    const sphere = new Sphere();
    const radius = (CHUNK / 2) * this.node.resolution;
    for (const chunk of this.chunks) {
      const distance = Math.max(chunk.centre.distanceTo(eye) - radius, 0.5 * this.node.resolution);
      chunk.voxelPixels = (this.node.resolution * pixelsPerRadian) / distance;
      sphere.set(chunk.centre, radius * Math.sqrt(3)).applyMatrix4(this.group.matrixWorld);
      chunk.inPicture = frustum.intersectsSphere(sphere);
    }
  }

  /** About how many triangles the picture has if cells are at most `pixels` large. */
  triangles(pixels) {
    let sum = 0;
    for (const chunk of this.chunks) {
      if (chunk.inPicture) sum += (3 * chunk.voxels.length) / 4 ** levelOf(chunk, pixels);
    }
    return sum;
  }

  /**
   * Shows every chunk as finely as there is a mesh for it, and says which meshes are wanted.
   * @param {{chunk, level, model}[]} wanted is added to
   */
  update(pixels, pixelsPerRadian, wanted) {
    this.material.uniforms.pixel.value = 1 / pixelsPerRadian;
    for (const chunk of this.chunks) {
      const level = levelOf(chunk, pixels);
      if (!chunk.meshes[level] && chunk.inPicture) wanted.push({ model: this, chunk, level });
      let best = chunk.meshes[level];
      for (let i = level + 1; !best && i < LEVELS; ++i) best = chunk.meshes[i];
      for (let i = level - 1; !best && i >= 0; --i) best = chunk.meshes[i];
      if (best === chunk.shown) continue;
      if (chunk.shown) chunk.shown.visible = false;
      if (best) best.visible = true;
      chunk.shown = best ?? null;
    }
  }

  /** Voxels of the chunks beside one, by direction (mesher.js). */
  #neighbours(chunk) {
    this.byPlace ??= new Map(this.chunks.map((each) => [`${each.x},${each.y},${each.z}`, each.voxels]));
    return [0, 1, 2, 3, 4, 5].map((direction) => {
      const place = [chunk.x, chunk.y, chunk.z];
      place[direction >> 1] += direction & 1 ? CHUNK : -CHUNK;
      return this.byPlace.get(place.join(","));
    });
  }

  build(chunk, level) {
    const cell = this.node.resolution * 2 ** level;
    const mesh = meshOf(meshChunk(chunk.voxels, level, this.#neighbours(chunk)), this.material, CHUNK >> level);
    const corner = new Vector3(chunk.x, chunk.y, chunk.z).subScalar(ORIGIN).multiplyScalar(this.node.resolution);
    mesh.matrix.makeScale(cell, cell, cell).setPosition(corner);
    mesh.visible = false;
    chunk.meshes[level] = mesh;
    this.group.add(mesh);
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
    while (extent / edge > 96) edge *= 2;
    const origin = low.map((l) => Math.floor(l / edge) * edge);
    this.freeMaterial = voxelMaterial({ transparent: true });
    this.freeMesh = meshOf(meshFree(this.free, origin, edge), this.freeMaterial, 128);
    const cell = edge * this.node.resolution;
    const corner = new Vector3(...origin).subScalar(ORIGIN).multiplyScalar(this.node.resolution);
    this.freeMesh.matrix.makeScale(cell, cell, cell).setPosition(corner);
    this.freeMesh.renderOrder = 2;
    this.group.add(this.freeMesh);
    return this.freeMesh;
  }
}
