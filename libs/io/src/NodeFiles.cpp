// SPDX-License-Identifier: BSD-3-Clause
#include "NodeFiles.h"

#include "MapNames.h"
#include "hoctomap/io/OctreeFile.h"
#include "hoctomap/io/Sha256.h"

namespace hoctomap {

void NodeFiles::know(const NodeRecord& record) {
  known_.insert_or_assign({record.id, record.version},
                          Contents{record.box_center, record.box_half_extents, record.voxels,
                                   record.memory_bytes, record.ot, record.bt});
}

NodeFiles::Contents NodeFiles::write(const MapNode& node) const {
  const auto store = [&](const char* extension, const std::string& bytes) {
    const std::string path =
        std::string(kNodesFolder) + "/" + nodeFileStem(node.id(), node.version) + extension;
    disk_.replace(directory_ / path, bytes);
    return FileRecord{path, bytes.size(), sha256Hex(bytes)};
  };
  Contents contents;
  const Eigen::AlignedBox3d& box = node.map().occupiedBox();
  if (!box.isEmpty()) {
    contents.box_center = box.center();
    contents.box_half_extents = (0.5 * box.sizes()).array() + node.map().resolution();
  }
  contents.voxels = node.map().countVoxels();
  contents.memory_bytes = node.map().tree().memoryUsage();
  contents.ot = store(".ot", otBytes(node.map().tree()));
  contents.bt = store(".bt", btBytes(node.map().tree()));
  return contents;
}

NodeRecord NodeFiles::record(const MapNode& node, const Pose& world_T_node) {
  const std::pair key{node.id(), node.version};
  auto known = known_.find(key);
  if (known == known_.end()) known = known_.emplace(key, write(node)).first;
  const Contents& contents = known->second;

  NodeRecord record;
  record.id = node.id();
  record.label = node.label();
  record.parent = node.parent();
  record.children = node.children();
  record.parent_T_node = node.parent_T_node();
  record.world_T_node = world_T_node;
  record.resolution = node.map().resolution();
  record.existence = node.existence();
  record.existence_log_odds = node.existence_log_odds;
  record.box_center = contents.box_center;
  record.box_half_extents = contents.box_half_extents;
  record.voxels = contents.voxels;
  record.memory_bytes = contents.memory_bytes;
  record.first_scan = node.first_scan;
  record.last_scan = node.last_scan;
  record.version = node.version;
  record.votes = node.votes;
  record.occupancy = node.map().model();
  record.ot = contents.ot;
  record.bt = contents.bt;
  return record;
}

}  // namespace hoctomap
