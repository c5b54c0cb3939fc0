// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <random>

#include "TableScene.h"
#include "hoctomap/exploration/ExpectedInformationGain.h"
#include "hoctomap/exploration/ViewpointSampler.h"

namespace hoctomap {
namespace {

using testing::box;
using testing::mapOf;

constexpr RangeNoise kNoNoise{.constant = 0.0, .quadratic = 0.0};

/// A table with a box on it of which the front (x > 0) has been seen, and free space all around the box.
struct Desk {
  explicit Desk(double object_resolution = 0.01) : hierarchy(testing::roomWithTable()) {
    const std::vector sides{box(-0.1, -0.1, 0.7, -0.09, 0.1, 0.9), box(0.09, -0.1, 0.7, 0.1, 0.1, 0.9)};
    hierarchy.add(labels::object, mapOf(object_resolution, {.free = {}, .occupied = sides}), Pose(),
                  testing::kTable);
    table = *tableArea(hierarchy, testing::kTable, {});
  }
  [[nodiscard]] ClearedSpace cleared() const {
    ClearedSpace space(table.space, 0.01, kNoNoise);
    // From high above, beams all over the table, but not into the box.
    PointCloud points;
    for (double x = table.space.min().x() - 0.1; x < table.space.max().x() + 0.1; x += 0.004) {
      for (double y = table.space.min().y() - 0.1; y < table.space.max().y() + 0.1; y += 0.004) {
        if (std::fabs(x) > 0.12 || std::fabs(y) > 0.12)
          points.emplace_back(static_cast<float>(x), static_cast<float>(y), 0.69F);
      }
    }
    space.add({0.013F, 0.017F, 12.0F}, points);
    return space;
  }

  MapHierarchy hierarchy;
  TableArea table;
};

RobotModel camera() {
  RobotModel robot;
  robot.camera = {160, 120, 135.0, 135.0, 79.5, 59.5};
  return robot;
}

Viewpoint from(const TableArea& table, double x, double y) {
  return ViewpointSampler({}, camera()).facing(table, {x, y}, 1.2);
}

double gain(const GainConfig& config, const KnowledgeGrid& grid, const Viewpoint& v,
            Wanted wanted = Wanted::boxes) {
  return ExpectedInformationGain(config, camera())(grid, v, wanted);
}

TEST(KnowledgeGrid, TellsFreeOccupiedAndUnknownInBoxes) {
  const Desk desk;
  const KnowledgeGrid grid(desk.hierarchy, desk.table, desk.cleared(), 0.01, 3.0);
  const auto at = [&](double x, double y, double z) {
    const Eigen::Vector3d cell = (Eigen::Vector3d(x, y, z) - grid.fine().corner) / grid.fine().cell;
    return static_cast<Knowledge>(grid.fine().cells[grid.fine().index(
        static_cast<int>(cell.x()), static_cast<int>(cell.y()), static_cast<int>(cell.z()))]);
  };
  EXPECT_EQ(at(0.0, 0.0, 0.8), Knowledge::unknown_in_box);
  EXPECT_EQ(at(0.095, 0.0, 0.8), Knowledge::occupied);
  EXPECT_EQ(at(0.3, 0.0, 0.8), Knowledge::free);
  EXPECT_EQ(at(0.0, 0.0, 0.95), Knowledge::unknown);
  // 18 x 20 x 20 cells between the two sides, one more around.
  EXPECT_NEAR(static_cast<double>(grid.count(Knowledge::unknown_in_box)), 18.0 * 20.0 * 20.0, 2500.0);
  EXPECT_GE(grid.entropy(),
            static_cast<double>(grid.count(Knowledge::unknown_in_box) + grid.count(Knowledge::unknown)));
}

TEST(ClearedSpace, AFarSurfaceIsNotKnownButTheWayToItIs) {
  const Eigen::AlignedBox3d space = box(-0.2, -0.2, 0.0, 0.2, 0.2, 1.0);
  const auto look = [&](float distance) {
    ClearedSpace cleared(space, 0.01, {.constant = 0.0, .quadratic = 1.5e-3});
    PointCloud points;
    for (float x = -0.1F; x < 0.1F; x += 0.005F)
      for (float y = -0.1F; y < 0.1F; y += 0.005F) points.emplace_back(x, y, 0.505F);
    cleared.add({0.0F, 0.0F, 0.505F + distance}, points);
    return [cleared = std::move(cleared)](double z) -> std::optional<bool> {
      const auto* voxel = cleared.map().tree().search(0.003, 0.003, z);
      if (voxel == nullptr) return std::nullopt;
      return cleared.map().tree().isNodeOccupied(voxel);
    };
  };
  const auto near = look(1.5F);  // sigma 3 mm
  EXPECT_EQ(near(0.505), true);
  EXPECT_EQ(near(0.525), false);
  const auto far = look(4.0F);  // sigma 24 mm
  EXPECT_EQ(far(0.505), std::nullopt);
  EXPECT_EQ(far(0.555), std::nullopt);
  EXPECT_EQ(far(0.605), false);
}

/// Brute force: whether each unknown cell can be seen, by sampling the straight way to its centre.
double cellsInView(const KnowledgeGrid& grid, const Viewpoint& v) {
  const RobotModel robot = camera();
  const Eigen::Isometry3d world_T_sensor = toIsometry(v.world_T_sensor());
  const auto& fine = grid.fine();
  double seen = 0.0;
  fine.forEachIn(fine.box(), [&](int x, int y, int z) {
    if (static_cast<Knowledge>(fine.cells[fine.index(x, y, z)]) != Knowledge::unknown_in_box) return;
    const Eigen::Vector3d center = fine.center(x, y, z);
    const Eigen::Vector3d p = world_T_sensor.inverse() * center;
    const double u = robot.camera.cx - robot.camera.fx * p.y() / p.x();
    const double w = robot.camera.cy - robot.camera.fy * p.z() / p.x();
    if (u < -0.5 || w < -0.5 || u > robot.camera.width - 0.5 || w > robot.camera.height - 0.5) return;
    const Eigen::Vector3d way = center - world_T_sensor.translation();
    for (double t = 0.0; t < 1.0; t += 0.001) {
      const Eigen::Vector3d at = world_T_sensor.translation() + t * way;
      if (!fine.box().contains(at)) continue;
      const Eigen::Vector3d cell = ((at - fine.corner) / fine.cell).array().floor();
      const auto i = fine.index(std::min(static_cast<int>(cell.x()), fine.size[0] - 1),
                                std::min(static_cast<int>(cell.y()), fine.size[1] - 1),
                                std::min(static_cast<int>(cell.z()), fine.size[2] - 1));
      if (static_cast<Knowledge>(fine.cells[i]) == Knowledge::occupied) return;
    }
    seen += 1.0;
  });
  return seen;
}

TEST(ExpectedInformationGain, SweptCellsAreTheDistinctCellsInView) {
  const Desk desk;
  const KnowledgeGrid grid(desk.hierarchy, desk.table, desk.cleared(), 0.01, 3.0);
  GainConfig config;
  config.unknown_space = UnknownSpace::transparent;
  config.columns = 160;
  config.rows = 120;
  for (const auto& [x, y] :
       {std::pair(0.0, -1.2), std::pair(1.4, 0.3), std::pair(-1.0, 1.0), std::pair(0.9, 1.1)}) {
    const Viewpoint v = from(desk.table, x, y);
    const double expected = cellsInView(grid, v);
    EXPECT_NEAR(gain(config, grid, v), expected, 0.06 * expected + 50.0) << x << ' ' << y;
  }
}

TEST(ExpectedInformationGain, AViewOfTheOpenSideIsWorthMore) {
  const Desk desk;
  const KnowledgeGrid grid(desk.hierarchy, desk.table, desk.cleared(), 0.01, 3.0);
  for (const auto measure : {GainMeasure::entropy, GainMeasure::swept_cells}) {
    for (const auto unknown : {UnknownSpace::transparent, UnknownSpace::occluding}) {
      GainConfig config;
      config.measure = measure;
      config.unknown_space = unknown;
      const double open = gain(config, grid, from(desk.table, 0.0, 1.2));
      const double closed = gain(config, grid, from(desk.table, 1.2, 0.0));
      EXPECT_GT(open, 1.2 * closed);
      EXPECT_GT(closed, 0.0);  // from above, over the seen side
    }
  }
}

TEST(ExpectedInformationGain, OccludingSpaceIsWorthLessThanTransparent) {
  const Desk desk;
  const KnowledgeGrid grid(desk.hierarchy, desk.table, desk.cleared(), 0.01, 3.0);
  GainConfig config;
  config.unknown_space = UnknownSpace::transparent;
  const Viewpoint v = from(desk.table, 0.0, 1.2);
  const double all = gain(config, grid, v);
  config.unknown_space = UnknownSpace::occluding;
  const double some = gain(config, grid, v);
  EXPECT_LT(some, all);
  config.attenuation = 1e6;
  EXPECT_LE(gain(config, grid, v), all);
}

/// Cells of half the edge are eight times as many.
TEST(ExpectedInformationGain, CountsInTheObjectsResolution) {
  const Desk coarse(0.01);
  const Desk fine(0.005);
  const KnowledgeGrid coarse_grid(coarse.hierarchy, coarse.table, coarse.cleared(), 0.005, 3.0);
  const KnowledgeGrid fine_grid(fine.hierarchy, fine.table, fine.cleared(), 0.005, 3.0);
  const Viewpoint v = from(coarse.table, 0.0, 1.2);
  // The box of the coarser object is larger: by a voxel all around.
  const double larger = static_cast<double>(fine_grid.count(Knowledge::unknown_in_box)) /
                        static_cast<double>(coarse_grid.count(Knowledge::unknown_in_box));
  EXPECT_GT(larger, 0.8);
  EXPECT_NEAR(gain({}, fine_grid, v) / gain({}, coarse_grid, v), 8.0 * larger, 0.5);
}

TEST(ExpectedInformationGain, WhatStandsInTheWayHidesTheTable) {
  Desk desk;
  const Viewpoint v = from(desk.table, 0.0, 1.5);
  const KnowledgeGrid before(desk.hierarchy, desk.table, desk.cleared(), 0.01, 3.0);
  EXPECT_GT(gain({}, before, v), 0.0);
  desk.hierarchy.add(labels::object, mapOf(0.02, {.free = {}, .occupied = {box(-1, 1.0, 0.0, 1, 1.04, 1.6)}}),
                     Pose(), kRootId);
  const KnowledgeGrid after(desk.hierarchy, desk.table, desk.cleared(), 0.01, 3.0);
  EXPECT_EQ(gain({}, after, v), 0.0);
}

TEST(ExpectedInformationGain, NothingIsGainedWhereAllIsKnownOrOutOfRange) {
  const MapHierarchy hierarchy = testing::roomWithTable();
  const TableArea table = *tableArea(hierarchy, testing::kTable, {});
  const KnowledgeGrid grid(hierarchy, table, ClearedSpace(table.space, 0.01), 0.01, 3.0);
  const Viewpoint near = from(table, 0.0, 1.2);
  EXPECT_EQ(gain({}, grid, near, Wanted::boxes), 0.0) << "no objects";
  EXPECT_GT(gain({}, grid, near, Wanted::everything), 0.0);
  EXPECT_EQ(gain({}, grid, from(table, 0.0, 20.0), Wanted::everything), 0.0) << "beyond the range";
}

TEST(ExpectedInformationGain, EntropyChangeOfTheSensorModel) {
  OccupancyModel sensor;
  sensor.prob_hit = 0.7;
  sensor.prob_miss = 0.4;
  // H(0.7) = 0.8813, H(0.4) = 0.9710 bits
  EXPECT_NEAR(ExpectedInformationGain::entropyChange(sensor), 1.0 - 0.5 * (0.8813 + 0.9710), 1e-4);
}

}  // namespace
}  // namespace hoctomap
