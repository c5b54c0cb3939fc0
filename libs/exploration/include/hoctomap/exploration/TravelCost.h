// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "hoctomap/exploration/TraversabilityMap.h"

namespace hoctomap {

/// cost(m_trav, x_t, v) of Eq. 13: constant time for a measurement plus travel time. One sweep of Dijkstra's
/// algorithm from where the robot is prices every place; a path itself is found by A*.
class TravelCost {
 public:
  /// @param from where the robot stands; if it cannot stand there, the nearest place where it can counts.
  /// @param speed m/s. @param measuring_time s.
  TravelCost(const TraversabilityMap& map, const Eigen::Vector2d& from, double speed, double measuring_time);
  TravelCost(TraversabilityMap&&, const Eigen::Vector2d&, double, double) = delete;  // it is not kept
  ~TravelCost();
  TravelCost(const TravelCost&) = delete;
  TravelCost& operator=(const TravelCost&) = delete;
  TravelCost(TravelCost&&) = delete;
  TravelCost& operator=(TravelCost&&) = delete;

  /// Metres to go, over the centres of cells; nothing if the place cannot be reached.
  [[nodiscard]] std::optional<double> length(const Eigen::Vector2d& to) const;
  /// Seconds to go there and measure.
  [[nodiscard]] std::optional<double> seconds(const Eigen::Vector2d& to) const;
  /// From `from` to `to`, both included. Empty if the place cannot be reached.
  [[nodiscard]] std::vector<Eigen::Vector2d> path(const Eigen::Vector2d& to) const;

  [[nodiscard]] const TraversabilityMap& map() const { return map_; }

 private:
  struct Ways;
  [[nodiscard]] std::optional<std::size_t> reached(const Eigen::Vector2d& to) const;

  const TraversabilityMap& map_;
  std::unique_ptr<Ways> ways_;  ///< between cells
  Eigen::Vector2d from_;
  double speed_;
  double measuring_time_;
  std::optional<std::size_t> start_;  ///< cell; none if the robot cannot stand anywhere
  std::vector<double> lengths_;       ///< m, by cell; infinite where there is no way
};

}  // namespace hoctomap
