// SPDX-License-Identifier: BSD-3-Clause
// The picture with its tools, legend and labels.
import { Vector3 } from "three";
import { h, plural } from "./dom.js";
import { SCALE } from "./colours.js";
import { Viewer } from "./viewer.js";
import { style } from "./charts.js";

const TOGGLES = [
  ["showFree", "Free space", "Free space of the selected node, or of all but the background"],
  ["showBoxes", "Boxes", "Boxes of the nodes"],
  ["showLabels", "Labels", "Names of the nodes"],
  ["showSensors", "Sensor", "Where the scans were taken from"],
];

export class Stage {
  /** @param colours [[value, text]] of the ways to colour  @param toggles names of those that make sense
   * @param selectedNode id of the selected node in a map, or null */
  constructor(mapScenes, state, { colours, legend, selectedNode = () => state.selected, toggles = TOGGLES.map((t) => t[0]) }) {
    this.mapScenes = mapScenes;
    this.state = state;
    this.legendOf = legend;
    this.selectedNode = selectedNode;
    this.canvas = h("canvas", { tabindex: 0, role: "application", "aria-label": "3D view: arrow keys turn, plus and minus zoom, F looks at the selection" });
    this.names = h("div.names", { "aria-hidden": "true" });
    this.legend = h("div.legend");
    this.select = h("select", { id: "colour", "aria-label": "Colour by", onchange: () => state.set({ colour: this.select.value }) },
      ...colours.map(([value, text]) => h("option", { value }, text)));
    this.toggles = TOGGLES.filter(([key]) => toggles.includes(key)).map(([key, text, title]) =>
      h("button.toggle", { title, "data-toggle": key, onclick: () => state.set({ [key]: !state[key] }) }, text));
    const views = ["fit", "top", "front"].map((name) => h("button", { title: `View: ${name}`, onclick: () => this.look(name) }, name[0].toUpperCase() + name.slice(1)));
    this.element = h("div.stage", {}, this.canvas, this.names,
      h("div.tools", { role: "toolbar", "aria-label": "View" }, this.select, ...this.toggles, h("span.spacer"), ...views), this.legend);
  }

  /** After the element is in the page. */
  start() {
    this.viewer = new Viewer(this.canvas, this.mapScenes);
    this.viewer.afterDraw = () => this.#placeNames();
    // For tests: how often the picture has come to rest; nothing while it changes.
    let rests = 0;
    this.viewer.onSettled = (settled) => {
      if (settled) document.documentElement.dataset.settled = String(++rests);
      else delete document.documentElement.dataset.settled;
    };
    this.state.listen(() => this.show());
  }

  /** Reads the voxels; what is there is shown. */
  async load() {
    for (const mapScene of this.mapScenes) await mapScene.load(() => this.viewer.refine());
    this.viewer.loading = false;
    document.documentElement.dataset.ready = "true";
    this.show();
  }

  show() {
    const dark = document.documentElement.dataset.theme === "dark";
    this.viewer.background = style("--stage");
    for (const mapScene of this.mapScenes) mapScene.show(this.state, dark);
    for (const button of this.toggles) button.setAttribute("aria-pressed", String(this.state[button.dataset.toggle]));
    this.select.value = this.state.colour;
    this.legend.replaceChildren(...this.#legendEntries());
    this.#nameNodes();
    this.viewer.changed();
  }

  #legendEntries() {
    const { colour } = this.state;
    if (colour === "probability" || colour === "height") {
      const heights = this.mapScenes[0].bounds(this.mapScenes[0].history.nodes.map((n) => n.id));
      const [low, high] = colour === "probability" ? ["0.5", "1"] : [`${heights.min.z.toFixed(2)} m`, `${heights.max.z.toFixed(2)} m`];
      return [h("span", {}, low), h("i.scale", { style: `background:linear-gradient(90deg,${SCALE.join(",")})` }), h("span", {}, high), ...this.#notes()];
    }
    return [...this.legendOf(this.state).map(([text, paint]) => h("span", {}, h("i.swatch", { style: `background:${paint}` }), text)), ...this.#notes()];
  }

  /** What the picture of an earlier scan is not. */
  #notes() {
    const earlier = this.mapScenes.length === 1 && this.state.scan < this.mapScenes[0].history.lastScan;
    return earlier ? [h("span.note", { title: "The scan decides which nodes are there, and where. How they looked after it: hoctomap report --at-scan" }, "voxels as last mapped")] : [];
  }

  /** Ids of nodes in a map that fill the picture: those that are shown, without the background. */
  #framed(mapScene) {
    const shown = [...mapScene.models.keys()].filter((id) => mapScene.isShown(id, this.state));
    const things = shown.filter((id) => id !== 0);
    return things.length > 0 ? things : shown;
  }

  box(idsOf = (mapScene) => this.#framed(mapScene)) {
    const [first, ...others] = this.mapScenes.map((mapScene) => mapScene.bounds(idsOf(mapScene)));
    return others.reduce((box, other) => box.union(other), first);
  }

  /** From the side that was seen, from above. */
  look(view) {
    const box = this.box();
    if (view !== "fit") return this.viewer.eye.frame(box, view);
    const sensor = this.mapScenes[0].meanSensor();
    const from = sensor && !box.isEmpty() ? sensor.sub(box.getCenter(new Vector3())) : new Vector3(-1, -1, 1);
    const flat = Math.hypot(from.x, from.y);
    from.z = Math.max(from.z, 0.7 * flat);
    if (flat < 0.2 * from.z) from.set(-0.4 * from.z, -0.5 * from.z, from.z);
    this.viewer.eye.frame(box, from);
  }

  lookAt(box) {
    if (!box.isEmpty()) this.viewer.eye.frame(box.expandByScalar(0.4 * box.getSize(new Vector3()).length()), this.viewer.eye.back());
  }

  #nameNodes() {
    this.named = [];
    for (const view of this.viewer.views) {
      for (const [id, model] of view.mapScene.models) {
        const wanted = this.selectedNode(view.mapScene) === id || (this.state.showLabels && id !== 0);
        if (!wanted || !model.group.visible) continue;
        const element = h("span", {}, `${model.node.label} ${id}`);
        this.named.push({ element, view, id });
      }
    }
    const first = ({ id, view }) => Number(id === this.selectedNode(view.mapScene));
    this.named.sort((a, b) => first(b) - first(a));
    this.names.replaceChildren(...this.named.map((name) => name.element));
  }

  #placeNames() {
    const placed = [];
    for (const { element, view, id } of this.named ?? []) {
      const box = view.mapScene.bounds([id]);
      const top = box.getCenter(new Vector3()).setZ(box.max.z);
      const place = box.isEmpty() ? null : this.viewer.place(top, view);
      const inside = place && place.x > view.x && place.x < view.x + view.width && place.y > view.y + 20 && place.y < view.y + view.height;
      // Names that would cover another one wait until there is room; that of the selection comes first.
      const covers = inside && placed.some((other) => Math.abs(other.x - place.x) < 62 && Math.abs(other.y - place.y) < 20);
      element.hidden = !inside || covers;
      if (!element.hidden) placed.push(place);
      if (!element.hidden) element.style.transform = `translate(${place.x.toFixed(1)}px, ${place.y.toFixed(1)}px)`;
    }
  }
}

export function mapLegend(mapScene, colourOf) {
  const labels = [...new Set(mapScene.history.nodes.map((node) => node.label))];
  return (state) => (state.colour === "node" ? [[plural(mapScene.history.nodes.length, "node") + ", a colour each", "var(--quiet)"]] : labels.map((label) => [label, colourOf(label)]));
}
