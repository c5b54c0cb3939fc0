// SPDX-License-Identifier: BSD-3-Clause
#include "hoctomap/geometry/Obb.h"

#include <algorithm>
#include <cmath>

#include "hoctomap/geometry/PcaFrame.h"

namespace hoctomap {

Obb Obb::padded(double margin) const {
  if (box.isEmpty()) return *this;
  const Eigen::Vector3d m = Eigen::Vector3d::Constant(margin);
  return {world_T_frame, Eigen::AlignedBox3d(box.min() - m, box.max() + m)};
}

Obb pcaBox(std::span<const Eigen::Vector3f> world_points) {
  Obb obb;
  if (world_points.empty()) return obb;
  obb.world_T_frame = toIsometry(pcaFrame(world_points));
  const Eigen::Isometry3d frame_T_world = obb.world_T_frame.inverse();
  for (const auto& p : world_points) obb.box.extend(frame_T_world * p.cast<double>());
  return obb;
}

bool intersects(const Obb& a, const Obb& b) {
  if (a.box.isEmpty() || b.box.isEmpty()) return false;
  const Eigen::Vector3d half_a = 0.5 * a.box.sizes();
  const Eigen::Vector3d half_b = 0.5 * b.box.sizes();
  // Everything in the axes of a: r(i, j) = a_i . b_j.
  const Eigen::Matrix3d r = a.world_T_frame.linear().transpose() * b.world_T_frame.linear();
  const Eigen::Vector3d t = a.world_T_frame.linear().transpose() * (b.center() - a.center());
  // Parallel edges make their cross product vanish; the epsilon keeps such an axis from separating by
  // rounding.
  const Eigen::Matrix3d abs_r = (r.cwiseAbs().array() + 1e-12).matrix();

  for (int i = 0; i < 3; ++i) {
    if (std::abs(t[i]) > half_a[i] + abs_r.row(i).dot(half_b)) return false;
  }
  for (int j = 0; j < 3; ++j) {
    if (std::abs(t.dot(r.col(j))) > half_b[j] + abs_r.col(j).dot(half_a)) return false;
  }
  for (int i = 0; i < 3; ++i) {
    const int i1 = (i + 1) % 3;
    const int i2 = (i + 2) % 3;
    for (int j = 0; j < 3; ++j) {
      const int j1 = (j + 1) % 3;
      const int j2 = (j + 2) % 3;
      const double distance = std::abs(t[i2] * r(i1, j) - t[i1] * r(i2, j));  // along a_i x b_j
      const double radius_a = half_a[i1] * abs_r(i2, j) + half_a[i2] * abs_r(i1, j);
      const double radius_b = half_b[j1] * abs_r(i, j2) + half_b[j2] * abs_r(i, j1);
      if (distance > radius_a + radius_b) return false;
    }
  }
  return true;
}

double overlapVolume(const Obb& a, const Obb& b) {
  if (!intersects(a, b)) return 0.0;
  const bool a_smaller = a.box.volume() <= b.box.volume();
  const Obb& small = a_smaller ? a : b;
  const Obb& large = a_smaller ? b : a;
  const Eigen::Isometry3d large_T_small = large.world_T_frame.inverse() * small.world_T_frame;

  constexpr int kCells = 16;
  const Eigen::Vector3d cell = small.box.sizes() / kCells;
  int inside = 0;
  for (int x = 0; x < kCells; ++x) {
    for (int y = 0; y < kCells; ++y) {
      for (int z = 0; z < kCells; ++z) {
        const Eigen::Vector3d p =
            small.box.min() + cell.cwiseProduct(Eigen::Vector3d(x + 0.5, y + 0.5, z + 0.5));
        inside += large.box.contains(large_T_small * p) ? 1 : 0;
      }
    }
  }
  return inside * cell.prod();
}

Eigen::AlignedBox3d worldBounds(const Obb& obb) {
  Eigen::AlignedBox3d bounds;
  if (obb.box.isEmpty()) return bounds;
  for (int corner = 0; corner < 8; ++corner) {
    bounds.extend(obb.world_T_frame * obb.box.corner(static_cast<Eigen::AlignedBox3d::CornerType>(corner)));
  }
  return bounds;
}

std::optional<std::pair<double, double>> clipSegment(const Eigen::Vector3d& from, const Eigen::Vector3d& to,
                                                     const Eigen::AlignedBox3d& box) {
  double enter = 0.0;
  double leave = 1.0;
  for (int i = 0; i < 3; ++i) {
    const double d = to[i] - from[i];
    if (d == 0.0) {
      if (from[i] < box.min()[i] || from[i] > box.max()[i]) return std::nullopt;
      continue;
    }
    const double t0 = (box.min()[i] - from[i]) / d;
    const double t1 = (box.max()[i] - from[i]) / d;
    enter = std::max(enter, std::min(t0, t1));
    leave = std::min(leave, std::max(t0, t1));
  }
  if (enter > leave) return std::nullopt;
  return std::make_pair(enter, leave);
}

}  // namespace hoctomap
