// SPDX-License-Identifier: BSD-3-Clause
#include "hoctomap/exploration/ViewpointSampler.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "hoctomap/geometry/Errors.h"

namespace hoctomap {

namespace {

/// What the camera looks at: a little above the table's face, where objects stand.
constexpr double kAboveFace = 0.1;  // m

std::size_t binOf(const Eigen::Vector2d& from_center, std::size_t bins) {
  const double turn = std::atan2(from_center.y(), from_center.x()) / (2.0 * std::numbers::pi) + 0.5;
  return std::min(static_cast<std::size_t>(turn * static_cast<double>(bins)), bins - 1);
}

}  // namespace

ViewpointSampler::ViewpointSampler(const ViewpointConfig& config, const RobotModel& robot)
    : config_(config), robot_(robot) {
  if (config.candidates < 1 || config.angular_bins < 1 || !(config.radius > 0.0)) {
    throw ConfigError("[exploration] candidates, bins and radius must be positive");
  }
}

std::vector<Viewpoint> ViewpointSampler::sample(const TableArea& table, const TravelCost& travel,
                                                std::uint64_t seed) const {
  const auto bins = static_cast<std::size_t>(config_.angular_bins);
  std::vector<std::vector<Eigen::Vector2d>> places(bins);
  const TraversabilityMap& map = travel.map();
  const Eigen::AlignedBox2d near(table.space.min().head<2>() - Eigen::Vector2d::Constant(config_.radius),
                                 table.space.max().head<2>() + Eigen::Vector2d::Constant(config_.radius));
  for (std::size_t i = 0; i < map.cells(); ++i) {
    const Eigen::Vector2d place = map.center(map.cell(i));
    if (!near.contains(place) || !travel.length(place) || table.distanceTo(place) > config_.radius) continue;
    places[binOf(place - table.center, bins)].push_back(place);
  }

  std::mt19937_64 rng(seed);
  const auto below = [&rng](std::size_t n) { return static_cast<std::size_t>(rng() % n); };
  const auto height = [&] {
    constexpr double kSteps = 1 << 20;
    const double share = static_cast<double>(below(std::size_t{1} << 20)) / kSteps;
    return robot_.min_sensor_height + share * (robot_.max_sensor_height - robot_.min_sensor_height);
  };
  std::vector<Viewpoint> candidates;
  const auto wanted = static_cast<std::size_t>(config_.candidates);
  bool more = true;
  while (candidates.size() < wanted && more) {
    more = false;
    for (auto& bin : places) {
      if (bin.empty() || candidates.size() == wanted) continue;
      std::swap(bin[below(bin.size())], bin.back());
      candidates.push_back(facing(table, bin.back(), height()));
      bin.pop_back();
      more = true;
    }
  }
  return candidates;
}

Viewpoint ViewpointSampler::facing(const TableArea& table, const Eigen::Vector2d& place,
                                   double sensor_height) const {
  const Eigen::Vector2d way = table.center - place;
  const double down = sensor_height - (table.top + kAboveFace);
  const double tilt = std::clamp(std::atan2(down, way.norm()), robot_.min_tilt, robot_.max_tilt);
  return {Pose(place.x(), place.y(), 0.0, std::atan2(way.y(), way.x()), 0.0, 0.0),
          Pose(0.0, 0.0, sensor_height, 0.0, tilt, 0.0)};
}

}  // namespace hoctomap
