// SPDX-License-Identifier: BSD-3-Clause
#include "hoctomap/io/PoseTrack.h"

#include <algorithm>
#include <cmath>

#include "hoctomap/geometry/Errors.h"

namespace hoctomap {

Pose poseFromInput(const Eigen::Matrix4d& matrix, const std::string& what) {
  try {
    return poseFromMatrix(matrix);
  } catch (const std::invalid_argument& error) {
    throw InputError("bad " + what + ": " + error.what());
  }
}

void PoseTrack::add(double stamp, const Pose& world_T_base) {
  if (!std::isfinite(stamp)) throw InputError("the time is not finite");
  const Eigen::Matrix4d matrix = toIsometry(world_T_base).matrix();
  (void)poseFromInput(matrix, "pose");
  const Eigen::Matrix3d rotation = matrix.topLeftCorner<3, 3>();
  const Entry entry{stamp, matrix.topRightCorner<3, 1>(), Eigen::Quaterniond(rotation).normalized()};
  if (!entries_.empty() && entries_.back().stamp == stamp) {
    if (!samePose(entries_.back(), entry)) throw InputError("a second, different pose at the same time");
    return;
  }
  entries_.push_back(entry);
}

void PoseTrack::finish() {
  const auto earlier = [](const Entry& a, const Entry& b) { return a.stamp < b.stamp; };
  std::stable_sort(entries_.begin(), entries_.end(), earlier);
  const auto clash = std::adjacent_find(entries_.begin(), entries_.end(), [](const Entry& a, const Entry& b) {
    return a.stamp == b.stamp && !samePose(a, b);
  });
  if (clash != entries_.end())
    throw InputError("two different poses at the same time " + std::to_string(clash->stamp));
}

std::optional<Pose> PoseTrack::at(double stamp, double max_gap) const {
  const auto after = std::lower_bound(entries_.begin(), entries_.end(), stamp,
                                      [](const Entry& entry, double t) { return entry.stamp < t; });
  if (after == entries_.end()) return std::nullopt;
  if (after->stamp == stamp) return poseOf(after->translation, after->rotation);
  if (after == entries_.begin()) return std::nullopt;
  const auto before = std::prev(after);
  const double gap = after->stamp - before->stamp;
  if (gap > max_gap) return std::nullopt;
  const double fraction = (stamp - before->stamp) / gap;
  return poseOf(before->translation + fraction * (after->translation - before->translation),
                before->rotation.slerp(fraction, after->rotation));
}

bool PoseTrack::samePose(const Entry& a, const Entry& b) {
  constexpr double kTolerance = 1e-9;  // rounding of what is meant to be one pose
  return (a.translation - b.translation).norm() <= kTolerance &&
         a.rotation.angularDistance(b.rotation) <= 1e-7;
}

Pose PoseTrack::poseOf(const Eigen::Vector3d& translation, const Eigen::Quaterniond& rotation) {
  Eigen::Matrix4d matrix = Eigen::Matrix4d::Identity();
  matrix.topLeftCorner<3, 3>() = rotation.normalized().toRotationMatrix();
  matrix.topRightCorner<3, 1>() = translation;
  return poseFromMatrix(matrix);
}

}  // namespace hoctomap
