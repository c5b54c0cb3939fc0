// SPDX-License-Identifier: BSD-3-Clause
// What hoctomap-experiments wrote: a chapter a folder, with its plots, pictures and tables.
import { parseCsv } from "./csv.js";
import { readBlock } from "./data.js";
import { h, plural } from "./dom.js";
import { header } from "./frame.js";
import { TablePlot } from "./tablePlot.js";

const TITLES = {
  "vi_a.csv": "VI-A: memory and time of the hierarchy and of one map (Fig. 4 and 5)",
  "vi_a_checks.csv": "VI-A: what was predicted, and what was measured",
  "vi_a_runs.csv": "VI-A: every run",
  "vi_b.csv": "VI-B: ghosts of removed objects (Fig. 6)",
  "vi_b_existence.csv": "VI-B: the removed node's probability of existence",
  "views.csv": "VI-C: coverage of the objects over the way of the robot (Fig. 7)",
  "steps.csv": "VI-C: expected gain, step by step",
  "trials.csv": "VI-C: every run",
  "changes.csv": "Random scripts of changes (III-D)",
  "identity.csv": "Is one object one node?",
  "segmentation.csv": "Segmentation (IV)",
  "performance.csv": "Performance",
};
const MAX_ROWS = 500;

function tableOf({ columns, rows }) {
  const body = h("tbody");
  const fill = (list) => body.replaceChildren(...list.slice(0, MAX_ROWS).map((row) => h("tr", {}, ...columns.map((c) => h(isNaN(Number(row[c])) ? "td" : "td.number", {}, row[c])))));
  let up = true;
  const sortBy = (column) => {
    up = !up;
    const compare = (a, b) => (isNaN(a[column] - b[column]) ? String(a[column]).localeCompare(b[column]) : a[column] - b[column]);
    fill([...rows].sort((a, b) => (up ? compare(a, b) : compare(b, a))));
  };
  fill(rows);
  return h("details", {}, h("summary", {}, "table ", h("small", {}, plural(rows.length, "row") + (rows.length > MAX_ROWS ? `, ${MAX_ROWS} shown` : ""))),
    h("div.wide", {}, h("table", {}, h("thead", {}, h("tr", {}, ...columns.map((c) => h("th", {}, h("button.link", { title: "Sort", onclick: () => sortBy(c) }, c))))), body)));
}

async function pictureOf({ name, block }) {
  const url = URL.createObjectURL(new Blob([await readBlock(block)], { type: "image/png" }));
  return h("figure", {}, h("img", { src: url, alt: name }), h("figcaption", {}, name));
}

export async function experimentsPage(page) {
  const plots = [];
  const draw = () => plots.forEach((plot) => plot.draw());
  const main = h("main");
  for (const chapter of page.chapters) {
    const section = h("section", {}, h("h2", {}, chapter.folder));
    const order = (name) => (name in TITLES ? Object.keys(TITLES).indexOf(name) : 100);
    for (const [name, text] of Object.entries(chapter.tables).sort((a, b) => order(a[0]) - order(b[0]))) {
      const table = parseCsv(text);
      const plot = new TablePlot(name, table);
      plots.push(plot);
      section.append(h("article", {}, h("h3", {}, TITLES[name] ?? name), plot.element, tableOf(table)));
    }
    if (chapter.pictures.length > 0) section.append(h("div.pictures", {}, ...(await Promise.all(chapter.pictures.map(pictureOf)))));
    main.append(section);
  }
  document.body.append(h("div.page.experiments", {}, header(page.name, plural(page.chapters.length, "folder"), draw, false), main));
  draw();
  document.documentElement.dataset.ready = "true";
  document.documentElement.dataset.settled = "1";
}
