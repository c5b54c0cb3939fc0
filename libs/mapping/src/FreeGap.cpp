// SPDX-License-Identifier: BSD-3-Clause
#include "FreeGap.h"

#include <algorithm>
#include <limits>
#include <vector>

#include "SurfacePoints.h"

namespace hoctomap {
namespace {

constexpr float kSpacing = 0.01F;   // m, of the points that are compared, and of those that are looked at
constexpr float kLeastGap = 0.04F;  // m
constexpr float kAsNear = 0.01F;    // m
constexpr float kSkin = 0.02F;      // m before the surfaces, where noise and edges of the image reach

struct Line {
  Eigen::Vector3f from;
  Eigen::Vector3f to;
  [[nodiscard]] float length() const { return (to - from).norm(); }
  [[nodiscard]] float height() const { return from.z() + to.z(); }  ///< twice that of its middle
};

/// From each point of `a` to the nearest of `b`.
std::vector<Line> linesBetween(const PointCloud& a, const PointCloud& b) {
  const SurfacePoints from(a, kSpacing);
  const SurfacePoints to(b, kSpacing);
  std::vector<Line> lines;
  for (const auto& p : from.points()) {
    if (const auto found = to.nearest(p, std::numeric_limits<float>::max()))
      lines.push_back({p, to.points()[found->index]});
  }
  return lines;
}

}  // namespace

bool hasFreeGap(const ScanSight& sight, const PointCloud& a, const PointCloud& b) {
  if (!sight.hasImage()) return false;
  std::vector<Line> lines = linesBetween(a, b);
  if (lines.empty()) return false;
  const float gap = std::ranges::min(lines, {}, &Line::length).length();
  if (gap < kLeastGap) return false;
  std::erase_if(lines, [gap](const Line& line) { return line.length() > gap + kAsNear; });
  const Line line = std::ranges::max(lines, {}, &Line::height);
  const Eigen::Vector3f direction = (line.to - line.from).normalized();
  bool seen_through = false;
  for (float at = kSkin; at <= line.length() - kSkin; at += kSpacing) {
    if (sight(line.from + at * direction) != Sight::seen_through) return false;
    seen_through = true;
  }
  return seen_through;
}

}  // namespace hoctomap
