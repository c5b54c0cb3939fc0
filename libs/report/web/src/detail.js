// SPDX-License-Identifier: BSD-3-Clause
// Which tiles of which level make up a picture.
import { Frustum, Matrix4, Vector3 } from "three";

/** The largest first. */
class Heap {
  #entries = [];

  get empty() {
    return this.#entries.length === 0;
  }

  push(entry) {
    const heap = this.#entries;
    let i = heap.push(entry) - 1;
    for (let up; i > 0 && heap[(up = (i - 1) >> 1)].pixels < entry.pixels; i = up) heap[i] = heap[up];
    heap[i] = entry;
  }

  pop() {
    const heap = this.#entries;
    const first = heap[0];
    const last = heap.pop();
    if (heap.length === 0) return first;
    let i = 0;
    for (;;) {
      let down = 2 * i + 1;
      if (down + 1 < heap.length && heap[down + 1].pixels > heap[down].pixels) ++down;
      if (down >= heap.length || heap[down].pixels <= last.pixels) break;
      heap[i] = heap[down];
      i = down;
    }
    heap[i] = last;
    return first;
  }
}

/**
 * Shows the coarsest tiles and then, always where cells are largest on the screen, finer ones in their place: until cells
 * are small enough, or the picture has as many rectangles as it may. A tile gives way only to meshes that are there.
 * @param models NodeModels that are in the picture
 * @param pixelsPerRadian of the screen
 * @param {{finest: number, most: number}} limits size of cells (pixels), rectangles
 * @returns {{wanted: {model, tile, pixels}[], rectangles: number}} tiles whose meshes are wanted next; how many rectangles are in sight
 */
export function showTiles(models, camera, pixelsPerRadian, { finest, most }) {
  const heap = new Heap();
  const wanted = [];
  const shown = [];
  let rectangles = 0;
  const toScreen = new Matrix4().multiplyMatrices(camera.projectionMatrix, camera.matrixWorldInverse);

  /** @returns null if it is not in the picture */
  const look = (view, tile) => {
    if (!view.frustum.intersectsBox(tile.box)) return null;
    const distance = Math.max(tile.box.distanceToPoint(view.eye), camera.near);
    return { view, tile, pixels: (tile.edge * pixelsPerRadian) / distance, range: tile.mesh && view.model.inSight(tile, view.eye) };
  };
  const count = ({ range }) => range.end - range.begin;

  for (const model of models) {
    const matrix = model.group.matrixWorld;
    const view = {
      model,
      eye: new Vector3().copy(camera.position).applyMatrix4(new Matrix4().copy(matrix).invert()),
      frustum: new Frustum().setFromProjectionMatrix(new Matrix4().multiplyMatrices(toScreen, matrix)),
      entries: [],
    };
    shown.push(view);
    const root = model.root && look(view, model.root);
    if (!root) continue;
    rectangles += count(root);
    heap.push(root);
  }
  while (!heap.empty) {
    const entry = heap.pop();
    const { view, tile, pixels } = entry;
    const finer = pixels > finest && rectangles < most ? tile.children.map((child) => look(view, child)).filter(Boolean) : [];
    const missing = finer.filter((child) => !child.range);
    for (const child of missing) wanted.push({ model: view.model, tile: child.tile, pixels });
    const enough = finer.length > 0 && missing.length === 0;
    const more = enough ? finer.reduce((sum, child) => sum + count(child), -count(entry)) : 0;
    if (enough && rectangles + more <= most) {
      rectangles += more;
      for (const child of finer) heap.push(child);
    } else {
      view.entries.push(entry);
    }
  }
  for (const { model, entries } of shown) model.show(entries);
  return { wanted: wanted.sort((a, b) => b.pixels - a.pixels), rectangles };
}
