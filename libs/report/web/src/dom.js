// SPDX-License-Identifier: BSD-3-Clause

/** Makes an element: h("button.small", { onclick, title }, "text", child, ...). */
export function h(name, properties = {}, ...children) {
  const [tag, ...classes] = name.split(".");
  const element = document.createElement(tag);
  if (classes.length) element.className = classes.join(" ");
  for (const [key, value] of Object.entries(properties)) {
    if (value === undefined || value === null) continue;
    if (key.startsWith("on")) element.addEventListener(key.slice(2), value);
    else if (key === "style") element.style.cssText = value;
    else element.setAttribute(key, value === true ? "" : value);
  }
  element.append(...children.filter((child) => child !== null && child !== undefined));
  return element;
}

export const number = (value) => Math.round(value).toLocaleString("en").replaceAll(",", "\u202f");

/** A length as people say it: 2 mm, 1 cm, 1.25 m. */
export function metres(value) {
  if (value < 0.01) return `${+(1000 * value).toPrecision(3)} mm`;
  if (value < 1) return `${+(100 * value).toPrecision(3)} cm`;
  return `${+value.toPrecision(3)} m`;
}

export function bytes(value) {
  const unit = value < 1e6 ? ["kB", 1e3] : value < 1e9 ? ["MB", 1e6] : ["GB", 1e9];
  return `${(value / unit[1]).toFixed(1)} ${unit[0]}`;
}

/** Size of a node's box, largest side first. */
export function sizeText(node) {
  const sides = node.obb.half_extents.map((x) => 2 * x);
  if (Math.max(...sides) === 0) return "empty";
  if (Math.max(...sides) < 1) return `${sides.map((x) => Math.round(100 * x)).join(" × ")} cm`;
  return `${sides.map((x) => x.toFixed(1)).join(" × ")} m`;
}

export const plural = (n, word) => `${number(n)} ${word}${n === 1 ? "" : "s"}`;
