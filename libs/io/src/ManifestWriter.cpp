// SPDX-License-Identifier: BSD-3-Clause
// The text of `hierarchy.yaml`. Written by hand rather than by a library: every number must be one for YAML
// 1.1 and 1.2 readers, with all its digits, and the same manifest must give the same bytes.
#include <span>

#include "ManifestHash.h"
#include "ManifestHead.h"
#include "NumberText.h"
#include "PoseText.h"
#include "hoctomap/io/Manifest.h"
#include "hoctomap/io/Sha256.h"

namespace hoctomap {
namespace {

std::string flowList(std::span<const double> numbers) {
  std::string text = "[";
  for (const double number : numbers) text += (text.size() > 1 ? ", " : "") + yamlNumber(number);
  return text + "]";
}

std::string vectorText(const Eigen::Vector3d& v) {
  return flowList({v.data(), 3});
}

std::string fileText(const FileRecord& file) {
  return "{path: " + yamlText(file.path) + ", bytes: " + std::to_string(file.bytes) +
         ", sha256: " + yamlText(file.sha256) + "}";
}

std::string childrenText(const std::vector<NodeId>& children) {
  std::string text = "[";
  for (const NodeId child : children) text += (text.size() > 1 ? ", " : "") + std::to_string(child.value);
  return text + "]";
}

std::string occupancyText(const OccupancyModel& model) {
  return "{prob_hit: " + yamlNumber(model.prob_hit) + ", prob_miss: " + yamlNumber(model.prob_miss) +
         ", clamping_min: " + yamlNumber(model.clamping_min) +
         ", clamping_max: " + yamlNumber(model.clamping_max) +
         ", occupancy_threshold: " + yamlNumber(model.occupancy_threshold) + "}";
}

std::string nodeText(const NodeRecord& node) {
  const auto line = [](const char* key, const std::string& value) {
    return "    " + std::string(key) + ": " + value + "\n";
  };
  const auto count = [&](const char* key, std::uint64_t value) { return line(key, std::to_string(value)); };
  std::string text = "  - id: " + std::to_string(node.id.value) + "\n";
  text += line("label", yamlText(node.label.name));
  text += line("parent", node.parent ? std::to_string(node.parent->value) : "null");
  text += line("children", childrenText(node.children));
  text += line("pose", yamlText(poseText(node.parent_T_node)));
  text += line("world_pose", yamlText(poseText(node.world_T_node)));
  text += line("pose_matrix", flowList(matrixNumbers(node.parent_T_node)));
  text += line("world_pose_matrix", flowList(matrixNumbers(node.world_T_node)));
  text += line("resolution", yamlNumber(node.resolution));
  text += line("existence", yamlNumber(node.existence));
  text += line("existence_log_odds", yamlNumber(node.existence_log_odds));
  text += line("obb", "{center: " + vectorText(node.box_center) +
                          ", half_extents: " + vectorText(node.box_half_extents) + "}");
  text += count("occupied_voxels", node.voxels.occupied);
  text += count("free_voxels", node.voxels.free);
  text += count("memory_bytes", node.memory_bytes);
  text += count("first_scan", node.first_scan);
  text += count("last_scan", node.last_scan);
  text += count("version", node.version);
  if (node.edition > 0) text += count("edition", node.edition);
  text += "    votes: {apart: " + std::to_string(node.votes.apart) +
          ", joined: " + std::to_string(node.votes.joined) +
          ", with: " + std::to_string(node.votes.with.value) + "}\n";
  if (node.confirmation.waits || node.confirmation.entered_at_end) {
    text += "    held_back: {shown: " + std::to_string(node.confirmation.shown) +
            ", missed: " + std::to_string(node.confirmation.missed) +
            ", points: " + std::to_string(node.confirmation.points) +
            ", enough: " + (node.confirmation.enough ? "true" : "false") + "}\n";
  }
  if (node.removed_scan) text += count("removed_scan", *node.removed_scan);
  text += line("occupancy", occupancyText(node.occupancy));
  text += "    files:\n      ot: " + fileText(node.ot) + "\n      bt: " + fileText(node.bt) + "\n";
  return text;
}

std::string nodesText(const char* key, const std::vector<NodeRecord>& nodes) {
  if (nodes.empty()) return std::string(key) + ": []\n";
  std::string text = std::string(key) + ":\n";
  for (const NodeRecord& node : nodes) text += nodeText(node);
  return text;
}

}  // namespace

std::string ownHashLine(std::string_view rest) {
  return std::string(kOwnHashMark) + sha256Hex(rest) + "\n";
}

namespace {

std::string headText(const Manifest& manifest) {
  std::string text = "# Hierarchy of octree maps; docs/map-format.md of hoctomap explains every key.\n";
  text += "format_version: " + std::to_string(manifest.format_version) + "\n";
  text += "generator: " + yamlText(manifest.generator) + "\n";
  text += "scans: " + std::to_string(manifest.scans) + "\n";
  text += "mapped_scans: " + std::to_string(manifest.mapped_scans) + "\n";
  text += "skipped_scans: " + std::to_string(manifest.skipped_scans) + "\n";
  if (manifest.edits > 0) text += "edits: " + std::to_string(manifest.edits) + "\n";
  text += "last_stamp: " + yamlNumber(manifest.last_stamp) + "\n";
  text += "config_sha256: " + yamlText(manifest.config_sha256) + "\n";
  text += "input: " + yamlText(manifest.input) + "\n";
  text += "next_id: " + std::to_string(manifest.next_id.value) + "\n";
  text += "files:\n  config: " + fileText(manifest.config) + "\n  events: " + fileText(manifest.events) +
          "\n  existence: " + fileText(manifest.existence) + "\n";
  if (manifest.scan_table) text += "  scans: " + fileText(*manifest.scan_table) + "\n";
  if (manifest.events_before_end) {
    text += "  events_before_end: " + fileText(*manifest.events_before_end) + "\n";
  }
  if (manifest.seams) text += "  seams: " + fileText(*manifest.seams) + "\n";
  if (manifest.index) text += "  index: " + fileText(*manifest.index) + "\n";
  if (manifest.scene) text += "  scene: " + fileText(*manifest.scene) + "\n";
  if (manifest.sensor) {
    text += "sensor: {still_since: " + std::to_string(manifest.sensor->since_scan) +
            ", pose_matrix: " + flowList(matrixNumbers(manifest.sensor->world_T_sensor)) + "}\n";
  }
  if (manifest.motions) {
    text += "motions: {scan: " + std::to_string(manifest.motions->scan) +
            ", time: " + yamlNumber(manifest.motions->time) +
            ", after_scan: " + std::to_string(manifest.motions->after_scan) +
            ", told_sha256: " + yamlText(manifest.motions->told_sha256) + "}\n";
  }
  return text;
}

}  // namespace

std::string manifestText(const Manifest& manifest, const std::string& nodes_text) {
  const std::string text = headText(manifest) + nodes_text;
  return ownHashLine(text) + text;
}

std::string manifestNodesText(const Manifest& manifest) {
  return nodesText("nodes", manifest.nodes) + nodesText("removed", manifest.removed) +
         nodesText("waiting", manifest.waiting);
}

std::string toYaml(const Manifest& manifest) {
  return manifestText(manifest, manifestNodesText(manifest));
}

}  // namespace hoctomap
