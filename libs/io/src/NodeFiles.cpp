// SPDX-License-Identifier: BSD-3-Clause
#include "NodeFiles.h"

#include <tbb/parallel_pipeline.h>

#include <algorithm>
#include <atomic>
#include <exception>
#include <iterator>
#include <memory>
#include <utility>
#include <vector>

#include "MapNames.h"
#include "hoctomap/io/OctreeFile.h"
#include "hoctomap/io/Sha256.h"

namespace hoctomap {

void NodeFiles::know(const NodeRecord& record) {
  known_.insert_or_assign({record.id, record.version, record.edition},
                          Contents{record.box_center, record.box_half_extents, record.voxels, std::nullopt,
                                   record.memory_bytes, record.ot, record.bt});
}

NodeFiles::Made NodeFiles::make(const MapNode& node) {
  const auto recordOf = [&](const char* extension, const std::string& bytes) {
    const std::string path =
        std::string(kNodesFolder) + "/" + nodeFileStem(node.id(), node.version, node.edition) + extension;
    return FileRecord{path, bytes.size(), sha256Hex(bytes)};
  };
  OctreeFiles files = octreeFiles(node.map().tree());
  Made made{&node, {}, std::move(files.ot), std::move(files.bt)};
  Contents& contents = made.contents;
  const Eigen::AlignedBox3d& box = node.map().occupiedBox();
  if (!box.isEmpty()) {
    contents.box_center = box.center();
    contents.box_half_extents = (0.5 * box.sizes()).array() + node.map().resolution();
  }
  contents.extent = files.extent;
  contents.voxels = files.extent.voxels;
  contents.memory_bytes = files.memory_bytes;
  contents.ot = recordOf(".ot", made.ot);
  contents.bt = recordOf(".bt", made.bt);
  return made;
}

void NodeFiles::write(std::span<const MapNode* const> nodes) {
  std::vector<const MapNode*> unknown;
  std::copy_if(nodes.begin(), nodes.end(), std::back_inserter(unknown),
               [this](const MapNode* node) { return !known_.contains(keyOf(*node)); });
  std::size_t next = 0;
  // oneTBB leaks what it has handed to a filter that throws: the error waits until the pipeline is empty.
  std::exception_ptr failure;
  std::atomic<bool> failed{false};
  const auto take = [&](tbb::flow_control& flow) {
    if (failed || next == unknown.size()) flow.stop();
    return next++;
  };
  const auto makeOne = [&](std::size_t i) { return std::make_shared<const Made>(make(*unknown[i])); };
  const auto store = [&](const std::shared_ptr<const Made>& made) {
    if (failed) return;
    try {
      disk_.replace(directory_ / made->contents.ot.path, made->ot);
      disk_.replace(directory_ / made->contents.bt.path, made->bt);
      known_.insert_or_assign(keyOf(*made->node), made->contents);
    } catch (...) {
      failure = std::current_exception();
      failed = true;
    }
  };
  constexpr std::size_t kInMemory = 4;  // nodes whose bytes wait to be written
  using tbb::filter_mode;
  using MadePtr = std::shared_ptr<const Made>;
  tbb::parallel_pipeline(kInMemory,
                         tbb::make_filter<void, std::size_t>(filter_mode::serial_in_order, take) &
                             tbb::make_filter<std::size_t, MadePtr>(filter_mode::parallel, makeOne) &
                             tbb::make_filter<MadePtr, void>(filter_mode::serial_in_order, store));
  if (failure) std::rethrow_exception(failure);
}

NodeRecord NodeFiles::record(const MapNode& node, const Pose& world_T_node) const {
  const Contents& contents = known_.at(keyOf(node));

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
  record.edition = node.edition;
  record.votes = node.votes;
  record.confirmation = node.confirmation;
  record.occupancy = node.map().model();
  record.ot = contents.ot;
  record.bt = contents.bt;
  return record;
}

const VoxelExtent& NodeFiles::extent(const MapNode& node) {
  Contents& contents = known_.at(keyOf(node));
  if (!contents.extent) contents.extent = node.map().extent();
  return *contents.extent;
}

}  // namespace hoctomap
