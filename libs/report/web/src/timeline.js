// SPDX-License-Identifier: BSD-3-Clause
// The bar below the picture: which scan is shown, and what happened when.
import { h, plural } from "./dom.js";
import { eventText } from "./details.js";

const MARKS = { created: "added", split: "added", removed: "removed", merged: "removed", moved: "moved", reidentified: "moved" };

export class TimelineBar {
  constructor(mapScene, state) {
    this.state = state;
    this.history = mapScene.history;
    this.last = this.history.lastScan;
    this.text = h("output.scan", { for: "scan" });
    this.slider = h("input", {
      type: "range", id: "scan", min: 0, max: this.last, step: 1, value: state.scan, "aria-label": "Scan",
      oninput: () => state.set({ scan: Number(this.slider.value) }),
    });
    this.play = h("button.play", { title: "Play (space)", "aria-label": "Play", onclick: () => this.toggle() }, "▶");
    this.element = h("div.timeline", {}, this.play,
      h("div.track", {}, h("div.marks", { "aria-hidden": "true" }, ...this.#marks(mapScene.map.events)), this.slider),
      this.text);
    if (this.last === 0) this.element.classList.add("single");
    state.listen(() => this.show(mapScene.map.events));
  }

  #marks(events) {
    const stacks = new Map(); // marks of one scan stand above each other
    return events.filter((event) => MARKS[event.event]).map((event) => {
      const level = Math.min(3, stacks.get(event.scan) ?? 0);
      stacks.set(event.scan, level + 1);
      const x = this.last === 0 ? 0 : event.scan / this.last;
      return h(`i.${MARKS[event.event]}`, {
        style: `--x:${x};--y:${level}`,
        title: `scan ${event.scan}: ${event.label} ${event.node} ${eventText(event)}`,
        onclick: () => this.state.set({ scan: event.scan, selected: event.node }),
      });
    });
  }

  show(events) {
    const { scan } = this.state;
    this.slider.value = scan;
    const now = events.filter((event) => event.scan === scan);
    const count = (kind) => now.filter((event) => MARKS[event.event] === kind).length;
    const what = [["added", "new"], ["moved", "moved"], ["removed", "gone"]].filter(([kind]) => count(kind)).map(([kind, word]) => `${count(kind)} ${word}`);
    const there = [...this.history.lives.keys()].filter((id) => this.history.isThere(id, scan)).length;
    this.text.replaceChildren(h("b", {}, `scan ${scan}`), ` of ${this.last}`, h("small", {}, `${plural(there, "node")}${what.length ? ", " + what.join(", ") : ""}`));
    this.slider.setAttribute("aria-valuetext", `scan ${scan}, ${plural(there, "node")}`);
  }

  toggle() {
    if (this.timer) return this.stop();
    if (this.state.scan >= this.last) this.state.set({ scan: 0 });
    this.play.textContent = "❚❚";
    this.timer = setInterval(() => {
      if (this.state.scan >= this.last) return this.stop();
      this.state.set({ scan: this.state.scan + 1 });
    }, Math.max(60, Math.min(500, 10000 / (this.last + 1))));
  }

  stop() {
    clearInterval(this.timer);
    this.timer = null;
    this.play.textContent = "▶";
  }
}
