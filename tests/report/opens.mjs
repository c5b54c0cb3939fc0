// SPDX-License-Identifier: BSD-3-Clause
// Opens pages in Chromium at two sizes: no errors, nothing fetched, something drawn, nothing overlaps.
// Usage: node opens.mjs PAGE.html SELECTOR_OF_WHAT_IS_DRAWN [SELECTOR_TO_CLICK]
import { resolve } from "node:path";
import { launch, layoutProblems, open, pictureOf } from "./browser.mjs";
import { countPixels, difference } from "./png.mjs";

const [file, drawn, clicked] = process.argv.slice(2);
const problems = [];
const browser = await launch();
for (const [width, height, theme] of [[1280, 800, "light"], [390, 844, "dark"]]) {
  const page = await open(browser, resolve(file), { width, height, theme }, problems);
  const name = `${width}x${height}`;
  const before = await pictureOf(page, drawn);
  const corner = before.at(2, before.height - 3);
  const ink = countPixels(before, (...p) => p.some((value, i) => Math.abs(value - corner[i]) > 24));
  if (ink < 0.005 * before.width * before.height) problems.push(`${name}: ${drawn} is all but empty`);
  for (const text of await layoutProblems(page)) problems.push(`${name}: ${text}`);
  if (clicked) {
    await page.locator(clicked).first().click();
    const share = difference(before, await pictureOf(page, drawn));
    if (share < 0.005) problems.push(`${name}: a click on ${clicked} changes ${(100 * share).toFixed(2)} % of the picture`);
  }
  await page.close();
}
await browser.close();
for (const text of problems) console.log(text);
process.exit(problems.length > 0 ? 1 : 0);
