// SPDX-License-Identifier: BSD-3-Clause
#include "hoctomap/mapping/Registration.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "SurfacePoints.h"

namespace hoctomap {

namespace {

constexpr std::size_t kCoarsePoints = 120;  // enough to tell the turns apart
constexpr int kCoarseSteps = 9;
constexpr std::size_t kFinePoints = 350;
constexpr std::size_t kRefinedStarts = 4;
constexpr double kOtherTurn = 0.17;  // rad; nearer turns are one fit
constexpr double kTrimmed = 0.85;    // share of the pairs that is believed

/// A point of the model where it is now, the seen point it should come to lie on, and the surface there.
struct Pair {
  Eigen::Vector3f model;
  Eigen::Vector3f seen;
  Eigen::Vector3f normal;
  float squared_distance;
};

enum class Freedom { yaw_and_shift, rigid };

/// About `count` points, evenly spread over the list.
std::vector<Eigen::Vector3f> thinned(const std::vector<Eigen::Vector3f>& points, std::size_t count) {
  const std::size_t step = std::max<std::size_t>(1, points.size() / count);
  std::vector<Eigen::Vector3f> kept;
  for (std::size_t i = 0; i < points.size(); i += step) kept.push_back(points[i]);
  return kept;
}

/// The small motion that brings the pairs together: least squares of the distances along the normals (Chen
/// and Medioni 1992), with a little of the plain distances so that planes do not slide.
Eigen::Isometry3f bestStep(const std::vector<Pair>& pairs, const Eigen::Vector3f& centre, Freedom freedom) {
  using Matrix6 = Eigen::Matrix<double, 6, 6>;
  using Vector6 = Eigen::Matrix<double, 6, 1>;
  constexpr double kPlainWeight = 0.1;
  Matrix6 normal_matrix = Matrix6::Zero();
  Vector6 right = Vector6::Zero();
  for (const Pair& pair : pairs) {
    const Eigen::Vector3d arm = (pair.model - centre).cast<double>();
    const Eigen::Vector3d gap = (pair.seen - pair.model).cast<double>();
    const auto add = [&](const Eigen::Vector3d& direction, double weight) {
      Vector6 row;
      row << arm.cross(direction), direction;
      if (freedom == Freedom::yaw_and_shift) row.head<2>().setZero();
      normal_matrix += weight * row * row.transpose();
      right += weight * direction.dot(gap) * row;
    };
    add(pair.normal.cast<double>(), 1.0);
    for (int axis = 0; axis < 3; ++axis) add(Eigen::Vector3d::Unit(axis), kPlainWeight);
  }
  if (freedom == Freedom::yaw_and_shift) normal_matrix.topLeftCorner<2, 2>().setIdentity();
  const Vector6 step = normal_matrix.ldlt().solve(right);
  const Eigen::Vector3d turn = step.head<3>();
  Eigen::Isometry3d motion = Eigen::Translation3d(centre.cast<double>() + step.tail<3>()) *
                             Eigen::Quaterniond(Eigen::AngleAxisd(turn.norm(), turn.stableNormalized())) *
                             Eigen::Translation3d(-centre.cast<double>());
  return motion.cast<float>();
}

class Registrar {
 public:
  Registrar(std::span<const Eigen::Vector3f> model, std::span<const Eigen::Vector3f> seen,
            const RegistrationConfig& config, const std::function<Sight(const Eigen::Vector3f&)>& sight,
            const std::function<bool(const Eigen::Vector3f&)>& was_shown)
      : config_(config),
        sight_(sight),
        was_shown_(was_shown),
        near_(static_cast<float>(config.near + config.tolerance)),
        model_(model, static_cast<float>(config.spacing)),
        seen_(seen, static_cast<float>(config.spacing)) {}

  [[nodiscard]] Registration best() const {
    if (model_.points().size() < 10 || seen_.points().size() < 10) {
      Registration none;
      none.verdict = Match::ambiguous;  // too few points to say anything
      return none;
    }
    Registration rest = judged(Eigen::Isometry3f::Identity());
    rest.rest_score = rest.score;
    if (rest.score >= config_.at_rest) return rest;
    std::vector<Registration> candidates;
    for (const Eigen::Isometry3f& start : coarseMotions()) candidates.push_back(judged(refined(start, 8)));
    const Registration* best = &*std::max_element(candidates.begin(), candidates.end(), fitsWorse);
    // A round thing fits at any turn: the one it had is kept.
    for (const Registration& c : candidates) {
      if (c.verdict == best->verdict && quality(c) >= quality(*best) - config_.rival_score &&
          turn(c.motion) < turn(best->motion) - kOtherTurn) {
        best = &c;
      }
    }
    const Registration polished = judged(refined(best->motion.cast<float>(), 16));
    Registration result = fitsWorse(polished, *best) ? *best : polished;
    result.rest_score = rest.score;
    return result;
  }

 private:
  static double quality(const Registration& r) {
    constexpr double kOfRms = 20.0;     // per metre: breaks ties of overlaps that are all but complete
    constexpr double kExplained = 0.5;  // lest a motion win by taking for new sides what it does not fit
    return r.score + kExplained * r.explained - kOfRms * r.rms;
  }
  static bool fitsWorse(const Registration& a, const Registration& b) { return quality(a) < quality(b); }

  static double turn(const Eigen::Isometry3d& motion) { return Eigen::AngleAxisd(motion.rotation()).angle(); }

  /// Turns about the vertical through the aligned centroids, each brought near by yaw and shift; the best
  /// few.
  [[nodiscard]] std::vector<Eigen::Isometry3f> coarseMotions() const {
    const auto seen = thinned(seen_.points(), kCoarsePoints);
    std::vector<std::pair<double, Eigen::Isometry3f>> ranked;
    for (int k = 0; k < config_.yaw_starts; ++k) {
      const auto yaw = static_cast<float>(2.0 * std::numbers::pi * k / config_.yaw_starts);
      Eigen::Isometry3f motion = Eigen::Isometry3f::Identity();
      motion.rotate(Eigen::AngleAxisf(yaw, Eigen::Vector3f::UnitZ()));
      motion.translation() = seen_.centroid() - motion.linear() * model_.centroid();
      for (int step = 0; step < kCoarseSteps; ++step) {
        const float radius = 0.060F - 0.005F * static_cast<float>(step);
        if (!improve(motion, seen, {}, radius, Freedom::yaw_and_shift)) break;
      }
      ranked.emplace_back(-shareNear(motion, seen), motion);
    }
    std::stable_sort(ranked.begin(), ranked.end(),
                     [](const auto& a, const auto& b) { return a.first < b.first; });
    std::vector<Eigen::Isometry3f> best;
    for (const auto& [cost, motion] : ranked) {
      if (best.size() == kRefinedStarts) break;
      const bool is_new = std::none_of(best.begin(), best.end(), [&m = motion](const auto& other) {
        return m.isApprox(other, 1e-2F);  // several starts end in one place
      });
      if (is_new) best.push_back(motion);
    }
    return best;
  }

  /// Brings a motion that is right to a centimetre or two to its end: first yaw and shift, then all six.
  [[nodiscard]] Eigen::Isometry3f refined(Eigen::Isometry3f motion, int steps) const {
    const auto seen = thinned(seen_.points(), kFinePoints);
    const auto model = thinned(model_.points(), kFinePoints);
    for (int step = 0; step < steps; ++step) {
      const Eigen::Isometry3f before = motion;
      const float radius = std::max(near_, 0.020F - 0.0020F * static_cast<float>(step));
      const Freedom freedom = step < steps / 2 ? Freedom::yaw_and_shift : Freedom::rigid;
      if (!improve(motion, seen, model, radius, freedom)) break;
      const bool settled = (motion * model_.centroid() - before * model_.centroid()).norm() < 1e-5F &&
                           motion.linear().isApprox(before.linear(), 1e-4F);
      if (settled && freedom == Freedom::rigid) break;
    }
    return motion;
  }

  /// One step of trimmed ICP. @return false if too few pairs are left
  bool improve(Eigen::Isometry3f& motion, const std::vector<Eigen::Vector3f>& seen,
               const std::vector<Eigen::Vector3f>& model, float radius, Freedom freedom) const {
    std::vector<Pair> pairs;
    const Eigen::Isometry3f back = motion.inverse();
    for (const auto& q : seen) {
      if (const auto p = model_.nearest(back * q, radius)) {
        pairs.push_back({motion * *p->point, q, motion.linear() * *p->normal, p->squared_distance});
      }
    }
    for (const auto& p : model) {
      const Eigen::Vector3f at = motion * p;
      if (const auto q = seen_.nearest(at, radius)) {
        pairs.push_back({at, *q->point, *q->normal, q->squared_distance});
      }
    }
    const auto kept = static_cast<std::size_t>(kTrimmed * static_cast<double>(pairs.size()));
    if (kept < 6) return false;
    std::nth_element(pairs.begin(), pairs.begin() + static_cast<std::ptrdiff_t>(kept), pairs.end(),
                     [](const Pair& a, const Pair& b) { return a.squared_distance < b.squared_distance; });
    pairs.resize(kept);
    motion = bestStep(pairs, motion * model_.centroid(), freedom) * motion;
    return true;
  }

  [[nodiscard]] double shareNear(const Eigen::Isometry3f& motion,
                                 const std::vector<Eigen::Vector3f>& seen) const {
    const Eigen::Isometry3f back = motion.inverse();
    const auto count = std::count_if(seen.begin(), seen.end(), [&](const auto& q) {
      return model_.nearest(back * q, 2.0F * near_).has_value();
    });
    return static_cast<double>(count) / static_cast<double>(seen.size());
  }

  [[nodiscard]] Registration judged(const Eigen::Isometry3f& motion) const {
    Registration r;
    r.motion = motion.cast<double>();
    r.motion.linear() = Eigen::Quaterniond(r.motion.linear()).normalized().toRotationMatrix();
    double squares = 0.0;
    std::size_t pairs = 0;

    const Eigen::Isometry3f back = motion.inverse();
    std::size_t seen_near = 0;
    std::size_t new_sides = 0;
    for (const auto& q : seen_.points()) {
      const Eigen::Vector3f before = back * q;
      const auto p = model_.nearest(before, near_);
      if (!p) {
        if (was_shown_ && !was_shown_(before)) ++new_sides;
        continue;
      }
      ++seen_near;
      squares += static_cast<double>(p->squared_distance);
      ++pairs;
    }
    std::size_t model_near = 0;
    std::size_t model_missed = 0;
    std::size_t model_through = 0;
    float highest = -std::numeric_limits<float>::infinity();
    for (const auto& at : model_.points()) {
      const Eigen::Vector3f p = motion * at;
      highest = std::max(highest, p.z());
      if (const auto q = seen_.nearest(p, near_)) {
        ++model_near;
        squares += static_cast<double>(q->squared_distance);
        ++pairs;
        continue;
      }
      const Sight sight = sight_ ? sight_(p) : Sight::surface;
      if (sight == Sight::hidden) continue;
      ++model_missed;
      if (sight == Sight::seen_through) ++model_through;
    }
    const std::size_t visible = model_near + model_missed;
    r.overlap_seen = share(seen_near, seen_.points().size() - new_sides);
    r.overlap_model = share(model_near, visible);
    r.seen_through = share(model_through, visible);
    r.rms = pairs == 0 ? 0.0 : std::sqrt(squares / static_cast<double>(pairs));
    r.score = std::min(r.overlap_model, r.overlap_seen);
    r.explained = share(seen_near, seen_.points().size());
    r.verdict = verdict(r, share(visible, model_.points().size()),
                        std::abs(static_cast<double>(highest - seen_.highest())));
    return r;
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

  static double share(std::size_t part, std::size_t whole) {
    return whole == 0 ? 0.0 : static_cast<double>(part) / static_cast<double>(whole);
  }

  const RegistrationConfig& config_;
  const std::function<Sight(const Eigen::Vector3f&)>& sight_;
  const std::function<bool(const Eigen::Vector3f&)>& was_shown_;
  float near_;
  SurfacePoints model_;
  SurfacePoints seen_;
};

}  // namespace

Registration registerPoints(std::span<const Eigen::Vector3f> model_world,
                            std::span<const Eigen::Vector3f> seen_world, const RegistrationConfig& config,
                            const std::function<Sight(const Eigen::Vector3f&)>& sight,
                            const std::function<bool(const Eigen::Vector3f&)>& was_shown) {
  // About the object itself: single precision near the world's origin is not that of far away.
  if (model_world.empty() || seen_world.empty()) return {};
  const Eigen::Vector3f centre = model_world.front();
  std::vector<Eigen::Vector3f> model(model_world.begin(), model_world.end());
  std::vector<Eigen::Vector3f> seen(seen_world.begin(), seen_world.end());
  for (auto& p : model) p -= centre;
  for (auto& p : seen) p -= centre;
  std::function<Sight(const Eigen::Vector3f&)> local;
  if (sight) local = [&](const Eigen::Vector3f& p) { return sight(p + centre); };
  std::function<bool(const Eigen::Vector3f&)> local_shown;
  if (was_shown) local_shown = [&](const Eigen::Vector3f& p) { return was_shown(p + centre); };
  Registration r = Registrar(model, seen, config, local, local_shown).best();
  const Eigen::Translation3d to_world(centre.cast<double>());
  r.motion = to_world * r.motion * to_world.inverse();
  return r;
}

}  // namespace hoctomap
