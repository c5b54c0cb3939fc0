// SPDX-License-Identifier: BSD-3-Clause
// The exact mid-ray start against octomap's loop, step by step.
#include <gtest/gtest.h>

#include <random>

#include "../../libs/octree/src/MortonCode.h"
#include "../../libs/octree/src/RayClip.h"
#include "../../libs/octree/src/RayTraversal.h"

namespace hoctomap::engine {
namespace {

using Rng = std::mt19937_64;

double uniform(Rng& rng, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(rng);
}
int uniformInt(Rng& rng, int low, int high) {
  return std::uniform_int_distribution<int>(low, high)(rng);
}

TEST(AddRepeatedly, EqualsTheLoopToTheLastBit) {
  Rng rng(1);
  for (int trial = 0; trial < 20000; ++trial) {
    double delta = std::exp(uniform(rng, -10.0, 10.0));
    if (trial % 3 == 0) delta = static_cast<float>(delta);  // many zeros at the end: exact sums
    if (trial % 5 == 0) delta = std::ldexp(uniformInt(rng, 1, 9), -52) + 1;  // ties
    const double start = trial % 7 == 0 ? -delta * uniform(rng, 0.0, 3.0) : delta * uniform(rng, 0.0, 2.0);
    const int count = uniformInt(rng, 0, trial % 50 == 0 ? 66000 : 600);
    double expected = start;
    for (int i = 0; i < count; ++i) expected += delta;
    ASSERT_EQ(addRepeatedly(start, delta, count), expected) << start << " + " << count << " * " << delta;
  }
}

struct Cell {
  Key key;
  std::array<double, 3> next;
};

/// All free cells of a regular ray with octomap's crossing times.
std::vector<Cell> walk(const Ray& ray) {
  std::vector<Cell> cells{{ray.origin, ray.next}};
  while (static_cast<int>(cells.size()) < ray.cells()) {
    Cell cell = cells.back();
    const std::size_t axis = nextAxis(cell.next);
    cell.key[axis] += ray.step[axis];
    cell.next[axis] += ray.delta[axis];
    cells.push_back(cell);
  }
  return cells;
}

TEST(RayClip, EqualsTheWalkThroughTheBox) {
  Rng rng(2);
  int regular = 0;
  int inside = 0;
  for (int trial = 0; trial < 50000; ++trial) {
    const double resolution = trial % 2 == 0 ? 0.001 : 0.05;
    const VoxelGrid grid(resolution);
    const auto coordinate = [&](double reach) {
      const double x = uniform(rng, -reach, reach);
      return static_cast<float>((uniformInt(rng, 0, 4) == 0 ? std::round(x) : x) * resolution);
    };
    const Eigen::Vector3f origin{coordinate(40), coordinate(40), coordinate(40)};
    Eigen::Vector3f end{coordinate(90), coordinate(90), coordinate(90)};
    if (trial % 6 == 0) end[trial % 3] = origin[trial % 3];
    if (trial % 11 == 0) end = origin + (end - origin).cwiseSign() * 0.037F;
    Key end_key;
    ASSERT_TRUE(grid.checkedKey(end, end_key));
    const RayCaster caster(grid, origin);
    if (end_key == caster.originKey()) continue;
    const Ray ray = caster.prepare(end, end_key);

    std::vector<Key> octomaps_cells;
    walkAsOctomap(ray, [&](const Key& key) { octomaps_cells.push_back(key); });
    if (!isRegular(ray)) continue;
    ++regular;
    const std::vector<Cell> cells = walk(ray);
    ASSERT_EQ(cells.size(), octomaps_cells.size());
    for (std::size_t i = 0; i < cells.size(); ++i) ASSERT_EQ(cells[i].key, octomaps_cells[i]);

    KeyBox box;
    for (std::size_t i = 0; i < 3; ++i) {
      const int a = kKeyOffset + uniformInt(rng, -60, 60);
      box.min[i] = a;
      box.max[i] = a + uniformInt(rng, 0, 50);
    }
    const auto first =
        std::find_if(cells.begin(), cells.end(), [&](const Cell& c) { return box.contains(c.key); });
    const auto last = std::find_if(first, cells.end(), [&](const Cell& c) { return !box.contains(c.key); });
    const auto stretch = clipRegularRay(ray, box);
    ASSERT_EQ(stretch.has_value(), first != cells.end());
    if (!stretch) continue;
    ++inside;
    ASSERT_EQ(stretch->cells, last - first);
    ASSERT_EQ(stretch->start.next, first->next);
    for (std::size_t i = 0; i < 3; ++i) {
      ASSERT_EQ(ray.origin[i] + ray.step[i] * stretch->start.taken[i], first->key[i]);
    }
    ASSERT_TRUE(BoxFilter(grid, origin, box).mayMeet(end));
  }
  EXPECT_GT(regular, 25000);
  EXPECT_GT(inside, 1500);
}

TEST(MortonCode, StepsAndComesBack) {
  Rng rng(3);
  for (int trial = 0; trial < 10000; ++trial) {
    const Key key{uniformInt(rng, 1, kMaxKey - 1), uniformInt(rng, 1, kMaxKey - 1),
                  uniformInt(rng, 1, kMaxKey - 1)};
    ASSERT_EQ(keyOf(codeOf(key)), key);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      // All other places set, the carry of adding 1 runs over them.
      const Code filled = (codeOf(key) & kAxisPlaces[axis]) | ~kAxisPlaces[axis];
      ASSERT_EQ(compact(((filled + 1) & kAxisPlaces[axis]) >> axis), key[axis] + 1);
    }
  }
}

}  // namespace
}  // namespace hoctomap::engine
