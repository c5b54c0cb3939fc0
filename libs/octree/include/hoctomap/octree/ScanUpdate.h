// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <octomap/OcTree.h>

#include <Eigen/Geometry>
#include <memory>
#include <optional>
#include <span>

#include "hoctomap/geometry/PointCloud.h"

namespace hoctomap {

/// The beams of one scan for one node map, all in the node's frame (after Eq. 12).
struct Beams {
  Eigen::Vector3f origin = Eigen::Vector3f::Zero();  ///< o'_z
  std::span<const Eigen::Vector3f> hits;       ///< endpoints in this node: carve up to them, then occupied
  std::span<const Eigen::Vector3f> passing;    ///< endpoints in other nodes: only carve up to them
  std::span<const Eigen::Vector3f> endpoints;  ///< only become occupied; what their beams clear is `passing`
  /// Beams longer than this are cut: free up to it and no endpoint, as in stock OctoMap. Negative: no limit.
  double max_range = -1.0;
  /// Only voxels whose key lies between the keys of the corners (inclusive) are updated. Empty: unbounded.
  std::optional<Eigen::AlignedBox3d> bounds;
};

/// What became of the endpoints of one update.
struct ScanUpdateReport {
  std::size_t beyond_key_range = 0;  ///< endpoints that no key of the tree can address: dropped
};

/// Integrates the beams of one scan into an octree (Section IV-B).
///
/// Guarantees of every implementation:
///  1. each voxel is updated at most once a scan, occupied wins over free;
///  2. free voxels are those that stock OctoMap's `computeRayKeys` visits and that lie within the bounds;
///  3. the tree is left pruned with inner nodes up to date, whatever order the voxels were updated in;
///  4. with `hits` alone and no bounds the result equals stock `insertPointCloud`.
class ScanUpdate {
 public:
  virtual ~ScanUpdate() = default;
  virtual ScanUpdateReport apply(octomap::OcTree& tree, const Beams& beams) const = 0;
};

/// The simple version: key sets, then one `updateNode` a key. Slow, and the oracle of any faster one.
[[nodiscard]] std::unique_ptr<ScanUpdate> makeReferenceScanUpdate();

}  // namespace hoctomap
