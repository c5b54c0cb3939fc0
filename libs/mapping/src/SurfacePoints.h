// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <nanoflann.hpp>
#include <optional>
#include <span>
#include <vector>

#include "hoctomap/hierarchy/MapHierarchy.h"

namespace hoctomap {

/// Points of a surface, thinned, with their normals and a search tree.
class SurfacePoints {
 public:
  /// Keeps the mean of the points in each cube of `spacing`, in an order that depends on the points only.
  SurfacePoints(std::span<const Eigen::Vector3f> points, float spacing);
  // The tree refers to the points.
  SurfacePoints(const SurfacePoints&) = delete;
  SurfacePoints& operator=(const SurfacePoints&) = delete;

  [[nodiscard]] const std::vector<Eigen::Vector3f>& points() const { return points_; }
  [[nodiscard]] const Eigen::Vector3f& centroid() const { return centroid_; }
  [[nodiscard]] float highest() const { return highest_; }

  struct Neighbour {
    const Eigen::Vector3f* point;
    const Eigen::Vector3f* normal;  ///< of the surface there; its sign means nothing
    float squared_distance;         ///< m^2
  };
  /// Nearest point; nothing if there is none within `radius`.
  [[nodiscard]] std::optional<Neighbour> nearest(const Eigen::Vector3f& p, float radius) const;

  // nanoflann's names
  [[nodiscard]] std::size_t kdtree_get_point_count() const { return points_.size(); }
  [[nodiscard]] float kdtree_get_pt(std::size_t i, std::size_t axis) const {
    return points_[i][static_cast<Eigen::Index>(axis)];
  }
  template <typename Box>
  bool kdtree_get_bbox(Box&) const {
    return false;
  }

 private:
  using Tree = nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<float, SurfacePoints>,
                                                   SurfacePoints, 3>;
  void estimateNormals(float spacing);

  std::vector<Eigen::Vector3f> points_;
  std::vector<Eigen::Vector3f> normals_;
  Eigen::Vector3f centroid_ = Eigen::Vector3f::Zero();
  float highest_ = 0.0F;
  std::optional<Tree> tree_;
};

/// Centres of a node's occupied voxels in the world, m.
[[nodiscard]] PointCloud worldSurface(const MapHierarchy& hierarchy, NodeId id);

}  // namespace hoctomap
