// SPDX-License-Identifier: BSD-3-Clause
#include "hoctomap/simulation/ViewPath.h"

#include <cmath>
#include <numbers>

#include "hoctomap/geometry/Errors.h"

namespace hoctomap {
namespace {

constexpr double kMinHorizontalDistance = 1e-6;  // metres; below it the heading is undefined

void check(const ArcPath& path) {
  if (path.views < 1) throw ConfigError("a path needs at least one view");
  if (!(path.radius > 0.0)) throw ConfigError("the radius of a path must be positive");
}

View viewAtAngle(const ArcPath& path, double angle) {
  const Eigen::Vector3d eye(path.centre.x() + path.radius * std::cos(angle),
                            path.centre.y() + path.radius * std::sin(angle), path.height);
  return lookAt(eye, path.target);
}

}  // namespace

View viewOfSensor(const Pose& world_T_sensor) {
  const Pose world_T_base(world_T_sensor.x(), world_T_sensor.y(), 0.0, world_T_sensor.yaw(), 0.0, 0.0);
  return {world_T_base, -world_T_base + world_T_sensor};
}

View lookAt(const Eigen::Vector3d& eye, const Eigen::Vector3d& target) {
  const Eigen::Vector3d d = target - eye;
  const double horizontal = d.head<2>().norm();
  if (!(horizontal > kMinHorizontalDistance))
    throw ConfigError("a camera that looks straight up or down has no heading: give it a pose instead");
  // MRPT: a positive pitch turns the x axis downwards.
  return viewOfBase(eye.x(), eye.y(), std::atan2(d.y(), d.x()), eye.z(), std::atan2(-d.z(), horizontal));
}

View viewOfBase(double x, double y, double yaw, double height, double tilt) {
  return {Pose(x, y, 0.0, yaw, 0.0, 0.0), Pose(0.0, 0.0, height, 0.0, tilt, 0.0)};
}

std::vector<View> sweep(const ArcPath& path) {
  check(path);
  std::vector<View> views;
  for (int i = 0; i < path.views; ++i) {
    const double part = path.views == 1 ? 0.5 : static_cast<double>(i) / (path.views - 1);
    views.push_back(viewAtAngle(path, path.angle_begin + part * (path.angle_end - path.angle_begin)));
  }
  return views;
}

std::vector<View> circle(const ArcPath& path) {
  check(path);
  std::vector<View> views;
  for (int i = 0; i < path.views; ++i)
    views.push_back(viewAtAngle(path, path.angle_begin + 2.0 * std::numbers::pi * i / path.views));
  return views;
}

}  // namespace hoctomap
