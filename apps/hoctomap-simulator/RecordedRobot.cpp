// SPDX-License-Identifier: BSD-3-Clause
#include "RecordedRobot.h"

#include <cmath>
#include <limits>

namespace hoctomap {

namespace {

/// What a log with images of 16 bits in steps of 1 mm gives back for a depth.
float asLogged(float depth) {
  constexpr double kStep = 0.001;
  const double steps = std::round(static_cast<double>(depth) / kStep);
  if (!(steps >= 1.0 && steps <= std::numeric_limits<std::uint16_t>::max())) return 0.0F;
  return static_cast<float>(static_cast<double>(static_cast<float>(kStep)) * steps);
}

/// What the reader of a log gives back for a pose of the robot, to the last digit: it interpolates between
/// unit quaternions. (A pose as such comes back as it was.)
Pose asLogged(const Pose& pose) {
  const Eigen::Isometry3d t = toIsometry(pose);
  const Eigen::Quaterniond kept = Eigen::Quaterniond(t.linear()).normalized();
  Eigen::Matrix4d matrix = t.matrix();
  matrix.topLeftCorner<3, 3>() = kept.normalized().toRotationMatrix();
  return poseFromMatrix(matrix);
}

}  // namespace

RecordedRobot::RecordedRobot(SimulatedRobot& robot, PipeLogWriter& log, const RangeLimits& limits)
    : robot_(robot), log_(log), limits_(limits) {}

std::optional<SourceItem> RecordedRobot::next() {
  auto item = robot_.next();
  if (!item) return item;
  const auto& taken = std::get<Measurement>(*item);
  DepthScan scan{taken.scan, taken.stamp, taken.sensor, taken.world_T_sensor, *taken.image};
  for (float& depth : scan.image.depth) depth = asLogged(depth);
  const Pose world_T_base = robot_.world_T_base();
  log_.write(TruthPose{taken.stamp, "localization", world_T_base});
  log_.write(scan);
  // The log has the pose of the sensor on the base.
  const Pose world_T_sensor = asLogged(world_T_base) + (-world_T_base + taken.world_T_sensor);
  Measurement z = unproject(std::move(scan.image), world_T_sensor, limits_);
  z.scan = taken.scan;
  z.stamp = taken.stamp;
  z.sensor = taken.sensor;
  return SourceItem(std::move(z));
}

}  // namespace hoctomap
