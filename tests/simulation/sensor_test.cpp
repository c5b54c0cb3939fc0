// SPDX-License-Identifier: BSD-3-Clause
// The faults of the camera, on made-up renderings.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "SmallScenes.h"
#include "hoctomap/geometry/Errors.h"

namespace hoctomap::test {
namespace {

constexpr int kWidth = 200;
constexpr int kHeight = 150;
constexpr std::size_t kPixels = 200 * 150;

RangeSensorModel faultless() {
  RangeSensorModel model = idealCamera();
  model.camera = {kWidth, kHeight, 300.0, 300.0, 99.5, 74.5};
  return model;
}

/// A surface of which every pixel's depth and incidence are told.
Rendering made(const std::function<double(int u)>& depth, double incidence_degrees = 0.0) {
  Rendering rendering;
  rendering.image.camera = faultless().camera;
  for (int v = 0; v < kHeight; ++v)
    for (int u = 0; u < kWidth; ++u) rendering.image.depth.push_back(static_cast<float>(depth(u)));
  rendering.solids.assign(kPixels, 0);
  rendering.cos_incidence.assign(kPixels,
                                 static_cast<float>(std::cos(incidence_degrees * std::numbers::pi / 180.0)));
  return rendering;
}

Rendering wall(double depth, double incidence_degrees = 0.0) {
  return made([=](int) { return depth; }, incidence_degrees);
}

/// Left half at 1 m, right half at 2 m.
Rendering step() {
  return made([](int u) { return u < kWidth / 2 ? 1.0 : 2.0; });
}

double shareWithoutReturn(const SensedImage& sensed) {
  const auto missing = std::count(sensed.image.depth.begin(), sensed.image.depth.end(), 0.0F);
  return static_cast<double>(missing) / static_cast<double>(sensed.image.depth.size());
}

struct Moments {
  double mean = 0.0;
  double deviation = 0.0;
};

Moments moments(const std::vector<float>& values, double centre) {
  double sum = 0.0;
  double squares = 0.0;
  for (const float f : values) {
    const double d = static_cast<double>(f) - centre;
    sum += d;
    squares += d * d;
  }
  const auto n = static_cast<double>(values.size());
  return {sum / n, std::sqrt(squares / n - sum * sum / (n * n))};
}

TEST(Sensor, WithoutFaultsTheTruthIsReported) {
  const Rendering rendering = step();
  const SensedImage sensed = degrade(rendering, faultless(), 1, 0, 1);
  EXPECT_EQ(sensed.image.depth, rendering.image.depth);
  EXPECT_EQ(sensed.solids, rendering.solids);
}

TEST(Sensor, NoiseGrowsWithTheSquareOfRange) {
  RangeSensorModel model = faultless();
  model.noise_constant = 0.0005;
  model.noise_quadratic = 0.002;
  for (const double z : {0.5, 1.0, 2.0, 4.0}) {
    const Moments m = moments(degrade(wall(z), model, 7, 3, 2).image.depth, z);
    const double sigma = 0.0005 + 0.002 * z * z;
    EXPECT_NEAR(m.mean, 0.0, 5.0 * sigma / std::sqrt(kPixels)) << z;
    EXPECT_NEAR(m.deviation, sigma, 0.03 * sigma) << z;
  }
}

TEST(Sensor, NoiseIsNormal) {
  RangeSensorModel model = faultless();
  model.noise_constant = 0.01;
  const auto depth = degrade(wall(1.0), model, 7, 3, 2).image.depth;
  for (const auto& [bound, expected] : {std::pair(0.01F, 0.1587), {0.02F, 0.02275}, {-0.01F, 0.8413}}) {
    const auto above =
        std::count_if(depth.begin(), depth.end(), [b = bound](float z) { return z > 1.0F + b; });
    EXPECT_NEAR(static_cast<double>(above) / kPixels, expected, 0.01) << bound;
  }
}

TEST(Sensor, NoiseOfNeighboursAndOfScansIsIndependent) {
  RangeSensorModel model = faultless();
  model.noise_constant = 0.01;
  const auto a = degrade(wall(1.0), model, 7, 3, 2).image.depth;
  const auto b = degrade(wall(1.0), model, 7, 4, 2).image.depth;
  const auto correlation = [](const std::vector<float>& x, const std::vector<float>& y, std::size_t shift) {
    double sum = 0.0;
    for (std::size_t i = 0; i + shift < x.size(); ++i)
      sum += static_cast<double>((x[i] - 1.0F) * (y[i + shift] - 1.0F));
    return sum / static_cast<double>(x.size()) / 1e-4;
  };
  EXPECT_NEAR(correlation(a, a, 0), 1.0, 0.03);
  for (const std::size_t shift : {1U, 2U, static_cast<unsigned>(kWidth)})
    EXPECT_NEAR(correlation(a, a, shift), 0.0, 0.03) << shift;
  EXPECT_NEAR(correlation(a, b, 0), 0.0, 0.03);
}

TEST(Sensor, DepthsOutOfRangeGiveNoReturn) {
  RangeSensorModel model = faultless();
  model.min_range = 0.5;
  model.max_range = 3.0;
  const SensedImage sensed = degrade(made([](int u) { return 0.1 + 0.02 * u; }), model, 1, 0, 1);
  for (int u = 0; u < kWidth; ++u) {
    const double z = static_cast<double>(static_cast<float>(0.1 + 0.02 * u));
    EXPECT_EQ(sensed.image.at(u, 3) > 0.0F, z >= 0.5 && z <= 3.0) << z;
    EXPECT_EQ(sensed.solids[static_cast<std::size_t>(3 * kWidth + u)] == kNoSolid,
              sensed.image.at(u, 3) == 0.0F);
  }
}

TEST(Sensor, DropoutHasItsProbability) {
  RangeSensorModel model = faultless();
  model.dropout = 0.2;
  EXPECT_NEAR(shareWithoutReturn(degrade(wall(1.0), model, 1, 0, 2)), 0.2, 0.01);
}

TEST(Sensor, ReturnsFailGraduallyAtGrazingIncidence) {
  RangeSensorModel model = faultless();
  model.grazing_begin = 70.0;
  model.grazing_end = 86.0;
  const auto failed = [&](double angle) {
    return shareWithoutReturn(degrade(wall(1.0, angle), model, 1, 0, 2));
  };
  EXPECT_EQ(failed(69.9), 0.0);
  EXPECT_NEAR(failed(74.0), 0.25, 0.01);
  EXPECT_NEAR(failed(82.0), 0.75, 0.01);
  EXPECT_EQ(failed(86.1), 1.0);
}

TEST(Sensor, EdgesLoseReturnsAndOnlyThere) {
  RangeSensorModel model = faultless();
  model.edge_dropout = 1.0;
  const SensedImage sensed = degrade(step(), model, 1, 0, 2);
  for (int u = 0; u < kWidth; ++u)
    EXPECT_EQ(sensed.image.at(u, 70) == 0.0F, u == kWidth / 2 - 1 || u == kWidth / 2) << u;
  model.edge_jump = 1.1;  // more than the step
  EXPECT_EQ(shareWithoutReturn(degrade(step(), model, 1, 0, 2)), 0.0);
}

TEST(Sensor, MixedPixelsLieBetweenTheTwoSides) {
  RangeSensorModel model = faultless();
  model.edge_mixed = 1.0;
  const SensedImage sensed = degrade(step(), model, 1, 0, 2);
  for (int v = 0; v < kHeight; ++v) {
    EXPECT_GE(sensed.image.at(kWidth / 2, v), 1.0F);
    EXPECT_LE(sensed.image.at(kWidth / 2, v), 2.0F);
    EXPECT_EQ(sensed.solids[static_cast<std::size_t>(v * kWidth + kWidth / 2)], kMixedSolids);
    EXPECT_EQ(sensed.image.at(0, v), 1.0F);
  }
}

TEST(Sensor, DisparityAndDepthAreMultiplesOfTheirSteps) {
  RangeSensorModel model = faultless();
  model.noise_quadratic = 0.002;
  model.disparity_baseline = 0.1;
  model.disparity_step = 0.125;
  for (const float z : degrade(wall(2.0), model, 1, 0, 2).image.depth) {
    const double steps = 300.0 * 0.1 / static_cast<double>(z) / 0.125;
    ASSERT_NEAR(steps, std::round(steps), 1e-4);
  }
  model.disparity_step = 0.0;
  model.depth_unit = 0.001;
  for (const float z : degrade(wall(2.0), model, 1, 0, 2).image.depth)
    ASSERT_NEAR(static_cast<double>(z) * 1000.0, std::round(static_cast<double>(z) * 1000.0), 1e-3);
}

TEST(Sensor, SameSeedSameBytesForAnyNumberOfThreads) {
  const RangeSensorModel model{};
  Rendering rendering = step();
  RangeSensorModel noisy = model;
  noisy.camera = rendering.image.camera;
  const SensedImage one = degrade(rendering, noisy, 42, 5, 1);
  for (const int threads : {0, 2, 7}) {
    const SensedImage many = degrade(rendering, noisy, 42, 5, threads);
    EXPECT_EQ(one.image.depth, many.image.depth);
    EXPECT_EQ(one.solids, many.solids);
  }
  EXPECT_NE(one.image.depth, degrade(rendering, noisy, 43, 5, 1).image.depth);
  EXPECT_NE(one.image.depth, degrade(rendering, noisy, 42, 6, 1).image.depth);
}

TEST(Sensor, OneFaultDoesNotChangeTheOthers) {
  RangeSensorModel model = faultless();
  model.noise_constant = 0.01;
  const auto without = degrade(wall(1.0), model, 1, 0, 1).image.depth;
  model.dropout = 0.3;
  const auto with = degrade(wall(1.0), model, 1, 0, 1).image.depth;
  for (std::size_t i = 0; i < kPixels; ++i) ASSERT_TRUE(with[i] == 0.0F || with[i] == without[i]);
}

TEST(Sensor, ModelsThatMakeNoSenseAreRefused) {
  const auto refused = [](const std::function<void(RangeSensorModel&)>& spoil) {
    RangeSensorModel model;
    spoil(model);
    EXPECT_THROW(check(model), ConfigError);
  };
  EXPECT_NO_THROW(check(RangeSensorModel{}));
  refused([](auto& m) { m.camera.width = 0; });
  refused([](auto& m) { m.camera.fx = 0.0; });
  refused([](auto& m) { m.max_range = m.min_range; });
  refused([](auto& m) { m.noise_quadratic = -1.0; });
  refused([](auto& m) { m.grazing_end = m.grazing_begin - 1.0; });
  refused([](auto& m) { m.edge_dropout = 1.5; });
  refused([](auto& m) { m.edge_jump = 0.0; });
  refused([](auto& m) { m.disparity_step = 0.1, m.disparity_baseline = 0.0; });
}

}  // namespace
}  // namespace hoctomap::test
