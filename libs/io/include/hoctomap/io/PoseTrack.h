// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <filesystem>
#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

#include "hoctomap/geometry/Pose.h"

namespace hoctomap {

/// The pose of a homogeneous matrix of foreign numbers. @param what for messages: "pose"
/// @throws InputError "bad pose: ..." where poseFromMatrix() throws.
[[nodiscard]] Pose poseFromInput(const Eigen::Matrix4d& matrix, const std::string& what);

/// Poses over time, interpolated between neighbours, never extrapolated.
class PoseTrack {
 public:
  /// @throws InputError if the pose is not finite and orthonormal, or another pose stands at the same time
  /// right
  ///         before it.
  void add(double stamp, const Pose& world_T_base);

  /// Sorts; call once after the last add().
  /// @throws InputError if one time has two different poses.
  void finish();

  [[nodiscard]] bool empty() const { return entries_.empty(); }
  [[nodiscard]] std::size_t size() const { return entries_.size(); }
  [[nodiscard]] double firstStamp() const { return entries_.front().stamp; }
  [[nodiscard]] double lastStamp() const { return entries_.back().stamp; }

  /// Pose at `stamp`: that of the entry of that very time; else, between two entries at most `max_gap`
  /// seconds apart, linear in translation and by slerp (shorter way) in rotation; else nothing.
  [[nodiscard]] std::optional<Pose> at(double stamp, double max_gap) const;

 private:
  struct Entry {
    double stamp;
    Eigen::Vector3d translation;
    Eigen::Quaterniond rotation;
  };
  static bool samePose(const Entry& a, const Entry& b);
  static Pose poseOf(const Eigen::Vector3d& translation, const Eigen::Quaterniond& rotation);

  std::vector<Entry> entries_;
};

/// Reads a text file of poses: MRPT's 7 columns `t x y z yaw pitch roll` (radians, as
/// CPose3DInterpolator::saveToTextFile writes) or TUM's 8 columns `t x y z qx qy qz qw`, told apart by the
/// number of columns. Seconds since the epoch, metres. Lines that are empty or start with `#` or `%` are
/// passed over.
/// @throws InputError with the line number for anything else: another number of columns, decimal commas, NaN,
/// a
///         quaternion that is no unit quaternion to 1 %, times not ascending, one time with two poses.
[[nodiscard]] PoseTrack readPoseFile(const std::filesystem::path& file);

/// The same from a stream; `name` stands for the file in messages.
[[nodiscard]] PoseTrack readPoses(std::istream& in, const std::string& name);

}  // namespace hoctomap
