// SPDX-License-Identifier: BSD-3-Clause
#include "BeamComparison.h"

#include <algorithm>
#include <cmath>

namespace hoctomap {

namespace {

constexpr std::size_t kSearchBeams = 300;  // enough to find the offset; all beams then count
constexpr int kCoarseSteps = 5;            // to each side of zero

template <typename T>
std::vector<T> strided(const std::vector<T>& all, std::size_t most) {
  if (all.size() <= most) return all;
  std::vector<T> some;
  some.reserve(most);
  for (std::size_t i = 0; i < most; ++i) some.push_back(all[i * all.size() / most]);
  return some;
}

}  // namespace

BeamComparison::BeamComparison(const BeamExistenceConfig& config, const RangeView& view,
                               const RangeBuffer& node, const RangeBuffer* support, double resolution)
    : config_(config), view_(view) {
  collectBeams(node, support, resolution);
}

void BeamComparison::collectBeams(const RangeBuffer& node, const RangeBuffer* support, double resolution) {
  std::vector<Beam> all;
  std::vector<bool> informative;
  for (int v = node.v0(); v <= node.v1(); ++v) {
    for (int u = node.u0(); u <= node.u1(); ++u) {
      const float expected = node.at(u, v);
      if (expected == RangeBuffer::kEmpty) continue;
      const int k = std::max(1, static_cast<int>(std::lround(view_.focal() * config_.window / expected)));
      float nearest = expected;
      float farthest = expected;
      for (int y = v - k; y <= v + k; ++y) {
        for (int x = u - k; x <= u + k; ++x) {
          nearest = std::min(nearest, node.at(x, y));
          farthest = std::max(farthest, node.at(x, y));
        }
      }
      // At the silhouette mixed pixels and halos say nothing.
      if (farthest == RangeBuffer::kEmpty) continue;
      const double tolerance = config_.tolerance + 0.87 * resolution + 3.0 * config_.noise.sigma(expected);
      const float behind = support == nullptr ? RangeBuffer::kEmpty : support->at(u, v);
      all.push_back({u, v, expected, nearest, farthest, static_cast<float>(tolerance)});
      informative.push_back(behind - farthest >= 2.0 * tolerance + config_.pose_depth);
    }
  }
  std::vector<std::size_t> order(all.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  for (const std::size_t i : strided(order, static_cast<std::size_t>(config_.max_beams))) {
    if (informative[i]) {
      beams_.push_back(all[i]);
    } else {
      ++uninformative_;
    }
  }
}

BeamComparison::Counts BeamComparison::count(const std::vector<Beam>& beams, const Offset& offset) const {
  Counts counts;
  for (const Beam& beam : beams) {
    const float measured = view_.measured(beam.u + offset.du, beam.v + offset.dv);
    if (measured == 0.0F) {
      ++counts.no_return;  // never free space
      continue;
    }
    const float range = measured - offset.depth;
    if (range < beam.nearest - beam.tolerance) {
      ++counts.occluded;
    } else if (range <= beam.farthest + beam.tolerance) {
      ++counts.present;
    } else {
      ++counts.absent;
    }
  }
  return counts;
}

float BeamComparison::depthOffset(const std::vector<Beam>& beams, int du, int dv) const {
  std::vector<float> differences;
  differences.reserve(beams.size());
  const auto pose_depth = static_cast<float>(config_.pose_depth);
  for (const Beam& beam : beams) {
    const float measured = view_.measured(beam.u + du, beam.v + dv);
    const float difference = measured - beam.expected;
    if (measured > 0.0F && std::abs(difference) < pose_depth + beam.tolerance)
      differences.push_back(difference);
  }
  if (differences.empty()) return 0.0F;
  const auto middle = differences.begin() + static_cast<std::ptrdiff_t>(differences.size() / 2);
  std::nth_element(differences.begin(), middle, differences.end());
  return std::clamp(*middle, -pose_depth, pose_depth);
}

BeamComparison::Offset BeamComparison::bestOffset() const {
  const std::vector<Beam> beams = strided(beams_, kSearchBeams);
  float mean_range = 0.0F;
  for (const Beam& beam : beams) mean_range += beam.expected;
  mean_range /= static_cast<float>(beams.size());
  const double reach = view_.focal() * config_.pose_shift / mean_range;  // pixels

  Offset best;
  double best_score = -1e9;
  const auto consider = [&](int du, int dv) {
    if (du * du + dv * dv > reach * reach) return;
    const Offset offset{du, dv, depthOffset(beams, du, dv)};
    const double share =
        static_cast<double>(count(beams, offset).present) / static_cast<double>(beams.size());
    const double depth = config_.pose_depth > 0.0 ? offset.depth / config_.pose_depth : 0.0;
    const double score = share - 0.05 * ((du * du + dv * dv) / std::max(1.0, reach * reach) + depth * depth);
    if (score > best_score) {
      best_score = score;
      best = offset;
    }
  };

  consider(0, 0);
  int step = std::max(1, static_cast<int>(std::ceil(reach / kCoarseSteps)));
  for (int y = -kCoarseSteps; y <= kCoarseSteps; ++y) {
    for (int x = -kCoarseSteps; x <= kCoarseSteps; ++x) consider(x * step, y * step);
  }
  while (step > 1) {
    step /= 2;
    const Offset center = best;
    for (int y = -1; y <= 1; ++y) {
      for (int x = -1; x <= 1; ++x) consider(center.du + x * step, center.dv + y * step);
    }
  }
  return best;
}

Evidence BeamComparison::evidence(double share_in_view, const ExistenceParameters& parameters) const {
  Evidence e;
  e.p_measurement = parameters.prior;
  if (beams_.empty()) return e;
  const Counts counts = count(beams_, bestOffset());
  e.present = counts.present;
  e.absent = counts.absent;
  e.occluded = counts.occluded;

  const double n = counts.present + counts.absent;
  const double visible = n / (n + counts.occluded + counts.no_return + uninformative_);
  e.informative = n >= config_.min_beams && visible >= config_.min_visible &&
                  share_in_view >= config_.min_in_view && n >= 0.3 * (n + uninformative_);
  if (!e.informative) return e;
  // From p_absent to p_present by the share of beams that end on the node, the less the fewer they are.
  const double share_present = counts.present / n;
  const double weight = n / (n + 100.0) * std::min(1.0, visible / 0.3) * std::min(1.0, share_in_view / 0.7);
  e.p_measurement = std::clamp(probability(8.0 * (share_present - 0.5) * weight + logOdds(parameters.prior)),
                               parameters.p_absent, parameters.p_present);
  return e;
}

}  // namespace hoctomap
