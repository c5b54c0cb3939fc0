// SPDX-License-Identifier: BSD-3-Clause
// The page of one map.
import { h, number, plural } from "./dom.js";
import { labelColour } from "./colours.js";
import { Details } from "./details.js";
import { header } from "./frame.js";
import { MapScene } from "./mapScene.js";
import { historyPanel, settingsPanel, tabs, timesPanel, warningsPanel } from "./panels.js";
import { mapLegend, Stage } from "./stage.js";
import { State } from "./state.js";
import { TimelineBar } from "./timeline.js";
import { NodeTree } from "./tree.js";

const COLOURS = [["label", "Colour: label"], ["node", "Colour: node"], ["probability", "Colour: probability"], ["height", "Colour: height"]];

function factsOf(map) {
  const voxels = map.nodes.reduce((sum, node) => sum + node.occupied_voxels, 0);
  return `${plural(map.nodes.length, "node")}, ${number(voxels)} voxels, ${plural(map.scans, "scan")}`;
}

function keys(state, stage, timeline, mapScene) {
  document.addEventListener("keydown", (event) => {
    const typing = /^(INPUT|SELECT|TEXTAREA)$/.test(event.target.tagName);
    if (event.ctrlKey || event.metaKey || event.altKey || document.querySelector("dialog[open]")) return;
    const { selected, scan } = state;
    const actions = {
      f: () => (selected === null ? stage.look("fit") : stage.lookAt(mapScene.bounds([selected]))),
      h: () => selected !== null && state.toggleHidden([selected]),
      i: () => selected !== null && state.set({ isolated: state.isolated ? null : new Set([selected]) }),
      " ": () => timeline.toggle(),
      ",": () => state.set({ scan: Math.max(0, scan - 1) }),
      ".": () => state.set({ scan: Math.min(timeline.last, scan + 1) }),
      "?": () => document.getElementById("help").click(),
      Escape: () => state.set({ selected: null, isolated: null }),
    };
    const action = actions[event.key.length === 1 ? event.key.toLowerCase() : event.key];
    const onButton = event.target.tagName === "BUTTON" && event.key === " ";
    const inTree = event.target.closest?.(".tree") && (event.key === " " || event.key.toLowerCase() === "h");
    if (!action || typing || onButton || inTree) return;
    event.preventDefault();
    action();
  });
}

export async function mapPage(page) {
  const [map] = page.maps;
  const mapScene = new MapScene(map);
  const state = new State(mapScene.history.lastScan);
  const stage = new Stage([mapScene], state, {
    colours: COLOURS,
    legend: mapLegend(mapScene, labelColour),
    toggles: ["showFree", "showBoxes", "showLabels", ...(map.scan_table.length ? ["showSensors"] : [])],
  });
  const fit = (ids) => stage.lookAt(mapScene.bounds(ids));
  const tree = new NodeTree(mapScene, state);
  const timeline = new TimelineBar(mapScene, state);
  const { list, body } = tabs([
    { name: "Nodes", element: h("div.nodes", {}, h("div.treebar", {},
      h("span", {}, "node"), h("span.spacer"), h("span", {}, "box"), h("span", {}, "voxel"), h("span", {}, "existence"),
      h("button.link", { title: "Show all nodes", onclick: () => state.set({ hidden: new Set(), isolated: null }) }, "all")),
    tree.element, new Details(mapScene, state, fit).element) },
    { name: "History", element: historyPanel(mapScene, state) },
    { name: "Times", element: timesPanel(map, state) },
    { name: "Settings", element: settingsPanel(map) },
    { name: "Warnings", badge: map.warnings.length, element: warningsPanel(map) },
  ]);
  document.body.append(h("div.page", {},
    header(page.name, factsOf(map), () => state.set({ theme: true })),
    stage.element, timeline.element, h("aside.side", {}, list, body)));
  stage.start();
  stage.viewer.onPick = ({ id }) => state.set({ selected: id === 0 && state.selected !== null ? null : id });
  keys(state, stage, timeline, mapScene);
  state.set({ first: true });
  stage.look("fit");
  await stage.load();
}
