// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "hoctomap/geometry/Measurement.h"
#include "hoctomap/mapping/Segmentation.h"
#include "hoctomap/octree/NodeMap.h"
#include "support/RandomScenes.h"

namespace hoctomap::test {

/// A world of axis-aligned boxes, and a depth camera in it.
struct BoxScene {
  std::vector<Eigen::AlignedBox3d> boxes;

  /// Adds a box by the centre of its bottom and its sizes; returns its index.
  std::size_t add(double x, double y, double bottom, double size_x, double size_y, double size_z);

  /// A picture taken from `eye` towards `target`; with noise of 0.0015 z^2 if there is a generator.
  [[nodiscard]] Measurement look(const Eigen::Vector3d& eye, const Eigen::Vector3d& target,
                                 Rng* noise = nullptr) const;
};

/// Number of points of `segment` that lie in `box`, grown by 2 cm.
std::size_t pointsIn(const Measurement& z, const Segment& segment, const Eigen::AlignedBox3d& box);

/// The segments of one kind.
std::vector<Segment> ofKind(const std::vector<Segment>& segments, Structure structure);

/// A map whose voxels are occupied within the box (its frame).
NodeMap filledMap(double resolution, const Eigen::AlignedBox3d& box);

}  // namespace hoctomap::test
