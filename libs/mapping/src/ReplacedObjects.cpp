// SPDX-License-Identifier: BSD-3-Clause
#include "ReplacedObjects.h"

#include <algorithm>

#include "BeamTraces.h"
#include "MovedObjects.h"
#include "SurfacePoints.h"

namespace hoctomap {

namespace {

constexpr std::size_t kMostPoints = 200;   // of the segment
constexpr double kLeastSeenThrough = 0.3;  // share of the segment
constexpr double kDrift = 0.01;            // m, by which views of one object may differ

/// Share of the points that lie where beams have passed: where the node's map is free, off its surface by
/// more than the views may differ, or in a free voxel of the root's map that none of that surface crosses.
double shareSeenThrough(const MapHierarchy& hierarchy, NodeId id, const PointCloud& world_points) {
  const BeamTraces own(hierarchy, id);
  const BeamTraces root(hierarchy, kRootId);
  const std::size_t step = std::max<std::size_t>(1, world_points.size() / kMostPoints);
  std::size_t asked = 0;
  std::size_t through = 0;
  for (std::size_t i = 0; i < world_points.size(); i += step) {
    const Eigen::Vector3f& p = world_points[i];
    ++asked;
    const bool seen_through =
        (own.isFree(p) && !own.mayBeNearSurface(p, kDrift + own.voxelDiagonal())) ||
        (root.isFree(p) && !own.mayBeNearSurface(root.voxelCentre(p), kDrift + 0.5 * root.voxelDiagonal()));
    through += seen_through ? 1U : 0U;
  }
  return static_cast<double>(through) / static_cast<double>(std::max<std::size_t>(1, asked));
}

/// Whether the segment shows much of the node's surface: then the node is a piece of what the segment shows.
bool isPieceOf(const PointCloud& world_points, const PointCloud& surface) {
  constexpr float kSpacing = 0.004F;    // m
  constexpr double kLeastCommon = 0.5;  // share of the surface
  const SurfacePoints segment(world_points, kSpacing);
  const std::size_t step = std::max<std::size_t>(1, surface.size() / kMostPoints);
  std::size_t asked = 0;
  std::size_t common = 0;
  for (std::size_t i = 0; i < surface.size(); i += step) {
    ++asked;
    common += segment.nearest(surface[i], static_cast<float>(kDrift)) ? 1U : 0U;
  }
  return static_cast<double>(common) > kLeastCommon * static_cast<double>(asked);
}

}  // namespace

bool isReplaced(const MapHierarchy& hierarchy, NodeId id, const PointCloud& world_points, double range,
                const ReidentificationConfig& config) {
  const MapNode& node = hierarchy.node(id);
  if (!config.enabled || node.map().occupiedVoxels().empty()) return false;
  if (shareSeenThrough(hierarchy, id, world_points) <= kLeastSeenThrough) return false;
  const PointCloud surface = worldSurface(hierarchy, id);
  if (isPieceOf(world_points, surface)) return false;
  const auto registration = registrationAt(config, node.map().resolution(), range);
  return registerPoints(surface, world_points, registration).verdict == Match::different;
}

}  // namespace hoctomap
