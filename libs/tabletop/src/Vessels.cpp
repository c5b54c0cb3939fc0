// SPDX-License-Identifier: BSD-3-Clause
#include "Vessels.h"

#include <algorithm>
#include <cmath>

namespace hoctomap {
namespace {

constexpr double kRim = 0.012;          // m by which the heights of the two rims may differ
constexpr double kGap = 0.036;          // m between inside and outside where the rim is lost
constexpr double kMostTopShare = 0.45;  // of a wall; a box shows more of its top

bool touch(const Cluster& a, const Cluster& b, const Measurement& z) {
  const auto touches = [&](const Candidate& p) {
    return std::any_of(b.begin(), b.end(), [&](const Candidate& q) {
      return (z.world_points[p.point] - z.world_points[q.point]).squaredNorm() <
             static_cast<float>(kGap * kGap);
    });
  };
  return std::any_of(a.begin(), a.end(), touches);
}

/// Whether both together are as deep as they are wide, seen from the sensor: a ring, and not two things in a
/// row.
bool areRound(const Cluster& a, const Cluster& b, const Eigen::Vector2d& view, const Measurement& z) {
  constexpr double kTolerance = 0.3;
  const Eigen::Vector2d side(-view.y(), view.x());
  Eigen::AlignedBox2d extent;
  for (const auto* cluster : {&a, &b}) {
    for (const auto& c : *cluster) {
      const Eigen::Vector2d p = z.world_points[c.point].head<2>().cast<double>();
      extent.extend(Eigen::Vector2d(view.dot(p), side.dot(p)));
    }
  }
  return std::abs(extent.sizes().x() / extent.sizes().y() - 1.0) < kTolerance;
}

bool isInsideOf(const ShapedCluster& inner, const ShapedCluster& outer, const Measurement& z,
                const TabletopSegmentationConfig& config) {
  const ClusterShape& i = inner.shape;
  const ClusterShape& o = outer.shape;
  const double breadth = o.box.sizes().head<2>().norm();
  const Eigen::Vector2d view = (o.box.center() - z.origin()).head<2>();
  return std::abs(i.highest - o.highest) < kRim + config.noise(i.range) &&
         i.range > o.range + 0.4 * breadth && i.top_share < kMostTopShare &&
         i.box.sizes().head<2>().norm() < 1.3 * breadth && view.norm() > 0.0 &&
         areRound(inner.points, outer.points, view.normalized(), z) && touch(inner.points, outer.points, z);
}

}  // namespace

void joinVessels(std::vector<ShapedCluster>& objects, const Measurement& z,
                 const TabletopSegmentationConfig& config) {
  for (std::size_t i = 0; i < objects.size();) {
    const auto outer = std::find_if(objects.begin(), objects.end(), [&](const ShapedCluster& other) {
      return &other != &objects[i] && isInsideOf(objects[i], other, z, config);
    });
    if (outer == objects.end()) {
      ++i;
      continue;
    }
    auto& all = outer->points;
    all.insert(all.end(), objects[i].points.begin(), objects[i].points.end());
    std::sort(all.begin(), all.end(), [](const auto& a, const auto& b) { return a.point < b.point; });
    objects.erase(objects.begin() + static_cast<std::ptrdiff_t>(i));
  }
}

}  // namespace hoctomap
