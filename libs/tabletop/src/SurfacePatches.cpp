// SPDX-License-Identifier: BSD-3-Clause
#include "SurfacePatches.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace hoctomap {
namespace {

// rad at 1 m, of the normal of a patch: what the noise of its pixels leaves. 15 mm for a Kinect at 1 m.
constexpr double kNormalError = 0.043;
constexpr int kLeastCell = 4;            // pixels; fewer do not hold a plane against the noise
constexpr double kWidestCell = 0.035;    // rad; what is wider spans things
constexpr double kBridgeAngle = 0.0057;  // rad: shadows of the projector along the edges of objects
// A patch spans curvature and the steps of the disparity: its scatter is larger than the noise of one range.
constexpr double kScatterOfNoise = 10.0 / 3.0;
constexpr double kJumpOfScatter = 4.0;
constexpr double kLeastNoise = 1e-4;  // 1/m, for sensors said to have none

constexpr int kRounds = 5;                // of the assignment; the borders settle in four
constexpr double kMostMisfit = 36.0;      // squared scatters that one pixel may count
constexpr double kCompactness = 8.0;      // squared scatters for a distance of one cell
constexpr double kTinyPenalty = 3.0;      // for patches too small to have a plane
constexpr double kTinyShare = 10.0 / 64;  // of a cell
constexpr double kScrapShare = 12.0 / 64;
constexpr double kMostScrapMisfit = 25.0;

/// Pixels. The slope of a square of n x n pixels in w has the standard deviation sqrt(12) noise / n^2, which
/// tilts the normal by that times the focal length.
int cellOf(double focal_length, double noise) {
  const double cell = std::sqrt(std::sqrt(12.0) * noise * focal_length / kNormalError);
  return std::max(kLeastCell, static_cast<int>(std::lround(std::min(cell, kWidestCell * focal_length))));
}

using Labels = std::vector<std::int32_t>;

std::size_t index(const InverseDepthImage& image, int u, int v) {
  return static_cast<std::size_t>(v) * static_cast<std::size_t>(image.width) + static_cast<std::size_t>(u);
}

/// Numbers the 4-connected parts of equal `group` among whose neighbours w differs by less than `step`;
/// returns how many there are.
int connectedParts(const InverseDepthImage& image, const Labels& group, double step, Labels& label) {
  label.assign(image.size(), SurfacePatches::kNone);
  const auto most = static_cast<float>(step);
  const auto width = static_cast<std::size_t>(image.width);
  std::vector<std::size_t> stack;
  int parts = 0;
  for (std::size_t seed = 0; seed < image.size(); ++seed) {
    if (!image.object[seed] || label[seed] >= 0) continue;
    const auto id = group[seed];
    label[seed] = parts;
    stack.push_back(seed);
    while (!stack.empty()) {
      const std::size_t at = stack.back();
      stack.pop_back();
      const float w = image.w[at];
      const auto enter = [&](std::size_t to) {
        if (!image.object[to] || label[to] >= 0 || group[to] != id || std::abs(image.w[to] - w) >= most) {
          return;
        }
        label[to] = parts;
        stack.push_back(to);
      };
      const std::size_t u = at % width;
      if (u > 0) enter(at - 1);
      if (u + 1 < width) enter(at + 1);
      if (at >= width) enter(at - width);
      if (at + width < image.size()) enter(at + width);
    }
    ++parts;
  }
  return parts;
}

/// The square cells of `cell` pixels, numbered.
Labels squares(const InverseDepthImage& image, int cell) {
  Labels square;
  square.reserve(image.size());
  const int columns = image.width / cell + 1;
  for (int v = 0; v < image.height; ++v) {
    for (int u = 0; u < image.width; ++u) square.push_back(v / cell * columns + u / cell);
  }
  return square;
}

/// The planes of the patches, from their moments.
void fitPlanes(double ridge, SurfacePatches& patches) {
  patches.planes.clear();
  for (const auto& m : patches.moments) patches.planes.push_back(m.plane(ridge));
}

void fit(const InverseDepthImage& image, double ridge, std::size_t count, SurfacePatches& patches) {
  patches.moments.assign(count, {});
  std::size_t i = 0;
  for (int v = 0; v < image.height; ++v) {
    for (int u = 0; u < image.width; ++u, ++i) {
      const auto label = patches.label[i];
      if (label >= 0) patches.moments[static_cast<std::size_t>(label)].add(u, v, image.w[i]);
    }
  }
  fitPlanes(ridge, patches);
}

/// What it costs a pixel to belong to a patch.
struct PatchCost {
  PatchPlane plane;
  double penalty;
};

/// One round: every pixel takes the best of the patches at itself and around it, whose planes follow.
void assign(const InverseDepthImage& image, const PatchScales& scales, SurfacePatches& patches) {
  const double per_scatter2 = 1.0 / (scales.scatter * scales.scatter);
  const double per_cell2 = kCompactness / (scales.cell * scales.cell);
  const double tiny = kTinyShare * scales.cell * scales.cell;
  std::vector<PatchCost> costs;
  costs.reserve(patches.size());
  for (std::size_t k = 0; k < patches.size(); ++k) {
    costs.push_back({patches.planes[k], patches.moments[k].n < tiny ? kTinyPenalty : 0.0});
  }
  const int reach = std::max(2, scales.cell / 4);
  const std::array<std::array<int, 2>, 8> around{
      {{-1, -1}, {1, -1}, {-1, 1}, {1, 1}, {-reach, 0}, {reach, 0}, {0, -reach}, {0, reach}}};
  std::array<std::ptrdiff_t, 8> steps;
  for (std::size_t n = 0; n < steps.size(); ++n) steps[n] = around[n][1] * image.width + around[n][0];
  Labels next(patches.label);
  for (int v = 0; v < image.height; ++v) {
    const bool rows_inside = v >= reach && v + reach < image.height;
    for (int u = 0; u < image.width; ++u) {
      const std::size_t i = index(image, u, v);
      const auto own = patches.label[i];
      if (own < 0) continue;
      const auto cost = [&](std::int32_t label) {
        const auto& [p, penalty] = costs[static_cast<std::size_t>(label)];
        const double r = image.w[i] - p.at(u, v);
        const double du = u - p.u;
        const double dv = v - p.v;
        return std::min(kMostMisfit, r * r * per_scatter2) + per_cell2 * (du * du + dv * dv) + penalty;
      };
      double least = -1.0;
      std::int32_t best = own;
      std::int32_t last = own;
      const auto consider = [&](std::int32_t label) {
        if (label < 0 || label == own || label == last) return;
        last = label;
        if (least < 0.0) least = cost(own);
        const double c = cost(label);
        if (c < least) {
          least = c;
          best = label;
        }
      };
      const std::int32_t* const here = patches.label.data() + i;
      if (rows_inside && u >= reach && u + reach < image.width) {
        for (const auto step : steps) consider(here[step]);
      } else {
        for (std::size_t n = 0; n < steps.size(); ++n) {
          const int x = u + around[n][0];
          const int y = v + around[n][1];
          if (x >= 0 && y >= 0 && x < image.width && y < image.height) consider(here[steps[n]]);
        }
      }
      if (best == own) continue;
      next[i] = best;
      patches.moments[static_cast<std::size_t>(own)].add(u, v, image.w[i], -1.0);
      patches.moments[static_cast<std::size_t>(best)].add(u, v, image.w[i]);
    }
  }
  patches.label = std::move(next);
  fitPlanes(scales.ridge, patches);
}

/// Gives scraps of a few pixels to the patch beside them that explains them best; renumbers the rest.
std::size_t dissolveScraps(const InverseDepthImage& image, const PatchScales& scales,
                           SurfacePatches& patches) {
  const double scrap = kScrapShare * scales.cell * scales.cell;
  const double per_scatter2 = 1.0 / (scales.scatter * scales.scatter);
  std::vector<std::vector<std::size_t>> pixels(patches.size());
  const auto isScrap = [&](std::int32_t k) {
    return patches.moments[static_cast<std::size_t>(k)].n <= scrap;
  };
  for (std::size_t i = 0; i < image.size(); ++i) {
    const auto k = patches.label[i];
    if (k >= 0 && isScrap(k)) pixels[static_cast<std::size_t>(k)].push_back(i);
  }
  const auto width = static_cast<std::size_t>(image.width);
  Labels target(patches.size());
  for (std::size_t k = 0; k < patches.size(); ++k) target[k] = static_cast<std::int32_t>(k);
  for (std::size_t k = 0; k < patches.size(); ++k) {
    double least = kMostScrapMisfit;
    std::vector<std::int32_t> tried;
    for (const auto i : pixels[k]) {
      for (const auto to : {i - 1, i + 1, i - width, i + width}) {
        if (to >= image.size()) continue;
        const auto other = patches.label[to];
        if (other < 0 || isScrap(other) || std::find(tried.begin(), tried.end(), other) != tried.end()) {
          continue;
        }
        tried.push_back(other);
        double sum = 0.0;
        for (const auto j : pixels[k]) {
          const double r = image.w[j] - patches.planes[static_cast<std::size_t>(other)].at(
                                            static_cast<double>(j % width), static_cast<double>(j / width));
          sum += std::min(100.0, r * r * per_scatter2);
        }
        sum /= static_cast<double>(pixels[k].size());
        if (sum < least) {
          least = sum;
          target[k] = other;
        }
      }
    }
  }
  Labels number(patches.size(), SurfacePatches::kNone);
  std::int32_t count = 0;
  for (auto& label : patches.label) {
    if (label < 0) continue;
    auto& n = number[static_cast<std::size_t>(target[static_cast<std::size_t>(label)])];
    if (n < 0) n = count++;
    label = n;
  }
  return static_cast<std::size_t>(count);
}

}  // namespace

PatchScales::PatchScales(const InverseDepthImage& image, double range_noise)
    : scatter(kScatterOfNoise * std::max(range_noise, kLeastNoise)),
      jump(kJumpOfScatter * scatter),
      cell(cellOf(image.focalLength(), std::max(range_noise, kLeastNoise))),
      ridge(std::pow(cell, 4) / 512.0),
      bridge(std::max(1, static_cast<int>(std::lround(kBridgeAngle * image.focalLength())))) {}

SurfacePatches surfacePatches(const InverseDepthImage& image, const PatchScales& scales) {
  SurfacePatches patches;
  int count = connectedParts(image, squares(image, scales.cell), 2.0 * scales.jump, patches.label);
  fit(image, scales.ridge, static_cast<std::size_t>(count), patches);
  for (int round = 0; round < kRounds; ++round) assign(image, scales, patches);
  const Labels assigned = patches.label;
  count = connectedParts(image, assigned, 4.0 * scales.jump, patches.label);
  fit(image, scales.ridge, static_cast<std::size_t>(count), patches);
  fit(image, scales.ridge, dissolveScraps(image, scales, patches), patches);
  return patches;
}

}  // namespace hoctomap
