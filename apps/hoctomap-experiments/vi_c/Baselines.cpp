// SPDX-License-Identifier: BSD-3-Clause
#include "vi_c/Baselines.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>

namespace hoctomap {

namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;

Eigen::Vector2d placeOf(const Pose& world_T_base) {
  return {world_T_base.x(), world_T_base.y()};
}

double lengthOf(const std::vector<Eigen::Vector2d>& path) {
  double length = 0.0;
  for (std::size_t i = 1; i < path.size(); ++i) length += (path[i] - path[i - 1]).norm();
  return length;
}

}  // namespace

BaselineExplorer::BaselineExplorer(Baseline baseline, const ExplorationConfig& config, int views,
                                   Robot& robot, MeasurementSource& sensor, HierarchyMapper& mapper)
    : baseline_(baseline),
      config_(config),
      views_(views),
      robot_(robot),
      sensor_(sensor),
      mapper_(mapper),
      sampler_(config.viewpoints, robot.model()) {}

void BaselineExplorer::run() {
  lookAround();
  while (const auto table = nextTable()) round(table->node);
}

void BaselineExplorer::lookAround() {
  const Pose start = robot_.world_T_base();
  const RobotModel& robot = robot_.model();
  constexpr double kTilt = 0.44;  // radians, as the explorer
  for (int i = 0; i < config_.first_look; ++i) {
    const double yaw = start.yaw() + kTurn * i / config_.first_look;
    const Viewpoint v{
        Pose(start.x(), start.y(), 0.0, yaw, 0.0, 0.0),
        Pose(0.0, 0.0, robot.max_sensor_height, 0.0, std::clamp(kTilt, robot.min_tilt, robot.max_tilt), 0.0)};
    if (robot_.moveTo(v, std::vector<Eigen::Vector2d>{placeOf(start)})) measure();
  }
  if (on_look_) on_look_();
}

void BaselineExplorer::measure() {
  mapper_.integrate(std::get<Measurement>(sensor_.next().value()));
}

/// The nearest of the tables with the fewest rounds that have not had their views.
std::optional<TableArea> BaselineExplorer::nextTable() {
  std::optional<TableArea> next;
  auto best = std::pair(std::numeric_limits<int>::max(), 0.0);
  for (TableArea& area : tableAreas(mapper_.hierarchy(), config_.space)) {
    const Visited& visited = visitedOf(area);
    const std::pair now(visited.rounds, area.distanceTo(placeOf(robot_.world_T_base())));
    if (visited.views >= views_ || (next && now >= best)) continue;
    best = now;
    next = std::move(area);
  }
  return next;
}

BaselineExplorer::Visited& BaselineExplorer::visitedOf(const TableArea& area) {
  constexpr double kSame = 0.2;  // m: its middle may be hidden, or become another as more of it is seen
  for (Visited& visited : visited_)
    if (area.distanceTo(visited.center) < kSame) return visited;
  return visited_.emplace_back(Visited{area.center});
}

void BaselineExplorer::round(NodeId table) {
  const auto area = tableArea(mapper_.hierarchy(), table, config_.space);
  Visited& visited = visitedOf(*area);
  const Eigen::Vector2d here = placeOf(robot_.world_T_base());
  const RobotModel& robot = robot_.model();
  const TraversabilityMap map(mapper_.hierarchy(), config_.traversability, robot.radius, robot.height, here);
  const TravelCost travel(map, here, robot.speed, robot.measuring_time);
  const int count = baseline_ == Baseline::circle_8 ? 8 : 4;
  const auto places = baseline_ == Baseline::random ? randomPlaces(*area, travel, count)
                                                    : circlePlaces(*area, travel, config_.viewpoints.radius,
                                                                   count, visited.rounds % 2 == 1);
  const std::size_t which = static_cast<std::size_t>(&visited - visited_.data());
  ++visited_[which].rounds;
  if (places.empty()) visited_[which].views = views_;  // out of reach
  for (const Eigen::Vector2d& place : places) {
    if (visited_[which].views >= views_) return;
    (void)view(table, place);
    ++visited_[which].views;  // tried
  }
}

bool BaselineExplorer::view(NodeId table, const Eigen::Vector2d& place) {
  if (!mapper_.hierarchy().contains(table)) return false;
  const auto area = tableArea(mapper_.hierarchy(), table, config_.space);
  if (!area) return false;
  const Eigen::Vector2d here = placeOf(robot_.world_T_base());
  const RobotModel& robot = robot_.model();
  const TraversabilityMap map(mapper_.hierarchy(), config_.traversability, robot.radius, robot.height, here);
  const TravelCost travel(map, here, robot.speed, robot.measuring_time);
  const auto path = travel.path(place);
  if (path.empty() || !robot_.moveTo(sampler_.facing(*area, place, robot.max_sensor_height), path))
    return false;
  measure();
  if (on_view_) on_view_(*area, lengthOf(path));
  return true;
}

std::vector<Eigen::Vector2d> BaselineExplorer::randomPlaces(const TableArea& area, const TravelCost& travel,
                                                            int count) {
  std::vector<Eigen::Vector2d> places;
  std::mt19937_64 random(config_.seed * 1000 + draws_++);
  const auto candidates = sampler_.sample(area, travel, random());
  if (candidates.empty()) return places;
  for (int i = 0; i < count; ++i)
    places.push_back(placeOf(candidates[random() % candidates.size()].world_T_base));
  return places;
}

/// Evenly over the directions from which the table can be seen, as near as possible to 0.8 m from its
/// outline, in the order of going around. @param between the directions in the middle between those of the
/// round before
std::vector<Eigen::Vector2d> BaselineExplorer::circlePlaces(const TableArea& area, const TravelCost& travel,
                                                            double radius, int count, bool between) {
  constexpr int kDirections = 72;
  constexpr double kDistance = 0.8;  // m
  constexpr double kStep = 0.05;     // m
  std::vector<std::pair<int, Eigen::Vector2d>> around;
  for (int d = 0; d < kDirections; ++d) {
    const double angle = kTurn * d / kDirections;
    const Eigen::Vector2d direction(std::cos(angle), std::sin(angle));
    std::optional<Eigen::Vector2d> best;
    double off = std::numeric_limits<double>::infinity();
    for (double r = kStep; r < 5.0; r += kStep) {
      const Eigen::Vector2d place = area.center + r * direction;
      const double distance = area.distanceTo(place);
      if (distance > radius || std::abs(distance - kDistance) >= off || !travel.length(place)) continue;
      best = place;
      off = std::abs(distance - kDistance);
    }
    if (best) around.emplace_back(d, *best);
  }
  if (around.empty()) return {};
  const auto lengthTo = [&travel](const Eigen::Vector2d& p) { return *travel.length(p); };
  const bool whole = around.size() == kDirections;
  // A whole circle begins where the robot is; an arc at the end of its largest gap.
  std::size_t first = 0;
  int widest = 0;
  for (std::size_t i = 0; i < around.size(); ++i) {
    const int gap =
        (around[i].first - around[(i + around.size() - 1) % around.size()].first + kDirections) % kDirections;
    if (whole ? lengthTo(around[i].second) < lengthTo(around[first].second) : gap > widest) first = i;
    widest = std::max(widest, gap);
  }
  std::rotate(around.begin(), around.begin() + static_cast<std::ptrdiff_t>(first), around.end());
  std::vector<Eigen::Vector2d> places;
  const double offset = whole == between ? 0.5 : 0.0;
  for (int k = 0; k < count; ++k) {
    const double at = (k + offset) * static_cast<double>(around.size()) / count;
    places.push_back(around[static_cast<std::size_t>(at) % around.size()].second);
  }
  if (!whole && lengthTo(places.back()) < lengthTo(places.front()))
    std::reverse(places.begin(), places.end());
  return places;
}

}  // namespace hoctomap
