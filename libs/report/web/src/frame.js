// SPDX-License-Identifier: BSD-3-Clause
// What all pages have: header, theme, help.
import { h } from "./dom.js";

function remembered(key, value) {
  try {
    if (value === undefined) return localStorage.getItem(key);
    localStorage.setItem(key, value);
  } catch {
    // A file opened from disk may have no storage.
  }
  return null;
}

export function setTheme(theme) {
  document.documentElement.dataset.theme = theme;
  remembered("hoctomap-theme", theme);
}

export function startTheme() {
  const dark = window.matchMedia("(prefers-color-scheme: dark)").matches;
  document.documentElement.dataset.theme = remembered("hoctomap-theme") ?? (dark ? "dark" : "light");
}

const KEYS = [
  ["drag, wheel", "turn, zoom; with the right button or two fingers: move"],
  ["arrows, + −", "the same, when the picture has the focus"],
  ["click", "select what is under the pointer"],
  ["F", "look at the selection, or at everything"],
  ["H, I", "hide the selected node; show only it, or all again"],
  ["space", "play the scans"],
  [", .", "one scan back or on"],
  ["Esc", "select nothing, show all"],
];

function help() {
  const dialog = h("dialog", { "aria-label": "Keys" }, h("h2", {}, "Mouse and keys"),
    h("dl", {}, ...KEYS.flatMap(([key, what]) => [h("dt", {}, key), h("dd", {}, what)])),
    h("p.hint", {}, "Voxels are shown as they were last mapped; the scan decides which nodes are there, and where."),
    h("form", { method: "dialog" }, h("button", { autofocus: true }, "Close")));
  document.body.append(dialog);
  dialog.addEventListener("close", () => dialog.remove());
  dialog.showModal();
}

/** @param onTheme called after the theme has changed  @param withKeys whether there is anything to press */
export function header(name, facts, onTheme, withKeys = true) {
  const theme = h("button", { id: "theme", title: "Light or dark", "aria-label": "Light or dark", onclick: () => {
    setTheme(document.documentElement.dataset.theme === "dark" ? "light" : "dark");
    onTheme();
  } }, "◐");
  return h("header.top", {}, h("span.brand", {}, "hoctomap"), h("h1", {}, name), h("span.facts", {}, facts), h("span.spacer"),
    ...(withKeys ? [h("button", { title: "Mouse and keys (?)", "aria-label": "Mouse and keys", onclick: help, id: "help" }, "?")] : []), theme);
}
