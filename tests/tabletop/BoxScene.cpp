// SPDX-License-Identifier: BSD-3-Clause
#include "BoxScene.h"

#include <algorithm>
#include <cmath>

namespace hoctomap::test {
namespace {

/// Distance along the ray to the box in units of the direction; infinity if it misses.
double hit(const Eigen::AlignedBox3d& box, const Eigen::Vector3d& from, const Eigen::Vector3d& direction) {
  double enter = 0.0;
  double leave = std::numeric_limits<double>::infinity();
  for (int axis = 0; axis < 3; ++axis) {
    const double a = (box.min()[axis] - from[axis]) / direction[axis];
    const double b = (box.max()[axis] - from[axis]) / direction[axis];
    enter = std::max(enter, std::min(a, b));
    leave = std::min(leave, std::max(a, b));
  }
  return enter <= leave ? enter : std::numeric_limits<double>::infinity();
}

}  // namespace

std::size_t BoxScene::add(double x, double y, double bottom, double size_x, double size_y, double size_z) {
  boxes.emplace_back(Eigen::Vector3d(x - size_x / 2.0, y - size_y / 2.0, bottom),
                     Eigen::Vector3d(x + size_x / 2.0, y + size_y / 2.0, bottom + size_z));
  return boxes.size() - 1;
}

Measurement BoxScene::look(const Eigen::Vector3d& eye, const Eigen::Vector3d& target, Rng* noise) const {
  DepthImage image;
  image.camera = {320, 240, 290.0, 290.0, 159.5, 119.5};
  image.depth.assign(320UL * 240UL, 0.0F);
  Eigen::Matrix4d m = Eigen::Matrix4d::Identity();
  const Eigen::Vector3d forward = (target - eye).normalized();
  const Eigen::Vector3d left = Eigen::Vector3d::UnitZ().cross(forward).normalized();
  m.block<3, 1>(0, 0) = forward;
  m.block<3, 1>(0, 1) = left;
  m.block<3, 1>(0, 2) = forward.cross(left);
  m.block<3, 1>(0, 3) = eye;
  std::normal_distribution<double> normal;
  for (int v = 0; v < 240; ++v) {
    for (int u = 0; u < 320; ++u) {
      const Eigen::Vector3d ray = m.topLeftCorner<3, 3>() * image.camera.point(u, v, 1.0);
      double depth = std::numeric_limits<double>::infinity();
      for (const auto& box : boxes) depth = std::min(depth, hit(box, eye, ray));
      if (!std::isfinite(depth) || depth > 6.0) continue;
      if (noise != nullptr) depth += 0.0015 * depth * depth * normal(*noise);
      image.depth[static_cast<std::size_t>(v) * 320 + static_cast<std::size_t>(u)] =
          static_cast<float>(depth);
    }
  }
  return unproject(std::move(image), poseFromMatrix(m), RangeLimits{});
}

std::size_t pointsIn(const Measurement& z, const Segment& segment, const Eigen::AlignedBox3d& box) {
  const Eigen::AlignedBox3d grown(box.min().array() - 0.02, box.max().array() + 0.02);
  return static_cast<std::size_t>(std::count_if(segment.points.begin(), segment.points.end(), [&](auto i) {
    return grown.contains(z.world_points[i].template cast<double>());
  }));
}

std::vector<Segment> ofKind(const std::vector<Segment>& segments, Structure structure) {
  std::vector<Segment> found;
  for (const auto& s : segments) {
    if (s.structure == structure) found.push_back(s);
  }
  return found;
}

NodeMap filledMap(double resolution, const Eigen::AlignedBox3d& box) {
  auto tree = std::make_unique<octomap::OcTree>(resolution);
  for (double x = box.min().x() + resolution / 2.0; x < box.max().x(); x += resolution)
    for (double y = box.min().y() + resolution / 2.0; y < box.max().y(); y += resolution)
      for (double z = box.min().z() + resolution / 2.0; z < box.max().z(); z += resolution)
        tree->updateNode(x, y, z, true);
  return NodeMap(std::move(tree), OccupancyModel{});
}

}  // namespace hoctomap::test
