// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "hoctomap/geometry/Measurement.h"

namespace hoctomap {

/// The structure a segment corresponds to (Section III-B). Also the order in which segments are integrated,
/// so that parents exist: remainder, planes, clusters.
enum class Structure { remainder, plane, cluster };

/// A part z_i of a measurement.
struct Segment {
  Structure structure = Structure::remainder;
  PointIndices points;  ///< into the measurement's cloud, ascending
  /// Of a plane: n.p + d = 0 in the world frame, n pointing to the sensor's side.
  std::optional<Eigen::Hyperplane<double, 3>> plane;
};

/// The segmentation S(z) of Eq. 5. Its segments are disjoint and their union is z.
class Segmentation {
 public:
  virtual ~Segmentation() = default;
  [[nodiscard]] virtual std::vector<Segment> segment(const Measurement& z) const = 0;
};

/// A segmentation from a lambda `std::vector<Segment>(const Measurement&)`.
[[nodiscard]] std::unique_ptr<Segmentation> makeSegmentation(
    std::function<std::vector<Segment>(const Measurement&)> segment);

/// S(z) = {z}: the monolithic map of the paper's experiments.
[[nodiscard]] std::unique_ptr<Segmentation> makeWholeSegmentation();

}  // namespace hoctomap
