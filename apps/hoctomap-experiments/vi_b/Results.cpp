// SPDX-License-Identifier: BSD-3-Clause
#include "vi_b/Results.h"

#include <algorithm>

#include "hoctomap/io/CsvText.h"
#include "measuring/Figures.h"

namespace hoctomap {

namespace {

bool hasRemoved(const SequenceResult& result) {
  return result.removed_objects > 0;
}

std::string percent(std::size_t part, std::size_t whole) {
  return numberText(100.0 * static_cast<double>(part) / static_cast<double>(std::max<std::size_t>(1, whole)),
                    2) +
         " %";
}

std::string megabytes(std::uint64_t bytes) {
  return numberText(1e-6 * static_cast<double>(bytes), 3) + " MB";
}

std::string resultRow(const SequenceResult& r) {
  std::string row = "| " + r.name + " | ";
  if (hasRemoved(r)) {
    row += std::to_string(r.removed_scan) + " | " + std::to_string(r.node_voxels) + " | " +
           std::to_string(r.ghosts_monolithic) + " (" + percent(r.ghosts_monolithic, r.node_voxels) +
           "), hidden " + std::to_string(r.hidden_monolithic) + " | " + std::to_string(r.ghosts_hierarchy);
  } else {
    row += "never | | |";
  }
  return row + " | " + std::to_string(r.removed_objects) + ", " + std::to_string(r.objects_left) + " | " +
         megabytes(r.monolithic.bytes) + ", " + megabytes(r.hierarchy.bytes) + " |\n";
}

/// The probability after a scan, as a cell: bold where it takes the node out of the map.
std::string cell(const NodeState& state) {
  if (!state.existence) return state.in_map ? "?" : "";
  const std::string text = numberText(*state.existence, 3);
  return state.in_map ? text : "**" + text + "**";
}

std::string existenceTable(const std::vector<SequenceResult>& results) {
  std::size_t scans = 0;  // up to the last one that says something
  for (const SequenceResult& r : results) {
    for (const NodeState& state : r.history) {
      if (state.existence) scans = std::max<std::size_t>(scans, state.scan + 1);
    }
  }
  std::string head = "| after scan |";
  std::string rule = "|---|";
  for (std::size_t i = 0; i < scans; ++i) {
    head += " " + std::to_string(i) + " |";
    rule += "---|";
  }
  std::string table = head + "\n" + rule + "\n";
  for (const SequenceResult& r : results) {
    table += "| " + r.name + " |";
    for (std::size_t i = 0; i < scans; ++i) {
      table += " " + (i < r.history.size() ? cell(r.history[i]) : std::string()) + " |";
    }
    table += "\n";
  }
  return table;
}

}  // namespace

std::string resultsCsv(const std::vector<SequenceResult>& results) {
  std::string csv =
      "sequence,scans,node,removed_scan,node_voxels,ghosts_monolithic,hidden_monolithic,ghosts_hierarchy,"
      "removed_objects,"
      "objects_left,occupied_monolithic,occupied_hierarchy,bytes_monolithic,bytes_hierarchy\n";
  for (const SequenceResult& r : results) {
    csv += csvField(r.name) + "," + std::to_string(r.scans) + ",";
    if (hasRemoved(r)) {
      csv += std::to_string(r.node.value) + "," + std::to_string(r.removed_scan) + "," +
             std::to_string(r.node_voxels) + "," + std::to_string(r.ghosts_monolithic) + "," +
             std::to_string(r.hidden_monolithic) + "," + std::to_string(r.ghosts_hierarchy);
    } else {
      csv += ",,,,,";
    }
    csv += "," + std::to_string(r.removed_objects) + "," + std::to_string(r.objects_left) + "," +
           std::to_string(r.monolithic.occupied) + "," + std::to_string(r.hierarchy.occupied) + "," +
           std::to_string(r.monolithic.bytes) + "," + std::to_string(r.hierarchy.bytes);
    csv += "\n";
  }
  return csv;
}

std::string existenceCsv(const std::vector<SequenceResult>& results) {
  std::string csv = "sequence,node,scan,in_map,present,absent,occluded,existence\n";
  for (const SequenceResult& r : results) {
    for (const NodeState& state : r.history) {
      csv += csvField(r.name) + "," + std::to_string(r.node.value) + "," + std::to_string(state.scan) + "," +
             (state.in_map ? "1," : "0,") + std::to_string(state.evidence.present) + "," +
             std::to_string(state.evidence.absent) + "," + std::to_string(state.evidence.occluded);
      if (state.existence) {
        appendNumber(csv, *state.existence);
      } else {
        csv += ",";
      }
      csv += "\n";
    }
  }
  return csv;
}

std::string resultsMarkdown(const std::vector<SequenceResult>& results) {
  std::string text =
      "| sequence | node removed after scan | its voxels | ghosts, monolithic | ghosts, hierarchy "
      "| objects removed, left | memory, monolithic and hierarchy |\n"
      "|---|---|---|---|---|---|---|\n";
  for (const SequenceResult& r : results) text += resultRow(r);
  return text + "\nExistence of the removed object's node after every scan (bold: removed by it):\n\n" +
         existenceTable(results);
}

}  // namespace hoctomap
