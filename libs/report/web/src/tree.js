// SPDX-License-Identifier: BSD-3-Clause
// The tree of nodes as text: select, hide, isolate. Keys as in any tree: arrows, Home, End, Enter; H, I.
import { h, metres, sizeText } from "./dom.js";
import { nodeColour } from "./colours.js";

const EYE = "M1 8s2.6-5 7-5 7 5 7 5-2.6 5-7 5-7-5-7-5z M8 10.2a2.2 2.2 0 1 0 0-4.4 2.2 2.2 0 0 0 0 4.4z";

function eyeIcon() {
  const svg = document.createElementNS("http://www.w3.org/2000/svg", "svg");
  svg.setAttribute("viewBox", "0 0 16 16");
  const path = document.createElementNS("http://www.w3.org/2000/svg", "path");
  path.setAttribute("d", EYE);
  svg.append(path);
  return svg;
}

export class NodeTree {
  constructor(mapScene, state) {
    this.mapScene = mapScene;
    this.history = mapScene.history;
    this.state = state;
    this.rows = new Map();
    this.element = h("div.tree", { role: "tree", "aria-label": "Nodes of the map" });
    this.element.addEventListener("keydown", (event) => this.#key(event));
    const removed = this.mapScene.map.removed;
    this.#addBelow(null, 1);
    if (removed.length > 0) {
      this.element.append(h("div.treehead", { role: "none" }, "Removed or merged in the course of the scans"));
      for (const node of removed) this.#addRow(node, 1);
    }
    state.listen(() => this.show());
  }

  #addBelow(parent, level) {
    for (const node of this.mapScene.map.nodes.filter((n) => n.parent === parent)) {
      this.#addRow(node, level);
      this.#addBelow(node.id, level + 1);
    }
  }

  #addRow(node, level) {
    const eye = h("button.eye", {
      title: `Hide or show ${node.label} ${node.id} (H)`,
      "aria-label": `Hide or show ${node.label} ${node.id}`,
      tabindex: -1,
      onclick: (event) => {
        event.stopPropagation();
        this.state.toggleHidden([node.id]);
      },
    }, eyeIcon());
    const swatch = h("span.swatch");
    const bar = h("span.bar", {}, h("i"));
    const value = h("span.value");
    const row = h("div.row", {
      role: "treeitem",
      "aria-level": level,
      tabindex: -1,
      style: `--level:${level - 1}`,
      "data-node": node.id,
      onclick: () => this.select(node.id),
    },
      swatch,
      h("span.name", {}, `${node.label} `, h("b", {}, String(node.id))),
      h("span.size", {}, sizeText(node)),
      h("span.resolution", {}, metres(node.resolution)),
      h("span.existence", { title: "probability of existence" }, bar, value),
      eye,
    );
    this.rows.set(node.id, { row, swatch, bar: bar.firstChild, value, eye, node });
    this.element.append(row);
  }

  select(id) {
    this.state.set({ selected: this.state.selected === id ? null : id });
  }

  show() {
    const { state } = this;
    for (const [id, { row, swatch, bar, value, eye, node }] of this.rows) {
      const there = this.history.isThere(id, state.scan);
      const existence = there ? this.history.existenceAt(id, state.scan) : 0;
      row.classList.toggle("absent", !there);
      row.classList.toggle("hidden", !this.mapScene.isShown(id, state) && there);
      row.setAttribute("aria-selected", String(state.selected === id));
      row.tabIndex = id === (state.selected ?? 0) ? 0 : -1;
      eye.setAttribute("aria-pressed", String(!this.mapScene.isShown(id, state)));
      swatch.style.background = state.colour === "node" ? nodeColour(node) : this.mapScene.colourOf(node);
      bar.style.width = `${100 * existence}%`;
      value.textContent = there ? existence.toFixed(2) : "–";
    }
    const selected = this.rows.get(state.selected)?.row;
    if (selected && this.scrolledTo !== state.selected) selected.scrollIntoView({ block: "nearest" });
    this.scrolledTo = state.selected;
  }

  #key(event) {
    const ids = [...this.rows.keys()];
    const at = ids.indexOf(Number(document.activeElement?.dataset?.node));
    if (at < 0) return;
    const go = { ArrowDown: at + 1, ArrowUp: at - 1, Home: 0, End: ids.length - 1 }[event.key];
    if (go !== undefined) {
      event.preventDefault();
      const row = this.rows.get(ids[Math.max(0, Math.min(ids.length - 1, go))]).row;
      for (const other of this.rows.values()) other.row.tabIndex = -1;
      row.tabIndex = 0;
      row.focus();
    } else if (event.key === "Enter" || event.key === " ") {
      event.preventDefault();
      this.select(ids[at]);
    } else if (event.key.toLowerCase() === "h") {
      this.state.toggleHidden([ids[at]]);
    }
  }
}
