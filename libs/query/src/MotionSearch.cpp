// SPDX-License-Identifier: BSD-3-Clause
#include "MotionSearch.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace hoctomap {

namespace {

constexpr double kLeastSeenOfBoth = 0.5;  // share of each thing that both maps must have for a doubtful fit

constexpr double kHeightError = 0.008;  // m, of a motion along a table
constexpr double kLeastStack = 0.02;    // m; the lowest thing that another one is put on

/// An order of two things that does not depend on which map is called A.
bool isMoreComplete(const Thing& x, const Thing& y) {
  const auto key = [](const Thing& t) {
    return std::tuple(t.voxels.size(), -t.resolution, t.position.x(), t.position.y(), t.position.z());
  };
  return key(x) >= key(y);
}

/// Whether a thing that stood on a table stands on one again. One may be put on another one, but none hovers
/// a finger's breadth above the table: that is what a taller thing looks like whose top fits.
bool standsAgain(const Thing& a, const Eigen::Isometry3d& a_to_b, const Thing& b, const TwoMaps& maps) {
  if (maps.a_in_b.sinks(a, a_to_b, b) || maps.b_in_a.sinks(b, a_to_b.inverse(), a)) return false;
  const auto before = maps.a_in_b.supportHeight(a);
  const auto after = maps.b_in_a.supportHeight(b);
  if (!before || !after) return true;
  const double lift = std::abs((a_to_b * a.position - a.position).z() - (*after - *before));
  return lift <= kHeightError || lift >= kLeastStack;
}

}  // namespace

double plainOverlap(const Thing& a, const Eigen::Isometry3d& a_to_b, const Thing& b, const TwoMaps& maps) {
  return std::min(maps.a_in_b.plainOverlap(a, a_to_b, b), maps.b_in_a.plainOverlap(b, a_to_b.inverse(), a));
}

double visibleOverlap(const Thing& a, const Eigen::Isometry3d& a_to_b, const Thing& b, const TwoMaps& maps,
                      Trust trust, double reach_factor) {
  return std::min(maps.a_in_b.cover(a, a_to_b, b, trust, reach_factor).overlap(),
                  maps.b_in_a.cover(b, a_to_b.inverse(), a, trust, reach_factor).overlap());
}

std::optional<Motion> findMotion(const Thing& a, const Thing& b, const TwoMaps& maps,
                                 const DiffConfig& config) {
  const bool forward = isMoreComplete(a, b);
  const Thing& model = forward ? a : b;
  const Thing& seen = forward ? b : a;
  const PlaceEvidence& evidence = forward ? maps.a_in_b : maps.b_in_a;
  RegistrationConfig registration = config.registration;
  registration.tolerance += 0.5 * (a.resolution + b.resolution);
  registration.spacing = std::max({registration.spacing, a.resolution, b.resolution});
  const Registration found =
      registerPoints(model.voxels, seen.voxels, registration,
                     {[&](const Eigen::Vector3f& p) { return evidence.sight(model, p.cast<double>()); }});
  if (found.verdict == Match::different) return std::nullopt;
  const Eigen::Isometry3d a_to_b = forward ? found.motion : found.motion.inverse();
  if (!standsAgain(a, a_to_b, b, maps)) return std::nullopt;
  // The registration knows only what one map saw; here both did.
  const double overlap = visibleOverlap(a, a_to_b, b, maps, Trust::sure);
  const bool sure = found.verdict == Match::same ? overlap >= config.same_overlap
                                                 : overlap >= registration.same_overlap &&
                                                       plainOverlap(a, a_to_b, b, maps) >= kLeastSeenOfBoth;
  if (!sure) return std::nullopt;
  // Things that are much alike differ in what is near, not in what is far.
  return Motion{a_to_b, 0.5 * (overlap + visibleOverlap(a, a_to_b, b, maps, Trust::sure, 0.5))};
}

bool isLarge(const Eigen::Isometry3d& a_to_b, const Thing& a, const Thing& b, const DiffConfig& config) {
  const double shift = std::max((a_to_b * a.position - a.position).norm(),
                                (a_to_b.inverse() * b.position - b.position).norm());
  return shift >= config.min_motion || Eigen::AngleAxisd(a_to_b.rotation()).angle() >= config.min_turn;
}

}  // namespace hoctomap
