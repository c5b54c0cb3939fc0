// SPDX-License-Identifier: BSD-3-Clause
#include "MatrixFile.h"

#include <Eigen/SVD>

#include "hoctomap/geometry/Errors.h"
#include "hoctomap/io/EscapedText.h"
#include "hoctomap/io/NumberLines.h"
#include "hoctomap/io/PoseTrack.h"

namespace hoctomap {

std::vector<std::vector<double>> readRows(const std::filesystem::path& file, const std::string& what,
                                          std::size_t columns) {
  std::ifstream in = openText(file, what);
  std::vector<std::vector<double>> rows;
  forEachLine(in, escapedText(file.string()), [&](std::string_view line, std::size_t) {
    rows.push_back(numbersFrom(line));
    if (rows.back().size() != columns)
      throw InputError(std::to_string(rows.back().size()) + " columns instead of " + std::to_string(columns));
  });
  return rows;
}

Pose nearestPose(const Eigen::Matrix<double, 3, 4>& upper) {
  constexpr double kTolerance = 1e-3;
  const Eigen::Matrix3d r = upper.leftCols<3>();
  if (!((r.transpose() * r - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff() <= kTolerance))
    throw InputError("the pose is not orthonormal");
  if (r.determinant() < 0.0) throw InputError("the pose is a reflection");
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(r, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Eigen::Matrix4d m = Eigen::Matrix4d::Identity();
  m.topLeftCorner<3, 3>() = svd.matrixU() * svd.matrixV().transpose();
  m.topRightCorner<3, 1>() = upper.col(3);
  return poseFromInput(m, "pose");
}

Pose poseFromRow(const std::vector<double>& row) {
  return nearestPose(Eigen::Map<const Eigen::Matrix<double, 3, 4, Eigen::RowMajor>>(row.data()));
}

}  // namespace hoctomap
