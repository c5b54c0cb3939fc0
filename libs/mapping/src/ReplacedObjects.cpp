// SPDX-License-Identifier: BSD-3-Clause
#include "ReplacedObjects.h"

#include <algorithm>
#include <cmath>

#include "MovedObjects.h"
#include "SurfacePoints.h"

namespace hoctomap {

namespace {

constexpr std::size_t kMostPoints = 200;      // of the segment
constexpr double kLeastSeenThrough = 0.3;     // share of the segment
constexpr double kDrift = 0.01;               // m, by which views of one object may differ
constexpr double kVoxelDiagonal = 1.7320508;  // a voxel that a surface crosses is free in part

/// A map in which beams have left their traces.
class Traces {
 public:
  Traces(const MapHierarchy& hierarchy, NodeId id)
      : tree_(hierarchy.node(id).map().tree()),
        node_T_world_(toIsometry(hierarchy.world_T_node(id)).inverse().cast<float>()) {}

  [[nodiscard]] bool isFree(const Eigen::Vector3f& world_point) const {
    const Eigen::Vector3f p = node_T_world_ * world_point;
    const auto* leaf = tree_.search(p.x(), p.y(), p.z());
    return leaf != nullptr && !tree_.isNodeOccupied(leaf);
  }

  /// Whether an occupied voxel may lie within `distance` metres; certainly true if one does. Inner nodes,
  /// which hold the maximum of their children, answer for cubes of less than half that size.
  [[nodiscard]] bool mayBeNearSurface(const Eigen::Vector3f& world_point, double distance) const {
    const Eigen::Vector3f centre = node_T_world_ * world_point;
    const int levels = std::max(0, static_cast<int>(std::log2(0.5 * distance / tree_.getResolution())));
    const unsigned depth = tree_.getTreeDepth() - static_cast<unsigned>(levels);
    const double cube = tree_.getNodeSize(depth);
    const int reach = static_cast<int>(std::ceil(distance / cube));
    const auto isOccupied = [&](int i, int j, int k) {
      const Eigen::Vector3f p = centre + static_cast<float>(cube) * Eigen::Vector3i(i, j, k).cast<float>();
      const auto* node = tree_.search(p.x(), p.y(), p.z(), depth);
      return node != nullptr && tree_.isNodeOccupied(node);
    };
    if (isOccupied(0, 0, 0)) return true;  // nearly always
    for (int i = -reach; i <= reach; ++i) {
      for (int j = -reach; j <= reach; ++j) {
        for (int k = -reach; k <= reach; ++k) {
          if (isOccupied(i, j, k)) return true;
        }
      }
    }
    return false;
  }

  [[nodiscard]] double voxelDiagonal() const { return kVoxelDiagonal * tree_.getResolution(); }

 private:
  const octomap::OcTree& tree_;
  Eigen::Isometry3f node_T_world_;
};

/// Share of the points that lie where beams have passed: off the node's surface, by more than the views may
/// differ, and where the node's or the root's map is free.
double shareSeenThrough(const MapHierarchy& hierarchy, NodeId id, const PointCloud& world_points) {
  const Traces own(hierarchy, id);
  const Traces root(hierarchy, kRootId);
  const std::size_t step = std::max<std::size_t>(1, world_points.size() / kMostPoints);
  std::size_t asked = 0;
  std::size_t through = 0;
  for (std::size_t i = 0; i < world_points.size(); i += step) {
    const Eigen::Vector3f& p = world_points[i];
    ++asked;
    const bool seen_through = (own.isFree(p) && !own.mayBeNearSurface(p, kDrift + own.voxelDiagonal())) ||
                              (root.isFree(p) && !own.mayBeNearSurface(p, kDrift + root.voxelDiagonal()));
    through += seen_through ? 1U : 0U;
  }
  return static_cast<double>(through) / static_cast<double>(std::max<std::size_t>(1, asked));
}

}  // namespace

bool isReplaced(const MapHierarchy& hierarchy, NodeId id, const PointCloud& world_points, double range,
                const ReidentificationConfig& config) {
  const MapNode& node = hierarchy.node(id);
  if (!config.enabled || node.map().occupiedVoxels().empty()) return false;
  if (shareSeenThrough(hierarchy, id, world_points) <= kLeastSeenThrough) return false;
  const auto registration = registrationAt(config, node.map().resolution(), range);
  return registerPoints(worldSurface(hierarchy, id), world_points, registration).verdict == Match::different;
}

}  // namespace hoctomap
