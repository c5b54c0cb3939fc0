// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <numbers>

#include "CounterRng.h"
#include "ForEachRow.h"
#include "hoctomap/geometry/Errors.h"
#include "hoctomap/simulation/SimulatedRangeSensor.h"

namespace hoctomap {
namespace {

// Numbers of a pixel's draws. Each fault has its own, so that switching one off leaves the others as they
// were.
enum Draw : std::uint64_t { kDropout, kGrazing, kEdgeDropout, kEdgeMixed, kMixture, kNoise };

/// A neighbour across a depth edge, or none (0).
double depthAcrossEdge(const DepthImage& image, int u, int v, double jump) {
  const double here = static_cast<double>(image.at(u, v));
  double across = 0.0;
  double widest = 0.0;
  for (int dv = -1; dv <= 1; ++dv)
    for (int du = -1; du <= 1; ++du) {
      const int nu = u + du;
      const int nv = v + dv;
      if (nu < 0 || nv < 0 || nu >= image.camera.width || nv >= image.camera.height) continue;
      const double there = static_cast<double>(image.at(nu, nv));
      const double gap = std::abs(there - here);
      if (there > 0.0 && gap > jump * std::min(here, there) && gap > widest) {
        across = there;
        widest = gap;
      }
    }
  return across;
}

double failureAtIncidence(const RangeSensorModel& model, double cos_incidence) {
  const double angle = std::acos(std::clamp(cos_incidence, 0.0, 1.0)) * 180.0 / std::numbers::pi;
  if (angle <= model.grazing_begin) return 0.0;
  if (angle >= model.grazing_end) return 1.0;
  return (angle - model.grazing_begin) / (model.grazing_end - model.grazing_begin);
}

double rounded(double value, double unit) {
  return unit > 0.0 ? std::round(value / unit) * unit : value;
}

/// Depth after noise and rounding; 0 if it left the range.
double measured(const RangeSensorModel& model, double z, double normal) {
  double depth = z + (model.noise_constant + model.noise_quadratic * z * z) * normal;
  if (depth <= 0.0) return 0.0;
  if (model.disparity_step > 0.0) {
    const double focal_times_baseline = model.camera.fx * model.disparity_baseline;
    const double disparity = rounded(focal_times_baseline / depth, model.disparity_step);
    if (disparity <= 0.0) return 0.0;
    depth = focal_times_baseline / disparity;
  }
  depth = rounded(depth, model.depth_unit);
  return depth >= model.min_range && depth <= model.max_range ? depth : 0.0;
}

struct Pixel {
  double depth = 0.0;
  std::int32_t solid = kNoSolid;
};

Pixel sensePixel(const Rendering& rendering, const RangeSensorModel& model, const CounterRng& rng, int u,
                 int v) {
  const auto index = static_cast<std::size_t>(v) * static_cast<std::size_t>(rendering.image.camera.width) +
                     static_cast<std::size_t>(u);
  double z = static_cast<double>(rendering.image.depth[index]);
  if (z <= 0.0) return {};
  std::int32_t solid = rendering.solids[index];

  if (rng.uniform(index, kDropout) < model.dropout) return {};
  const auto cos_incidence = static_cast<double>(rendering.cos_incidence[index]);
  if (rng.uniform(index, kGrazing) < failureAtIncidence(model, cos_incidence)) return {};
  if (model.edge_dropout > 0.0 || model.edge_mixed > 0.0) {
    const double across = depthAcrossEdge(rendering.image, u, v, model.edge_jump);
    if (across > 0.0) {
      if (rng.uniform(index, kEdgeDropout) < model.edge_dropout) return {};
      if (rng.uniform(index, kEdgeMixed) < model.edge_mixed) {
        z += rng.uniform(index, kMixture) * (across - z);
        solid = kMixedSolids;
      }
    }
  }
  const double depth = measured(model, z, rng.normal(index, kNoise));
  return depth > 0.0 ? Pixel{depth, solid} : Pixel{};
}

bool isProbability(double p) {
  return p >= 0.0 && p <= 1.0;
}

}  // namespace

RangeSensorModel ideal(RangeSensorModel model) {
  model.noise_constant = model.noise_quadratic = 0.0;
  model.disparity_step = model.depth_unit = 0.0;
  model.dropout = model.edge_dropout = model.edge_mixed = 0.0;
  model.grazing_begin = model.grazing_end = 90.0;
  return model;
}

void check(const RangeSensorModel& model) {
  const PinholeCamera& camera = model.camera;
  if (camera.width < 1 || camera.height < 1) throw ConfigError("camera: width and height must be positive");
  if (!(camera.fx > 0.0) || !(camera.fy > 0.0)) throw ConfigError("camera: fx and fy must be positive");
  if (!std::isfinite(camera.cx) || !std::isfinite(camera.cy))
    throw ConfigError("camera: cx, cy must be finite");
  if (!(model.min_range >= 0.0) || !(model.max_range > model.min_range))
    throw ConfigError("camera: max_range must be above min_range");
  if (!(model.noise_constant >= 0.0) || !(model.noise_quadratic >= 0.0))
    throw ConfigError("camera: noise must not be negative");
  if (!(model.disparity_step >= 0.0) || !(model.depth_unit >= 0.0) || !(model.edge_jump > 0.0))
    throw ConfigError("camera: steps must not be negative, edge_jump must be positive");
  if (model.disparity_step > 0.0 && !(model.disparity_baseline > 0.0))
    throw ConfigError("camera: disparity_step needs a positive disparity_baseline");
  if (!(model.grazing_begin >= 0.0) || !(model.grazing_end >= model.grazing_begin))
    throw ConfigError("camera: grazing_end must not be below grazing_begin");
  if (!isProbability(model.dropout) || !isProbability(model.edge_dropout) || !isProbability(model.edge_mixed))
    throw ConfigError("camera: probabilities must lie in [0, 1]");
}

SensedImage degrade(const Rendering& rendering, const RangeSensorModel& model, std::uint64_t seed,
                    std::uint64_t scan, int threads) {
  check(model);
  const PinholeCamera& camera = rendering.image.camera;
  SensedImage sensed;
  sensed.image.camera = camera;
  sensed.image.depth.resize(rendering.image.depth.size());
  sensed.solids.resize(rendering.solids.size());
  const CounterRng rng(seed, scan);
  forEachRow(camera.height, threads, [&](int v) {
    auto index = static_cast<std::size_t>(v) * static_cast<std::size_t>(camera.width);
    for (int u = 0; u < camera.width; ++u, ++index) {
      const Pixel pixel = sensePixel(rendering, model, rng, u, v);
      sensed.image.depth[index] = static_cast<float>(pixel.depth);
      sensed.solids[index] = pixel.solid;
    }
  });
  return sensed;
}

}  // namespace hoctomap
