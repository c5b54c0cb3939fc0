// SPDX-License-Identifier: BSD-3-Clause
#include "hoctomap/geometry/SurfaceNormals.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>

#include "support/RandomScenes.h"

namespace hoctomap {
namespace {

/// Points of a square of 10 cm across `normal`, with noise along it.
PointCloud plane(test::Rng& rng, const Eigen::Vector3d& normal, double noise) {
  const Eigen::Vector3d a = normal.unitOrthogonal();
  const Eigen::Vector3d b = normal.cross(a);
  PointCloud points;
  for (int i = 0; i < 3000; ++i) {
    const Eigen::Vector3d at = test::uniformVector(rng, -1.0, 1.0);
    points.push_back((0.05 * at.x() * a + 0.05 * at.y() * b + noise * at.z() * normal).cast<float>());
  }
  return points;
}

TEST(SurfaceNormals, OfAPlaneAreItsNormalWhateverItsDirection) {
  test::Rng rng(1);
  for (int i = 0; i < 20; ++i) {
    const Eigen::Vector3d normal = test::uniformVector(rng, -1.0, 1.0).normalized();
    for (const auto& n : surfaceNormals(plane(rng, normal, 0.002), 0.01)) {
      ASSERT_NEAR(static_cast<double>(n.norm()), 1.0, 1e-5);
      // 2 mm of noise over 2 to 3 cm: corners of the square have few points.
      ASSERT_GT(std::abs(n.cast<double>().dot(normal)), std::cos(0.12));
    }
  }
}

/// The definition, point by point: the same cells, found by going through all points.
TEST(SurfaceNormals, EqualTheDefinition) {
  test::Rng rng(2);
  PointCloud points;
  for (int i = 0; i < 400; ++i) points.push_back(test::uniformVector(rng, -0.05, 0.05).cast<float>());
  const double cell = 0.02;
  Eigen::Vector3f low = points.front();
  for (const auto& p : points) low = low.cwiseMin(p);
  const auto cellOf = [&](const Eigen::Vector3f& p) -> Eigen::Vector3i {
    return ((p - low) * static_cast<float>(1.0 / cell)).array().floor().cast<int>();
  };
  const PointCloud normals = surfaceNormals(points, cell);
  int compared = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    std::vector<Eigen::Vector3d> near;
    Eigen::Vector3d mean = Eigen::Vector3d::Zero();
    for (const auto& q : points) {
      if ((cellOf(q) - cellOf(points[i])).cwiseAbs().maxCoeff() > 1) continue;
      near.push_back(q.cast<double>());
      mean += near.back();
    }
    if (near.size() < 6) {
      EXPECT_TRUE(normals[i].isZero());
      continue;
    }
    mean /= static_cast<double>(near.size());
    Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
    for (const auto& q : near) covariance += (q - mean) * (q - mean).transpose();
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(covariance);
    if (solver.eigenvalues()[1] - solver.eigenvalues()[0] < 0.05 * solver.eigenvalues()[2]) continue;
    EXPECT_NEAR(std::abs(solver.eigenvectors().col(0).dot(normals[i].cast<double>())), 1.0, 1e-4);
    ++compared;
  }
  EXPECT_GT(compared, 300);
}

TEST(SurfaceNormals, FewPointsAndLinesHaveNone) {
  EXPECT_TRUE(surfaceNormals({}, 0.01).empty());
  PointCloud line;
  for (int i = 0; i < 30; ++i) line.emplace_back(0.001F * static_cast<float>(i), 0.0F, 0.0F);
  for (const auto& n : surfaceNormals(line, 0.01)) EXPECT_TRUE(n.isZero());
  const PointCloud few{{0, 0, 0}, {0.001F, 0, 0}, {0, 0.001F, 0}, {5, 5, 5}};
  for (const auto& n : surfaceNormals(few, 0.01)) EXPECT_TRUE(n.isZero());
}

}  // namespace
}  // namespace hoctomap
