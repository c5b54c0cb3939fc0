// SPDX-License-Identifier: BSD-3-Clause
// Many beams, done by several threads and in parts: the bytes are those of one thread and of the reference.
#include <gtest/gtest.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <cmath>

#include "block_scenes.h"
#include "hoctomap/geometry/Errors.h"
#include "hoctomap/octree/BlockScanUpdate.h"
#include "hoctomap/octree/UpdateMemory.h"

namespace hoctomap::test {
namespace {

/// A wavy wall as a depth camera sees it.
PointCloud wall(int columns, int rows, double distance) {
  PointCloud points;
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      const double y = (column + 0.5) / columns - 0.5;
      const double z = (row + 0.5) / rows - 0.5;
      const double x = distance * (1.0 + 0.1 * std::sin(9.0 * y) * std::cos(7.0 * z));
      points.push_back(Eigen::Vector3d(x, x * y, x * z).cast<float>());
    }
  }
  return points;
}

std::string updated(int threads, double resolution, const std::vector<Beams>& scans) {
  octomap::OcTree tree(resolution);
  const auto engine = makeBlockScanUpdate();
  const tbb::global_control more(tbb::global_control::max_allowed_parallelism, 4);
  tbb::task_arena arena(threads);
  arena.execute([&] {
    for (const Beams& beams : scans) engine->apply(tree, beams);
  });
  return otBytes(tree);
}

TEST(BlockScanUpdate, AnyNumberOfThreadsGivesTheSameBytes) {
  const PointCloud points = wall(160, 120, 1.5);
  const PointCloud others = wall(130, 70, 2.1);
  Beams first;
  first.origin = {0.011F, -0.02F, 0.03F};
  first.hits = points;
  Beams second = first;
  second.origin = {0.1F, 0.3F, -0.02F};
  second.passing = others;
  second.bounds = Eigen::AlignedBox3d(Eigen::Vector3d(0.3, -0.3, -0.5), Eigen::Vector3d(1.45, 0.4, 0.6));
  const std::vector<Beams> scans{first, second};

  octomap::OcTree expected(0.02);
  const auto simple = makeReferenceScanUpdate();
  for (const Beams& beams : scans) simple->apply(expected, beams);
  const std::string bytes = otBytes(expected);
  for (const int threads : {1, 2, 4}) {
    ASSERT_TRUE(updated(threads, 0.02, scans) == bytes) << threads << " threads";
  }
}

TEST(BlockScanUpdate, OneEngineServesSeveralTreesAtOnce) {
  const PointCloud points = wall(60, 40, 1.0);
  Beams beams;
  beams.hits = points;
  const auto engine = makeBlockScanUpdate();
  std::vector<std::unique_ptr<octomap::OcTree>> trees;
  for (int i = 0; i < 8; ++i) trees.push_back(std::make_unique<octomap::OcTree>(0.02));
  const tbb::global_control more(tbb::global_control::max_allowed_parallelism, 4);
  tbb::task_arena arena(4);
  arena.execute([&] {
    tbb::parallel_for(std::size_t{0}, trees.size(), [&](std::size_t i) { engine->apply(*trees[i], beams); });
  });
  for (const auto& tree : trees) ASSERT_EQ(difference(*trees[0], *tree), "");
  EXPECT_GT(trees[0]->size(), 1000U);
}

/// Beams so many and long that the update is done in parts: the bits would take too much memory at once.
TEST(BlockScanUpdate, PartsGiveTheSameBytes) {
  const PointCloud points = wall(24, 18, 2.6);
  Beams beams;
  beams.origin = {0.0111F, -0.0222F, 0.0333F};
  beams.hits = points;
  octomap::OcTree expected(0.0025);
  octomap::OcTree actual(0.0025);
  makeReferenceScanUpdate()->apply(expected, beams);
  makeBlockScanUpdate()->apply(actual, beams);
  ASSERT_EQ(difference(expected, actual), "");
}

TEST(UpdateMemory, IsNearWhatTheTreeTakes) {
  const auto engine = makeBlockScanUpdate();
  for (const double resolution : {0.05, 0.02, 0.01, 0.005}) {
    for (const int columns : {320, 80, 20}) {
      const PointCloud points = wall(columns, columns * 3 / 4, 2.0);
      Beams beams;
      beams.origin = {0.01F, 0.02F, 0.03F};
      beams.hits = points;
      octomap::OcTree tree(resolution);
      const UpdateMemory estimate = estimateUpdateMemory(tree, beams);
      engine->apply(tree, beams);
      const double ratio = static_cast<double>(estimate.tree) / static_cast<double>(tree.memoryUsage());
      EXPECT_GT(ratio, 0.7) << resolution << " m, " << columns << " columns";
      EXPECT_LT(ratio, 5.0) << resolution << " m, " << columns << " columns";
    }
  }
}

TEST(UpdateMemory, NothingToUpdateTakesNothing) {
  const octomap::OcTree tree(0.01);
  EXPECT_EQ(estimateUpdateMemory(tree, Beams{}).total(), 0U);
}

TEST(UpdateMemory, RefusesWhatIsTooMuch) {
  const PointCloud points = wall(80, 60, 2.0);
  Beams beams;
  beams.hits = points;
  const octomap::OcTree tree(0.005);
  EXPECT_NO_THROW(requireUpdateMemory(tree, beams, std::size_t{2} << 30, "object 7"));
  try {
    requireUpdateMemory(tree, beams, 1'000'000, "object 7");
    FAIL() << "not refused";
  } catch (const LimitError& e) {
    EXPECT_NE(std::string(e.what()).find("object 7"), std::string::npos);
  }
}

}  // namespace
}  // namespace hoctomap::test
