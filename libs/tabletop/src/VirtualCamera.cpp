// SPDX-License-Identifier: BSD-3-Clause
#include "VirtualCamera.h"

#include <algorithm>
#include <cmath>
#include <nanoflann.hpp>

namespace hoctomap {
namespace {

constexpr double kWidest = 3.7;        // tangent of 75 degrees
constexpr double kPixelPitch = 1.25;   // of the angle between neighbours, for a sampling that is not regular
constexpr int kNeighbours = 5;         // the point itself and four, as on a square grid
constexpr std::size_t kSample = 2000;  // points whose neighbours are looked at
constexpr double kMostPixels = 2048.0;

using Directions = std::vector<Eigen::Vector3d>;

struct DirectionCloud {
  const Directions& directions;
  // The names are nanoflann's.
  [[nodiscard]] std::size_t kdtree_get_point_count() const { return directions.size(); }
  [[nodiscard]] double kdtree_get_pt(std::size_t i, std::size_t axis) const {
    return directions[i][static_cast<Eigen::Index>(axis)];
  }
  template <class Box>
  bool kdtree_get_bbox(Box&) const {
    return false;
  }
};

/// Angle between neighbouring beams, rad: the median distance to the fourth neighbour on the unit sphere.
double beamAngle(const Directions& directions) {
  using Tree = nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<double, DirectionCloud>,
                                                   DirectionCloud, 3>;
  const DirectionCloud cloud{directions};
  Tree tree(3, cloud, nanoflann::KDTreeSingleIndexAdaptorParams(16));
  tree.buildIndex();
  std::vector<double> angles;
  const std::size_t step = std::max<std::size_t>(1, directions.size() / kSample);
  for (std::size_t i = 0; i < directions.size(); i += step) {
    std::uint32_t neighbours[kNeighbours];
    double squared[kNeighbours];
    const auto found = tree.knnSearch(directions[i].data(), kNeighbours, neighbours, squared);
    if (found > 1) angles.push_back(std::sqrt(squared[found - 1]));
  }
  if (angles.empty()) return 0.0;
  const auto middle = angles.begin() + static_cast<std::ptrdiff_t>(angles.size() / 2);
  std::nth_element(angles.begin(), middle, angles.end());
  return *middle;
}

}  // namespace

VirtualCamera::VirtualCamera(const Measurement& z, std::span<const Candidate> candidates)
    : origin_(z.origin()) {
  Directions directions;
  Eigen::Vector3d axis = Eigen::Vector3d::Zero();
  for (const auto& c : candidates) {
    directions.push_back((z.world_points[c.point].cast<double>() - origin_).normalized());
    axis += directions.back();
  }
  axis = axis.norm() > 1e-9 ? axis.normalized() : Eigen::Vector3d(Eigen::Vector3d::UnitX());
  const Eigen::Vector3d up = std::abs(axis.z()) < 0.99 ? Eigen::Vector3d(Eigen::Vector3d::UnitZ())
                                                       : Eigen::Vector3d(Eigen::Vector3d::UnitX());
  const Eigen::Vector3d right = axis.cross(up).normalized();
  camera_R_world_ << right.transpose(), axis.cross(right).transpose(), axis.transpose();

  Eigen::AlignedBox2d view(Eigen::Vector2d(0.0, 0.0));
  for (const auto& d : directions) {
    const Eigen::Vector3d p = camera_R_world_ * d;
    if (p.z() > 0.0 && p.head<2>().norm() < kWidest * p.z()) view.extend(p.head<2>() / p.z());
  }
  const double widest = std::max(1e-3, view.sizes().maxCoeff());
  const double pixel = std::max(kPixelPitch * beamAngle(directions), widest / kMostPixels);
  camera_.fx = camera_.fy = 1.0 / pixel;
  camera_.cx = -view.min().x() / pixel + 2.0;
  camera_.cy = -view.min().y() / pixel + 2.0;
  camera_.width = static_cast<int>(view.sizes().x() / pixel) + 5;
  camera_.height = static_cast<int>(view.sizes().y() / pixel) + 5;
}

std::optional<VirtualCamera::Pixel> VirtualCamera::project(const Eigen::Vector3f& world_point) const {
  const Eigen::Vector3d p = camera_R_world_ * (world_point.cast<double>() - origin_);
  if (!(p.z() > 1e-6) || p.head<2>().norm() >= kWidest * p.z()) return std::nullopt;
  const double u = camera_.cx + camera_.fx * p.x() / p.z();
  const double v = camera_.cy + camera_.fy * p.y() / p.z();
  if (!(u >= 0.0 && v >= 0.0 && u < camera_.width && v < camera_.height)) return std::nullopt;
  return Pixel{static_cast<int>(u), static_cast<int>(v), 1.0 / p.z()};
}

}  // namespace hoctomap
