// SPDX-License-Identifier: BSD-3-Clause
#include "TableScene.h"

namespace hoctomap::testing {

void setVoxels(octomap::OcTree& tree, const Eigen::AlignedBox3d& box, bool occupied) {
  const double r = tree.getResolution();
  for (double x = box.min().x() + 0.5 * r; x < box.max().x(); x += r) {
    for (double y = box.min().y() + 0.5 * r; y < box.max().y(); y += r) {
      for (double z = box.min().z() + 0.5 * r; z < box.max().z(); z += r) {
        tree.updateNode(x, y, z, occupied);
      }
    }
  }
}

NodeMap mapOf(double resolution, const Boxes& boxes) {
  auto tree = std::make_unique<octomap::OcTree>(resolution);
  OccupancyModel{}.applyTo(*tree);
  for (const auto& b : boxes.free) setVoxels(*tree, b, false);
  for (const auto& b : boxes.occupied) setVoxels(*tree, b, true);
  return {std::move(tree), OccupancyModel{}};
}

Eigen::AlignedBox3d box(double x0, double y0, double z0, double x1, double y1, double z1) {
  return {Eigen::Vector3d(x0, y0, z0), Eigen::Vector3d(x1, y1, z1)};
}

MapHierarchy roomWithTable() {
  MapHierarchy map(labels::background,
                   mapOf(0.05, {.free = {box(-2.0, -2.0, 0.1, 2.0, 2.0, 1.3)}, .occupied = {}}));
  map.add(labels::table, mapOf(0.01, {.free = {}, .occupied = {box(-0.5, -0.3, 0.68, 0.5, 0.3, 0.7)}}),
          Pose(), kRootId);
  return map;
}

}  // namespace hoctomap::testing
