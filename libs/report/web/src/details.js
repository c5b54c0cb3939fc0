// SPDX-License-Identifier: BSD-3-Clause
// What is known of the selected node.
import { bytes, h, metres, number, sizeText } from "./dom.js";
import { ExistenceChart } from "./charts.js";

const EVENT_WORDS = {
  created: "entered the map", removed: "was removed", merged: "was merged", moved: "was moved",
  reidentified: "was found elsewhere", split: "was split off", updated: "was changed by hand",
};
export const eventText = (event) => EVENT_WORDS[event.event] ?? event.event;

export class Details {
  constructor(mapScene, state, fit) {
    this.mapScene = mapScene;
    this.state = state;
    this.fit = fit;
    this.element = h("section.details", { "aria-live": "polite", "aria-label": "Selected node" });
    state.listen((_, change) => {
      if ("selected" in change || "theme" in change || "first" in change) this.#fill();
      this.chart?.setScan(state.scan);
    });
  }

  #fill() {
    const { state, mapScene } = this;
    this.chart?.destroy();
    this.chart = null;
    const node = mapScene.history.byId.get(state.selected);
    if (!node) {
      this.element.replaceChildren(h("p.hint", {}, "Select a node in the list or click it in the picture."));
      return;
    }
    const life = mapScene.history.lives.get(node.id);
    const parent = node.parent === null ? "none: the root" : `${mapScene.history.byId.get(node.parent)?.label ?? "node"} ${node.parent}`;
    const facts = [
      ["resolution", metres(node.resolution)],
      ["box", sizeText(node)],
      ["voxels", `${number(node.occupied_voxels)} occupied, ${number(node.free_voxels)} free`],
      ["memory", bytes(node.memory_bytes)],
      ["parent", parent],
      ["seen in", `scans ${node.first_scan} to ${node.last_scan}`],
    ];
    const events = mapScene.map.events.filter((event) => event.node === node.id);
    const only = () => state.set({ isolated: state.isolated ? null : new Set([node.id]) });
    this.element.replaceChildren(
      h("header", {},
        h("h2", {}, `${node.label} ${node.id}`),
        h("span.spacer"),
        h("button", { onclick: () => this.fit([node.id]), title: "Look at it (F)" }, "Look at"),
        h("button", { onclick: only, title: "Show only this node, or all again (I)", id: "isolate" }, state.isolated ? "Show all" : "Isolate"),
        h("button", { onclick: () => state.set({ selected: null, isolated: null }), title: "Select nothing (Esc)", "aria-label": "Select nothing" }, "×"),
      ),
      h("dl", {}, ...facts.flatMap(([key, value]) => [h("dt", {}, key), h("dd", {}, value)])),
      ...(events.length === 0 ? [] : [h("ul.events", {}, ...events.map((event) => h("li", {},
        h("button.link", { onclick: () => state.set({ scan: event.scan }) }, `scan ${event.scan}`),
        ` ${eventText(event)}`, h("small", {}, event.detail ? `: ${event.detail}` : ""))))]),
    );
    if (mapScene.map.scans > 1 && life.existence.length > 1) {
      this.chart = new ExistenceChart(mapScene, [node.id], state, 110);
      this.element.append(h("h3", {}, "Probability of existence"), this.chart.element);
    }
  }
}
