// SPDX-License-Identifier: BSD-3-Clause
// What dense scans leave out: only cells that are marked, whatever the sensor's place and the beams' ends.
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>

#include "../../libs/octree/src/DenseScan.h"
#include "../../libs/octree/src/RayTraversal.h"
#include "block_scenes.h"
#include "hoctomap/octree/BlockScanUpdate.h"

namespace hoctomap::engine {
namespace {

using Eigen::Vector3f;

class Random {
 public:
  explicit Random(std::uint64_t seed) : rng_(seed) {}
  double uniform(double low, double high) { return std::uniform_real_distribution<double>(low, high)(rng_); }
  int pick(int choices) { return std::uniform_int_distribution<int>(0, choices - 1)(rng_); }
  /// A coordinate in voxels: anywhere, on a border, in the middle, next to a border.
  double coordinate(double reach) {
    const double x = uniform(-reach, reach);
    const std::array<double, 4> choices{x, std::round(x), std::floor(x) + 0.5,
                                        std::round(x) + uniform(-1e-4, 1e-4)};
    return choices[static_cast<std::size_t>(pick(4))];
  }
  Vector3f point(double reach, double resolution) {
    Vector3f p;
    for (Eigen::Index i = 0; i < 3; ++i) p[i] = static_cast<float>(coordinate(reach) * resolution);
    return p;
  }

 private:
  std::mt19937_64 rng_;
};

/// Marks all voxels of a box but some, and looks whether rays meet an unmarked one too early.
/// @return steps that could be left out.
long checkReach(std::uint64_t seed) {
  Random random(seed);
  const double resolution = std::array{0.001, 0.01, 0.0073, 0.2}[seed % 4];
  const VoxelGrid grid(resolution);
  const Vector3f origin = random.point(20.0, resolution);
  KeyBox box;
  for (std::size_t i = 0; i < 3; ++i) {
    box.min[i] = kKeyOffset - 21 - random.pick(40);
    box.max[i] = kKeyOffset + 21 + random.pick(40);
  }
  const BlockFrame frame(box);
  VoxelBits bits;
  bits.open(frame);
  const int holes = random.pick(3) == 0 ? 1 : 3000;
  const auto isHole = [&](const Key& key) {
    const Code scattered = Code{key[0]} * 7919 + Code{key[1]} * 104729 + Code{key[2]} * 1299709;
    return scattered % holes == 7;
  };
  Key k;
  for (k[0] = box.min[0]; k[0] <= box.max[0]; ++k[0]) {
    for (k[1] = box.min[1]; k[1] <= box.max[1]; ++k[1]) {
      for (k[2] = box.min[2]; k[2] <= box.max[2]; ++k[2]) {
        if (holes == 1 || !isHole(k)) bits.mark(frame.localCode(k));
      }
    }
  }
  const auto marked = [&](const Key& key) { return box.contains(key) && (holes == 1 || !isHole(key)); };
  MarkedReach reach(grid, origin, frame, bits);
  const RayCaster caster(grid, origin);
  long steps = 0;
  for (int trial = 0; trial < 3000; ++trial) {
    const Vector3f end = random.point(90.0, resolution);
    Key end_key;
    if (!grid.checkedKey(end, end_key) || end_key == caster.originKey()) continue;
    const Direction direction = directionOf(end - origin);
    const std::size_t axis = MarkedReach::axisOf(direction);
    const int free_steps = reach.stepsMarked(direction);
    steps += free_steps;
    walkAsOctomap(caster.prepare(end, end_key), [&](const Key& key) {
      if (std::abs(key[axis] - caster.originKey()[axis]) < free_steps) {
        EXPECT_TRUE(marked(key)) << "seed " << seed << " trial " << trial;
      }
    });
    if (testing::Test::HasFailure()) break;
  }
  return steps;
}

TEST(MarkedReach, OnlyMarkedCellsAreLeftOut) {
  long steps = 0;
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    steps += checkReach(seed);
    ASSERT_FALSE(HasFailure()) << "seed " << seed;
  }
  EXPECT_GT(steps, 60 * 3000 * 5);
}

TEST(MarkedReach, GrowsWithTheMarks) {
  const VoxelGrid grid(0.01);
  const KeyBox box{{kKeyOffset, kKeyOffset, kKeyOffset}, {kKeyOffset + 60, kKeyOffset + 60, kKeyOffset + 60}};
  const BlockFrame frame(box);
  VoxelBits bits;
  bits.open(frame);
  const Vector3f origin(0.305F, 0.305F, 0.005F);
  MarkedReach reach(grid, origin, frame, bits);
  const Direction up = directionOf(Vector3f(0.001F, 0.002F, 1.0F));
  EXPECT_EQ(reach.stepsMarked(up), 0);
  const auto mark = [&](int from, int to) {
    for (int z = from; z < to; ++z) {
      for (int x = 20; x < 40; ++x) {
        for (int y = 20; y < 40; ++y) bits.mark(codeOf({x, y, z}));
      }
    }
  };
  mark(0, 18);
  EXPECT_EQ(reach.stepsMarked(up), 0);  // until told
  reach.refresh();
  EXPECT_EQ(reach.stepsMarked(up), 16);                                           // whole words
  EXPECT_EQ(reach.stepsMarked(directionOf(Vector3f(0.001F, 0.002F, -1.0F))), 1);  // the frame ends there
  mark(18, 64);
  reach.refresh();
  EXPECT_EQ(reach.stepsMarked(up), 64);
}

TEST(DenseScan, RoundsMeetEachBeamOnce) {
  for (const std::size_t beams : {0U, 1U, 31U, 32U, 1000U}) {
    std::vector<int> met(beams);
    for (std::size_t round = 0; round < kRounds.size(); ++round) {
      forEachOfRound(round, beams, [&](std::size_t i) { ++met[i]; });
    }
    EXPECT_EQ(std::count(met.begin(), met.end(), 1), static_cast<std::ptrdiff_t>(beams));
  }
}

TEST(DenseScan, RoundsAreDrawnEvenly) {
  // Of the beams of one column of an image, too.
  for (const std::size_t width : {1U, 32U, 320U, 640U, 641U, 1024U}) {
    std::vector<double> of_column(width);
    constexpr std::size_t kHeight = 480;
    forEachOfRound(1, width * kHeight, [&](std::size_t i) { of_column[i % width] += 1.0 / kHeight; });
    for (const double share : of_column) EXPECT_NEAR(share, 6.0 / 32.0, 0.06) << width;
  }
}

TEST(DenseScan, SomeBeamsHaveNoDirection) {
  EXPECT_TRUE(hasDirection({0.0F, 0.0F, -1e-6F}));
  EXPECT_FALSE(hasDirection({0.0F, 0.0F, 0.0F}));
  EXPECT_FALSE(hasDirection({std::numeric_limits<float>::infinity(), 0.0F, 0.0F}));
  EXPECT_FALSE(hasDirection({0.0F, std::numeric_limits<float>::quiet_NaN(), 0.0F}));
}

/// Rays over a rectangle of directions, to depths with steps in them, some of them short: dense enough.
std::vector<Vector3f> fan(Random& random, const Vector3f& origin, double resolution) {
  const std::array<int, 3> axes = std::array<std::array<int, 3>, 3>{
      {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}}}[static_cast<std::size_t>(random.pick(3))];
  const double sign = random.pick(2) == 0 ? 1.0 : -1.0;
  const double a0 = random.uniform(-1.1, 1.0);
  const double b0 = random.uniform(-1.1, 1.0);
  const int side = random.pick(4) == 0 ? 94 : 66;  // the larger one is shared by two threads
  constexpr double kWidth = 0.14;
  std::vector<Vector3f> points;
  for (int i = 0; i < side; ++i) {
    for (int j = 0; j < side; ++j) {
      const double depth = (random.pick(50) == 0 ? random.uniform(0.0, 200.0)
                            : i / 11 % 2 == 0    ? 190.0
                                                 : 150.0) *
                           resolution;
      Vector3f p = origin;
      p[axes[0]] += static_cast<float>(sign * depth);
      p[axes[1]] += static_cast<float>(depth * (a0 + kWidth * i / side));
      p[axes[2]] += static_cast<float>(depth * (b0 + kWidth * j / side));
      points.push_back(p);
    }
  }
  return points;
}

TEST(MarkedReach, DenseScansGiveTheSameBytes) {
  const auto simple = makeReferenceScanUpdate();
  int dense = 0;
  for (std::uint64_t seed = 0; seed < 14U * static_cast<unsigned>(test::sweepFactor()); ++seed) {
    Random random(100 + seed);
    const double resolution = std::array{0.001, 0.01, 0.0073, 0.05}[seed % 4];
    const auto fast = makeBlockScanUpdate(test::instructionsFor(seed));
    octomap::OcTree expected(resolution);
    octomap::OcTree actual(resolution);
    Beams beams;
    beams.origin = random.point(60.0, resolution);
    for (int scan = 0; scan < 2; ++scan) {
      const std::vector<Vector3f> points = fan(random, beams.origin, resolution);
      (seed % 3 == 0 ? beams.passing : beams.hits) = points;
      if (seed % 5 == 1) beams.max_range = 160.0 * resolution;
      if (seed % 2 == 1) {  // with the sensor inside
        const Eigen::Vector3d at = beams.origin.cast<double>();
        beams.bounds = Eigen::AlignedBox3d(at.array() - random.uniform(0.0, 200.0) * resolution,
                                           at.array() + random.uniform(0.0, 200.0) * resolution);
      }
      const VoxelGrid grid(resolution);
      dense += isDense(ScanBeams(grid, beams), points) ? 1 : 0;
      simple->apply(expected, beams);
      fast->apply(actual, beams);
      ASSERT_EQ(test::difference(expected, actual), "") << "seed " << seed << " scan " << scan;
      if (seed % 4 == 2) beams.origin += random.point(3.0, resolution);
      beams.hits = beams.passing = {};
    }
  }
  EXPECT_GT(dense, 20);
}

}  // namespace
}  // namespace hoctomap::engine
