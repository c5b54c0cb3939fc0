// SPDX-License-Identifier: BSD-3-Clause
// The panels beside the picture, but for the tree: what happened, times, settings, warnings.
import { bytes, h, number, plural } from "./dom.js";
import { ExistenceChart, stageTotals, TimingChart } from "./charts.js";
import { eventText } from "./details.js";

/** Tabs with panels; arrow keys move between them. @param panels [{name, badge, make() -> element}] */
export function tabs(panels) {
  const list = h("div.tabs", { role: "tablist" });
  const body = h("div.panels");
  const select = (index, focus) => {
    [...list.children].forEach((tab, i) => {
      tab.setAttribute("aria-selected", String(i === index));
      tab.tabIndex = i === index ? 0 : -1;
      body.children[i].hidden = i !== index;
    });
    if (focus) list.children[index].focus();
  };
  panels.forEach((panel, i) => {
    list.append(h("button", { role: "tab", id: `tab${i}`, "aria-controls": `panel${i}`, onclick: () => select(i) },
      panel.name, panel.badge ? h("span.badge", {}, String(panel.badge)) : null));
    body.append(h("div.panel", { role: "tabpanel", id: `panel${i}`, "aria-labelledby": `tab${i}` }, panel.element));
  });
  list.addEventListener("keydown", (event) => {
    const step = { ArrowRight: 1, ArrowLeft: -1 }[event.key];
    if (!step) return;
    const at = [...list.children].indexOf(document.activeElement);
    select((at + step + panels.length) % panels.length, true);
  });
  select(0);
  return { list, body };
}

export function historyPanel(mapScene, state) {
  const { map, history } = mapScene;
  const element = h("div");
  let chart = null;
  const fill = () => {
    chart?.destroy();
    const ids = history.nodes.map((node) => node.id).filter((id) => history.lives.get(id).existence.length > 1).slice(0, 60);
    chart = ids.length > 0 && map.scans > 1 ? new ExistenceChart(mapScene, ids, state, 190) : null;
    element.replaceChildren(
      ...(chart ? [h("h3", {}, "Probability of existence, a line a node (click: that scan)"), chart.element] : []),
      h("h3", {}, "What happened"),
      h("ol.log", {}, ...map.events.map((event) => h("li", {},
        h("button.link", { onclick: () => state.set({ scan: event.scan, selected: event.node }) }, `scan ${event.scan}`),
        " ", h("b", {}, `${event.label} ${event.node}`), ` ${eventText(event)}`, h("small", {}, event.detail ? `: ${event.detail}` : "")))),
    );
    if (map.events.length === 0) element.append(h("p.hint", {}, "Nothing but the background."));
  };
  state.listen((_, change) => {
    if ("first" in change || "theme" in change) fill();
    else if ("scan" in change) chart?.setScan();
  });
  return element;
}

function skippedTable(map) {
  const reasons = new Map();
  for (const row of map.scan_table.filter((r) => r.skipped)) {
    reasons.set(row.skipped, [...(reasons.get(row.skipped) ?? []), row.scan]);
  }
  if (reasons.size === 0) return h("p", {}, `${plural(map.mapped_scans || map.scans, "scan")} used, none skipped.`);
  return h("div", {}, h("p", {}, `${plural(map.mapped_scans, "scan")} used, ${map.skipped_scans} skipped:`),
    h("ul", {}, ...[...reasons].map(([reason, scans]) => h("li", {}, `${scans.length} × ${reason} (first: scan ${scans[0]})`))));
}

export function timesPanel(map, state) {
  const element = h("div");
  let chart = null;
  const fill = () => {
    chart?.destroy();
    const totals = stageTotals(map);
    const all = totals.reduce((sum, stage) => sum + stage.seconds, 0);
    chart = map.timing.length > 0 ? new TimingChart(map, state, 200) : null;
    element.replaceChildren(
      h("h3", {}, "Time of a scan"),
      ...(chart ? [chart.element,
        h("table", {}, h("tbody", {}, ...totals.map((stage) => h("tr", {},
          h("td", {}, h("span.swatch", { style: `background:${stage.colour}` }), stage.name),
          h("td.number", {}, `${stage.seconds.toFixed(2)} s`), h("td.number", {}, all > 0 ? `${Math.round((100 * stage.seconds) / all)} %` : ""))),
          h("tr.sum", {}, h("td", {}, "all"), h("td.number", {}, `${all.toFixed(2)} s`), h("td.number", {}, map.timing.length ? `${(all / map.timing.length * 1000).toFixed(0)} ms a scan` : "")))),
        h("p.hint", {}, "Wall time of each stage. Stages of neighbouring scans overlap, so the run took less.")]
        : [h("p.hint", {}, "The map has no times of its scans.")]),
      h("h3", {}, "Scans"), skippedTable(map),
    );
  };
  state.listen((_, change) => {
    if ("first" in change || "theme" in change) fill();
    else if ("scan" in change) chart?.setScan();
  });
  return element;
}

function settingsText(ini) {
  return ini.split(/^(?=\[)/m).filter((part) => part.trim()).map((part) => {
    const [head, ...lines] = part.trim().split("\n");
    const rows = lines.filter((line) => line.includes("=")).map((line) => {
      const at = line.indexOf("=");
      return h("tr", {}, h("td", {}, line.slice(0, at).trim()), h("td.number", {}, line.slice(at + 1).trim()));
    });
    return h("details", {}, h("summary", {}, head.replace(/^\[|\]$/g, ""), h("small", {}, ` ${rows.length}`)), h("table", {}, h("tbody", {}, ...rows)));
  });
}

export function settingsPanel(map) {
  const labels = new Map();
  for (const node of map.nodes) {
    const sum = labels.get(node.label) ?? { nodes: 0, voxels: 0, memory: 0 };
    labels.set(node.label, { nodes: sum.nodes + 1, voxels: sum.voxels + node.occupied_voxels, memory: sum.memory + node.memory_bytes });
  }
  return h("div", {},
    h("h3", {}, "The map"),
    h("table", {}, h("thead", {}, h("tr", {}, ...["label", "nodes", "occupied", "memory"].map((t, i) => h(i ? "th.number" : "th", {}, t)))),
      h("tbody", {}, ...[...labels].map(([label, sum]) => h("tr", {}, h("td", {}, label), h("td.number", {}, number(sum.nodes)), h("td.number", {}, number(sum.voxels)), h("td.number", {}, bytes(sum.memory)))))),
    h("dl", {}, h("dt", {}, "made by"), h("dd", {}, map.generator), h("dt", {}, "folder"), h("dd", {}, map.path),
      h("dt", {}, "input"), h("dd.hash", {}, map.input || "not recorded"), h("dt", {}, "settings"), h("dd.hash", {}, map.config_sha256)),
    h("h3", {}, "Settings in force (config.ini)"), ...settingsText(map.config));
}

export function warningsPanel(map) {
  if (map.warnings.length === 0) return h("p.hint", {}, "The last run on this map had no warnings.");
  return h("ul.warnings", {}, ...map.warnings.map((text) => h("li", {}, text)));
}
