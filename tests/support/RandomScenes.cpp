// SPDX-License-Identifier: BSD-3-Clause
#include "support/RandomScenes.h"

namespace hoctomap::test {

double uniform(Rng& rng, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(rng);
}

Eigen::Vector3d uniformVector(Rng& rng, double low, double high) {
  const double x = uniform(rng, low, high);
  const double y = uniform(rng, low, high);
  return {x, y, uniform(rng, low, high)};
}

Pose randomPose(Rng& rng, double extent) {
  std::normal_distribution<double> normal;
  Eigen::Quaterniond q(normal(rng), normal(rng), normal(rng), normal(rng));
  Eigen::Matrix4d m = Eigen::Matrix4d::Identity();
  m.topLeftCorner<3, 3>() = q.normalized().toRotationMatrix();
  m.topRightCorner<3, 1>() = uniformVector(rng, -extent, extent);
  return poseFromMatrix(m);
}

Obb randomBox(Rng& rng, double extent) {
  const Eigen::Vector3d half = uniformVector(rng, 0.01, 1.0);
  return {toIsometry(randomPose(rng, extent)), Eigen::AlignedBox3d(-half, half)};
}

PointCloud boxSurface(Rng& rng, const Obb& obb, std::size_t count) {
  PointCloud points;
  points.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    Eigen::Vector3d p;
    for (int axis = 0; axis < 3; ++axis) p[axis] = uniform(rng, obb.box.min()[axis], obb.box.max()[axis]);
    const int face = static_cast<int>(rng() % 6);
    p[face % 3] = face < 3 ? obb.box.min()[face % 3] : obb.box.max()[face % 3];
    points.push_back((obb.world_T_frame * p).cast<float>());
  }
  return points;
}

}  // namespace hoctomap::test
