// SPDX-License-Identifier: BSD-3-Clause
// Plots over scans.
import uPlot from "uplot";
import { h } from "./dom.js";
import { nodeColour } from "./colours.js";

export const style = (name) => getComputedStyle(document.documentElement).getPropertyValue(name).trim();

export const axis = (label, more = {}) => ({
  label,
  stroke: style("--quiet"),
  font: "11px system-ui, sans-serif",
  labelFont: "11px system-ui, sans-serif",
  labelSize: 16,
  labelGap: 0,
  grid: { stroke: style("--line"), width: 1 },
  ticks: { stroke: style("--line"), width: 1, size: 4 },
  ...more,
});

/** A plot as wide as the element it is in. */
export class Plot {
  constructor(options, data, height) {
    this.element = h("div.plot");
    this.plot = new uPlot({ width: 320, height, padding: [8, 8, 0, 0], ...options }, data, this.element);
    this.observer = new ResizeObserver(() => {
      const width = this.element.clientWidth;
      if (width > 0 && width !== this.plot.width) this.plot.setSize({ width, height });
    });
    this.observer.observe(this.element);
  }
  destroy() {
    this.observer.disconnect();
    this.plot.destroy();
    this.element.remove();
  }
}

const range = (n) => Array.from({ length: n }, (_, i) => i);
const wholeNumbers = (_, values) => values.map((v) => (Number.isInteger(v) ? v : ""));

/** Marks the current scan in a plot over scans. */
function marker(state) {
  return {
    hooks: {
      draw: (u) => {
        const x = Math.round(u.valToPos(state.scan, "x", true));
        u.ctx.save();
        u.ctx.strokeStyle = style("--accent");
        u.ctx.lineWidth = 2;
        u.ctx.beginPath();
        u.ctx.moveTo(x, u.bbox.top);
        u.ctx.lineTo(x, u.bbox.top + u.bbox.height);
        u.ctx.stroke();
        u.ctx.restore();
      },
    },
  };
}

export class ExistenceChart extends Plot {
  constructor(mapScene, ids, state, height) {
    const { history, map } = mapScene;
    const options = {
      legend: { show: false },
      cursor: { y: false, points: { size: 5 } },
      plugins: [marker(state)],
      scales: { x: { time: false, range: [0, Math.max(1, map.scans - 1)] }, y: { range: [0, 1] } },
      axes: [axis("scan", { values: wholeNumbers, size: 28 }), axis(null, { size: 34 })],
      series: [{}, ...ids.map((id) => ({
        label: `${history.byId.get(id).label} ${id}`,
        stroke: ids.length === 1 ? style("--ink") : nodeColour({ id: id || 100000 }),
        width: 1.5,
        points: { show: false },
        paths: uPlot.paths.stepped({ align: 1 }),
      }))],
    };
    super(options, [range(map.scans), ...ids.map((id) => history.curve(id))], height);
    this.ids = ids;
    this.plot.over.addEventListener("click", () => {
      const scan = this.plot.cursor.idx;
      if (scan !== null && scan !== undefined) state.set({ scan });
    });
  }
  setScan() {
    this.plot.redraw(false);
  }
}

const STAGES = ["read", "segment", "associate", "update", "existence", "write"];
export const STAGE_COLOURS = ["#7c8aa5", "#3b82c4", "#2aa198", "#d9a520", "#cc3fa6", "#8b6f47"];

/** Seconds of every stage, one bar a scan, stage upon stage. */
export class TimingChart extends Plot {
  constructor(map, state, height) {
    const rows = map.timing;
    let sums = rows.map(() => 0);
    const stacks = STAGES.map((_, s) => (sums = sums.map((sum, i) => sum + 1000 * rows[i][s + 2])));
    const bars = uPlot.paths.bars({ size: [0.8, 40], gap: 1 });
    super({
      legend: { show: false },
      cursor: { y: false, points: { show: false } },
      plugins: [marker(state)],
      scales: { x: { time: false, range: [-0.6, map.scans - 0.4] }, y: { range: (_, low, high) => [0, 1.05 * high || 1] } },
      axes: [axis("scan", { values: wholeNumbers, size: 28 }), axis("ms", { size: 44 })],
      // The whole first, then what is below its last part, so that every stage is seen.
      series: [{}, ...STAGES.map((name, s) => ({ label: name, fill: STAGE_COLOURS[s], stroke: STAGE_COLOURS[s], width: 0, paths: bars, points: { show: false } })).reverse()],
    }, [rows.map((row) => row[0]), ...stacks.reverse()], height);
  }
  setScan() {
    this.plot.redraw(false);
  }
}

export const stageTotals = (map) => STAGES.map((name, s) => ({
  name, colour: STAGE_COLOURS[s], seconds: map.timing.reduce((sum, row) => sum + row[s + 2], 0),
}));
