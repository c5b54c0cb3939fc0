// SPDX-License-Identifier: BSD-3-Clause
#include "SeamEvidence.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace hoctomap {

Passage passage(const SurfacePiece& a, const SurfacePiece& b) {
  // A normal of 1.5 cm of surface is good to some degrees, a corner is 90.
  constexpr double kSmooth = 20.0;  // degrees
  constexpr double kConvex = 30.0;
  constexpr double kConcave = 45.0;
  constexpr double kLevel = 0.005;  // m, off the common tangent plane
  constexpr double kStep = 0.008;
  if (a.normal.isZero() || b.normal.isZero()) return Passage::vague;
  const double cosine = std::clamp(a.normal.dot(b.normal), -1.0, 1.0);
  const double bend = std::acos(cosine) * 180.0 / std::numbers::pi;
  const Eigen::Vector3d way = b.center - a.center;
  const double off = std::abs(way.dot((a.normal + b.normal).normalized()));
  const bool is_concave = (b.normal - a.normal).dot(way) < 0.0;
  if (bend < kConcave && off > kStep) return Passage::step;
  if (bend < kSmooth && off < kLevel) return Passage::smooth;
  if (is_concave) return bend > kConcave ? Passage::concave : Passage::vague;
  return bend > kConvex ? Passage::convex : Passage::vague;
}

int seamEvidence(Passage passage, bool cut) {
  // Ratios of how often these are met on seams and on single things of simulated crowded tables.
  switch (passage) {
    case Passage::smooth:
      return cut ? 1 : -2;
    case Passage::convex:
      return cut ? 2 : -1;
    case Passage::vague:
      return cut ? 3 : -1;
    case Passage::concave:
      return cut ? 5 : 0;
    case Passage::step:
      return cut ? 6 : 0;
  }
  return 0;
}

}  // namespace hoctomap
