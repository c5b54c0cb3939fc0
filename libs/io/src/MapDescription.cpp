// SPDX-License-Identifier: BSD-3-Clause
#include "hoctomap/io/MapDescription.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <map>
#include <span>
#include <vector>

#include "hoctomap/io/EscapedText.h"

namespace hoctomap {
namespace {

std::string fixed(double value, int digits) {
  std::array<char, 64> text{};
  std::snprintf(text.data(), text.size(), "%.*f", digits, value);
  return text.data();
}

std::string humanBytes(std::uint64_t bytes) {
  constexpr std::array units{"B", "kB", "MB", "GB", "TB"};
  auto value = static_cast<double>(bytes);
  std::size_t unit = 0;
  while (value >= 999.95 && unit + 1 < units.size()) {
    value /= 1000.0;
    ++unit;
  }
  return fixed(value, unit == 0 ? 0 : 1) + " " + units.at(unit);
}

/// Thousands apart: 1234567 as "1 234 567".
std::string grouped(std::uint64_t value) {
  std::string text = std::to_string(value);
  for (auto at = static_cast<std::ptrdiff_t>(text.size()) - 3; at > 0; at -= 3) {
    text.insert(static_cast<std::size_t>(at), 1, ' ');
  }
  return text;
}

std::string metres(double value) {
  return value < 0.01 - 1e-12 ? fixed(value * 1000.0, 1) + " mm" : fixed(value * 100.0, 1) + " cm";
}

std::string extent(const NodeRecord& node) {
  if (node.box_half_extents.isZero(0.0)) return "-";
  const Eigen::Vector3d size = 2.0 * node.box_half_extents;
  return fixed(size.x(), 2) + " x " + fixed(size.y(), 2) + " x " + fixed(size.z(), 2);
}

using Row = std::array<std::string, 9>;
constexpr std::array kTitles{"node",        "resolution", "existence", "box [m]", "occupied",
                             "free voxels", "memory",     "file",      "scans"};

Row nodeRow(const NodeRecord& node, const std::string& branches) {
  return {branches + std::to_string(node.id.value) + " " + escapedText(node.label.name, 60),
          metres(node.resolution),
          fixed(node.existence, 3),
          extent(node),
          grouped(node.voxels.occupied),
          grouped(node.voxels.free),
          humanBytes(node.memory_bytes),
          humanBytes(node.ot.bytes),
          std::to_string(node.first_scan) + "-" + std::to_string(node.last_scan)};
}

/// Columns that a terminal takes for a UTF-8 text: bytes that do not continue a character.
std::size_t columns(const std::string& text) {
  return static_cast<std::size_t>(std::count_if(
      text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U; }));
}

std::string aligned(const std::vector<Row>& rows) {
  std::array<std::size_t, kTitles.size()> widths{};
  for (const Row& row : rows) {
    for (std::size_t i = 0; i < row.size(); ++i) widths.at(i) = std::max(widths.at(i), columns(row.at(i)));
  }
  std::string text;
  for (const Row& row : rows) {
    std::string line;
    for (std::size_t i = 0; i < row.size(); ++i) {
      const std::string fill(widths.at(i) - columns(row.at(i)), ' ');
      line += (i > 0 ? "  " : "") + (i == 0 ? row.at(i) + fill : fill + row.at(i));
    }
    text += line + "\n";
  }
  return text;
}

/// The branches drawn before each node of the tree; nodes come parents first.
std::map<NodeId, std::string> branches(const Manifest& manifest) {
  std::map<NodeId, std::string> before_node;
  std::map<NodeId, std::string> before_children;
  for (const NodeRecord& node : manifest.nodes) {
    for (const NodeId child : node.children) {
      const bool last = child == node.children.back();
      before_node[child] = before_children[node.id] + (last ? "└─ " : "├─ ");
      before_children[child] = before_children[node.id] + (last ? "   " : "│  ");
    }
  }
  return before_node;
}

std::string countText(std::size_t count, const std::string& one, const std::string& more) {
  return std::to_string(count) + " " + (count == 1 ? one : more);
}

std::string summary(const Manifest& manifest) {
  std::uint64_t memory = 0;
  std::uint64_t disk = 0;
  std::map<std::string, std::size_t> by_label;
  for (const NodeRecord& node : manifest.nodes) {
    memory += node.memory_bytes;
    ++by_label[node.label.name];
  }
  for (const FileRecord& file : manifest.files()) disk += file.bytes;
  std::string labels;
  for (const auto& [label, count] : by_label) {
    labels += (labels.empty() ? "" : ", ") + std::to_string(count) + " " + escapedText(label, 60);
  }
  return "map after " + countText(manifest.scans, "scan", "scans") + ", " +
         countText(manifest.nodes.size(), "node", "nodes") + " (" + labels + "), " +
         std::to_string(manifest.removed.size()) + " removed; " + humanBytes(memory) + " in memory, " +
         humanBytes(disk) + " on disk; format " + std::to_string(manifest.format_version) + ", " +
         escapedText(manifest.generator, 60) + "\n";
}

}  // namespace

std::string describeMap(const Manifest& manifest) {
  auto before = branches(manifest);
  std::vector<Row> rows(1);
  std::copy(kTitles.begin(), kTitles.end(), rows.front().begin());
  for (const NodeRecord& node : manifest.nodes) rows.push_back(nodeRow(node, before[node.id]));
  std::string text = summary(manifest) + "\n" + aligned(rows);
  if (manifest.removed.empty()) return text;
  text += "\nremoved:\n";
  for (const NodeRecord& node : manifest.removed) {
    text += "  " + std::to_string(node.id.value) + " " + escapedText(node.label.name, 60) + "  after scan " +
            std::to_string(node.removed_scan.value_or(0)) + ", existence " + fixed(node.existence, 3) +
            ", mapped in scans " + std::to_string(node.first_scan) + "-" + std::to_string(node.last_scan) +
            "\n";
  }
  return text;
}

}  // namespace hoctomap
