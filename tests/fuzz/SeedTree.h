// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <octomap/OcTree.h>

#include <memory>

namespace hoctomap::fuzz {

inline constexpr double kSeedResolution = 0.05;

/// A small octree: `count` voxels along a diagonal, occupied and free by turns.
inline std::unique_ptr<octomap::OcTree> seedTree(int count) {
  auto tree = std::make_unique<octomap::OcTree>(kSeedResolution);
  for (int i = 0; i < count; ++i) {
    const auto at = static_cast<float>(0.06 * i - 1.0);
    tree->updateNode(octomap::point3d(at, 0.5F * at, 0.1F), i % 2 == 0);
  }
  tree->updateInnerOccupancy();
  tree->prune();
  return tree;
}

}  // namespace hoctomap::fuzz
