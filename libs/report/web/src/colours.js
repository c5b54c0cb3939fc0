// SPDX-License-Identifier: BSD-3-Clause
import { Color } from "three";

// Fig. 3 of the paper: objects cyan, tables magenta, the rest yellow; labels of one's own green.
const LABELS = { object: "#1fb6c9", table: "#cc3fa6", background: "#e3c65c" };
export const labelColour = (label) => LABELS[label] ?? "#7bb35c";

/** A colour of its own for each node: hues a golden angle apart. */
export function nodeColour(node) {
  if (node.id === 0) return "#b9b4a4";
  const hue = ((node.id * 137.508 + 190) % 360) / 360;
  return `#${new Color().setHSL(hue, 0.58, 0.55).getHexString()}`;
}

export const CHANGES = {
  added: "#2fa84f",
  removed: "#e0453a",
  moved: "#3b82f6",
  changed: "#e08a1e",
  unobservable: "#8b7fd0",
};
export const UNCHANGED = "#a3a8ad";

/** Colours along a scale from 0 to 1, also in the shader. */
export const SCALE = ["#40276f", "#33638d", "#1f9a8a", "#75c95a", "#f4e04a"];
