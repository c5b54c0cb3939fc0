// SPDX-License-Identifier: BSD-3-Clause
#include <nlohmann/json.hpp>

#include "PoseText.h"
#include "hoctomap/io/MapDescription.h"

namespace hoctomap {
namespace {

using Json = nlohmann::ordered_json;

Json fileJson(const FileRecord& file) {
  return {{"path", file.path}, {"bytes", file.bytes}, {"sha256", file.sha256}};
}

Json vectorJson(const Eigen::Vector3d& v) {
  return Json::array({v.x(), v.y(), v.z()});
}

Json nodeJson(const NodeRecord& node) {
  Json children = Json::array();
  for (const NodeId child : node.children) children.push_back(child.value);
  Json json{
      {"id", node.id.value},
      {"label", node.label.name},
      {"parent", node.parent ? Json(node.parent->value) : Json(nullptr)},
      {"children", children},
      {"pose", poseText(node.parent_T_node)},
      {"world_pose", poseText(node.world_T_node)},
      {"pose_matrix", matrixNumbers(node.parent_T_node)},
      {"world_pose_matrix", matrixNumbers(node.world_T_node)},
      {"resolution", node.resolution},
      {"existence", node.existence},
      {"existence_log_odds", node.existence_log_odds},
      {"obb", {{"center", vectorJson(node.box_center)}, {"half_extents", vectorJson(node.box_half_extents)}}},
      {"occupied_voxels", node.voxels.occupied},
      {"free_voxels", node.voxels.free},
      {"memory_bytes", node.memory_bytes},
      {"first_scan", node.first_scan},
      {"last_scan", node.last_scan},
      {"version", node.version}};
  if (node.removed_scan) json["removed_scan"] = *node.removed_scan;
  json["occupancy"] = {{"prob_hit", node.occupancy.prob_hit},
                       {"prob_miss", node.occupancy.prob_miss},
                       {"clamping_min", node.occupancy.clamping_min},
                       {"clamping_max", node.occupancy.clamping_max},
                       {"occupancy_threshold", node.occupancy.occupancy_threshold}};
  json["files"] = {{"ot", fileJson(node.ot)}, {"bt", fileJson(node.bt)}};
  return json;
}

Json nodesJson(const std::vector<NodeRecord>& nodes) {
  Json list = Json::array();
  for (const NodeRecord& node : nodes) list.push_back(nodeJson(node));
  return list;
}

}  // namespace

std::string mapJson(const Manifest& manifest) {
  Json files{{"config", fileJson(manifest.config)},
             {"events", fileJson(manifest.events)},
             {"existence", fileJson(manifest.existence)}};
  if (manifest.scan_table) files["scans"] = fileJson(*manifest.scan_table);
  if (manifest.scene) files["scene"] = fileJson(*manifest.scene);
  const Json json{{"format_version", manifest.format_version},
                  {"generator", manifest.generator},
                  {"scans", manifest.scans},
                  {"config_sha256", manifest.config_sha256},
                  {"input", manifest.input},
                  {"next_id", manifest.next_id.value},
                  {"files", files},
                  {"nodes", nodesJson(manifest.nodes)},
                  {"removed", nodesJson(manifest.removed)}};
  // Labels of a hand-edited map may be no UTF-8.
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace hoctomap
