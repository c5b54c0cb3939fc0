// SPDX-License-Identifier: BSD-3-Clause
// What the page shows at the moment; everything on it listens to this.

export class State {
  constructor(lastScan) {
    this.scan = lastScan;
    this.selected = null; // id of a node (in a comparison: of a change)
    this.hidden = new Set();
    this.isolated = null; // set of ids, or null
    this.colour = "label"; // label, node, probability, height
    this.showFree = false;
    this.showBoxes = false;
    this.showSensors = false;
    this.showLabels = false;
    this.listeners = [];
  }

  listen(listener) {
    this.listeners.push(listener);
  }

  set(change) {
    Object.assign(this, change);
    for (const listener of this.listeners) listener(this, change);
  }

  toggleHidden(ids) {
    const hidden = new Set(this.hidden);
    const hide = ids.some((id) => !hidden.has(id));
    for (const id of ids) hide ? hidden.add(id) : hidden.delete(id);
    this.set({ hidden, isolated: null });
  }
}
