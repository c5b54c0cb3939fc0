// SPDX-License-Identifier: BSD-3-Clause
#include "hoctomap/mapping/Registration.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "ClosestPoints.h"
#include "MotionJudge.h"
#include "SurfaceRegistration.h"
#include "hoctomap/geometry/ForEachIndex.h"

namespace hoctomap {

namespace {

constexpr std::size_t kFewPoints = 60;      // enough to drop turns that are far off
constexpr std::size_t kCoarsePoints = 120;  // enough to tell the turns apart
constexpr std::size_t kFinePoints = 350;
constexpr std::size_t kJudgedPoints = 600;  // one percent of a share
constexpr std::size_t kAll = std::numeric_limits<std::size_t>::max();
constexpr std::size_t kTurnsFollowed = 7;
constexpr std::size_t kRefinedStarts = 4;
constexpr double kOtherTurn = 0.17;  // rad; nearer turns are one fit

class Registrar {
 public:
  Registrar(const RegistrationSurface& model, const RegistrationSurface& seen,
            const RegistrationConfig& config, const RegistrationSight& sight, const MotionNeeds& needs)
      : config_(config),
        needs_(needs),
        model_(model),
        seen_(seen),
        points_(model, seen, sight),
        judge_(model, seen, points_, config, sight) {}

  [[nodiscard]] Registration best() const {
    if (model_.size() < kLeastPoints || seen_.size() < kLeastPoints) {
      Registration none;
      none.verdict = Match::ambiguous;  // too few points to say anything
      return none;
    }
    Registration rest = judge_.judged(points_.atRest(), kJudgedPoints);
    rest.rest_score = rest.score;
    if (rest.score >= config_.at_rest) return rest;
    const std::optional<double> least_score = needs_ ? needs_(rest) : 0.0;
    if (!least_score) {
      rest.verdict = Match::different;
      return rest;
    }
    const std::vector<Eigen::Isometry3f> coarse = coarseMotions();
    std::vector<Registration> candidates(coarse.size());
    forEachIndex(coarse.size(), [&](std::size_t k) {
      candidates[k] = judge_.judged(
          points_.refined(coarse[k], 8, judge_.near(), Freedom::yaw_and_shift, kFinePoints), kJudgedPoints);
    });
    if (candidates.empty()) {  // nowhere near at any turn
      rest.verdict = Match::different;
      return rest;
    }
    // A few points tell what is nearly square by chance: of a thing that fits, all turns are followed to
    // their end before one is chosen.
    const Registration first = *std::max_element(candidates.begin(), candidates.end(), fitsWorse);
    constexpr double kFollowed = 0.03;  // more has not been seen to come of it
    if (first.score + kFollowed < *least_score) {
      rest.verdict = Match::different;
      return rest;
    }
    const double margin = first.verdict == Match::same ? 2.0 * config_.rival_score : 0.0;
    forEachIndex(candidates.size(), [&](std::size_t k) {
      Registration& c = candidates[k];
      if (margin > 0.0 && fitsNearlyAs(c, first, margin)) improve(c, Freedom::yaw_and_shift, kJudgedPoints);
    });
    const Registration best = *std::max_element(candidates.begin(), candidates.end(), fitsWorse);
    std::erase_if(candidates, [&](const auto& c) { return !fitsNearlyAs(c, best, config_.rival_score); });
    // A round thing fits at any turn: the one it had is kept.
    Registration result = best;
    for (const Registration& c : candidates) {
      if (turn(c.motion) < turn(result.motion) - kOtherTurn) result = c;
    }
    result = polished(result);
    for (const Registration& c : candidates) {
      const double other = std::remainder(yaw(c.motion) - yaw(result.motion), 2.0 * std::numbers::pi);
      if (std::abs(other) > kOtherTurn) result.other_turns.push_back(other);
    }
    result.rest_score = rest.score;
    return result;
  }

 private:
  static constexpr std::size_t kLeastPoints = 10;

  static double quality(const Registration& r) {
    constexpr double kOfRms = 20.0;      // per metre: breaks ties of overlaps that are all but complete
    constexpr double kOfOutline = 30.0;  // per metre: sides that differ little differ in where they end
    constexpr double kExplained = 0.2;   // lest a motion win by taking for new sides what it does not fit
    return r.score + kExplained * r.explained - kOfRms * r.rms - kOfOutline * r.outline_error;
  }
  static bool fitsWorse(const Registration& a, const Registration& b) { return quality(a) < quality(b); }

  [[nodiscard]] static bool fitsNearlyAs(const Registration& r, const Registration& best, double margin) {
    return r.verdict == best.verdict && quality(r) >= quality(best) - margin;
  }

  static double turn(const Eigen::Isometry3d& motion) { return Eigen::AngleAxisd(motion.rotation()).angle(); }
  static double yaw(const Eigen::Isometry3d& motion) { return std::atan2(motion(1, 0), motion(0, 0)); }

  /// All points, and six degrees of freedom if they explain more.
  [[nodiscard]] Registration polished(const Registration& start) const {
    const Eigen::Isometry3f from = judge_.toLocal(start.motion);
    Registration best = judge_.judged(from, kAll);
    if (improve(best, Freedom::yaw_and_shift, kAll)) improve(best, Freedom::yaw_and_shift, kAll);
    improve(best, Freedom::rigid, kAll);
    return best;
  }

  /// Takes what a refinement with more points finds, if it fits better.
  bool improve(Registration& r, Freedom freedom, std::size_t judged_points) const {
    Registration refined = judge_.judged(
        points_.refined(judge_.toLocal(r.motion), 8, judge_.near(), freedom, 2 * kFinePoints), judged_points);
    if (fitsWorse(refined, r)) return false;
    r = std::move(refined);
    return true;
  }

  /// Turns about the vertical through the aligned centroids, each brought near by yaw and shift; the best
  /// few. None if the two have no shape in common.
  [[nodiscard]] std::vector<Eigen::Isometry3f> coarseMotions() const {
    struct Start {
      float distance;
      Eigen::Isometry3f motion;
    };
    const auto rank = [](std::vector<Start>& starts) {
      std::stable_sort(starts.begin(), starts.end(),
                       [](const Start& a, const Start& b) { return a.distance < b.distance; });
    };
    const float far = 3.0F * judge_.near();
    std::vector<Start> starts(static_cast<std::size_t>(config_.yaw_starts));
    forEachIndex(starts.size(), [&](std::size_t k) {
      Eigen::Isometry3f motion = points_.turned(
          static_cast<float>(2.0 * std::numbers::pi * static_cast<double>(k) / config_.yaw_starts));
      points_.approach(motion, 3, 0.060F, 0.040F, kFewPoints);
      starts[k] = {points_.meanDistance(motion, far, kCoarsePoints), motion};
    });
    rank(starts);
    starts.resize(std::min(starts.size(), kTurnsFollowed));
    forEachIndex(starts.size(), [&](std::size_t k) {
      points_.approach(starts[k].motion, 6, 0.040F, 0.020F, kCoarsePoints);
      starts[k].distance = points_.meanDistance(starts[k].motion, far, 2 * kCoarsePoints);
    });
    rank(starts);
    std::vector<Eigen::Isometry3f> best;
    for (const Start& start : starts) {
      // Even a side that was never seen lies near one that was at its edge.
      if (best.size() == kRefinedStarts || start.distance > 0.6F * far) break;
      const bool is_new = std::none_of(best.begin(), best.end(),
                                       [&](const auto& other) { return endTogether(start.motion, other); });
      if (is_new) best.push_back(start.motion);
    }
    return best;
  }

  /// Several starts end in one place.
  [[nodiscard]] bool endTogether(const Eigen::Isometry3f& a, const Eigen::Isometry3f& b) const {
    constexpr float kShift = 0.01F;  // m
    constexpr double kTurn = 0.1;    // rad
    return (a * model_.centroid() - b * model_.centroid()).norm() < kShift &&
           turn((a.inverse() * b).cast<double>()) < kTurn;
  }

  const RegistrationConfig& config_;
  const MotionNeeds& needs_;
  const RegistrationSurface& model_;
  const RegistrationSurface& seen_;
  ClosestPoints points_;
  MotionJudge judge_;
};

}  // namespace

Registration registerSurfaces(const RegistrationSurface& model, const RegistrationSurface& seen,
                              const RegistrationConfig& config, const RegistrationSight& sight,
                              const MotionNeeds& needs) {
  return Registrar(model, seen, config, sight, needs).best();
}

void orientModel(RegistrationSurface& model, const RegistrationSight& sight) {
  if (!sight.origin || !sight.was_free) return;
  const auto beside = static_cast<float>(sight.beside);
  model.orient([&](const Eigen::Vector3f& p, const Eigen::Vector3f& normal) {
    const bool over = sight.was_free(p + model.origin() + beside * normal);
    const bool under = sight.was_free(p + model.origin() - beside * normal);
    // Thin things, and such that stand among others: most surfaces face away from the middle.
    if (over == under) return normal.dot(p - model.centroid()) > 0.0F ? 1 : -1;
    return over ? 1 : -1;
  });
}

void orientSeen(RegistrationSurface& seen, const RegistrationSight& sight) {
  if (!sight.origin) return;
  const Eigen::Vector3f origin = sight.origin->cast<float>() - seen.origin();
  seen.orient([&](const Eigen::Vector3f& p, const Eigen::Vector3f& normal) {
    return normal.dot(origin - p) > 0.0F ? 1 : -1;
  });
}

Registration registerPoints(std::span<const Eigen::Vector3f> model_world,
                            std::span<const Eigen::Vector3f> seen_world, const RegistrationConfig& config,
                            const RegistrationSight& sight) {
  if (model_world.empty() || seen_world.empty()) return {};
  RegistrationSurface model(model_world, config.spacing);
  RegistrationSurface seen(seen_world, config.spacing);
  orientModel(model, sight);
  orientSeen(seen, sight);
  return registerSurfaces(model, seen, config, sight);
}

}  // namespace hoctomap
