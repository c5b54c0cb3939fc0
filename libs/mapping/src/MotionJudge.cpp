// SPDX-License-Identifier: BSD-3-Clause
#include "MotionJudge.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace hoctomap {

namespace {

std::size_t stride(const RegistrationSurface& surface, std::size_t samples) {
  return std::max<std::size_t>(1, surface.size() / samples);
}

double share(std::size_t part, std::size_t whole) {
  return whole == 0 ? 0.0 : static_cast<double>(part) / static_cast<double>(whole);
}

}  // namespace

Registration MotionJudge::judged(const Eigen::Isometry3f& motion, std::size_t samples) const {
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

bool MotionJudge::isNewSide(std::size_t seen, const Eigen::Isometry3f& back) const {
  if (!model_.isOriented() || seen_.facing(seen) == 0) return false;
  return !model_.hasSide(static_cast<float>(seen_.facing(seen)) * (back.linear() * seen_.normal(seen)));
}

Sight MotionJudge::sightOf(std::size_t model, const Eigen::Isometry3f& motion) const {
  const Eigen::Vector3f p = motion * model_.points()[model] + seen_.origin();
  if (sight_.origin && model_.facing(model) != 0) {
    const Eigen::Vector3f to_sensor = sight_.origin->cast<float>() - p;
    const Eigen::Vector3f normal = motion.linear() * model_.normal(model);
    if (static_cast<float>(model_.facing(model)) * normal.dot(to_sensor) < 0.0F) return Sight::hidden;
  }
  return sight_.now ? sight_.now(p) : Sight::surface;
}

double MotionJudge::heightError(const Eigen::Isometry3f& motion) const {
  float highest = -std::numeric_limits<float>::infinity();
  for (const auto& p : model_.points()) highest = std::max(highest, (motion * p).z());
  return static_cast<double>(std::abs(highest - seen_.highest()));
}

Match MotionJudge::verdict(const Registration& r, double visible, double height_error) const {
  const double least = std::min(r.overlap_model, r.overlap_seen);
  if (r.overlap_seen < config_.different_overlap || least < config_.least_overlap) return Match::different;
  const bool same = least >= config_.same_overlap && r.explained >= config_.least_explained &&
                    r.rms <= config_.max_rms + config_.tolerance &&
                    height_error <= config_.max_height_error + config_.tolerance &&
                    visible >= config_.min_visible && r.seen_through <= config_.max_seen_through;
  return same ? Match::same : Match::ambiguous;
}

Eigen::Isometry3d MotionJudge::toWorld(const Eigen::Isometry3f& motion) const {
  Eigen::Isometry3d m = motion.cast<double>();
  m.linear() = Eigen::Quaterniond(m.linear()).normalized().toRotationMatrix();
  return Eigen::Translation3d(seen_.origin().cast<double>()) * m *
         Eigen::Translation3d(-model_.origin().cast<double>());
}

Eigen::Isometry3f MotionJudge::toLocal(const Eigen::Isometry3d& motion) const {
  const Eigen::Isometry3d m = Eigen::Translation3d(-seen_.origin().cast<double>()) * motion *
                              Eigen::Translation3d(model_.origin().cast<double>());
  return m.cast<float>();
}

}  // namespace hoctomap
