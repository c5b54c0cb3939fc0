// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <tuple>
#include <utility>

#include "Disk.h"
#include "hoctomap/hierarchy/MapNode.h"
#include "hoctomap/io/Manifest.h"

namespace hoctomap {

/// The immutable octree files of a map. What a map looks like is settled by node and version, so each is
/// written, hashed and counted once.
class NodeFiles {
 public:
  NodeFiles(const Disk& disk, std::filesystem::path directory)
      : disk_(disk), directory_(std::move(directory)) {}

  /// The files of this record are there already.
  void know(const NodeRecord& record);

  /// Writes the files of these nodes unless they are there: made in parallel, written in order.
  void write(std::span<const MapNode* const> nodes);

  /// The node as the manifest describes it. Its files have been written.
  [[nodiscard]] NodeRecord record(const MapNode& node, const Pose& world_T_node) const;

  /// Of the node's octree. Its files have been written.
  [[nodiscard]] const VoxelExtent& extent(const MapNode& node);

 private:
  /// Everything that follows from the octree alone.
  struct Contents {
    Eigen::Vector3d box_center = Eigen::Vector3d::Zero();
    Eigen::Vector3d box_half_extents = Eigen::Vector3d::Zero();
    VoxelCounts voxels;
    std::optional<VoxelExtent> extent;  ///< not known of files that were there already
    std::uint64_t memory_bytes = 0;
    FileRecord ot;
    FileRecord bt;
  };
  /// Contents with the bytes of the files.
  struct Made {
    const MapNode* node = nullptr;
    Contents contents;
    std::string ot;
    std::string bt;
  };
  [[nodiscard]] static Made make(const MapNode& node);

  const Disk& disk_;
  std::filesystem::path directory_;
  /// Node, version, edition.
  using Key = std::tuple<NodeId, std::uint64_t, std::uint64_t>;
  static Key keyOf(const MapNode& node) { return {node.id(), node.version, node.edition}; }
  std::map<Key, Contents> known_;
};

}  // namespace hoctomap
