// SPDX-License-Identifier: BSD-3-Clause
// Draws one map, or two side by side from the same eye; draws only when something has changed.
import { Vector3, WebGLRenderer, WebGLRenderTarget } from "three";
import { Eye } from "./camera.js";
import { showTiles } from "./detail.js";
import { HELPERS } from "./mapScene.js";

const BUILD_MS = [8, 250]; // of meshing between two pictures: while it moves, and at most at rest
// Size of cells on the screen (pixels) and rectangles of a picture at rest and, at most, while it moves.
const DETAIL = {
  card: { rest: { finest: 1.1, most: 3e6 }, moving: { finest: 1.5, most: 1.5e6 } },
  software: { rest: { finest: 1.6, most: 1e6 }, moving: { finest: 2, most: 5e4 } },
};
const LEAST_MOVING = 1.2e4; // rectangles, however slow it is
const SMOOTH_MS = [24, 40]; // between pictures while it moves: more detail below, less above

/** Whether the browser draws without a graphics card. */
function drawsInSoftware() {
  const gl = document.createElement("canvas").getContext("webgl2");
  const info = gl?.getExtension("WEBGL_debug_renderer_info");
  const name = info ? gl.getParameter(info.UNMASKED_RENDERER_WEBGL) : "";
  gl?.getExtension("WEBGL_lose_context")?.loseContext();
  return /swiftshader|llvmpipe|software/i.test(name);
}

export class Viewer {
  constructor(canvas, mapScenes) {
    this.canvas = canvas;
    this.mapScenes = mapScenes;
    this.software = drawsInSoftware();
    this.detail = DETAIL[this.software ? "software" : "card"];
    this.mostMoving = this.detail.moving.most;
    this.renderer = new WebGLRenderer({ canvas, antialias: !this.software, powerPreference: "high-performance" });
    this.renderer.autoClear = false;
    this.#setSharpness(false);
    this.eye = new Eye(canvas, () => this.moved());
    this.eye.camera.layers.enable(HELPERS);
    this.pickTarget = new WebGLRenderTarget(1, 1);
    this.background = "#ffffff";
    this.lastMove = -Infinity;
    this.loading = true;
    this.lastDraw = 0;
    this.afterDraw = () => {};
    this.onSettled = () => {};
    this.onPick = () => {};
    new ResizeObserver(() => this.resize()).observe(canvas.parentElement);
    this.#listenForClicks();
    this.resize();
  }

  moved() {
    this.lastMove = performance.now();
    this.invalidate();
  }

  /** Something else is to be seen: coarsely at first, if a whole picture takes its time. */
  changed() {
    if (this.isHeavy) this.moved();
    else this.invalidate();
  }

  invalidate() {
    this.stale = true;
    this.refine();
  }

  /** There may be more detail to show. */
  refine() {
    this.onSettled(false);
    if (this.pending) return;
    this.pending = requestAnimationFrame(() => {
      this.pending = 0;
      this.draw();
    });
  }

  resize() {
    const { clientWidth: width, clientHeight: height } = this.canvas.parentElement;
    if (width === 0 || height === 0) return;
    this.renderer.setSize(width, height, false);
    this.views = this.#layout(width, height);
    this.eye.resize(this.views[0].width / this.views[0].height);
    this.invalidate();
  }

  /** The part of the canvas of each map, in CSS pixels from the top left. */
  #layout(width, height) {
    const n = this.mapScenes.length;
    const beside = width >= height;
    return this.mapScenes.map((mapScene, i) => ({
      mapScene,
      x: beside ? (i * width) / n : 0,
      y: beside ? 0 : (i * height) / n,
      width: beside ? width / n : width,
      height: beside ? height : height / n,
    }));
  }

  draw() {
    const start = performance.now();
    const { renderer, eye: { camera } } = this;
    const moving = this.loading || start - this.lastMove < this.#patience();
    if (moving && this.moving) this.#adapt(start - this.lastDraw);
    this.#setSharpness(moving);
    const perRadian = (this.views[0].height * renderer.getPixelRatio()) / (2 * Math.tan((camera.fov * Math.PI) / 360));
    camera.updateMatrixWorld();
    for (const { mapScene } of this.views) mapScene.scene.updateMatrixWorld();
    const models = this.views.flatMap((view) => this.#shownModels(view));
    const { wanted, rectangles } = showTiles(models, camera, perRadian, moving ? { ...this.detail.moving, most: this.mostMoving } : this.detail.rest);
    // What only becomes finer is drawn when it is twice as fine, and in the end.
    if (this.stale || wanted.length === 0 || rectangles > 2 * this.drawn) {
      this.#render(models, perRadian);
      this.stale = false;
      this.drawn = rectangles;
    }
    const built = this.#build(wanted, moving ? BUILD_MS[0] : Math.max(BUILD_MS[0], Math.min(BUILD_MS[1], start - this.lastDraw)));
    this.lastDraw = start;
    this.moving = moving;
    if (!moving) this.isHeavy = rectangles > this.detail.moving.most;
    this.afterDraw();
    if (wanted.length === 0 && !moving) this.onSettled(true);
    clearTimeout(this.rest);
    if (built) this.refine();
    else if (moving) this.rest = setTimeout(() => this.invalidate(), this.#patience() + 10);
  }

  #render(models, perRadian) {
    const { renderer } = this;
    renderer.setScissorTest(false);
    renderer.setClearColor(this.background);
    renderer.clear();
    const height = this.canvas.clientHeight;
    for (const model of models) model.material.uniforms.pixel.value = 1 / perRadian;
    for (const view of this.views) {
      const rectangle = [view.x, height - view.y - view.height, view.width, view.height];
      renderer.setViewport(...rectangle);
      renderer.setScissor(...rectangle);
      renderer.setScissorTest(true);
      renderer.render(view.mapScene.scene, this.eye.camera);
    }
  }

  /** How long after a motion (ms) it counts as going on: longer with the mouse held, and where pictures take long. */
  #patience() {
    return (this.eye.held ? 800 : 250) + 2 * (this.interval ?? 0);
  }

  /** Fewer rectangles where pictures are slow in coming, more where they are not. */
  #adapt(milliseconds) {
    const { most } = this.detail.moving;
    this.interval = Math.min(milliseconds, 1000);
    if (milliseconds > SMOOTH_MS[1]) this.mostMoving = Math.max(LEAST_MOVING, 0.85 * this.mostMoving);
    if (milliseconds < SMOOTH_MS[0]) this.mostMoving = Math.min(most, 1.1 * this.mostMoving);
  }

  /** Without a graphics card every pixel costs: fewer while the picture moves. */
  #setSharpness(moving) {
    const ratio = this.software ? (moving ? 0.6 : 1) : Math.min(2, window.devicePixelRatio);
    if (ratio === this.renderer.getPixelRatio()) return;
    this.renderer.setPixelRatio(ratio);
    this.stale = true; // another size is an empty picture
  }

  #shownModels(view) {
    return [...view.mapScene.models.values()].filter((model) => model.group.visible);
  }

  /** Makes meshes for some milliseconds. */
  #build(wanted, milliseconds) {
    const end = performance.now() + milliseconds;
    for (const { model, tile } of wanted) {
      model.build(tile);
      if (performance.now() > end) break;
    }
    return wanted.length > 0;
  }

  /** The view under a place of the canvas (CSS pixels). */
  viewAt(x, y) {
    return this.views.find((v) => x >= v.x && x < v.x + v.width && y >= v.y && y < v.y + v.height) ?? this.views[0];
  }

  /** Id of the node seen at a place of the canvas; null if there is none. */
  pick(x, y) {
    const view = this.viewAt(x, y);
    const { camera } = this.eye;
    const saved = [];
    for (const [id, { material, group, freeMesh }] of view.mapScene.models) {
      const { colour, mode } = material.uniforms;
      saved.push({ colour, mode, old: colour.value.clone(), oldMode: mode.value, freeMesh, free: freeMesh?.visible });
      if (freeMesh) freeMesh.visible = false;
      if (!group.visible) continue;
      mode.value = 3;
      colour.value.set(((id + 1) & 255) / 255, (((id + 1) >> 8) & 255) / 255, (((id + 1) >> 16) & 255) / 255);
    }
    camera.setViewOffset(view.width, view.height, x - view.x, y - view.y, 1, 1);
    camera.layers.disable(HELPERS);
    this.renderer.setRenderTarget(this.pickTarget);
    this.renderer.setScissorTest(false);
    this.renderer.setClearColor(0x000000);
    this.renderer.clear();
    this.renderer.render(view.mapScene.scene, camera);
    const pixel = new Uint8Array(4);
    this.renderer.readRenderTargetPixels(this.pickTarget, 0, 0, 1, 1, pixel);
    this.renderer.setRenderTarget(null);
    camera.layers.enable(HELPERS);
    camera.clearViewOffset();
    for (const { colour, mode, old, oldMode, freeMesh, free } of saved) {
      colour.value.copy(old);
      mode.value = oldMode;
      if (freeMesh) freeMesh.visible = free;
    }
    const id = pixel[0] + 256 * pixel[1] + 65536 * pixel[2] - 1;
    return { id: id >= 0 ? id : null, mapScene: view.mapScene };
  }

  /** Where a point of the world is on the canvas (CSS pixels), as seen in a view; null behind the eye. */
  place(point, view) {
    const p = new Vector3().copy(point).project(this.eye.camera);
    if (p.z > 1) return null;
    return { x: view.x + (0.5 + 0.5 * p.x) * view.width, y: view.y + (0.5 - 0.5 * p.y) * view.height };
  }

  #listenForClicks() {
    let down = null;
    this.canvas.addEventListener("pointerdown", (event) => (down = event));
    this.canvas.addEventListener("pointerup", (event) => {
      if (!down || Math.hypot(event.clientX - down.clientX, event.clientY - down.clientY) > 4) return;
      const box = this.canvas.getBoundingClientRect();
      this.onPick(this.pick(event.clientX - box.left, event.clientY - box.top));
      this.invalidate();
    });
  }
}
