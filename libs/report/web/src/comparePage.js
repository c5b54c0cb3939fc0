// SPDX-License-Identifier: BSD-3-Clause
// Two maps side by side, coloured by what `hoctomap diff` says.
import { Vector3 } from "three";
import { h, plural } from "./dom.js";
import { CHANGES, labelColour, UNCHANGED } from "./colours.js";
import { header } from "./frame.js";
import { matrixOf } from "./history.js";
import { MapScene } from "./mapScene.js";
import { settingsPanel, tabs } from "./panels.js";
import { Stage } from "./stage.js";
import { State } from "./state.js";

function whatText(change) {
  const percent = `${Math.round(100 * change.score)} %`;
  if (change.change === "moved") {
    const before = new Vector3(...change.position);
    const way = before.clone().applyMatrix4(matrixOf(change.motion_matrix)).sub(before);
    const turn = Math.hypot(...change.motion.slice(3));
    return `by ${(100 * way.length()).toFixed(1)} cm, turned by ${turn.toFixed(0)}°; shapes agree to ${percent}`;
  }
  return change.change === "changed" ? `shape agrees to ${percent}` : `the other map saw ${percent} of the place`;
}

export async function comparePage(page) {
  const { diff } = page;
  const mapScenes = page.maps.map((map) => new MapScene(map));
  mapScenes[1].root.matrix.copy(matrixOf(diff.transform));
  mapScenes[1].root.matrixWorldNeedsUpdate = true;
  const nodeOf = (change, side) => (side === 0 ? change.node_a : change.node_b);
  const changeOf = mapScenes.map((_, side) => new Map(diff.changes.flatMap((change, i) => {
    const carried = (change.carried ?? []).map((pair) => (side === 0 ? pair.node_a : pair.node_b));
    return [nodeOf(change, side), ...carried].filter((id) => id !== null).map((id) => [id, i]);
  })));
  const state = new State(Number.MAX_SAFE_INTEGER); // the maps as they are
  const selectedNode = (mapScene) => (state.selected === null ? null : nodeOf(diff.changes[state.selected], mapScenes.indexOf(mapScene)));
  mapScenes.forEach((mapScene, side) => {
    mapScene.colourOf = (node) => {
      if (state.colour === "label") return labelColour(node.label);
      const change = diff.changes[changeOf[side].get(node.id)];
      return change ? CHANGES[change.change] : node.id === 0 ? (document.documentElement.dataset.theme === "dark" ? "#565c63" : "#d3d6da") : UNCHANGED;
    };
    // A change is selected, not a node.
    const show = mapScene.show.bind(mapScene);
    mapScene.show = (current, dark) => show({ ...current, selected: selectedNode(mapScene) }, dark);
  });
  const kinds = Object.keys(CHANGES).filter((kind) => diff.counts[kind] > 0);
  const stage = new Stage(mapScenes, state, {
    colours: [["change", "Colour: change"], ["label", "Colour: label"], ["probability", "Colour: probability"], ["height", "Colour: height"]],
    legend: ({ colour }) => (colour === "label" ? [] : [...kinds.map((kind) => [kind, CHANGES[kind]]), ["unchanged", UNCHANGED]]),
    selectedNode,
    toggles: ["showBoxes", "showLabels"],
  });
  state.colour = "change";
  stage.element.append(...["A", "B"].map((side, i) => h(`span.sidename.${side.toLowerCase()}`, {}, h("b", {}, side), ` ${page.maps[i].path}, ${plural(page.maps[i].scans, "scan")}`)));

  const boxOf = (change) => {
    const boxes = mapScenes.flatMap((mapScene, side) => (nodeOf(change, side) === null ? [] : [mapScene.bounds([nodeOf(change, side)])]));
    return boxes.slice(1).reduce((box, other) => box.union(other), boxes[0]);
  };
  const rows = diff.changes.map((change, i) => h("button.change", { "data-change": i, onclick: () => {
    const selected = state.selected === i ? null : i;
    state.set({ selected });
    if (selected !== null) stage.lookAt(boxOf(change));
  } },
    h("span.kind", { style: `--kind:${CHANGES[change.change]}` }, change.change),
    h("b", {}, `${change.label} ${[change.node_a, change.node_b].filter((id) => id !== null).join(" → ")}`),
    h("small", {}, [whatText(change), change.carried?.length ? `with it ${plural(change.carried.length, "node")}` : "", change.detail ?? ""].filter(Boolean).join("; "))));
  state.listen(() => rows.forEach((row, i) => row.setAttribute("aria-pressed", String(state.selected === i))));
  const { list, body } = tabs([
    { name: "Changes", badge: diff.changes.length, element: h("div.changes", {}, ...rows, diff.changes.length ? null : h("p.hint", {}, "No changes.")) },
    { name: "A", element: settingsPanel(page.maps[0]) },
    { name: "B", element: settingsPanel(page.maps[1]) },
  ]);
  const facts = kinds.map((kind) => `${diff.counts[kind]} ${kind}`).join(", ") || "no changes";
  document.body.append(h("div.page.compare", {}, header(page.name, facts, () => state.set({ theme: true })), stage.element, h("aside.side", {}, list, body)));
  stage.start();
  stage.viewer.onPick = ({ id, mapScene }) => state.set({ selected: changeOf[mapScenes.indexOf(mapScene)].get(id) ?? null });
  document.addEventListener("keydown", (event) => {
    if (document.querySelector("dialog[open]")) return;
    if (event.key === "Escape") state.set({ selected: null });
    if (event.key.toLowerCase() === "f") state.selected === null ? stage.look("fit") : stage.lookAt(boxOf(diff.changes[state.selected]));
  });
  state.set({ first: true });
  stage.look("fit");
  await stage.load();
}
