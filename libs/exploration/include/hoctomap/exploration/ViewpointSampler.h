// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "hoctomap/exploration/Robot.h"
#include "hoctomap/exploration/TableArea.h"
#include "hoctomap/exploration/TravelCost.h"

namespace hoctomap {

struct ViewpointConfig {
  double radius = 1.2;    ///< m from the table's outline, at most
  int candidates = 100;   ///< in a set V
  int angular_bins = 20;  ///< around the table: as many candidates in each as there is room for
};

/// Draws the set V of Algorithm 1: poses in the traversable area that can be reached, within a radius of the
/// table, facing it. Stratified over the directions around the table. The same seed gives the same set.
class ViewpointSampler {
 public:
  ViewpointSampler(const ViewpointConfig& config, const RobotModel& robot);

  /// @return empty if no place near the table can be reached.
  [[nodiscard]] std::vector<Viewpoint> sample(const TableArea& table, const TravelCost& travel,
                                              std::uint64_t seed) const;

  /// The viewpoint of a place on the floor: the base and the camera face the table's middle.
  [[nodiscard]] Viewpoint facing(const TableArea& table, const Eigen::Vector2d& place,
                                 double sensor_height) const;

 private:
  ViewpointConfig config_;
  RobotModel robot_;
};

}  // namespace hoctomap
