// SPDX-License-Identifier: BSD-3-Clause
// Four rays at a time against one at a time, on every instruction set: the same cells, to the last bit.
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <random>

#include "../../libs/octree/src/RayBatch.h"
#include "../../libs/octree/src/RayClip.h"

namespace hoctomap::engine {
namespace {

using Eigen::Vector3f;
using State = RayBatch::State;

/// Random rays and boxes, measured in voxels: borders, edges, corners and diagonals are met on purpose.
class Scene {
 public:
  explicit Scene(std::uint64_t seed) : rng_(seed) {}

  double uniform(double low, double high) { return std::uniform_real_distribution<double>(low, high)(rng_); }
  int pick(int low, int high) { return std::uniform_int_distribution<int>(low, high)(rng_); }
  Vector3f point(double reach, double resolution) {
    Vector3f p;
    for (Eigen::Index i = 0; i < 3; ++i) {
      const double x = uniform(-reach, reach);
      p[i] = static_cast<float>((pick(0, 5) == 0 ? std::round(x) : x) * resolution);
    }
    return p;
  }
  KeyBox box(int reach) {
    KeyBox box;
    for (std::size_t i = 0; i < 3; ++i) {
      box.min[i] = kKeyOffset + pick(-reach, reach);
      box.max[i] = box.min[i] + pick(0, reach);
    }
    return box;
  }

 private:
  std::mt19937_64 rng_;
};

void expectSameStart(const RayBatch& batch, std::size_t lane, const RayFan& fan, const Ray& ray,
                     const Stretch& stretch) {
  Traversals exact{};
  placeRay(fan, ray, stretch, exact);
  ASSERT_EQ(batch.cells[lane], stretch.cells);
  ASSERT_EQ(batch.start.mirror[lane], exact.mirror[0]);
  for (std::size_t i = 0; i < 3; ++i) {
    ASSERT_EQ(batch.start.next[i][lane], exact.next[i][0]);
    ASSERT_EQ(batch.start.delta[i][lane], exact.delta[i][0]);
    ASSERT_EQ(batch.start.place[i][lane], exact.place[i][0]);
  }
}

/// Returns the number of rays that met the box.
int compareWithExactPath(std::uint64_t seed, bool bounded, bool best_instructions) {
  Scene scene(seed);
  const double resolution = seed % 3 == 0 ? 0.001 : seed % 3 == 1 ? 0.05 : 0.0073;
  const int reach = seed % 5 == 0 ? 900 : 60;
  const VoxelGrid grid(resolution);
  const Vector3f origin = scene.point(reach, resolution);
  KeyBox box = scene.box(reach);
  if (!bounded) {
    box.min = {kKeyOffset - 2000, kKeyOffset - 2000, kKeyOffset - 2000};
    box.max = {kKeyOffset + 2000, kKeyOffset + 2000, kKeyOffset + 2000};
  }
  const BlockFrame frame(box);
  const RayFan fan(grid, origin, box, frame, bounded);
  const RayCaster caster(grid, origin);
  const PrepareRays prepare = choosePrepareRays(best_instructions);
  int met = 0;
  for (int trial = 0; trial < 500; ++trial) {
    const auto count = static_cast<std::size_t>(scene.pick(1, 4));
    std::array<Vector3f, kLanes> ends;
    for (auto& end : ends) end = scene.point(1.5 * reach, resolution);
    if (trial % 7 == 0) ends[0][trial % 3] = origin[trial % 3];
    if (trial % 50 == 0) ends[0] = origin;
    if (trial % 90 == 0) ends[0][0] = 1e9F;
    RayBatch batch;
    prepare(fan, {ends, count, {}, {}, false}, batch);
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      Key key;
      const bool is_ray = lane < count && grid.checkedKey(ends[lane], key) && key != caster.originKey();
      const Ray ray = is_ray ? caster.prepare(ends[lane], key) : Ray{};
      const bool regular = is_ray && isRegular(ray);
      const auto stretch = !regular ? std::nullopt : bounded ? clipRegularRay(ray, box) : wholeRay(ray);
      if (batch.state[lane] == State::ready) {
        EXPECT_TRUE(stretch.has_value());
        if (stretch) expectSameStart(batch, lane, fan, ray, *stretch);
        ++met;
      } else if (batch.state[lane] == State::none) {
        EXPECT_FALSE(stretch.has_value()) << "seed " << seed << " trial " << trial;
        EXPECT_TRUE(bounded || !is_ray);
      }
      if (testing::Test::HasFailure()) return met;
    }
  }
  return met;
}

TEST(RayBatch, EqualsTheExactPathOnEveryInstructionSet) {
  int met = 0;
  for (std::uint64_t seed = 0; seed < 120; ++seed) {
    for (const bool best : {false, true}) met += compareWithExactPath(seed, seed % 4 != 0, best);
    ASSERT_FALSE(HasFailure()) << "seed " << seed;
  }
  EXPECT_GT(met, 50000);
}

/// Special rays are exact, too, but slow: they must stay rare.
TEST(RayBatch, FewRaysAreSpecial) {
  Scene scene(7);
  const VoxelGrid grid(0.002);
  const Vector3f origin(0.1234F, 0.2345F, 0.3456F);
  const KeyBox box{{kKeyOffset + 200, kKeyOffset + 200, kKeyOffset + 200},
                   {kKeyOffset + 300, kKeyOffset + 300, kKeyOffset + 300}};
  const BlockFrame frame(box);
  const RayFan fan(grid, origin, box, frame, true);
  int special = 0;
  for (int trial = 0; trial < 10000; ++trial) {
    std::array<Vector3f, kLanes> ends;
    for (auto& end : ends) {
      for (Eigen::Index i = 0; i < 3; ++i) end[i] = static_cast<float>(scene.uniform(0.4, 0.6));
    }
    RayBatch batch;
    choosePrepareRays(true)(fan, {ends, kLanes, {}, {}, false}, batch);
    special += static_cast<int>(std::count(batch.state.begin(), batch.state.end(), State::special));
  }
  EXPECT_LT(special, 100);
}

TEST(VoxelBits, UnitesAndClears) {
  const BlockFrame frame(KeyBox{{100, 100, 100}, {400, 300, 200}});
  VoxelBits a;
  VoxelBits b;
  a.open(frame);
  b.open(frame);
  a.mark(frame.localCode({100, 100, 100}));
  b.mark(frame.localCode({400, 300, 200}));
  a.unite(b);
  int bits = 0;
  for (Code block = 0; block < static_cast<Code>(frame.blocks()); ++block) {
    for (std::size_t word = 0; word < kBlockWords; ++word) bits += std::popcount(a.block(block)[word]);
  }
  EXPECT_EQ(bits, 2);
  a.clear();
  a.open(frame);
  for (Code block = 0; block < static_cast<Code>(frame.blocks()); ++block) {
    EXPECT_EQ(a.blockPages(block), 0U);
    for (std::size_t word = 0; word < kBlockWords; ++word) ASSERT_EQ(a.block(block)[word], 0U);
  }
}

}  // namespace
}  // namespace hoctomap::engine
