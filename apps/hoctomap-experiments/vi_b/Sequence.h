// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "vi_b/NodeHistory.h"

namespace hoctomap {

struct ViBOptions {
  std::filesystem::path output;
  std::string config;                    ///< INI, for both maps
  std::vector<std::string> assignments;  ///< `section.key=value`, for both maps
  double resolution = 0.002;             ///< m, of the objects and of the single map
  bool resume = false;                   ///< take maps that are there already
};

/// A map as built.
struct BuiltMap {
  std::uint64_t occupied = 0;  ///< voxels, over all nodes
  std::uint64_t bytes = 0;     ///< OctoMap's memoryUsage(), over all nodes
};

/// The experiment on one log: an object, one in front of it, the first one taken away.
struct SequenceResult {
  std::string name;
  std::size_t scans = 0;
  std::size_t removed_objects = 0;  ///< nodes that lost their existence; 1 is right
  std::size_t objects_left = 0;
  BuiltMap hierarchy;
  BuiltMap monolithic;
  // Of the largest removed object; without one there is no place to look for ghosts at.
  NodeId node;
  std::vector<NodeState> history;
  std::uint64_t removed_scan = 0;
  std::size_t node_voxels = 0;
  std::size_t ghosts_monolithic = 0;
  std::size_t hidden_monolithic = 0;  ///< those of them that no scan since has seen through
  std::size_t ghosts_hierarchy = 0;
};

/// Builds both maps of a log in `output`/`name` with the program `hoctomap`, counts the ghosts in them and
/// makes their pictures, `monolithic.png` and `hierarchy.png`.
/// @throws InputError if a map cannot be built
[[nodiscard]] SequenceResult runSequence(const ViBOptions& options, const std::string& name,
                                         const std::filesystem::path& log,
                                         const std::function<void(const std::string&)>& say);

}  // namespace hoctomap
