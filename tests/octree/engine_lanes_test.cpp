// SPDX-License-Identifier: BSD-3-Clause
// Several rays at a time against one at a time, on every instruction set: the same cells, to the last bit.
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <memory>
#include <random>

#include "../../libs/octree/src/RayClip.h"
#include "../../libs/octree/src/RayMarker.h"

namespace hoctomap::engine {
namespace {

using Eigen::Vector3f;

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

/// The sets of instructions that this processor has.
std::vector<InstructionSet> instructionSets() {
  std::vector<InstructionSet> sets;
  for (const auto set : {InstructionSet::baseline, InstructionSet::avx2, InstructionSet::avx512}) {
    if (set <= bestInstructionSet()) sets.push_back(set);
  }
  return sets;
}

void setEnds(RayEnds& ends, std::span<const Vector3f> points) {
  for (std::size_t ray = 0; ray < points.size(); ++ray) {
    for (std::size_t i = 0; i < 3; ++i) ends.end[i][ray] = points[ray][static_cast<Eigen::Index>(i)];
  }
}

void expectSameStart(const RayBatch& batch, std::size_t lane, const RayFan& fan, const Ray& ray,
                     const Stretch& stretch) {
  ASSERT_EQ(batch.cells[lane], stretch.cells);
  bool from_origin = true;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::int64_t local = fan.axes[i].local + ray.step[i] * stretch.start.taken[i];
    const Code mirrored = ray.step[i] < 0 ? fan.mirror_places & kAxisPlaces[i] : 0;
    ASSERT_EQ(batch.place[i][lane], ((dilate(static_cast<int>(local)) << i) ^ mirrored) | ~kAxisPlaces[i]);
    ASSERT_EQ(batch.mirror[lane] & kAxisPlaces[i], mirrored);
    ASSERT_EQ(batch.delta[i][lane], ray.delta[i]);
    from_origin &= stretch.start.taken[i] == 0;
  }
  for (std::size_t i = 0; i < 3; ++i) {
    if (from_origin) {
      ASSERT_EQ(batch.next[i][lane], stretch.start.next[i]);
    } else if (ray.step[i] != 0) {
      ASSERT_NEAR(batch.next[i][lane], stretch.start.next[i], 0.5 * batch.margin[lane]);
    }
  }
  ASSERT_EQ(batch.margin[lane] < 0.0, from_origin);
}

constexpr std::size_t kRays = 8;  // two groups of narrow lanes, one of wide ones

/// Returns the number of rays that met the box.
int compareWithExactPath(std::uint64_t seed, bool bounded, InstructionSet set) {
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
  const Preparation preparation = choosePreparation(set);
  int met = 0;
  const auto ends = std::make_unique<RayEnds>();
  const auto batch = std::make_unique<RayBatch>();
  for (int trial = 0; trial < 500; ++trial) {
    ends->count = static_cast<std::size_t>(scene.pick(1, kRays));
    std::array<Vector3f, kRays> points;
    for (auto& end : points) end = scene.point(1.5 * reach, resolution);
    if (trial % 7 == 0) points[0][trial % 3] = origin[trial % 3];
    if (trial % 50 == 0) points[0] = origin;
    if (trial % 90 == 0) points[0][0] = 1e9F;
    setEnds(*ends, points);
    for (std::size_t at = 0; at < kRays; at += preparation.lanes) preparation.prepare(fan, *ends, at, *batch);
    for (std::size_t lane = 0; lane < kRays; ++lane) {
      Key key;
      const Vector3f& end = points[lane];
      const bool is_ray = lane < ends->count && grid.checkedKey(end, key) && key != caster.originKey();
      const Ray ray = is_ray ? caster.prepare(end, key) : Ray{};
      const bool regular = is_ray && isRegular(ray);
      const auto stretch = !regular ? std::nullopt : bounded ? clipRegularRay(ray, box) : wholeRay(ray);
      if (batch->cells[lane] > 0) {
        EXPECT_TRUE(stretch.has_value());
        if (stretch) expectSameStart(*batch, lane, fan, ray, *stretch);
        ++met;
      } else if (batch->cells[lane] == 0) {
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
    for (const InstructionSet set : instructionSets()) met += compareWithExactPath(seed, seed % 4 != 0, set);
    ASSERT_FALSE(HasFailure()) << "seed " << seed;
  }
  EXPECT_GT(met, 25000);
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
  VoxelBits bits;
  bits.open(frame);
  RayMarker marker(fan, bits, bestInstructionSet());
  for (int trial = 0; trial < 40000; ++trial) {
    Vector3f end;
    for (Eigen::Index i = 0; i < 3; ++i) end[i] = static_cast<float>(scene.uniform(0.4, 0.6));
    marker.add(end);
  }
  marker.finish();
  EXPECT_LT(marker.special().size(), 100U);
}

/// What rays mark, with the ones that the marker hands back.
std::vector<Code> cellsMarked(const RayFan& fan, const BlockFrame& frame, const VoxelGrid& grid,
                              const Vector3f& origin, const KeyBox& box, const std::vector<Vector3f>& points,
                              InstructionSet set) {
  VoxelBits bits;
  bits.open(frame);
  RayMarker marker(fan, bits, set);
  for (const Vector3f& p : points) marker.add(p);
  marker.finish();
  const RayCaster caster(grid, origin);
  for (const Vector3f& p : marker.special()) {
    Key key;
    if (!grid.checkedKey(p, key)) continue;
    walkAsOctomap(caster.prepare(p, key), [&](const Key& k) {
      if (box.contains(k)) bits.mark(frame.localCode(k));
    });
  }
  bits.unflagEmptyPages();
  std::vector<Code> cells;
  for (std::size_t word = 0; word < frame.blocks() * kBlockWords; ++word) {
    if (bits.pages()[word / kPageWords] == 0) continue;
    for (unsigned bit = 0; bit < 64; ++bit) {
      if ((bits.words()[word] >> bit & 1U) != 0) cells.push_back(static_cast<Code>(64 * word + bit));
    }
  }
  return cells;
}

TEST(RayMarker, MarksTheSameCellsOnEveryInstructionSet) {
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    Scene scene(1000 + seed);
    const int reach = seed % 5 == 0 ? 900 : 60;
    const double resolution = seed % 3 == 0 ? 0.001 : 0.0073;
    const VoxelGrid grid(resolution);
    const Vector3f origin = scene.point(reach, resolution);
    const KeyBox box = scene.box(reach);
    const BlockFrame frame(box);
    const RayFan fan(grid, origin, box, frame, true);
    std::vector<Vector3f> points;
    for (int i = scene.pick(1, 700); i > 0; --i) points.push_back(scene.point(1.5 * reach, resolution));
    std::vector<Code> expected;
    const RayCaster caster(grid, origin);
    for (const Vector3f& p : points) {
      Key key;
      if (!grid.checkedKey(p, key)) continue;
      walkAsOctomap(caster.prepare(p, key), [&](const Key& k) {
        if (box.contains(k)) expected.push_back(frame.localCode(k));
      });
    }
    std::sort(expected.begin(), expected.end());
    expected.erase(std::unique(expected.begin(), expected.end()), expected.end());
    for (const InstructionSet set : instructionSets()) {
      ASSERT_EQ(cellsMarked(fan, frame, grid, origin, box, points, set), expected) << "seed " << seed;
    }
  }
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
