// SPDX-License-Identifier: BSD-3-Clause
// One map in 3D: its nodes at one scan, boxes, sensor poses, changes.
import {
  Box3,
  BufferGeometry,
  Float32BufferAttribute,
  Group,
  LineBasicMaterial,
  LineSegments,
  Matrix4,
  Scene,
  Vector3,
} from "three";
import { History, matrixOf } from "./history.js";
import { labelColour, nodeColour } from "./colours.js";
import { NodeModel } from "./nodeModel.js";
import { setColour } from "./material.js";
import { readBlock } from "./data.js";

export const HELPERS = 1; // layer of what cannot be picked

const lines = (points, colour, opacity = 1) => {
  const geometry = new BufferGeometry();
  geometry.setAttribute("position", new Float32BufferAttribute(points, 3));
  const material = new LineBasicMaterial({ color: colour, transparent: opacity < 1, opacity, toneMapped: false });
  const object = new LineSegments(geometry, material);
  object.layers.set(HELPERS);
  return object;
};

const CORNERS = [0, 1, 2, 3, 4, 5, 6, 7].map((i) => [i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1]);
const EDGES = [0, 1, 2, 3, 4, 5, 6, 7].flatMap((i) => [1, 2, 4].filter((b) => !(i & b)).map((b) => [i, i | b]));

function boxCorners(node) {
  const { center, half_extents } = node.obb;
  return CORNERS.map((c) => new Vector3(...c.map((s, k) => center[k] + s * half_extents[k])));
}

function boxLines(node) {
  const corners = boxCorners(node);
  return lines(EDGES.flatMap(([a, b]) => [...corners[a].toArray(), ...corners[b].toArray()]), "#ffffff");
}

/** A sensor: x forward, y left, z up; its field of view if it has one. */
function frustumPoints(pose, fov, size) {
  const [w, h] = fov ? fov.map((angle) => size * Math.tan((angle * Math.PI) / 360)) : [0.6 * size, 0.4 * size];
  const eye = new Vector3().applyMatrix4(pose);
  const rim = [[1, 1], [-1, 1], [-1, -1], [1, -1]].map(([a, b]) => new Vector3(size, a * w, b * h).applyMatrix4(pose));
  return rim.flatMap((corner, i) => [
    ...eye.toArray(), ...corner.toArray(), ...corner.toArray(), ...rim[(i + 1) % 4].toArray(),
  ]);
}

export class MapScene {
  constructor(map) {
    this.map = map;
    this.history = new History(map);
    this.scene = new Scene();
    this.root = new Group(); // the map's world in that of the page
    this.root.matrixAutoUpdate = false;
    this.scene.add(this.root);
    this.models = new Map();
    this.boxes = new Map();
    this.sensors = new Group();
    this.root.add(this.sensors);
    this.colourOf = (node) => labelColour(node.label);
    for (const node of this.history.nodes) this.#addNode(node);
    this.#addSensors();
  }

  #addNode(node) {
    const model = new NodeModel(node);
    this.models.set(node.id, model);
    const box = boxLines(node);
    box.visible = false;
    model.group.add(box);
    this.boxes.set(node.id, box);
    this.root.add(model.group);
  }

  /** Reads the voxels, node by node. @param loaded called after each */
  async load(loaded) {
    for (const [id, model] of this.models) {
      model.load(await readBlock(this.map.prefix + id));
      loaded();
    }
  }

  #addSensors() {
    this.sensorOf = new Map();
    let last = null;
    const path = [];
    for (const row of this.map.scan_table) {
      if (!row.pose) continue;
      const pose = matrixOf(row.pose);
      const object = lines(frustumPoints(pose, row.fov, 0.2), "#7d8794");
      this.sensorOf.set(row.scan, object);
      this.sensors.add(object);
      const eye = new Vector3().setFromMatrixPosition(pose);
      if (last) path.push(...last.toArray(), ...eye.toArray());
      last = eye;
    }
    this.sensors.add(lines(path, "#7d8794", 0.6));
  }

  /** Mean of the sensor's places in the world; null if they are not known. */
  meanSensor() {
    const places = this.map.scan_table.filter((row) => row.pose).map((row) => new Vector3().setFromMatrixPosition(matrixOf(row.pose)));
    if (places.length === 0) return null;
    return places.reduce((sum, p) => sum.add(p), new Vector3()).divideScalar(places.length).applyMatrix4(this.root.matrix);
  }

  /** Box in the page's world of some nodes. */
  bounds(ids) {
    const box = new Box3();
    for (const id of ids) {
      const node = this.history.byId.get(id);
      if (node.occupied_voxels === 0) continue;
      const pose = this.models.get(id).group.matrix;
      const world = new Matrix4().multiplyMatrices(this.root.matrix, pose);
      for (const corner of boxCorners(node)) box.expandByPoint(corner.applyMatrix4(world));
    }
    return box;
  }

  isShown(id, state) {
    if (!this.history.isThere(id, state.scan)) return false;
    if (state.isolated) return state.isolated.has(id);
    return !state.hidden.has(id);
  }

  /** Makes the scene show `state` (state.js). */
  show(state, dark) {
    const MODES = { probability: 1, height: 2 };
    const heights = this.bounds(this.history.nodes.map((node) => node.id));
    for (const [id, model] of this.models) {
      const { node, group, material } = model;
      group.visible = this.isShown(id, state);
      if (!group.visible) continue;
      model.setPose(this.history.poseAt(id, state.scan));
      const selected = state.selected === id;
      const colour = state.colour === "node" ? nodeColour(node) : this.colourOf(node);
      setColour(material, colour);
      material.uniforms.mode.value = MODES[state.colour] ?? 0;
      material.uniforms.heights.value.set(heights.min.z, heights.max.z);
      material.uniforms.glow.value = selected ? 1 : 0;
      const box = this.boxes.get(id);
      box.visible = selected || (state.showBoxes && id !== 0);
      box.material.color.set(selected ? (dark ? "#ffffff" : "#101418") : colour);
      const wantsFree = state.showFree && (state.selected === null ? id !== 0 : selected);
      if (wantsFree || model.freeMesh) {
        const mesh = model.freeSpace();
        if (mesh) {
          mesh.visible = wantsFree;
          setColour(model.freeMaterial, dark ? "#8fb7ff" : "#2563c9");
        }
      }
    }
    this.sensors.visible = state.showSensors;
    for (const [scan, object] of this.sensorOf) {
      const now = scan === state.scan;
      object.visible = scan <= state.scan;
      object.material.color.set(now ? "#e8622c" : "#7d8794");
    }
  }
}
