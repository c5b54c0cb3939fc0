// SPDX-License-Identifier: BSD-3-Clause
#include "ContestedNodes.h"

#include <algorithm>

#include "SurfacePoints.h"

namespace hoctomap {

namespace {

constexpr float kSpacing = 0.004F;        // m
constexpr float kNear = 0.01F;            // m, beside a voxel: views drift apart
constexpr double kLeastAtSurface = 0.25;  // share of a segment's points

/// Number of the segment's points, of at most about 400, that lie at the node's surface, as a share.
double shareAtSurface(const PointCloud& world_points, const SurfacePoints& surface,
                      const Eigen::Isometry3f& node_T_world, float radius) {
  const std::size_t step = std::max<std::size_t>(1, world_points.size() / 400);
  std::size_t asked = 0;
  std::size_t near = 0;
  for (std::size_t i = 0; i < world_points.size(); i += step) {
    ++asked;
    near += surface.nearest(node_T_world * world_points[i], radius) ? 1U : 0U;
  }
  return static_cast<double>(near) / static_cast<double>(std::max<std::size_t>(1, asked));
}

}  // namespace

void releaseStrangers(const MapHierarchy& hierarchy, std::span<SegmentInQuestion> segments) {
  std::map<NodeId, std::vector<std::size_t>> takers;
  for (std::size_t i = 0; i < segments.size(); ++i) {
    if (segments[i].node) takers[*segments[i].node].push_back(i);
  }
  for (const auto& [id, indices] : takers) {
    const NodeMap& map = hierarchy.node(id).map();
    if (indices.size() < 2 || map.occupiedVoxels().empty()) continue;
    const SurfacePoints surface(map.occupiedVoxels(), kSpacing);
    const Eigen::Isometry3f node_T_world = toIsometry(hierarchy.world_T_node(id)).inverse().cast<float>();
    const float radius = kNear + static_cast<float>(map.resolution());
    std::vector<double> points;  // at the surface
    std::vector<double> shares;
    for (const std::size_t i : indices) {
      shares.push_back(shareAtSurface(*segments[i].world_points, surface, node_T_world, radius));
      points.push_back(shares.back() * static_cast<double>(segments[i].world_points->size()));
    }
    const auto best = std::max_element(points.begin(), points.end()) - points.begin();
    for (std::size_t k = 0; k < indices.size(); ++k) {
      if (static_cast<std::ptrdiff_t>(k) != best && shares[k] < kLeastAtSurface)
        segments[indices[k]].node.reset();
    }
  }
}

}  // namespace hoctomap
