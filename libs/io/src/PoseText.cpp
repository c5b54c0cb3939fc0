// SPDX-License-Identifier: BSD-3-Clause
#include "PoseText.h"

#include <mrpt/core/bits_math.h>

#include <cmath>
#include <vector>

#include "NumberText.h"

namespace hoctomap {

std::string poseText(const Pose& pose) {
  const Pose plain = poseFromNumbers(matrixNumbers(pose));  // angles computed, not remembered
  std::string text = "[";
  for (const double value : {plain.x(), plain.y(), plain.z(), mrpt::RAD2DEG(plain.yaw()),
                             mrpt::RAD2DEG(plain.pitch()), mrpt::RAD2DEG(plain.roll())}) {
    if (text.size() > 1) text += ' ';
    text += yamlNumber(value);
  }
  return text + "]";
}

std::optional<Pose> parsePoseText(std::string_view text) {
  if (!text.starts_with('[') || !text.ends_with(']')) return {};
  text = text.substr(1, text.size() - 2);
  std::vector<double> values;
  while (true) {
    const auto begin = text.find_first_not_of(" ,");
    if (begin == std::string_view::npos) break;
    text.remove_prefix(begin);
    const auto word = text.substr(0, text.find_first_of(" ,"));
    const auto value = parseNumber(word);
    if (!value) return {};
    values.push_back(*value);
    text.remove_prefix(word.size());
  }
  if (values.size() != 6) return {};
  return Pose(values[0], values[1], values[2], mrpt::DEG2RAD(values[3]), mrpt::DEG2RAD(values[4]),
              mrpt::DEG2RAD(values[5]));
}

std::array<double, 16> matrixNumbers(const Pose& pose) {
  const auto matrix = pose.getHomogeneousMatrixVal<mrpt::math::CMatrixDouble44>();
  std::array<double, 16> numbers{};
  for (int row = 0; row < 4; ++row) {
    for (int column = 0; column < 4; ++column) {
      numbers.at(static_cast<std::size_t>(4 * row + column)) = matrix(row, column);
    }
  }
  return numbers;
}

Pose poseFromNumbers(const std::array<double, 16>& numbers) {
  Eigen::Matrix4d matrix;
  for (Eigen::Index i = 0; i < 16; ++i) matrix(i / 4, i % 4) = numbers.at(static_cast<std::size_t>(i));
  Pose pose = poseFromMatrix(matrix);  // validates
  mrpt::math::CMatrixDouble33 rotation;
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) rotation(row, column) = matrix(row, column);
  }
  pose.setRotationMatrix(rotation);  // and here bit for bit
  pose.x(matrix(0, 3));
  pose.y(matrix(1, 3));
  pose.z(matrix(2, 3));
  return pose;
}

bool nearlyEqual(const Pose& a, const Pose& b, double tolerance) {
  const auto left = matrixNumbers(a);
  const auto right = matrixNumbers(b);
  for (std::size_t i = 0; i < left.size(); ++i) {
    if (!(std::abs(left.at(i) - right.at(i)) <= tolerance)) return false;
  }
  return true;
}

}  // namespace hoctomap
