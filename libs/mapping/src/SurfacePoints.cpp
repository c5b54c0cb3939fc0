// SPDX-License-Identifier: BSD-3-Clause
#include "SurfacePoints.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <utility>

namespace hoctomap {

SurfacePoints::SurfacePoints(std::span<const Eigen::Vector3f> points, float spacing) {
  using Cell = std::array<std::int32_t, 3>;
  std::vector<std::pair<Cell, std::uint32_t>> cells;
  cells.reserve(points.size());
  for (std::uint32_t i = 0; i < points.size(); ++i) {
    const Eigen::Array3i cell = (points[i] / spacing).array().floor().cast<int>();
    cells.push_back({{cell.x(), cell.y(), cell.z()}, i});
  }
  std::sort(cells.begin(), cells.end());
  highest_ = -std::numeric_limits<float>::infinity();
  for (auto it = cells.begin(); it != cells.end();) {
    Eigen::Vector3f sum = Eigen::Vector3f::Zero();
    const auto first = it;
    for (; it != cells.end() && it->first == first->first; ++it) sum += points[it->second];
    points_.push_back(sum / static_cast<float>(it - first));
    centroid_ += points_.back();
    highest_ = std::max(highest_, points_.back().z());
  }
  if (!points_.empty()) centroid_ /= static_cast<float>(points_.size());
  tree_.emplace(3, *this, nanoflann::KDTreeSingleIndexAdaptorParams(12));
  estimateNormals(spacing);
}

void SurfacePoints::estimateNormals(float spacing) {
  const float radius = 2.5F * spacing;
  std::vector<std::pair<std::uint32_t, float>> near;
  for (const auto& p : points_) {
    tree_->radiusSearch(p.data(), radius * radius, near, nanoflann::SearchParams());
    Eigen::Vector3f mean = Eigen::Vector3f::Zero();
    for (const auto& [index, distance] : near) mean += points_[index];
    mean /= static_cast<float>(near.size());
    Eigen::Matrix3f covariance = Eigen::Matrix3f::Zero();
    for (const auto& [index, distance] : near) {
      covariance += (points_[index] - mean) * (points_[index] - mean).transpose();
    }
    Eigen::SelfAdjointEigenSolver<Eigen::Matrix3f> axes;
    axes.computeDirect(covariance);
    normals_.push_back(axes.eigenvectors().col(0));
  }
}

std::optional<SurfacePoints::Neighbour> SurfacePoints::nearest(const Eigen::Vector3f& p, float radius) const {
  if (points_.empty()) return std::nullopt;
  std::size_t index = 0;
  float squared_distance = 0.0F;
  nanoflann::KNNResultSet<float> result(1);
  result.init(&index, &squared_distance);
  // Nothing beyond the radius is looked at.
  squared_distance = radius * radius;
  index = points_.size();
  tree_->findNeighbors(result, p.data(), nanoflann::SearchParams());
  if (index == points_.size() || squared_distance > radius * radius) return std::nullopt;
  return Neighbour{&points_[index], &normals_[index], squared_distance};
}

PointCloud worldSurface(const MapHierarchy& hierarchy, NodeId id) {
  const Eigen::Isometry3f world_T_node = toIsometry(hierarchy.world_T_node(id)).cast<float>();
  PointCloud surface;
  for (const auto& voxel : hierarchy.node(id).map().occupiedVoxels()) surface.push_back(world_T_node * voxel);
  return surface;
}

}  // namespace hoctomap
