// SPDX-License-Identifier: BSD-3-Clause

/** Rows of a CSV text (RFC 4180) as objects by column name. */
export function parseCsv(text) {
  const rows = [[]];
  let field = "";
  let quoted = false;
  const endField = () => {
    rows.at(-1).push(field);
    field = "";
  };
  for (let i = 0; i < text.length; ++i) {
    const c = text[i];
    if (quoted) {
      if (c !== '"') field += c;
      else if (text[i + 1] === '"') field += text[++i];
      else quoted = false;
    } else if (c === '"') quoted = true;
    else if (c === ",") endField();
    else if (c === "\n") {
      endField();
      rows.push([]);
    } else if (c !== "\r") field += c;
  }
  if (field || rows.at(-1).length) endField();
  else rows.pop();
  const [columns, ...body] = rows;
  return { columns, rows: body.map((row) => Object.fromEntries(columns.map((name, i) => [name, row[i] ?? ""]))) };
}
