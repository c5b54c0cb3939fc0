// SPDX-License-Identifier: BSD-3-Clause
// Where one looks from: mouse and fingers by OrbitControls, keys, and views that frame a box.
import { PerspectiveCamera, Vector3 } from "three";
import { OrbitControls } from "three/addons/controls/OrbitControls.js";

const DIRECTIONS = { top: [-90, 89.9], front: [-90, 10], back: [90, 10], left: [180, 10], right: [0, 10] };

function direction(azimuth, elevation) {
  const [a, e] = [azimuth, elevation].map((angle) => (angle * Math.PI) / 180);
  return new Vector3(Math.cos(e) * Math.cos(a), Math.cos(e) * Math.sin(a), Math.sin(e));
}

export class Eye {
  constructor(element, changed) {
    this.camera = new PerspectiveCamera(36, 1, 0.01, 1000);
    this.camera.up.set(0, 0, 1);
    this.controls = new OrbitControls(this.camera, element);
    this.controls.zoomToCursor = true;
    this.controls.maxPolarAngle = Math.PI - 0.05;
    this.controls.addEventListener("change", changed);
    this.held = false; // by mouse or finger
    this.controls.addEventListener("start", () => (this.held = true));
    this.controls.addEventListener("end", () => (this.held = false));
    this.changed = changed;
    element.addEventListener("keydown", (event) => this.#key(event));
  }

  resize(aspect) {
    this.camera.aspect = aspect;
    this.camera.updateProjectionMatrix();
  }

  /** Looks at a box from a direction (a name, or a vector from the box), all of it in the picture. */
  frame(box, from) {
    if (box.isEmpty()) return;
    const back = typeof from === "string" ? direction(...DIRECTIONS[from]) : from.clone().normalize();
    const target = box.getCenter(new Vector3());
    const right = new Vector3(0, 0, 1).cross(back).normalize();
    const up = back.clone().cross(right);
    const slope = Math.tan((this.camera.fov * Math.PI) / 360);
    let distance = 0.1;
    for (let i = 0; i < 8; ++i) {
      const p = new Vector3(i & 1 ? box.max.x : box.min.x, i & 2 ? box.max.y : box.min.y, i & 4 ? box.max.z : box.min.z).sub(target);
      const needed = Math.max(Math.abs(p.dot(right)) / (slope * this.camera.aspect), Math.abs(p.dot(up)) / slope);
      distance = Math.max(distance, needed + p.dot(back));
    }
    this.camera.position.copy(target).addScaledVector(back, 1.04 * distance);
    this.camera.near = 0.01 * distance;
    this.camera.far = 60 * distance;
    this.camera.updateProjectionMatrix();
    this.controls.target.copy(target);
    this.controls.update();
    this.changed();
  }

  /** Direction from what is looked at to the eye. */
  back() {
    return this.camera.position.clone().sub(this.controls.target).normalize();
  }

  #turn(azimuth, elevation, zoom) {
    const offset = this.camera.position.clone().sub(this.controls.target);
    const radius = offset.length() * zoom;
    const a = Math.atan2(offset.y, offset.x) + azimuth;
    const e = Math.max(-1.5, Math.min(1.5, Math.asin(offset.z / offset.length()) + elevation));
    offset.set(Math.cos(e) * Math.cos(a), Math.cos(e) * Math.sin(a), Math.sin(e)).multiplyScalar(radius);
    this.camera.position.copy(this.controls.target).add(offset);
    this.controls.update();
    this.changed();
  }

  #key(event) {
    const moves = {
      ArrowLeft: [-0.12, 0, 1], ArrowRight: [0.12, 0, 1], ArrowUp: [0, 0.1, 1], ArrowDown: [0, -0.1, 1],
      "+": [0, 0, 0.85], "=": [0, 0, 0.85], "-": [0, 0, 1 / 0.85],
    };
    const move = moves[event.key];
    if (!move || event.ctrlKey || event.metaKey || event.altKey) return;
    event.preventDefault();
    event.stopPropagation();
    this.#turn(...move);
  }
}
