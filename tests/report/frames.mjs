// SPDX-License-Identifier: BSD-3-Clause
// How soon a report can be used and how smoothly it turns, with software WebGL. No test: times depend on the machine. What
// others do on it matters less for the processor's time, of all processes of the browser.
// Usage: node frames.mjs REPORT.html ...
import { readdirSync, readFileSync } from "node:fs";
import { resolve } from "node:path";
import { launch } from "./browser.mjs";

const FRAMES = 90;

/** Seconds that the processor spent for what this process has started. */
function cpuSeconds() {
  const processes = readdirSync("/proc").filter((name) => /^\d+$/.test(name)).map((pid) => {
    try {
      const fields = readFileSync(`/proc/${pid}/stat`, "latin1").replace(/.*\) /s, "").split(" ");
      return { pid: Number(pid), parent: Number(fields[1]), ticks: Number(fields[11]) + Number(fields[12]) };
    } catch {
      return { ticks: 0 }; // ended meanwhile
    }
  });
  const below = (pid) => processes.filter((p) => p.parent === pid).reduce((sum, p) => sum + p.ticks + below(p.pid), 0);
  return below(process.pid) / 100;
}

/** Turns the picture by dragging, a step a frame; milliseconds between frames. */
function turn(frames) {
  const canvas = document.querySelector("canvas");
  const box = canvas.getBoundingClientRect();
  const at = (type, i) => canvas.dispatchEvent(new PointerEvent(type, {
    pointerId: 1, pointerType: "mouse", button: type === "pointermove" ? -1 : 0, buttons: type === "pointerup" ? 0 : 1, bubbles: true,
    clientX: box.left + box.width / 3 + 4 * i, clientY: box.top + box.height / 2 + i,
  }));
  canvas.setPointerCapture = canvas.releasePointerCapture = () => {};
  at("pointerdown", 0);
  return new Promise((done) => {
    const times = [];
    const step = (now) => {
      times.push(now);
      if (times.length > frames) {
        at("pointerup", frames);
        return done(times.slice(1).map((time, i) => time - times[i]));
      }
      at("pointermove", times.length);
      requestAnimationFrame(step);
    };
    requestAnimationFrame(step);
  });
}

const browser = await launch();
for (const file of process.argv.slice(2)) {
  const page = await browser.newPage({ viewport: { width: 1280, height: 800 } });
  page.setDefaultTimeout(300000);
  const [start, cpuAtStart] = [Date.now(), cpuSeconds()];
  const since = () => `${((Date.now() - start) / 1000).toFixed(1)} s (${(cpuSeconds() - cpuAtStart).toFixed(1)} s of CPU)`;
  await page.goto(`file://${resolve(file)}`);
  await page.waitForFunction(() => document.documentElement.dataset.ready);
  const usable = since();
  await page.waitForFunction(() => document.documentElement.dataset.settled);
  const settled = since();
  const loading = cpuSeconds();
  const times = (await page.evaluate(turn, FRAMES)).slice(5).sort((a, b) => a - b);
  const cpu = ((cpuSeconds() - loading) * 1000) / FRAMES;
  const part = (share) => `${times[Math.floor(share * (times.length - 1))].toFixed(0)} ms`;
  console.log(`${file}: usable ${usable}, at rest ${settled}, turning: median ${part(0.5)}, 9 of 10 below ${part(0.9)}, worst ${part(1)}, ${cpu.toFixed(0)} ms of CPU a picture`);
  await page.close();
}
await browser.close();
