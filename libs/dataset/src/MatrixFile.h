// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <vector>

#include "hoctomap/geometry/Pose.h"

namespace hoctomap {

/// Rows of numbers, as many a line as `columns` says.
/// @throws InputError with file and line
[[nodiscard]] std::vector<std::vector<double>> readRows(const std::filesystem::path& file,
                                                        const std::string& what, std::size_t columns);

/// The pose of a matrix of a text file, whose digits make it orthonormal to some 1e-3 only: the nearest one.
/// @param upper 3x4
/// @throws InputError if it is further from a rotation than that, or a reflection
[[nodiscard]] Pose nearestPose(const Eigen::Matrix<double, 3, 4>& upper);

/// Pose of twelve numbers, row by row.
[[nodiscard]] Pose poseFromRow(const std::vector<double>& row);

}  // namespace hoctomap
