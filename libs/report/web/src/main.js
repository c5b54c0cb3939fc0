// SPDX-License-Identifier: BSD-3-Clause
import { readJson } from "./data.js";
import { comparePage } from "./comparePage.js";
import { experimentsPage } from "./experimentsPage.js";
import { startTheme } from "./frame.js";
import { mapPage } from "./mapPage.js";

startTheme();
const pages = { map: mapPage, compare: comparePage, experiments: experimentsPage };
readJson("page")
  .then((page) => pages[page.kind](page))
  .catch((error) => {
    const text = document.createElement("p");
    text.className = "failure";
    text.textContent = `This report cannot be shown: ${error.message}. It needs WebGL 2 and a browser of 2023 or later.`;
    document.body.append(text);
    throw error;
  });
