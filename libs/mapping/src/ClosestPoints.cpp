// SPDX-License-Identifier: BSD-3-Clause
#include "ClosestPoints.h"

#include <algorithm>
#include <cmath>

namespace hoctomap {

namespace {

constexpr double kTrimmed = 0.85;  // share of the pairs that is believed
constexpr std::size_t kLeastPairs = 6;
constexpr float kBeyond = 0.01F;  // m beyond an edge, where nothing of the object must be
constexpr float kOneSide = RegistrationSurface::kOneSide;
constexpr float kOverEdge = 0.75F;  // spacings beyond an edge: less is chance

/// Every how many of `size` points make about `samples` of them.
std::size_t strideFor(std::size_t size, std::size_t samples) {
  return std::max<std::size_t>(1, size / samples);
}

/// Least squares for a small motion about `centre`: each row says how far a point should go in a direction.
class Equations {
 public:
  explicit Equations(const Eigen::Vector3f& centre) : centre_(centre) {}

  void add(const Eigen::Vector3f& at, const Eigen::Vector3f& direction, float gap, double weight) {
    Vector6 row;
    row << (at - centre_).cross(direction).cast<double>(), direction.cast<double>();
    matrix_ += weight * row * row.transpose();
    right_ += weight * static_cast<double>(gap) * row;
  }
  /// All three directions: lest planes slide away, or stay where they are.
  void addPlain(const Eigen::Vector3f& at, const Eigen::Vector3f& gap, double weight) {
    for (int axis = 0; axis < 3; ++axis) add(at, Eigen::Vector3f::Unit(axis), gap[axis], weight);
  }

  [[nodiscard]] Eigen::Isometry3f solved(Freedom freedom) const {
    Matrix6 matrix = matrix_;
    Vector6 right = right_;
    if (freedom == Freedom::yaw_and_shift) {
      matrix.topRows<2>().setZero();
      matrix.leftCols<2>().setZero();
      matrix.topLeftCorner<2, 2>().setIdentity();
      right.head<2>().setZero();
    }
    const Vector6 step = matrix.ldlt().solve(right);
    const Eigen::Vector3d turn = step.head<3>();
    const Eigen::Isometry3d motion =
        Eigen::Translation3d(centre_.cast<double>() + step.tail<3>()) *
        Eigen::Quaterniond(Eigen::AngleAxisd(turn.norm(), turn.stableNormalized())) *
        Eigen::Translation3d(-centre_.cast<double>());
    return motion.cast<float>();
  }

 private:
  using Matrix6 = Eigen::Matrix<double, 6, 6>;
  using Vector6 = Eigen::Matrix<double, 6, 1>;

  Eigen::Vector3f centre_;
  Matrix6 matrix_ = Matrix6::Zero();
  Vector6 right_ = Vector6::Zero();
};

}  // namespace

ClosestPoints::ClosestPoints(const RegistrationSurface& model, const RegistrationSurface& seen,
                             const RegistrationSight& sight)
    : model_(model), seen_(seen), sight_(sight), model_ends_(model.size(), 0), seen_ends_(seen.size(), 0) {
  for (std::size_t i = 0; i < model.size(); ++i) {
    if (model.outward(i).isZero()) continue;
    const Eigen::Vector3f beyond = model.points()[i] + kBeyond * model.outward(i);
    model_ends_[i] = !sight.was_shown || sight.was_shown(beyond + model.origin()) ? 1 : 0;
  }
  for (std::size_t i = 0; i < seen.size(); ++i) {
    if (seen.outward(i).isZero()) continue;
    seen_ends_[i] = isHidden(seen.points()[i] + kBeyond * seen.outward(i)) ? 0 : 1;
  }
}

bool ClosestPoints::isHidden(const Eigen::Vector3f& p) const {
  return sight_.now && sight_.now(p + seen_.origin()) == Sight::hidden;
}

Eigen::Isometry3f ClosestPoints::atRest() const {
  return Eigen::Isometry3f(Eigen::Translation3f(model_.origin() - seen_.origin()));
}

Eigen::Isometry3f ClosestPoints::turned(float yaw) const {
  Eigen::Isometry3f motion = Eigen::Isometry3f::Identity();
  motion.rotate(Eigen::AngleAxisf(yaw, Eigen::Vector3f::UnitZ()));
  motion.translation() = seen_.centroid() - motion.linear() * model_.centroid();
  return motion;
}

bool ClosestPoints::trim(Pairs& pairs) {
  const auto kept = static_cast<std::size_t>(kTrimmed * static_cast<double>(pairs.size()));
  if (kept < kLeastPairs) return false;
  std::nth_element(pairs.begin(), pairs.begin() + static_cast<std::ptrdiff_t>(kept), pairs.end(),
                   [](const Pair& a, const Pair& b) { return a.squared_error < b.squared_error; });
  pairs.resize(kept);
  return true;
}

void ClosestPoints::approach(Eigen::Isometry3f& motion, int steps, float radius, float least_radius,
                             std::size_t samples) const {
  constexpr double kPlainWeight = 0.1;
  const std::size_t stride = strideFor(seen_.size(), samples);
  const float shrink = (radius - least_radius) / static_cast<float>(std::max(1, steps - 1));
  Pairs pairs;
  for (int step = 0; step < steps; ++step) {
    const Eigen::Isometry3f back = motion.inverse();
    pairs.clear();
    for (std::size_t i = 0; i < seen_.size(); i += stride) {
      const auto p = model_.nearest(back * seen_.points()[i], radius - shrink * static_cast<float>(step));
      if (p) pairs.push_back({p->index, i, p->squared_distance, true});
    }
    if (!trim(pairs)) return;
    Equations equations(motion * model_.centroid());
    for (const Pair& pair : pairs) {
      const Eigen::Vector3f at = motion * model_.points()[pair.model];
      const Eigen::Vector3f gap = seen_.points()[pair.seen] - at;
      const Eigen::Vector3f normal = motion.linear() * model_.normal(pair.model);
      equations.add(at, normal, normal.dot(gap), 1.0);
      equations.addPlain(at, gap, kPlainWeight);
    }
    motion = equations.solved(Freedom::yaw_and_shift) * motion;
  }
}

float ClosestPoints::meanDistance(const Eigen::Isometry3f& motion, float radius, std::size_t samples) const {
  const std::size_t stride = strideFor(seen_.size(), samples);
  const Eigen::Isometry3f back = motion.inverse();
  float sum = 0.0F;
  std::size_t asked = 0;
  for (std::size_t i = 0; i < seen_.size(); i += stride, ++asked) {
    const auto p = model_.nearest(back * seen_.points()[i], radius);
    sum += p ? std::sqrt(p->squared_distance) : radius;
  }
  return sum / static_cast<float>(std::max<std::size_t>(1, asked));
}

std::optional<SurfacePoints::Neighbour> ClosestPoints::modelFor(std::size_t seen,
                                                                const Eigen::Isometry3f& back,
                                                                float radius) const {
  const Eigen::Vector3f at = back * seen_.points()[seen];
  if (seen_ends_[seen] == 0) return model_.nearest(at, radius);
  return model_.nearestOnSide(at, back.linear() * seen_.normal(seen), radius);
}

std::optional<SurfacePoints::Neighbour> ClosestPoints::seenFor(std::size_t model,
                                                               const Eigen::Isometry3f& motion,
                                                               float radius) const {
  const Eigen::Vector3f at = motion * model_.points()[model];
  if (model_ends_[model] == 0) return seen_.nearest(at, radius);
  return seen_.nearestOnSide(at, motion.linear() * model_.normal(model), radius);
}

ClosestPoints::Pairs ClosestPoints::pairsOf(const Eigen::Isometry3f& motion, float radius,
                                            std::size_t samples) const {
  Pairs pairs;
  const auto add = [&](std::size_t model, std::size_t seen, bool asked_seen) {
    const Eigen::Vector3f model_normal = motion.linear() * model_.normal(model);
    const Eigen::Vector3f& seen_normal = seen_.normal(seen);
    if (std::abs(model_normal.dot(seen_normal)) < kOneSide) return;
    const Eigen::Vector3f gap = seen_.points()[seen] - motion * model_.points()[model];
    const float across = gap.dot(asked_seen ? model_normal : seen_normal);
    pairs.push_back({model, seen, across * across, asked_seen});
  };
  const Eigen::Isometry3f back = motion.inverse();
  for (std::size_t i = 0; i < seen_.size(); i += strideFor(seen_.size(), samples)) {
    if (const auto p = modelFor(i, back, radius)) add(p->index, i, true);
  }
  for (std::size_t i = 0; i < model_.size(); i += strideFor(model_.size(), samples)) {
    const auto q = seenFor(i, motion, radius);
    if (q && !isHidden(motion * model_.points()[i])) add(i, q->index, false);
  }
  return pairs;
}

std::optional<Eigen::Vector3f> ClosestPoints::edgeOf(const Pair& pair,
                                                     const Eigen::Isometry3f& motion) const {
  const bool found_end = (pair.asked_seen ? model_ends_[pair.model] : seen_ends_[pair.seen]) != 0;
  if (!found_end) return std::nullopt;
  const Eigen::Vector3f of_model = motion.linear() * model_.outward(pair.model);
  const Eigen::Vector3f& of_seen = seen_.outward(pair.seen);
  const Eigen::Vector3f edge = pair.asked_seen ? of_model : of_seen;
  const bool asked_end = (pair.asked_seen ? seen_ends_[pair.seen] : model_ends_[pair.model]) != 0;
  if (asked_end && of_model.dot(of_seen) >= kOneSide) return edge;
  const Eigen::Vector3f gap = seen_.points()[pair.seen] - motion * model_.points()[pair.model];
  const float beyond = pair.asked_seen ? gap.dot(edge) : -gap.dot(edge);
  if (beyond < kOverEdge * std::max(model_.spacing(), seen_.spacing())) return std::nullopt;
  return edge;
}

Eigen::Isometry3f ClosestPoints::refined(Eigen::Isometry3f motion, int steps, float near, Freedom freedom,
                                         std::size_t samples) const {
  constexpr double kPlainWeight = 0.002;  // where there is no outline
  for (int step = 0; step < steps; ++step) {
    const Eigen::Isometry3f before = motion;
    Pairs pairs = pairsOf(motion, std::max(near, 0.020F - 0.0025F * static_cast<float>(step)), samples);
    if (!trim(pairs)) break;
    Equations equations(motion * model_.centroid());
    for (const Pair& pair : pairs) {
      const Eigen::Vector3f at = motion * model_.points()[pair.model];
      const Eigen::Vector3f gap = seen_.points()[pair.seen] - at;
      const Eigen::Vector3f normal = pair.asked_seen
                                         ? Eigen::Vector3f(motion.linear() * model_.normal(pair.model))
                                         : seen_.normal(pair.seen);
      equations.add(at, normal, normal.dot(gap), 1.0);
      if (const auto edge = edgeOf(pair, motion)) {
        equations.add(at, *edge, edge->dot(gap), 1.0);
      } else {
        equations.addPlain(at, gap, kPlainWeight);
      }
    }
    motion = equations.solved(freedom) * motion;
    const bool settled = (motion * model_.centroid() - before * model_.centroid()).norm() < 1e-4F &&
                         motion.linear().isApprox(before.linear(), 1e-3F);
    if (settled && step >= 4) break;
  }
  return motion;
}

double ClosestPoints::outlineError(const Eigen::Isometry3f& motion, float radius) const {
  double squares = 0.0;
  std::size_t rows = 0;
  const auto count = [&](const Pair& pair) {
    const auto edge = edgeOf(pair, motion);
    if (!edge) return;
    const Eigen::Vector3f gap = seen_.points()[pair.seen] - motion * model_.points()[pair.model];
    squares += std::pow(static_cast<double>(edge->dot(gap)), 2);
    ++rows;
  };
  const Eigen::Isometry3f back = motion.inverse();
  for (std::size_t i = 0; i < seen_.size(); ++i) {
    if (seen_ends_[i] == 0) continue;
    if (const auto p = modelFor(i, back, radius)) count({p->index, i, 0.0F, true});
  }
  for (std::size_t i = 0; i < model_.size(); ++i) {
    if (model_ends_[i] == 0) continue;
    const auto q = seenFor(i, motion, radius);
    if (q && !isHidden(motion * model_.points()[i])) count({i, q->index, 0.0F, false});
  }
  // Few of them are chance.
  constexpr double kOutlinePoints = 0.03;  // of all points
  const double least = kOutlinePoints * static_cast<double>(model_.size() + seen_.size());
  return std::sqrt(squares / std::max(static_cast<double>(rows), least));
}

}  // namespace hoctomap
