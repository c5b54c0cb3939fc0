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

/// Points of a surface, thinned, with a search tree.
class SurfacePoints {
 public:
  /// Keeps the mean of the points in each cube of `spacing`, in an order that depends on the points only.
  SurfacePoints(std::span<const Eigen::Vector3f> points, float spacing);
  // The tree refers to the points.
  SurfacePoints(const SurfacePoints&) = delete;
  SurfacePoints& operator=(const SurfacePoints&) = delete;

  [[nodiscard]] const std::vector<Eigen::Vector3f>& points() const { return points_; }
  [[nodiscard]] std::size_t size() const { return points_.size(); }

  struct Neighbour {
    std::size_t index;
    float squared_distance;  ///< m^2
  };
  /// Nearest point; nothing if there is none within `radius`.
  [[nodiscard]] std::optional<Neighbour> nearest(const Eigen::Vector3f& p, float radius) const;
  /// Nearest point for which `keep(index)` is true; nothing if there is none within `radius`.
  template <typename Keep>
  [[nodiscard]] std::optional<Neighbour> nearestOf(const Eigen::Vector3f& p, float radius,
                                                   const Keep& keep) const {
    NearestOf<Keep> result{keep, {points_.size(), radius * radius}};
    if (!points_.empty()) tree_->findNeighbors(result, p.data(), nanoflann::SearchParams());
    if (result.best.index == points_.size()) return std::nullopt;
    return result.best;
  }
  /// Distance of a point's n-th neighbour beside itself, m; of the last one if there are fewer.
  [[nodiscard]] float distanceToNeighbour(const Eigen::Vector3f& p, std::size_t n) const;
  /// Calls `visit(index)` for every point within `radius`.
  template <typename Visit>
  void forPointsNear(const Eigen::Vector3f& p, float radius, const Visit& visit) const {
    Visitor<Visit> visitor{visit, radius * radius};
    if (!points_.empty()) tree_->findNeighbors(visitor, p.data(), nanoflann::SearchParams());
  }

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
  /// A result set of nanoflann that keeps nothing.
  template <typename Visit>
  struct Visitor {
    using DistanceType = float;
    const Visit& visit;
    float squared_radius;

    bool addPoint(float, std::size_t index) {
      visit(index);
      return true;
    }
    [[nodiscard]] float worstDist() const { return squared_radius; }
    [[nodiscard]] bool full() const { return true; }
  };

  /// A result set that keeps the nearest of some.
  template <typename Keep>
  struct NearestOf {
    using DistanceType = float;
    const Keep& keep;
    Neighbour best;

    bool addPoint(float squared_distance, std::size_t index) {
      if (squared_distance < best.squared_distance && keep(index)) best = {index, squared_distance};
      return true;
    }
    [[nodiscard]] float worstDist() const { return best.squared_distance; }
    [[nodiscard]] bool full() const { return true; }
  };

  std::vector<Eigen::Vector3f> points_;
  std::optional<Tree> tree_;
};

/// Centres of a node's occupied voxels in the world, m.
[[nodiscard]] PointCloud worldSurface(const MapHierarchy& hierarchy, NodeId id);

}  // namespace hoctomap
