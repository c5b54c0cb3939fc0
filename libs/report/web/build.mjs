// SPDX-License-Identifier: BSD-3-Clause
// Makes the page of reports from src/: one HTML text without data, as a C++ source file.
// Usage: node build.mjs PageText.cpp
import { readFileSync, writeFileSync } from "node:fs";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";
import { buildSync } from "esbuild";

const here = dirname(fileURLToPath(import.meta.url));

function bundle(entry) {
  const result = buildSync({
    entryPoints: [join(here, "src", entry)],
    bundle: true,
    minify: true,
    write: false,
    legalComments: "inline", // the licences of what is inside travel with it
    target: ["chrome100", "firefox113", "safari16.4"],
    charset: "ascii",
  });
  return result.outputFiles[0].text;
}

/** Raw string literals of a size that compilers take. */
function cppText(text) {
  const parts = [];
  for (let i = 0; i < text.length; i += 16000) parts.push(`R"hoctomap(${text.slice(i, i + 16000)})hoctomap"`);
  return parts.join("\n");
}

const html = readFileSync(join(here, "src", "page.html"), "utf8");
const [head, tail] = html
  .replace("/*style*/", () => bundle("style.css"))
  .replace("/*script*/", () => bundle("main.js"))
  .split("<!--data-->");
writeFileSync(
  process.argv[2],
  `// Made by web/build.mjs.
#include "PageText.h"
#pragma GCC diagnostic ignored "-Woverlength-strings"
namespace hoctomap {
const std::string_view kPageHead = ${cppText(head)};
const std::string_view kPageTail = ${cppText(tail)};
}  // namespace hoctomap
`,
);
