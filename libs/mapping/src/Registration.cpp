// SPDX-License-Identifier: BSD-3-Clause
#include "hoctomap/mapping/Registration.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <string>
#include <vector>

#include "ClosestPoints.h"
#include "SurfaceRegistration.h"

namespace hoctomap {

namespace {

constexpr std::size_t kFewPoints = 60;      // enough to drop turns that are far off
constexpr std::size_t kCoarsePoints = 120;  // enough to tell the turns apart
constexpr std::size_t kFinePoints = 350;
constexpr std::size_t kJudgedPoints = 600;  // one percent of a share
constexpr std::size_t kTurnsFollowed = 7;
constexpr std::size_t kRefinedStarts = 4;
constexpr double kOtherTurn = 0.17;  // rad; nearer turns are one fit

class Registrar {
 public:
  Registrar(const RegistrationSurface& model, const RegistrationSurface& seen,
            const RegistrationConfig& config, const RegistrationSight& sight)
      : config_(config),
        sight_(sight),
        near_(static_cast<float>(config.near + config.tolerance)),
        model_(model),
        seen_(seen),
        points_(model, seen, sight) {}

  [[nodiscard]] Registration best() const {
    if (model_.size() < kLeastPoints || seen_.size() < kLeastPoints) {
      Registration none;
      none.verdict = Match::ambiguous;  // too few points to say anything
      return none;
    }
    Registration rest = judged(points_.atRest(), kJudgedPoints);
    rest.rest_score = rest.score;
    if (rest.score >= config_.at_rest) return rest;
    std::vector<Registration> candidates;
    for (const Eigen::Isometry3f& start : coarseMotions()) {
      candidates.push_back(
          judged(points_.refined(start, 8, near_, Freedom::yaw_and_shift, kFinePoints), kJudgedPoints));
    }
    if (candidates.empty()) {  // nowhere near at any turn
      rest.verdict = Match::different;
      return rest;
    }
    const Registration* best = &*std::max_element(candidates.begin(), candidates.end(), fitsWorse);
    // A round thing fits at any turn: the one it had is kept.
    for (const Registration& c : candidates) {
      if (isRival(c, *best) && turn(c.motion) < turn(best->motion) - kOtherTurn) best = &c;
    }
    Registration result = polished(*best);
    for (const Registration& c : candidates) {
      const double other = std::remainder(yaw(c.motion) - yaw(result.motion), 2.0 * std::numbers::pi);
      if (isRival(c, *best) && std::abs(other) > kOtherTurn) result.other_turns.push_back(other);
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

  /// Whether a fit is as good as the best, by another turn.
  [[nodiscard]] bool isRival(const Registration& r, const Registration& best) const {
    return r.verdict == best.verdict && quality(r) >= quality(best) - config_.rival_score;
  }

  static double turn(const Eigen::Isometry3d& motion) { return Eigen::AngleAxisd(motion.rotation()).angle(); }
  static double yaw(const Eigen::Isometry3d& motion) { return std::atan2(motion(1, 0), motion(0, 0)); }

  /// All points, and six degrees of freedom if they explain more.
  [[nodiscard]] Registration polished(const Registration& start) const {
    const Eigen::Isometry3f from = toLocal(start.motion);
    Registration best = judged(from, seen_.size() + model_.size());
    for (const Freedom freedom : {Freedom::yaw_and_shift, Freedom::rigid}) {
      const Registration r = judged(points_.refined(toLocal(best.motion), 8, near_, freedom, 2 * kFinePoints),
                                    seen_.size() + model_.size());
      if (!fitsWorse(r, best)) best = r;
    }
    return best;
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
    const float far = 3.0F * near_;
    std::vector<Start> starts;
    for (int k = 0; k < config_.yaw_starts; ++k) {
      Eigen::Isometry3f motion =
          points_.turned(static_cast<float>(2.0 * std::numbers::pi * k / config_.yaw_starts));
      points_.approach(motion, 3, 0.060F, 0.040F, kFewPoints);
      starts.push_back({points_.meanDistance(motion, far, kCoarsePoints), motion});
    }
    rank(starts);
    starts.resize(std::min(starts.size(), kTurnsFollowed));
    for (Start& start : starts) {
      points_.approach(start.motion, 6, 0.040F, 0.020F, kCoarsePoints);
      start.distance = points_.meanDistance(start.motion, far, 2 * kCoarsePoints);
    }
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

  [[nodiscard]] Registration judged(const Eigen::Isometry3f& motion, std::size_t samples) const {
    Registration r;
    r.motion = toWorld(motion);
    double squares = 0.0;
    std::size_t pairs = 0;

    const Eigen::Isometry3f back = motion.inverse();
    std::size_t seen_asked = 0;
    std::size_t seen_near = 0;
    std::size_t new_sides = 0;
    for (std::size_t i = 0; i < seen_.size(); i += stride(seen_, samples)) {
      ++seen_asked;
      const Eigen::Vector3f before = back * seen_.points()[i];
      const auto p = model_.nearest(before, near_);
      if (!p) {
        new_sides += isNewSide(i, back) ? 1U : 0U;
        continue;
      }
      ++seen_near;
      squares += static_cast<double>(p->squared_distance);
      ++pairs;
    }
    std::size_t model_asked = 0;
    std::size_t model_near = 0;
    std::size_t model_missed = 0;
    std::size_t model_through = 0;
    for (std::size_t i = 0; i < model_.size(); i += stride(model_, samples)) {
      ++model_asked;
      const Eigen::Vector3f p = motion * model_.points()[i];
      if (const auto q = seen_.nearest(p, near_)) {
        ++model_near;
        squares += static_cast<double>(q->squared_distance);
        ++pairs;
        continue;
      }
      const Sight sight = sightOf(i, motion);
      if (sight == Sight::hidden) continue;
      ++model_missed;
      if (sight == Sight::seen_through) ++model_through;
    }
    const std::size_t visible = model_near + model_missed;
    r.overlap_seen = share(seen_near, seen_asked - new_sides);
    r.overlap_model = share(model_near, visible);
    r.seen_through = share(model_through, visible);
    r.rms = pairs == 0 ? 0.0 : std::sqrt(squares / static_cast<double>(pairs));
    r.score = std::min(r.overlap_model, r.overlap_seen);
    r.explained = share(seen_near, seen_asked);
    r.outline_error = points_.outlineError(motion, 2.0F * near_);
    r.verdict = verdict(r, share(visible, model_asked), heightError(motion));
    return r;
  }

  /// Whether a seen point faces a way that nothing of the model does.
  [[nodiscard]] bool isNewSide(std::size_t seen, const Eigen::Isometry3f& back) const {
    if (!model_.isOriented() || seen_.facing(seen) == 0) return false;
    return !model_.hasSide(static_cast<float>(seen_.facing(seen)) * (back.linear() * seen_.normal(seen)));
  }

  /// What the scan says of a point of the model.
  [[nodiscard]] Sight sightOf(std::size_t model, const Eigen::Isometry3f& motion) const {
    const Eigen::Vector3f p = motion * model_.points()[model] + seen_.origin();
    if (sight_.origin && model_.facing(model) != 0) {
      const Eigen::Vector3f to_sensor = sight_.origin->cast<float>() - p;
      const Eigen::Vector3f normal = motion.linear() * model_.normal(model);
      if (static_cast<float>(model_.facing(model)) * normal.dot(to_sensor) < 0.0F) return Sight::hidden;
    }
    return sight_.now ? sight_.now(p) : Sight::surface;
  }

  /// Difference of the tops, m.
  [[nodiscard]] double heightError(const Eigen::Isometry3f& motion) const {
    float highest = -std::numeric_limits<float>::infinity();
    for (const auto& p : model_.points()) highest = std::max(highest, (motion * p).z());
    return static_cast<double>(std::abs(highest - seen_.highest()));
  }

  [[nodiscard]] Match verdict(const Registration& r, double visible, double height_error) const {
    const double least = std::min(r.overlap_model, r.overlap_seen);
    if (r.overlap_seen < config_.different_overlap || least < config_.least_overlap) return Match::different;
    const bool same = least >= config_.same_overlap && r.explained >= config_.least_explained &&
                      r.rms <= config_.max_rms + config_.tolerance &&
                      height_error <= config_.max_height_error + config_.tolerance &&
                      visible >= config_.min_visible && r.seen_through <= config_.max_seen_through;
    return same ? Match::same : Match::ambiguous;
  }

  static std::size_t stride(const RegistrationSurface& surface, std::size_t samples) {
    return std::max<std::size_t>(1, surface.size() / samples);
  }
  static double share(std::size_t part, std::size_t whole) {
    return whole == 0 ? 0.0 : static_cast<double>(part) / static_cast<double>(whole);
  }

  /// From motions of the surfaces about their origins to those of the world, and back.
  [[nodiscard]] Eigen::Isometry3d toWorld(const Eigen::Isometry3f& motion) const {
    Eigen::Isometry3d m = motion.cast<double>();
    m.linear() = Eigen::Quaterniond(m.linear()).normalized().toRotationMatrix();
    return Eigen::Translation3d(seen_.origin().cast<double>()) * m *
           Eigen::Translation3d(-model_.origin().cast<double>());
  }
  [[nodiscard]] Eigen::Isometry3f toLocal(const Eigen::Isometry3d& motion) const {
    const Eigen::Isometry3d m = Eigen::Translation3d(-seen_.origin().cast<double>()) * motion *
                                Eigen::Translation3d(model_.origin().cast<double>());
    return m.cast<float>();
  }

  const RegistrationConfig& config_;
  const RegistrationSight& sight_;
  float near_;
  const RegistrationSurface& model_;
  const RegistrationSurface& seen_;
  ClosestPoints points_;
};

}  // namespace

Registration registerSurfaces(const RegistrationSurface& model, const RegistrationSurface& seen,
                              const RegistrationConfig& config, const RegistrationSight& sight) {
  return Registrar(model, seen, config, sight).best();
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
