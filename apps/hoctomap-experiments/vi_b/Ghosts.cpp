// SPDX-License-Identifier: BSD-3-Clause
#include "vi_b/Ghosts.h"

#include <algorithm>
#include <cmath>

namespace hoctomap {

namespace {

Eigen::AlignedBox3d boundsOf(const RemovedNode& gone, double pad) {
  const Eigen::Isometry3d world_T_node = toIsometry(gone.world_T_node);
  Eigen::AlignedBox3d bounds = worldBounds({world_T_node, gone.node.map().occupiedBox()});
  const Eigen::Vector3d margin = Eigen::Vector3d::Constant(pad);
  return {bounds.min() - margin, bounds.max() + margin};
}

}  // namespace

VacatedPlace::VacatedPlace(const RemovedNode& gone, const MapHierarchy& now,
                           const std::vector<Measurement>& scans_since)
    : resolution_(gone.node.map().resolution()), object_(resolution_), measured_(resolution_) {
  const Eigen::Isometry3d world_T_node = toIsometry(gone.world_T_node);
  for (const Eigen::Vector3f& voxel : gone.node.map().occupiedVoxels()) {
    object_.insert(world_T_node * voxel.cast<double>());
  }
  // Voxels of the background may be large; what is farther away than they are has no part in it.
  const Eigen::AlignedBox3d near = boundsOf(gone, 2.0 * now.root().map().resolution());
  for (const Measurement& z : scans_since) {
    if (z.image) views_.push_back({toIsometry(z.world_T_sensor).inverse(), &*z.image});
    for (const Eigen::Vector3f& point : z.world_points) {
      if (near.contains(point.cast<double>())) measured_.insert(point.cast<double>());
    }
  }
  for (const NodeId id : now.ids()) {
    const MapNode& node = now.node(id);
    if (node.label() != labels::table) continue;
    tables_.push_back({toIsometry(now.world_T_node(id)).inverse(), &node.map().tree()});
  }
}

bool VacatedPlace::atTable(const Eigen::Vector3d& world_point) const {
  for (const Table& table : tables_) {
    const Eigen::Vector3d p = table.node_T_world * world_point;
    for (int i = 0; i < 27; ++i) {
      const Eigen::Vector3d q = p + resolution_ * Eigen::Vector3d(i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1);
      const auto* cell = table.tree->search(q.x(), q.y(), q.z());
      if (cell != nullptr && table.tree->isNodeOccupied(cell)) return true;
    }
  }
  return false;
}

bool VacatedPlace::isHidden(const Eigen::Vector3d& world_point) const {
  for (const View& view : views_) {
    const PinholeCamera& camera = view.image->camera;
    const Eigen::Vector3d p = view.sensor_T_world * world_point;
    if (p.x() <= 0.0) continue;
    const auto u = static_cast<int>(std::lround(camera.cx - camera.fx * p.y() / p.x()));
    const auto v = static_cast<int>(std::lround(camera.cy - camera.fy * p.z() / p.x()));
    if (u < 0 || v < 0 || u >= camera.width || v >= camera.height) continue;
    if (static_cast<double>(view.image->at(u, v)) > p.x()) return false;
  }
  return true;
}

std::size_t VacatedPlace::countHidden(const PointCloud& world_points) const {
  return static_cast<std::size_t>(std::count_if(world_points.begin(), world_points.end(), [&](const auto& p) {
    return isHidden(p.template cast<double>());
  }));
}

bool VacatedPlace::isGhost(const Eigen::Vector3d& world_center, double voxel) const {
  const double reach = 0.5 * voxel + resolution_;
  return object_.anyNear(world_center, reach) && !measured_.anyNear(world_center, reach) &&
         !atTable(world_center);
}

PointCloud VacatedPlace::ghostsOf(const MapHierarchy& map) const {
  PointCloud ghosts;
  for (const NodeId id : map.ids()) {
    const MapNode& node = map.node(id);
    if (node.label() == labels::table) continue;
    const Eigen::Isometry3d world_T_node = toIsometry(map.world_T_node(id));
    for (const Eigen::Vector3f& voxel : node.map().occupiedVoxels()) {
      const Eigen::Vector3d center = world_T_node * voxel.cast<double>();
      if (isGhost(center, node.map().resolution())) ghosts.emplace_back(center.cast<float>());
    }
  }
  return ghosts;
}

}  // namespace hoctomap
