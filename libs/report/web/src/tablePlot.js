// SPDX-License-Identifier: BSD-3-Clause
// A table of numbers as a plot whose axes and lines can be chosen.
import uPlot from "uplot";
import { axis, Plot, style } from "./charts.js";
import { h } from "./dom.js";

const PAINTS = ["#0b6bcb", "#d9480f", "#2f9e44", "#ae3ec9", "#e8a317", "#0c8599", "#c2255c", "#6b7280"];
const DASHES = [[], [10, 5], [4, 6], [2, 4]]; // a line is seen below another one
const short = new Intl.NumberFormat("en", { notation: "compact", maximumSignificantDigits: 4 });
/** 0.25, 100, 20K, 5M; nothing where uPlot leaves a tick without a number. */
const shortNumbers = (_, values) => values.map((value) => (value === null ? "" : short.format(value)));
const isNumber = (text) => text !== "" && Number.isFinite(Number(text));

/** What is shown at first of the tables of known experiments. */
const FIRST = {
  "vi_a.csv": { x: "resolution_mm", y: "bytes", colour: "method", facet: "set", logX: true, logY: true },
  "vi_b_existence.csv": { x: "scan", y: "existence", colour: "sequence" },
  "vi_b.csv": { x: "scans", y: "ghosts_monolithic", colour: "sequence" },
  "trials.csv": { x: "travel_m", y: "coverage", colour: "method", facet: "scene" },
  "views.csv": { x: "travel_m", y: "coverage", colour: "method", line: "seed", facet: "scene" },
  "steps.csv": { x: "step", y: "best_gain", colour: "scene", line: "seed", facet: "method" },
  "identity.csv": { x: "objects", y: "f", colour: "order" },
  "segmentation.csv": { x: "objects", y: "f", colour: "category" },
};

export class TablePlot {
  constructor(name, { columns, rows }) {
    this.rows = rows;
    const numeric = columns.filter((c) => rows.some((r) => isNumber(r[c])) && rows.every((r) => r[c] === "" || isNumber(r[c])));
    const words = columns.filter((c) => !numeric.includes(c));
    this.choice = { x: numeric[0], y: numeric[1] ?? numeric[0], colour: words[0] ?? "", line: "", facet: "", logX: false, logY: false, ...FIRST[name] };
    this.facets = this.choice.facet ? [...new Set(rows.map((r) => r[this.choice.facet]))] : [];
    this.facet = this.facets[0];
    this.holder = h("div");
    this.key = h("div.key");
    this.element = h("div.tableplot");
    if (numeric.length < 2) return;
    const pick = (label, field, options) => h("label", {}, `${label} `, h("select", { onchange: (event) => {
      this.choice[field] = event.target.value;
      this.draw();
    } }, ...options.map((o) => h("option", { value: o, selected: o === this.choice[field] || undefined }, o || "none"))));
    const log = (label, field) => h("label", {}, h("input", { type: "checkbox", checked: this.choice[field] || undefined, onchange: (event) => {
      this.choice[field] = event.target.checked;
      this.draw();
    } }), ` ${label}`);
    const facet = this.facets.length > 1 ? h("label", {}, `${this.choice.facet} `, h("select", { onchange: (event) => {
      this.facet = event.target.value;
      this.draw();
    } }, ...this.facets.map((o) => h("option", {}, o)))) : null;
    this.element.append(h("div.controls", {}, facet, pick("down", "y", numeric), log("log", "logY"), pick("across", "x", numeric), log("log", "logX"), pick("colour", "colour", ["", ...columns])), this.holder, this.key);
  }

  draw() {
    this.plot?.destroy();
    this.plot = null;
    if (!this.element.firstChild) return;
    const { x, y, colour, line, facet, logX, logY } = this.choice;
    const usable = (r) => isNumber(r[x]) && isNumber(r[y]) && (!logX || r[x] > 0) && (!logY || r[y] > 0) && (!facet || r[facet] === this.facet);
    const groups = new Map();
    for (const row of this.rows.filter(usable)) {
      const name = colour ? row[colour] : y;
      const key = JSON.stringify([name, line ? row[line] : ""]);
      groups.set(key, groups.get(key) ?? { name, points: [] });
      groups.get(key).points.push([Number(row[x]), Number(row[y])]);
    }
    if (groups.size === 0) return;
    const names = [...new Set([...groups.values()].map((group) => group.name))];
    const paint = (name) => PAINTS[names.indexOf(name) % PAINTS.length];
    const tables = [...groups.values()].map(({ points }) => {
      points.sort((a, b) => a[0] - b[0]);
      return [points.map((p) => p[0]), points.map((p) => p[1])];
    });
    // Points at one place across that are not one line: dots.
    const dots = tables.some(([xs]) => new Set(xs).size < xs.length);
    const unique = dots ? tables.flatMap(([xs, ys]) => xs.map((value, i) => [[value], [ys[i]]])) : tables;
    const owners = dots ? [...groups.values()].flatMap((group) => group.points.map(() => group.name)) : [...groups.values()].map((group) => group.name);
    this.plot = new Plot({
      legend: { show: false },
      scales: { x: { time: false, distr: logX ? 3 : 1 }, y: { distr: logY ? 3 : 1 } },
      padding: [8, 24, 0, 0],
      axes: [axis(x, { size: 30, values: shortNumbers }), axis(y, { size: 62, values: shortNumbers })],
      cursor: { drag: { x: true, y: true } },
      series: [{}, ...owners.map((name) => ({ label: name, dash: DASHES[names.indexOf(name) % DASHES.length], stroke: paint(name), width: 1.6, spanGaps: true, points: { show: true, size: dots ? 6 : 4, fill: paint(name) } }))],
    }, uPlot.join(unique), 280);
    this.holder.replaceChildren(this.plot.element);
    this.key.replaceChildren(...names.slice(0, 24).map((name) => h("span", {}, h("i.swatch", { style: `background:${paint(name)}` }), name)), ...(names.length > 24 ? [h("span", {}, `and ${names.length - 24} more`)] : []));
    this.key.style.color = style("--ink");
  }
}
