// SPDX-License-Identifier: BSD-3-Clause
// Opens the report of a map of configs/scenes/occlusion.ini (object 2 is removed after scan 9) in Chromium and
// tries it out. Usage: node look.mjs REPORT.html REFERENCE_FOLDER [--update]
import { existsSync, readFileSync, writeFileSync } from "node:fs";
import { join, resolve } from "node:path";
import { inflateSync } from "node:zlib";
import { decodeOctree } from "../../libs/report/web/src/octree.js";
import { launch, layoutProblems, open, pictureOf } from "./browser.mjs";
import { countPixels, decodePng, difference } from "./png.mjs";

const [report, reference] = process.argv.slice(2, 4).map((path) => resolve(path));
const update = process.argv.includes("--update");
const problems = [];
const check = (holds, text) => holds || problems.push(text);
const changes = async (page, text, action, least = 0.002) => {
  const before = await pictureOf(page, ".stage");
  await action();
  const share = difference(before, await pictureOf(page, ".stage"));
  check(share > least, `${text}: only ${(100 * share).toFixed(2)} % of the picture changes`);
};
const isCyan = (r, g, b) => g > r + 50 && b > r + 50 && Math.abs(g - b) < 50;
const rowOf = (page, id) => page.locator(`.row[data-node="${id}"]`);
const setScan = (page, scan) => page.locator("#scan").fill(String(scan));

// Every voxel is in the page: as many as the manifest counts. Free space is coarser.
const html = readFileSync(report, "latin1");
const block = (id) => new Uint8Array(inflateSync(Buffer.from(html.match(new RegExp(`id="${id}">([^<]*)<`))[1], "base64")));
const [map] = JSON.parse(Buffer.from(block("page")).toString()).maps;
const finest = (tile) => (tile.level === 0 ? tile.cells.length : tile.children.reduce((sum, child) => sum + finest(child), 0));
for (const node of [...map.nodes, ...map.removed]) {
  const { root, free } = decodeOctree(block(map.prefix + node.id));
  const occupied = root ? finest(root) : 0;
  let freeVoxels = 0;
  for (let i = 3; i < free.length; i += 4) freeVoxels += free[i] ** 3;
  check(occupied === node.occupied_voxels, `node ${node.id} has ${occupied} voxels, not ${node.occupied_voxels}`);
  const much = freeVoxels / node.free_voxels;
  check(node.free_voxels === 0 ? freeVoxels === 0 : much > 0.8 && much < 2, `node ${node.id} has ${much.toFixed(2)} times its free space`);
}

const browser = await launch();
const page = await open(browser, report, {}, problems);

const first = await pictureOf(page, ".stage");
const background = first.at(5, first.height >> 1);
const drawn = countPixels(first, (...p) => p.some((value, i) => Math.abs(value - background[i]) > 12));
check(drawn > 0.1 * first.width * first.height, "the picture is all but empty");
check(countPixels(first, isCyan) > 200, "no object is seen");

await changes(page, "selection in the tree", () => rowOf(page, 3).click());
check((await page.locator(".details h2").textContent()) === "object 3", "the details are not of the selected node");
await changes(page, "selecting nothing", () => page.keyboard.press("Escape"));

// The other way: where a cyan pixel is, there is an object.
const stage = await page.locator(".stage").boundingBox();
search: for (let y = 60; y < first.height - 60; ++y) {
  for (let x = 20; x < first.width - 20; ++x) {
    if (![-3, 0, 3].every((d) => isCyan(...first.at(x + d, y)) && isCyan(...first.at(x, y + d)))) continue;
    await page.mouse.click(stage.x + x, stage.y + y);
    break search;
  }
}
check((await rowOf(page, 3).getAttribute("aria-selected")) === "true", "a click on object 3 does not select it in the tree");
await page.keyboard.press("Escape");

// Object 2 is gone at the end, was there before, and vanishes again.
const cyanAt = async (scan) => {
  await setScan(page, scan);
  return countPixels(await pictureOf(page, ".stage"), isCyan);
};
const isAbsent = async (id) => /absent/.test(await rowOf(page, id).getAttribute("class"));
const [early, middle, late] = [await cyanAt(2), await cyanAt(7), await cyanAt(11)];
check(early > 50, "object 2 is not seen after scan 2");
check(middle > late + 50, `object 2 does not come back: ${middle} cyan pixels after scan 7, ${late} after scan 11`);
check(await isAbsent(2), "the tree shows the removed object 2 as if it were there");
await setScan(page, 7);
check(!(await isAbsent(2)), "after scan 7 the tree does not show object 2");
await setScan(page, 0);
check(await isAbsent(3), "object 3 is in the tree before it was seen");
await setScan(page, 11);

await changes(page, "hiding", () => page.getByLabel("Hide or show table 1").click());
await changes(page, "showing again", () => page.getByLabel("Hide or show table 1").click());
await rowOf(page, 3).click();
await changes(page, "isolating", () => page.locator("#isolate").click());
await page.keyboard.press("Escape");
for (const colour of ["probability", "height", "node", "label"]) {
  await changes(page, `colouring by ${colour}`, () => page.locator("#colour").selectOption(colour));
}
for (const toggle of ["Free space", "Boxes", "Labels", "Sensor"]) {
  await changes(page, toggle, () => page.getByRole("button", { name: toggle, exact: true }).click(), 0.0005);
  await page.getByRole("button", { name: toggle, exact: true }).click();
}

// By keys alone.
await rowOf(page, 0).focus();
await page.keyboard.press("ArrowDown");
await page.keyboard.press("Enter");
check((await rowOf(page, 1).getAttribute("aria-selected")) === "true", "arrow and Enter do not select in the tree");
await page.keyboard.press("Escape");
await page.locator("canvas").first().focus();
await changes(page, "turning by keys", () => page.keyboard.press("ArrowLeft"));
for (const tab of ["History", "Times", "Settings", "Warnings", "Nodes"]) {
  await page.getByRole("tab", { name: tab }).click();
  check((await page.locator("[role=tabpanel]:visible").innerText()).length > 20, `the panel ${tab} is empty`);
}
await page.close();

for (const [width, height] of [[1280, 800], [390, 844]]) {
  for (const theme of ["light", "dark"]) {
    const name = `${width}-${theme}`;
    const sized = await open(browser, report, { width, height, theme, scale: 0.5 }, problems);
    await rowOf(sized, 3).click();
    const file = join(reference, `${name}.png`);
    const picture = await pictureOf(sized);
    if (update) writeFileSync(file, await sized.screenshot());
    const share = existsSync(file) ? difference(picture, decodePng(readFileSync(file)), 40) : 1;
    check(share < 0.06, `${name}: ${(100 * share).toFixed(1)} % of the pixels differ from ${file}`);
    for (const tab of ["Nodes", "History", "Times", "Settings"]) {
      await sized.getByRole("tab", { name: tab }).click();
      for (const text of await layoutProblems(sized)) problems.push(`${name}, ${tab}: ${text}`);
    }
    await sized.close();
  }
}
await browser.close();
for (const text of problems) console.log(text);
process.exit(problems.length > 0 ? 1 : 0);
