// SPDX-License-Identifier: BSD-3-Clause
#include "hoctomap/geometry/Pose.h"

#include <mrpt/math/CMatrixFixed.h>

#include <stdexcept>

namespace hoctomap {

namespace {

Pose fromRotationAndTranslation(const Eigen::Matrix3d& rotation, const Eigen::Vector3d& translation) {
  mrpt::math::CMatrixDouble33 r;
  r.asEigen() = rotation;
  mrpt::math::CVectorFixedDouble<3> t;
  t.asEigen() = translation;
  return Pose(r, t);
}

Eigen::Matrix3d nearestRotation(const Eigen::Matrix3d& m) {
  return Eigen::Quaterniond(m).normalized().toRotationMatrix();
}

}  // namespace

Eigen::Isometry3d toIsometry(const Pose& pose) {
  Eigen::Isometry3d t = Eigen::Isometry3d::Identity();
  t.linear() = pose.getRotationMatrix().asEigen();
  t.translation() = Eigen::Vector3d(pose.x(), pose.y(), pose.z());
  return t;
}

Pose poseFromMatrix(const Eigen::Matrix4d& matrix) {
  if (!matrix.allFinite()) throw std::invalid_argument("pose is not finite");
  // A thousand kilometres, as for points: beyond it single precision tells nothing apart, and sums of poses
  // overflow.
  constexpr double kFarthest = 1e6;
  if (matrix.topRightCorner<3, 1>().cwiseAbs().maxCoeff() > kFarthest) {
    throw std::invalid_argument("pose is more than 1000 km from the origin");
  }
  const Eigen::Matrix3d rotation = matrix.topLeftCorner<3, 3>();
  if ((rotation.transpose() * rotation - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff() > 1e-6) {
    throw std::invalid_argument("rotation of pose is not orthonormal");
  }
  if (rotation.determinant() < 0.0) throw std::invalid_argument("pose is a reflection");
  if ((matrix.row(3) - Eigen::RowVector4d(0, 0, 0, 1)).cwiseAbs().maxCoeff() > 1e-9) {
    throw std::invalid_argument("last row of pose matrix is not 0 0 0 1");
  }
  return fromRotationAndTranslation(rotation, matrix.topRightCorner<3, 1>());
}

Pose orthonormalized(const Pose& pose) {
  const Eigen::Isometry3d t = toIsometry(pose);
  return fromRotationAndTranslation(nearestRotation(t.linear()), t.translation());
}

PointCloud transformed(const Pose& a_T_b, const PointCloud& points) {
  const Eigen::Isometry3d t = toIsometry(a_T_b);
  PointCloud result;
  result.reserve(points.size());
  for (const auto& p : points) result.push_back((t * p.cast<double>()).cast<float>());
  return result;
}

Pose levelled(const Eigen::Vector3d& up) {
  if (!up.allFinite() || up.norm() < 1e-9) throw std::invalid_argument("up direction is zero or not finite");
  const Eigen::Vector3d u = up.normalized();
  if (u.z() < -1.0 + 1e-12) {
    return fromRotationAndTranslation(Eigen::Vector3d(1, -1, -1).asDiagonal(), Eigen::Vector3d::Zero());
  }
  const auto q = Eigen::Quaterniond::FromTwoVectors(u, Eigen::Vector3d::UnitZ());
  return fromRotationAndTranslation(q.normalized().toRotationMatrix(), Eigen::Vector3d::Zero());
}

}  // namespace hoctomap
