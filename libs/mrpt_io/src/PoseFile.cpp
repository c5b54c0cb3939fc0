// SPDX-License-Identifier: BSD-3-Clause
#include <charconv>
#include <cmath>
#include <fstream>
#include <string>
#include <string_view>

#include "hoctomap/geometry/Errors.h"
#include "hoctomap/io/EscapedText.h"
#include "hoctomap/mrpt_io/PoseTrack.h"

namespace hoctomap {

namespace {

constexpr std::size_t kMrptColumns = 7;
constexpr std::size_t kTumColumns = 8;
constexpr std::size_t kMaxLineBytes = 4096;

double numberFrom(std::string_view word) {
  if (word.find(',') != std::string_view::npos)
    throw InputError("'" + escapedText(word, 60) +
                     "': numbers have a decimal point and stand between spaces, without commas");
  if (word.starts_with('+')) word.remove_prefix(1);
  double value = 0.0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc{} || end != word.data() + word.size())
    throw InputError("'" + escapedText(word, 60) + "' is not a number");
  if (!std::isfinite(value)) throw InputError("'" + escapedText(word, 60) + "' is not finite");
  return value;
}

std::vector<double> numbersFrom(std::string_view line) {
  constexpr std::string_view kSpace = " \t\r";
  std::vector<double> numbers;
  for (auto at = line.find_first_not_of(kSpace); at != std::string_view::npos;) {
    const auto end = std::min(line.find_first_of(kSpace, at), line.size());
    numbers.push_back(numberFrom(line.substr(at, end - at)));
    at = line.find_first_not_of(kSpace, end);
  }
  return numbers;
}

Pose tumPose(const std::vector<double>& v) {
  const Eigen::Quaterniond q(v[7], v[4], v[5], v[6]);
  if (std::abs(q.norm() - 1.0) > 0.01)
    throw InputError("the quaternion's length is " + std::to_string(q.norm()) + " instead of 1");
  Eigen::Matrix4d matrix = Eigen::Matrix4d::Identity();
  matrix.topLeftCorner<3, 3>() = q.normalized().toRotationMatrix();
  matrix.topRightCorner<3, 1>() = Eigen::Vector3d(v[1], v[2], v[3]);
  return poseFromMatrix(matrix);
}

Pose poseFrom(const std::vector<double>& v) {
  if (v.size() == kTumColumns) return tumPose(v);
  return {v[1], v[2], v[3], v[4], v[5], v[6]};  // yaw, pitch, roll in radians
}

/// Adds the pose of one line; `columns` is the number of columns of the lines before, 0 at first.
void addLine(std::string_view line, PoseTrack& track, std::size_t& columns) {
  if (line.size() > kMaxLineBytes) throw InputError("the line is too long for a pose");
  const std::vector<double> numbers = numbersFrom(line);
  if (numbers.empty()) return;
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
  const std::string name = escapedText(file.string());
  std::error_code error;
  if (!std::filesystem::exists(file, error)) throw InputError(name + ": no such pose file");
  if (!std::filesystem::is_regular_file(file, error)) throw InputError(name + ": not a regular file");
  std::ifstream in(file, std::ios::binary);
  if (!in) throw InputError(name + ": cannot open the pose file");

  return readPoses(in, name);
}

PoseTrack readPoses(std::istream& in, const std::string& name) {
  PoseTrack track;
  std::string line;
  std::size_t columns = 0;
  for (std::size_t number = 1; std::getline(in, line); ++number) {
    if (line.starts_with('#') || line.starts_with('%')) continue;
    try {
      addLine(line, track, columns);
    } catch (const InputError& what) {
      throw InputError(name + ":" + std::to_string(number) + ": " + what.what());
    }
  }
  if (in.bad()) throw InputError(name + ": cannot read the pose file");
  if (track.empty()) throw InputError(name + ": holds no pose");
  track.finish();
  return track;
}

}  // namespace hoctomap
