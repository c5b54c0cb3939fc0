// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <octomap/OcTree.h>

#include <Eigen/Geometry>
#include <memory>
#include <optional>
#include <random>
#include <string>

#include "hoctomap/octree/BlockScanUpdate.h"

namespace hoctomap::test {

/// Random scans made to hit the awkward cases: everything is measured in voxels and then scaled by the
/// resolution, so that voxel borders, edges, corners and exact diagonals are met on purpose.
class SceneMaker {
 public:
  explicit SceneMaker(std::uint64_t seed);

  /// One scan. Its points live until the next call.
  Beams scan(std::size_t hits, std::size_t passing, std::size_t endpoints = 0);

  /// A box that the beams may cross, miss, graze, start in or end in; may be inverted or beyond the key
  /// range.
  Eigen::AlignedBox3d box();

  [[nodiscard]] double resolution() const { return resolution_; }
  [[nodiscard]] double maxRange();

 private:
  double uniform(double low, double high) { return std::uniform_real_distribution<double>(low, high)(rng_); }
  int pick(int choices) { return std::uniform_int_distribution<int>(0, choices - 1)(rng_); }
  double coordinate();
  Eigen::Vector3f point();
  Eigen::Vector3f endpoint(const Eigen::Vector3f& origin);

  std::mt19937_64 rng_;
  double resolution_;
  Eigen::Vector3d center_;  ///< in voxels
  double extent_;           ///< in voxels
  PointCloud hits_;
  PointCloud passing_;
  PointCloud endpoints_;
};

/// The bytes of the tree's `.ot` file.
std::string otBytes(const octomap::OcTree& tree);

/// Empty if the trees are equal in every node, bytes and size; else what differs.
std::string difference(const octomap::OcTree& a, const octomap::OcTree& b);

/// How much more than usual to test: environment variable HOCTOMAP_SWEEP, default 1.
int sweepFactor();

/// The instructions to test with: the best ones mostly, else one of the others.
Instructions instructionsFor(std::uint64_t seed);

}  // namespace hoctomap::test
