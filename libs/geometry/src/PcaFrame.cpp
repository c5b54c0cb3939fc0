// SPDX-License-Identifier: BSD-3-Clause
#include "hoctomap/geometry/PcaFrame.h"

#include <Eigen/Eigenvalues>
#include <cmath>

namespace hoctomap {

namespace {

// Variances closer than this (relative to the largest) leave the direction to rounding: treated as equal.
constexpr double kEqualVariance = 1e-6;

/// Positive component of largest magnitude; of equal magnitudes the first counts.
Eigen::Vector3d withFixedSign(const Eigen::Vector3d& axis) {
  int largest = 0;
  for (int i = 1; i < 3; ++i) {
    if (std::abs(axis[i]) > std::abs(axis[largest]) + 1e-9) largest = i;
  }
  return axis[largest] < 0.0 ? Eigen::Vector3d(-axis) : axis;
}

/// The world axis that is least aligned with `normal` (first of equals), made orthogonal to it.
Eigen::Vector3d worldAxisAcross(const Eigen::Vector3d& normal) {
  int least = 0;
  for (int i = 1; i < 3; ++i) {
    if (std::abs(normal[i]) < std::abs(normal[least]) - 1e-9) least = i;
  }
  Eigen::Vector3d axis = Eigen::Vector3d::Unit(least);
  return (axis - axis.dot(normal) * normal).normalized();
}

Eigen::Vector3d centroidOf(std::span<const Eigen::Vector3f> points) {
  double x = 0.0, y = 0.0, z = 0.0;
  for (const auto& p : points) {
    x += static_cast<double>(p.x());
    y += static_cast<double>(p.y());
    z += static_cast<double>(p.z());
  }
  return Eigen::Vector3d(x, y, z) / static_cast<double>(points.size());
}

/// Sum of d d^T over the points, d from the centroid; sum by sum, which keeps them in registers.
Eigen::Matrix3d scatter(std::span<const Eigen::Vector3f> points, const Eigen::Vector3d& centroid) {
  double xx = 0.0, xy = 0.0, xz = 0.0, yy = 0.0, yz = 0.0, zz = 0.0;
  for (const auto& p : points) {
    const double x = static_cast<double>(p.x()) - centroid.x();
    const double y = static_cast<double>(p.y()) - centroid.y();
    const double z = static_cast<double>(p.z()) - centroid.z();
    xx += x * x;
    xy += x * y;
    xz += x * z;
    yy += y * y;
    yz += y * z;
    zz += z * z;
  }
  Eigen::Matrix3d sum;
  sum << xx, xy, xz, xy, yy, yz, xz, yz, zz;
  return sum;
}

Eigen::Matrix3d axesOf(const Eigen::Matrix3d& covariance) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(covariance);
  const Eigen::Vector3d variance = solver.eigenvalues().reverse();
  const Eigen::Matrix3d components = solver.eigenvectors().rowwise().reverse();
  const double tolerance = kEqualVariance * variance[0];
  const bool first_two_equal = variance[0] - variance[1] <= tolerance;
  const bool last_two_equal = variance[1] - variance[2] <= tolerance;

  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();
  if (!(variance[0] > 0.0) || (first_two_equal && last_two_equal)) return axes;  // a point, or isotropic
  if (first_two_equal) {                                                         // a disc: only its normal
    axes.col(0) = withFixedSign(worldAxisAcross(components.col(2)));
    axes.col(1) = withFixedSign(components.col(2).cross(axes.col(0)));
  } else {
    axes.col(0) = withFixedSign(components.col(0));
    // A line, or a body of revolution about the first axis, leaves the second open.
    axes.col(1) = withFixedSign(last_two_equal ? worldAxisAcross(axes.col(0)) : components.col(1));
  }
  axes.col(2) = axes.col(0).cross(axes.col(1));
  return axes;
}

}  // namespace

Pose pcaFrame(std::span<const Eigen::Vector3f> points) {
  if (points.empty()) return Pose();
  const Eigen::Vector3d centroid = centroidOf(points);

  Eigen::Matrix4d world_T_frame = Eigen::Matrix4d::Identity();
  world_T_frame.topRightCorner<3, 1>() = centroid;
  if (points.size() >= 3) {
    world_T_frame.topLeftCorner<3, 3>() =
        axesOf(scatter(points, centroid) / static_cast<double>(points.size()));
  }
  return poseFromMatrix(world_T_frame);
}

}  // namespace hoctomap
