// SPDX-License-Identifier: BSD-3-Clause
#include "BeamTraces.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace hoctomap {

BeamTraces::BeamTraces(const MapHierarchy& hierarchy, NodeId id)
    : tree_(hierarchy.node(id).map().tree()),
      node_T_world_(toIsometry(hierarchy.world_T_node(id)).inverse().cast<float>()) {}

bool BeamTraces::isFree(const Eigen::Vector3f& world_point) const {
  const Eigen::Vector3f p = node_T_world_ * world_point;
  const auto* leaf = tree_.search(p.x(), p.y(), p.z());
  return leaf != nullptr && !tree_.isNodeOccupied(leaf);
}

bool BeamTraces::isKnown(const Eigen::Vector3f& world_point) const {
  const Eigen::Vector3f p = node_T_world_ * world_point;
  return tree_.search(p.x(), p.y(), p.z()) != nullptr;
}

bool BeamTraces::mayBeNearSurface(const Eigen::Vector3f& world_point, double distance) const {
  // Inner nodes, which hold the maximum of their children, answer for cubes of less than half that size.
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

Eigen::Vector3f BeamTraces::voxelCentre(const Eigen::Vector3f& world_point) const {
  const double edge = tree_.getResolution();
  const Eigen::Array3d p = (node_T_world_ * world_point).cast<double>().array();
  const Eigen::Vector3d centre = (((p / edge).floor() + 0.5) * edge).matrix();
  return node_T_world_.inverse() * centre.cast<float>();
}

double BeamTraces::voxelDiagonal() const {
  return std::numbers::sqrt3 * tree_.getResolution();
}

}  // namespace hoctomap
