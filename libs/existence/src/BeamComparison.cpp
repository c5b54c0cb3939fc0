// SPDX-License-Identifier: BSD-3-Clause
#include "BeamComparison.h"

#include <algorithm>
#include <cmath>

namespace hoctomap {

namespace {

constexpr std::size_t kSearchBeams = 300;  // enough to find the offset; all beams then count
constexpr int kCoarseSteps = 5;            // to each side of zero
constexpr std::size_t kInnerPixels = 100;  // of a node; if it has fewer, its edges count too
constexpr double kOffsetDoubt = 0.05;      // share of the beams that the largest error of a pose has to win
constexpr double kHalfWeight = 25.0;       // beams that say half of what many do

template <typename T>
std::vector<T> strided(const std::vector<T>& all, std::size_t most) {
  if (all.size() <= most) return all;
  std::vector<T> some;
  some.reserve(most);
  for (std::size_t i = 0; i < most; ++i) some.push_back(all[i * all.size() / most]);
  return some;
}

/// Where a rendered node leaves holes: numbers of empty pixels above and to the left of each, so that any
/// rectangle is counted by four of them.
class EmptyCount {
 public:
  explicit EmptyCount(const RangeBuffer& buffer)
      : buffer_(buffer), columns_(static_cast<std::size_t>(buffer.u1() - buffer.u0() + 2)) {
    count_.resize(columns_ * static_cast<std::size_t>(buffer.v1() - buffer.v0() + 2));
    std::size_t at = columns_;
    for (int v = buffer.v0(); v <= buffer.v1(); ++v) {
      std::uint32_t in_row = 0;
      ++at;
      for (int u = buffer.u0(); u <= buffer.u1(); ++u, ++at) {
        in_row += buffer.at(u, v) == RangeBuffer::kEmpty ? 1U : 0U;
        count_[at] = count_[at - columns_] + in_row;
      }
    }
  }

  /// Whether a pixel at most `k` away along both axes is empty or outside the buffer.
  [[nodiscard]] bool anyAround(int u, int v, int k) const {
    if (u - k < buffer_.u0() || v - k < buffer_.v0() || u + k > buffer_.u1() || v + k > buffer_.v1())
      return true;
    const auto before = [&](int x, int y) {  // pixels (u0 .. x-1, v0 .. y-1)
      return count_[static_cast<std::size_t>(y - buffer_.v0()) * columns_ +
                    static_cast<std::size_t>(x - buffer_.u0())];
    };
    return before(u + k + 1, v + k + 1) - before(u - k, v + k + 1) - before(u + k + 1, v - k) +
               before(u - k, v - k) !=
           0;
  }

 private:
  const RangeBuffer& buffer_;
  std::size_t columns_;
  std::vector<std::uint32_t> count_;
};

struct Pixel {
  int u;
  int v;
  int k;  ///< half width of the neighbourhood
};

/// Pixels that have the node all around them, as far as `window` metres. At the silhouette mixed pixels and
/// halos say nothing; but what is all edge, because it is small or thin, is judged by narrower
/// neighbourhoods.
std::vector<Pixel> innerPixels(const RangeBuffer& node, float focal, double window) {
  const EmptyCount empty(node);
  std::vector<Pixel> pixels;
  for (double half = window;; half *= 0.5) {
    pixels.clear();
    int widest = 1;
    for (int v = node.v0(); v <= node.v1(); ++v) {
      for (int u = node.u0(); u <= node.u1(); ++u) {
        const float expected = node.at(u, v);
        if (expected == RangeBuffer::kEmpty) continue;
        const int k = std::max(1, static_cast<int>(focal * half / expected + 0.5));
        widest = std::max(widest, k);
        if (!empty.anyAround(u, v, k)) pixels.push_back({u, v, k});
      }
    }
    if (pixels.size() >= kInnerPixels || widest == 1) return pixels;
  }
}

}  // namespace

BeamComparison::BeamComparison(const BeamExistenceConfig& config, const RangeView& view,
                               const RangeBuffer& node, const Support* support, double resolution)
    : config_(config), view_(view), support_(support) {
  collectBeams(node, resolution);
}

void BeamComparison::collectBeams(const RangeBuffer& node, double resolution) {
  const auto pixels =
      strided(innerPixels(node, view_.focal(), config_.window), static_cast<std::size_t>(config_.max_beams));
  for (const auto& [u, v, k] : pixels) {
    const float expected = node.at(u, v);
    float nearest = expected;
    float farthest = expected;
    for (int y = v - k; y <= v + k; ++y) {
      for (int x = u - k; x <= u + k; ++x) {
        nearest = std::min(nearest, node.at(x, y));
        farthest = std::max(farthest, node.at(x, y));
      }
    }
    const double tolerance = config_.rangeTolerance(resolution, expected);
    const float behind = support_ == nullptr ? RangeBuffer::kEmpty : support_->behind.at(u, v);
    const bool clear = behind - farthest >= 2.0 * tolerance + config_.pose_depth;
    beams_.push_back({u, v, expected, nearest, farthest, static_cast<float>(tolerance), clear});
  }
}

void BeamComparison::measure(const std::vector<Beam>& beams, int du, int dv, std::vector<End>& ends) const {
  ends.clear();
  for (const Beam& beam : beams) {
    const int u = beam.u + du;
    const int v = beam.v + dv;
    ends.push_back(
        {view_.measured(u, v), support_ == nullptr ? RangeBuffer::kEmpty : support_->exact.at(u, v)});
  }
}

BeamComparison::Counts BeamComparison::count(const std::vector<Beam>& beams, const std::vector<End>& ends,
                                             float depth) {
  Counts counts;
  for (std::size_t i = 0; i < beams.size(); ++i) {
    const Beam& beam = beams[i];
    const auto& [measured, background] = ends[i];
    if (measured == 0.0F) {
      ++counts.no_return;  // never free space
      continue;
    }
    const float range = measured - depth;
    if (range < beam.nearest - beam.tolerance) {
      ++counts.occluded;
      continue;
    }
    // A beam that ends on what is mapped there anyway is not the node's, whatever the error of the pose.
    const bool on_node = range <= beam.farthest + beam.tolerance &&
                         std::abs(range - beam.expected) <= std::abs(measured - background);
    counts.nearer_to_node += on_node;
    // Where the background is nearer than beams are sure of, one that ends there may end on the node as well.
    const bool may_be_on_node = std::abs(background - beam.expected) < beam.tolerance &&
                                std::abs(measured - background) < beam.tolerance;
    if (on_node || (may_be_on_node && !beam.clear)) {
      ++(beam.clear ? counts.present : counts.unclear_present);
    } else {
      ++(beam.clear ? counts.absent : counts.unclear_absent);
    }
  }
  return counts;
}

float BeamComparison::depthOffset(const std::vector<Beam>& beams, const std::vector<End>& ends, float about,
                                  std::vector<float>& scratch) const {
  scratch.clear();
  const auto pose_depth = static_cast<float>(config_.pose_depth);
  for (std::size_t i = 0; i < beams.size(); ++i) {
    const float difference = ends[i].measured - beams[i].expected;
    if (ends[i].measured > 0.0F && std::abs(difference - about) < pose_depth + beams[i].tolerance)
      scratch.push_back(difference);
  }
  if (scratch.empty()) return about;
  const auto middle = scratch.begin() + static_cast<std::ptrdiff_t>(scratch.size() / 2);
  std::nth_element(scratch.begin(), middle, scratch.end());
  return std::clamp(*middle, about - pose_depth, about + pose_depth);
}

BeamComparison::Offset BeamComparison::bestOffset(const Offset& about) const {
  const std::vector<Beam> beams = strided(beams_, kSearchBeams);
  float mean_range = 0.0F;
  for (const Beam& beam : beams) mean_range += beam.expected;
  mean_range /= static_cast<float>(beams.size());
  const double reach = view_.focal() * config_.pose_shift / mean_range;  // pixels

  Offset best;
  double best_score = -1e9;
  std::vector<End> ends;
  std::vector<float> scratch;
  const auto consider = [&](int du, int dv) {  // beside `about`
    if (du * du + dv * dv > reach * reach) return;
    measure(beams, about.du + du, about.dv + dv, ends);
    Offset offset{about.du + du, about.dv + dv, depthOffset(beams, ends, about.depth, scratch)};
    const double share = static_cast<double>(count(beams, ends, offset.depth).nearer_to_node) /
                         static_cast<double>(beams.size());
    const double depth = config_.pose_depth > 0.0 ? (offset.depth - about.depth) / config_.pose_depth : 0.0;
    offset.doubt = kOffsetDoubt * ((du * du + dv * dv) / std::max(1.0, reach * reach) + depth * depth);
    if (share - offset.doubt > best_score) {
      best_score = share - offset.doubt;
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
      for (int x = -1; x <= 1; ++x)
        consider(center.du - about.du + x * step, center.dv - about.dv + y * step);
    }
  }
  return best;
}

Eigen::Vector3d BeamComparison::shiftOf(const Offset& offset) const {
  const Beam& beam = beams_[beams_.size() / 2];  // all are about as far
  const auto at = [](int x) { return static_cast<float>(x); };
  return (view_.worldPoint({at(beam.u + offset.du), at(beam.v + offset.dv), beam.expected + offset.depth}) -
          view_.worldPoint({at(beam.u), at(beam.v), beam.expected}))
      .cast<double>();
}

BeamComparison::Offset BeamComparison::offsetOf(const Eigen::Vector3d& shift) const {
  const Beam& beam = beams_[beams_.size() / 2];
  const Eigen::Vector3f p =
      view_.worldPoint({static_cast<float>(beam.u), static_cast<float>(beam.v), beam.expected});
  const auto pixel = view_.project(p + shift.cast<float>());
  if (!pixel) return {};
  return {static_cast<int>(std::lround(pixel->u)) - beam.u, static_cast<int>(std::lround(pixel->v)) - beam.v,
          pixel->range - beam.expected};
}

Evidence BeamComparison::evidence(double share_in_view, const ExistenceParameters& parameters,
                                  const Eigen::Vector3d& scan_shift) const {
  Evidence e;
  e.p_measurement = parameters.prior;
  if (beams_.empty()) return e;
  const Offset offset = bestOffset(offsetOf(scan_shift));
  std::vector<End> ends;
  measure(beams_, offset.du, offset.dv, ends);
  const Counts counts = count(beams_, ends, offset.depth);
  e.present = counts.present;
  e.absent = counts.absent;
  e.occluded = counts.occluded;
  e.shift = shiftOf(offset);

  const auto all = static_cast<double>(beams_.size());
  const auto isEnough = [&](double n) {
    return n >= config_.min_beams && n >= config_.min_visible * all && share_in_view >= config_.min_in_view;
  };
  e.in_sight = isEnough(counts.reached());
  double n = counts.present + counts.absent;
  double share_present = counts.present / n;
  e.informative = isEnough(n) && n >= 0.3 * (n + counts.unclear_present + counts.unclear_absent);
  // Where the background is near, beams that end on the node say little, but those that pass it do.
  if (!e.informative && isEnough(counts.reached()) &&
      counts.present_at_most() < (0.5 + offset.doubt) * counts.reached()) {
    e.informative = true;
    e.present = counts.present_at_most();
    e.absent = counts.absent + counts.unclear_absent;
    n = counts.reached();
    share_present = e.present / n - offset.doubt;
  }
  if (!e.informative) return e;
  // From p_absent to p_present by the share of beams that end on the node, the less the fewer they are.
  const double weight =
      n / (n + kHalfWeight) * std::min(1.0, n / all / 0.3) * std::min(1.0, share_in_view / 0.7);
  e.p_measurement = std::clamp(probability(8.0 * (share_present - 0.5) * weight + logOdds(parameters.prior)),
                               parameters.p_absent, parameters.p_present);
  return e;
}

}  // namespace hoctomap
