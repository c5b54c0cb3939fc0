// SPDX-License-Identifier: BSD-3-Clause
// Chromium without a display, a sandbox, a graphics card or a network.
import { chromium } from "playwright-core";
import { decodePng } from "./png.mjs";

export async function launch() {
  return chromium.launch({
    executablePath: process.env.HOCTOMAP_CHROMIUM ?? "/usr/bin/chromium",
    args: [
      "--no-sandbox", "--disable-gpu", "--use-angle=swiftshader", "--enable-unsafe-swiftshader",
      "--disable-background-networking", "--disable-component-update", "--disable-sync", "--no-first-run",
      "--disable-quic", "--hide-scrollbars", "--font-render-hinting=none",
    ],
  });
}

/** Opens a report; what goes wrong in it is added to `problems`. */
export async function open(browser, file, { width = 1280, height = 800, theme = "light", scale = 1 }, problems) {
  const page = await browser.newPage({ viewport: { width, height }, colorScheme: theme, deviceScaleFactor: scale });
  page.setDefaultTimeout(60000);
  page.on("console", (message) => message.type() === "error" && problems.push(`console: ${message.text()}`));
  page.on("pageerror", (error) => problems.push(`error: ${error}`));
  page.on("request", (request) => /^(file|data|blob):/.test(request.url()) || problems.push(`fetches ${request.url()}`));
  await page.goto(`file://${file}`);
  await page.waitForFunction(() => document.documentElement.dataset.ready);
  await settle(page);
  return page;
}

/** Waits until the picture does not change any more. */
export async function settle(page) {
  await page.waitForTimeout(50);
  for (let before = null; ; ) {
    const now = await page.evaluate(() => document.documentElement.dataset.settled);
    if (now !== undefined && now === before) return;
    before = now;
    await page.waitForTimeout(300);
  }
}

export async function pictureOf(page, selector) {
  await settle(page);
  const target = selector ? page.locator(selector).first() : page;
  return decodePng(await target.screenshot({ animations: "disabled" }));
}

/** What overlaps, is cut off, or sticks out of the page: texts for people. */
export async function layoutProblems(page) {
  return page.evaluate(() => {
    const problems = [];
    const name = (e) => `${e.tagName.toLowerCase()}${e.id ? "#" + e.id : ""} "${(e.textContent || e.title || "").trim().slice(0, 30)}"`;
    const visible = (e) => e.getClientRects().length > 0 && getComputedStyle(e).visibility !== "hidden";
    const scrolls = (e) => {
      for (let p = e.parentElement; p; p = p.parentElement) {
        const box = p.getBoundingClientRect();
        const own = e.getBoundingClientRect();
        const style = getComputedStyle(p);
        const hides = (over) => over === "auto" || over === "hidden" || over === "scroll";
        if (hides(style.overflowY) && (own.bottom > box.bottom + 1 || own.top < box.top - 1)) return true;
        if (hides(style.overflowX) && (own.right > box.right + 1 || own.left < box.left - 1)) return true;
      }
      return false;
    };
    if (document.documentElement.scrollWidth > innerWidth) problems.push("the page is wider than the window");
    const all = [...document.querySelectorAll("button, select, input, .legend, .row .name, .row .size, .scan, h1, h2, .sidename")].filter((e) => visible(e) && !scrolls(e));
    all.forEach((a, i) => {
      const p = a.getBoundingClientRect();
      if (p.left < -1 || p.right > innerWidth + 1) problems.push(`${name(a)} sticks out`);
      for (const b of all.slice(i + 1)) {
        if (a.contains(b) || b.contains(a)) continue;
        const q = b.getBoundingClientRect();
        const w = Math.min(p.right, q.right) - Math.max(p.left, q.left);
        const h = Math.min(p.bottom, q.bottom) - Math.max(p.top, q.top);
        if (w > 1 && h > 1) problems.push(`${name(a)} overlaps ${name(b)}`);
      }
    });
    return problems;
  });
}
