// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <fstream>
#include <string>
#include <string_view>

#include "hoctomap/geometry/Errors.h"
#include "hoctomap/io/EscapedText.h"
#include "hoctomap/io/NumberLines.h"
#include "hoctomap/io/PoseTrack.h"

namespace hoctomap {

namespace {

constexpr std::size_t kMrptColumns = 7;
constexpr std::size_t kTumColumns = 8;

Pose tumPose(const std::vector<double>& v) {
  const Eigen::Quaterniond q(v[7], v[4], v[5], v[6]);
  if (std::abs(q.norm() - 1.0) > 0.01)
    throw InputError("the quaternion's length is " + std::to_string(q.norm()) + " instead of 1");
  Eigen::Matrix4d matrix = Eigen::Matrix4d::Identity();
  matrix.topLeftCorner<3, 3>() = q.normalized().toRotationMatrix();
  matrix.topRightCorner<3, 1>() = Eigen::Vector3d(v[1], v[2], v[3]);
  return poseFromInput(matrix, "pose");
}

Pose poseFrom(const std::vector<double>& v) {
  if (v.size() == kTumColumns) return tumPose(v);
  return {v[1], v[2], v[3], v[4], v[5], v[6]};  // yaw, pitch, roll in radians
}

/// Adds the pose of one line; `columns` is the number of columns of the lines before, 0 at first.
void addLine(std::string_view line, PoseTrack& track, std::size_t& columns) {
  const std::vector<double> numbers = numbersFrom(line);
  if (numbers.size() != kMrptColumns && numbers.size() != kTumColumns)
    throw InputError(std::to_string(numbers.size()) +
                     " columns instead of 7 (t x y z yaw pitch roll) or 8 (t x y z qx qy qz qw)");
  if (columns != 0 && numbers.size() != columns)
    throw InputError(std::to_string(numbers.size()) + " columns after lines of " + std::to_string(columns));
  columns = numbers.size();
  if (!track.empty() && numbers[0] < track.lastStamp()) throw InputError("the times are not ascending");
  track.add(numbers[0], poseFrom(numbers));
}

}  // namespace

PoseTrack readPoseFile(const std::filesystem::path& file) {
  std::ifstream in = openText(file, "pose file");
  return readPoses(in, escapedText(file.string()));
}

PoseTrack readPoses(std::istream& in, const std::string& name) {
  PoseTrack track;
  std::size_t columns = 0;
  forEachLine(in, name, [&](std::string_view line, std::size_t) { addLine(line, track, columns); });
  if (track.empty()) throw InputError(name + ": holds no pose");
  track.finish();
  return track;
}

}  // namespace hoctomap
