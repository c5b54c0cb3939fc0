// SPDX-License-Identifier: BSD-3-Clause
#include "hoctomap/simulation/SimulatedRobot.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "CounterRng.h"
#include "hoctomap/geometry/Errors.h"

namespace hoctomap {
namespace {

constexpr double kDriveStep = 0.02;      // m, between two places where the way is looked at
constexpr double kStampStep = 1.0 / 64;  // s

/// Draws of a drive; not those of any scan.
CounterRng drawsOf(std::uint64_t seed, std::uint64_t drive) {
  constexpr std::uint64_t kRobot = 0x726f626f74;  // "robot"
  return {seed ^ kRobot, drive};
}

enum Draw : std::uint64_t { fails, where, error_x, error_y, error_heading };

const SimulatedRobotConfig& robotOf(const Simulation& simulation) {
  if (!simulation.robot) throw ConfigError("the scene has no robot: it needs a section [robot]");
  check(*simulation.robot);
  return *simulation.robot;
}

FloorPlan planOf(const Scene& scene, const SimulatedRobotConfig& robot) {
  return {scene, robot.model.radius - robot.body_margin, robot.ground_clearance, robot.model.height};
}

double lengthOf(std::span<const Eigen::Vector2d> way) {
  double length = 0.0;
  for (std::size_t i = 1; i < way.size(); ++i) length += (way[i] - way[i - 1]).norm();
  return length;
}

/// How far a robot comes on a way, and what it then heads for.
struct Drive {
  Eigen::Vector2d place;
  double heading;
  double length = 0.0;
  bool arrived = true;
};

Drive drive(const FloorPlan& plan, std::span<const Eigen::Vector2d> way, double heading, double ends_after) {
  Drive done{way.front(), heading};
  // A robot that stands too near to something may drive out of it.
  bool stuck = !plan.fits(way.front());
  for (std::size_t i = 1; i < way.size(); ++i) {
    const Eigen::Vector2d leg = way[i] - way[i - 1];
    const auto steps = static_cast<int>(std::ceil(leg.norm() / kDriveStep));
    if (steps > 0) done.heading = std::atan2(leg.y(), leg.x());
    for (int s = 1; s <= steps; ++s) {
      const Eigen::Vector2d next = way[i - 1] + leg * (static_cast<double>(s) / steps);
      const bool fits = plan.fits(next);
      stuck = stuck && !fits;
      const double length = done.length + (next - done.place).norm();
      if ((!fits && !stuck) || length > ends_after) {
        done.arrived = false;
        return done;
      }
      done.length = length;
      done.place = next;
    }
  }
  done.arrived = !stuck;
  return done;
}

}  // namespace

void check(const SimulatedRobotConfig& config) {
  const RobotModel& m = config.model;
  if (!(m.radius > 0.0) || !(m.height > 0.0) || !(m.speed > 0.0) || !(m.measuring_time >= 0.0))
    throw ConfigError("robot: radius, height and speed must be positive");
  if (!(config.body_margin >= 0.0) || !(config.body_margin < m.radius))
    throw ConfigError("robot: body_margin must be below radius");
  if (!(config.ground_clearance >= 0.0) || !(config.ground_clearance < m.height))
    throw ConfigError("robot: ground_clearance must be below height");
  if (!(m.min_sensor_height > 0.0) || !(m.max_sensor_height >= m.min_sensor_height))
    throw ConfigError("robot: max_sensor_height must not be below min_sensor_height");
  if (!(m.max_tilt >= m.min_tilt)) throw ConfigError("robot: max_tilt must not be below min_tilt");
  if (!(m.max_range > m.min_range))
    throw ConfigError("robot: max_range must be above that at which the camera begins");
  if (!(config.position_error >= 0.0) || !(config.heading_error >= 0.0))
    throw ConfigError("robot: errors must not be negative");
  if (!(config.move_failure >= 0.0) || !(config.move_failure <= 1.0))
    throw ConfigError("robot: move_failure must lie in [0, 1]");
}

SimulatedRobot::SimulatedRobot(const Simulation& simulation, const RangeLimits& limits, int threads)
    : config_(robotOf(simulation)),
      script_(simulation.script),
      sensor_label_(simulation.sensor_label),
      seed_(simulation.seed),
      start_stamp_(simulation.start_stamp),
      limits_(limits),
      scene_(simulation.scene),
      sensor_(simulation.sensor, simulation.seed, threads),
      plan_(planOf(scene_, config_)) {
  const RobotModel& m = config_.model;
  believed_.base_T_sensor = Pose(0.0, 0.0, m.min_sensor_height, 0.0, 0.5 * (m.min_tilt + m.max_tilt), 0.0);
  standAt(config_.world_T_start);
}

bool SimulatedRobot::moveTo(const Viewpoint& goal, std::span<const Eigen::Vector2d> path) {
  ++drives_;
  std::vector<Eigen::Vector2d> way{place()};
  way.insert(way.end(), path.begin(), path.end());
  way.emplace_back(goal.world_T_base.x(), goal.world_T_base.y());
  const CounterRng draws = drawsOf(seed_, drives_);
  const double length = lengthOf(way);
  // A turn on the spot has no way to fail on.
  const bool fails_here = length > 0.0 && draws.uniform(Draw::fails, 0) < config_.move_failure;
  const double ends_after =
      fails_here ? draws.uniform(Draw::where, 0) * length : std::numeric_limits<double>::infinity();
  const Drive done = drive(plan_, way, believed_.world_T_base.yaw(), ends_after);
  seconds_ += done.length / config_.model.speed;
  if (!done.arrived || fails_here) {
    standAt(Pose(done.place.x(), done.place.y(), 0.0, done.heading, 0.0, 0.0));
    return false;
  }
  believed_.base_T_sensor = goal.base_T_sensor;
  standAt(goal.world_T_base);
  return true;
}

std::optional<SourceItem> SimulatedRobot::next() {
  const auto& events = script_.events();
  const bool changes =
      std::any_of(events.begin(), events.end(), [&](const SceneEvent& e) { return e.scan == scans_; });
  if (changes) {
    script_.apply(scene_, scans_);
    plan_ = planOf(scene_, config_);
  }
  seconds_ += config_.model.measuring_time;
  auto reading = sensor_.sense(scene_, world_T_trueBase() + believed_.base_T_sensor, scans_);
  Measurement z = unproject(std::move(reading.sensed.image), believed_.world_T_sensor(), limits_);
  z.scan = scans_++;
  // At least one step a scan, for robots that measure in no time.
  const double steps = std::round(seconds_ / kStampStep) + static_cast<double>(z.scan);
  z.stamp = start_stamp_ + kStampStep * steps;
  z.sensor = sensor_label_;
  return SourceItem(std::move(z));
}

Eigen::Vector2d SimulatedRobot::place() const {
  return {believed_.world_T_base.x(), believed_.world_T_base.y()};
}

void SimulatedRobot::standAt(const Pose& world_T_base) {
  believed_.world_T_base = world_T_base;
  error_ = drawError();
}

Pose SimulatedRobot::drawError() const {
  const CounterRng draws = drawsOf(seed_, drives_);
  return {config_.position_error * draws.normal(Draw::error_x, 0),
          config_.position_error * draws.normal(Draw::error_y, 0),
          0.0,
          config_.heading_error * draws.normal(Draw::error_heading, 0),
          0.0,
          0.0};
}

}  // namespace hoctomap
