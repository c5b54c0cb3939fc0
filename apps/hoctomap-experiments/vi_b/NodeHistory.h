// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "hoctomap/io/MapReader.h"
#include "hoctomap/io/MapTables.h"

namespace hoctomap {

/// What a map knew of one node after one scan.
struct NodeState {
  std::uint64_t scan = 0;
  bool in_map = false;              ///< after the scan
  std::optional<double> existence;  ///< P(n | z_1:t); of a node that this scan removed: why
  ExistenceRow evidence;            ///< of this scan; all zero without any
};

/// The node after every scan of the log.
[[nodiscard]] std::vector<NodeState> historyOf(const std::filesystem::path& map, const Manifest& manifest,
                                               NodeId node);

/// Of the objects that lost their existence, the one with the most occupied voxels.
/// @returns null if there is none
[[nodiscard]] const RemovedNode* largestRemovedObject(const std::filesystem::path& directory,
                                                      const StoredMap& map);

/// How many objects lost their existence. Nodes that were merged into others did not.
[[nodiscard]] std::size_t countRemovedObjects(const std::filesystem::path& directory,
                                              const Manifest& manifest);

}  // namespace hoctomap
