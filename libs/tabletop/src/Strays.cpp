// SPDX-License-Identifier: BSD-3-Clause
#include "Strays.h"

#include <algorithm>
#include <cmath>
#include <nanoflann.hpp>

namespace hoctomap {
namespace {

/// All objects' points, for nanoflann, with the object that each belongs to.
struct ObjectPoints {
  PointCloud points;
  std::vector<std::size_t> object;

  // nanoflann's names
  [[nodiscard]] std::size_t kdtree_get_point_count() const { return points.size(); }
  [[nodiscard]] float kdtree_get_pt(std::size_t i, std::size_t axis) const {
    return points[i][static_cast<Eigen::Index>(axis)];
  }
  template <typename Box>
  bool kdtree_get_bbox(Box&) const {
    return false;
  }
};

using Tree =
    nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<float, ObjectPoints>, ObjectPoints, 3>;

/// The nearest object within `radius` of a point.
std::optional<std::size_t> nearestObject(const Tree& tree, const ObjectPoints& cloud,
                                         const Eigen::Vector3f& p, float radius) {
  if (cloud.points.empty()) return std::nullopt;
  std::uint32_t index = 0;
  float squared_distance = 0.0F;
  if (tree.knnSearch(p.data(), 1, &index, &squared_distance) == 0 || squared_distance > radius * radius) {
    return std::nullopt;
  }
  return cloud.object[index];
}

}  // namespace

void attachStrays(const Measurement& z, std::vector<TableSurface>& tables, std::vector<PointIndices>& objects,
                  const TabletopSegmentationConfig& config) {
  ObjectPoints cloud;
  std::vector<bool> taken(z.world_points.size(), false);
  for (const auto& table : tables) {
    for (const auto i : table.points) taken[i] = true;
  }
  for (std::size_t k = 0; k < objects.size(); ++k) {
    for (const auto i : objects[k]) {
      taken[i] = true;
      cloud.points.push_back(z.world_points[i]);
      cloud.object.push_back(k);
    }
  }
  const Tree tree(3, cloud, nanoflann::KDTreeSingleIndexAdaptorParams(16));

  const Eigen::Vector3d origin = z.origin();
  for (std::uint32_t i = 0; i < z.world_points.size(); ++i) {
    if (taken[i]) continue;
    const Eigen::Vector3d p = z.world_points[i].cast<double>();
    for (auto& table : tables) {
      const double height = table.plane.signedDistance(p);
      const double flat = config.flatHeight((p - origin).norm());
      if (height < -flat || height > config.object_height_max) continue;
      const auto cell = table.grid.cellOf(p.x(), p.y());
      if (cell >= table.grid.size() || !table.extent[cell]) continue;
      if (std::abs(height) <= flat) {
        table.points.push_back(i);
      } else if (const auto object = nearestObject(tree, cloud, z.world_points[i],
                                                   static_cast<float>(config.cluster_tolerance))) {
        objects[*object].push_back(i);
      } else {
        continue;
      }
      break;
    }
  }
  for (auto& object : objects) std::sort(object.begin(), object.end());
  for (auto& table : tables) std::sort(table.points.begin(), table.points.end());
}

}  // namespace hoctomap
