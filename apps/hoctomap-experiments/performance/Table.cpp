// SPDX-License-Identifier: BSD-3-Clause
#include "performance/Table.h"

#include "measuring/Figures.h"

namespace hoctomap {

namespace {

std::string goalText(const TableRow& row) {
  return std::string(row.at_least ? ">= " : "<= ") + numberText(row.goal, 6);
}

}  // namespace

std::string tableMarkdown(const std::vector<TableRow>& rows) {
  std::string text =
      "| what | hoctomap | compared with | figure | goal | met | equal `.ot` "
      "|\n|---|---|---|---|---|---|---|\n";
  for (const TableRow& row : rows) {
    text += "| " + row.what + " | " + row.ours + " | " + row.stock + " | **" + numberText(row.value, 3) +
            row.unit + "** | " + goalText(row) + " | " + (row.met() ? "yes" : "no") + " | " + row.equal +
            " |\n";
  }
  return text;
}

std::string tableCsv(const std::vector<TableRow>& rows) {
  const auto quoted = [](const std::string& text) { return "\"" + text + "\""; };
  std::string text = "what,ours,stock,value,unit,goal,met,equal\n";
  for (const TableRow& row : rows) {
    text += quoted(row.what) + "," + quoted(row.ours) + "," + quoted(row.stock) + "," +
            numberText(row.value) + "," + quoted(row.unit) + "," + goalText(row) + "," +
            (row.met() ? "yes" : "no") + "," + row.equal + "\n";
  }
  return text;
}

}  // namespace hoctomap
