// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <span>
#include <utility>

#include "hoctomap/geometry/PointCloud.h"
#include "hoctomap/geometry/Pose.h"

namespace hoctomap {

/// An oriented box: a frame and an axis-aligned box in it, which is how a map node has one (frame t_i^global
/// and the extent of m_i, Section IV-C).
struct Obb {
  Eigen::Isometry3d world_T_frame = Eigen::Isometry3d::Identity();
  Eigen::AlignedBox3d box;  ///< in the frame, metres

  [[nodiscard]] Eigen::Vector3d center() const { return world_T_frame * box.center(); }
  [[nodiscard]] bool contains(const Eigen::Vector3d& world_point) const {
    return box.contains(world_T_frame.inverse() * world_point);
  }
  /// The same box grown by `margin` metres on every side.
  [[nodiscard]] Obb padded(double margin) const;
};

/// Oriented box of a cloud along its principal components. An empty cloud gives an empty box.
[[nodiscard]] Obb pcaBox(std::span<const Eigen::Vector3f> world_points);

/// Gottschalk's separating-axis test: whether two boxes share a point. Touching boxes do; an empty box
/// intersects nothing. [S. Gottschalk, M. Lin, D. Manocha: OBBTree, SIGGRAPH 1996]
[[nodiscard]] bool intersects(const Obb& a, const Obb& b);

/// Volume of the intersection in cubic metres, estimated on a regular 16^3 grid over the smaller box.
[[nodiscard]] double overlapVolume(const Obb& a, const Obb& b);

/// Axis-aligned box in the world that encloses `obb`.
[[nodiscard]] Eigen::AlignedBox3d worldBounds(const Obb& obb);

/// Parameters t in [0, 1] between which the segment `from` + t (`to` - `from`) lies in `box`; nothing if it
/// misses.
[[nodiscard]] std::optional<std::pair<double, double>> clipSegment(const Eigen::Vector3d& from,
                                                                   const Eigen::Vector3d& to,
                                                                   const Eigen::AlignedBox3d& box);

}  // namespace hoctomap
