// SPDX-License-Identifier: BSD-3-Clause
#include "hoctomap/tabletop/TableSearch.h"

#include <gtest/gtest.h>

#include "BoxScene.h"
#include "hoctomap/tabletop/TabletopSegmentation.h"

namespace hoctomap {
namespace {

using test::BoxScene;
using test::ofKind;
using test::pointsIn;
using test::Rng;

const Eigen::Vector3d kEye(0.0, 0.0, 1.5);
const Eigen::Vector3d kTarget(1.2, 0.0, 0.7);

std::vector<TableSurface> tablesOf(const BoxScene& scene, std::uint64_t seed = 1) {
  Rng rng(seed);
  return findTables(scene.look(kEye, kTarget, &rng), TabletopSegmentationConfig{});
}

/// Height of a table's plane in its middle.
double heightOf(const TableSurface& table, double x, double y) {
  return -table.plane.signedDistance(Eigen::Vector3d(x, y, 0.0)) / table.plane.normal().z();
}

TEST(TableSearch, FindsTablesOfTwoHeights) {
  BoxScene scene;
  scene.add(1.0, 0.4, 0.70, 0.7, 0.6, 0.03);
  scene.add(1.2, -0.4, 0.87, 0.6, 0.5, 0.03);
  const auto tables = tablesOf(scene);
  ASSERT_EQ(tables.size(), 2U);
  EXPECT_GE(tables[0].area(), tables[1].area());
  const bool first_is_low = heightOf(tables[0], 1.0, 0.0) < 0.8;
  EXPECT_NEAR(heightOf(tables[first_is_low ? 0 : 1], 1.0, 0.4), 0.73, 0.003);
  EXPECT_NEAR(heightOf(tables[first_is_low ? 1 : 0], 1.2, -0.4), 0.90, 0.003);
}

TEST(TableSearch, KeepsTablesOfOneHeightApart) {
  BoxScene scene;
  scene.add(1.0, 0.45, 0.70, 0.7, 0.6, 0.03);
  scene.add(1.0, -0.45, 0.70, 0.7, 0.6, 0.03);
  const auto tables = tablesOf(scene);
  ASSERT_EQ(tables.size(), 2U);
  for (const auto& table : tables) {
    const bool left = tables[0].grid.cellOf(1.0, 0.45) < tables[0].grid.size() &&
                      table.grid.cellOf(1.0, 0.45) < table.grid.size() &&
                      table.patch[table.grid.cellOf(1.0, 0.45)];
    const auto other = table.grid.cellOf(1.0, left ? -0.45 : 0.45);
    EXPECT_TRUE(other >= table.grid.size() || !table.extent[other]);
  }
}

TEST(TableSearch, OneTableBehindAnObjectIsOneTable) {
  BoxScene scene;
  scene.add(1.0, 0.0, 0.70, 0.6, 1.2, 0.03);
  scene.add(0.75, 0.0, 0.73, 0.09, 0.15, 0.35);  // its shadow parts the table
  EXPECT_EQ(tablesOf(scene).size(), 1U);
}

TEST(TableSearch, TakesNoFloorWallSeatOrScrap) {
  BoxScene scene;
  scene.add(0.0, 0.0, -0.1, 8.0, 8.0, 0.1);      // floor
  scene.add(2.6, 0.0, 0.0, 0.1, 8.0, 2.5);       // wall
  scene.add(1.2, 0.5, 0.40, 0.45, 0.45, 0.05);   // seat, below the band
  scene.add(1.2, -0.5, 0.70, 0.15, 0.15, 0.03);  // scrap
  scene.add(1.5, 0.0, 1.05, 0.6, 0.6, 0.03);     // board, above the band
  for (std::uint64_t seed = 1; seed <= 4; ++seed) EXPECT_TRUE(tablesOf(scene, seed).empty());
}

/// At 5 m the ranges of a wall scatter by the depth of a small table.
TEST(TableSearch, TheNoiseOfAFarWallIsNoTable) {
  BoxScene scene;
  scene.add(0.0, 0.0, -0.1, 14.0, 14.0, 0.1);  // floor
  scene.add(5.2, 0.0, 0.0, 0.1, 8.0, 2.5);     // wall
  const auto table = scene.add(4.3, 0.6, 0.70, 0.8, 1.2, 0.03);
  const Eigen::AlignedBox2d top(scene.boxes[table].min().head<2>(), scene.boxes[table].max().head<2>());
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    Rng rng(seed);
    const auto z = scene.look({0.0, 0.0, 1.45}, {5.0, 0.0, 0.9}, &rng);
    for (const auto& found : findTables(z, TabletopSegmentationConfig{})) {
      for (std::size_t i = 0; i < found.patch.size(); ++i) {
        if (!found.patch[i]) continue;
        ASSERT_LT(top.exteriorDistance(found.grid.center(i)), 0.1) << "seed " << seed;
      }
    }
  }
}

TEST(TableSearch, TopOfABoxIsNoTable) {
  BoxScene scene;
  scene.add(1.1, 0.0, 0.67, 0.8, 1.2, 0.03);
  const auto box = scene.add(1.0, 0.0, 0.70, 0.35, 0.4, 0.2);
  Rng rng(1);
  const auto z = scene.look(kEye, kTarget, &rng);
  const auto segments = TabletopSegmentation(TabletopSegmentationConfig{}).segment(z);
  ASSERT_EQ(ofKind(segments, Structure::plane).size(), 1U);
  const auto objects = ofKind(segments, Structure::cluster);
  ASSERT_EQ(objects.size(), 1U);
  EXPECT_EQ(pointsIn(z, objects[0], scene.boxes[box]), objects[0].points.size());
}

TEST(TableSearch, TakesTiltedTablesAndNoRamps) {
  // A plane of points, as from above; a ramp of 12 degrees is none.
  for (const double degrees : {0.0, 1.5, 3.0, 12.0}) {
    Measurement z;
    z.world_T_sensor = Pose(0, 0, 1.6, 0, 0, 0);
    const double slope = std::tan(degrees * 3.14159265358979 / 180.0);
    for (double x = 0.6; x < 1.4; x += 0.005) {
      for (double y = -0.4; y < 0.4; y += 0.005) {
        z.world_points.push_back(Eigen::Vector3d(x, y, 0.75 + slope * y).cast<float>());
      }
    }
    const auto tables = findTables(z, TabletopSegmentationConfig{});
    ASSERT_EQ(tables.size(), degrees < 5.0 ? 1U : 0U) << degrees;
    if (!tables.empty()) {
      EXPECT_NEAR(std::acos(tables[0].plane.normal().z()), degrees * 3.14159265358979 / 180.0, 1e-3);
      EXPECT_EQ(tables[0].points.size(), z.world_points.size());
    }
  }
}

/// An L-shaped counter around the sensor's right, and the back of a chair in its notch.
TEST(TableSearch, ChairInTheNotchOfAnLIsNoObject) {
  BoxScene scene;
  scene.add(0.0, 0.0, -0.1, 8.0, 8.0, 0.1);
  scene.add(1.5, 0.0, 0.72, 0.4, 1.6, 0.03);   // the far bar
  scene.add(1.0, -0.6, 0.72, 0.6, 0.4, 0.03);  // the near bar
  const auto mug = scene.add(1.45, 0.2, 0.75, 0.09, 0.09, 0.12);
  const auto chair = scene.add(0.95, 0.15, 0.45, 0.03, 0.4, 0.5);  // in the notch, inside the hull
  Rng rng(2);
  const auto z = scene.look(kEye, kTarget, &rng);
  const auto tables = findTables(z, TabletopSegmentationConfig{});
  ASSERT_EQ(tables.size(), 1U);
  const auto notch = tables[0].grid.cellOf(0.85, 0.15);  // in front of the chair, open to view
  EXPECT_TRUE(notch >= tables[0].grid.size() || !tables[0].extent[notch]);
  const auto objects =
      ofKind(TabletopSegmentation(TabletopSegmentationConfig{}).segment(z), Structure::cluster);
  ASSERT_EQ(objects.size(), 1U);
  EXPECT_EQ(pointsIn(z, objects[0], scene.boxes[chair]), 0U);
  EXPECT_EQ(pointsIn(z, objects[0], scene.boxes[mug]), objects[0].points.size());
}

TEST(TableSearch, ChairBehindTheFarEdgeIsNoObject) {
  BoxScene scene;
  scene.add(0.0, 0.0, -0.1, 8.0, 8.0, 0.1);
  scene.add(1.1, 0.0, 0.72, 0.8, 1.4, 0.03);
  scene.add(1.58, 0.2, 0.5, 0.03, 0.4, 0.4);  // 6.5 cm behind the edge
  const auto box = scene.add(1.4, -0.3, 0.75, 0.12, 0.12, 0.15);
  Rng rng(2);
  const auto z = scene.look(kEye, kTarget, &rng);
  const auto objects =
      ofKind(TabletopSegmentation(TabletopSegmentationConfig{}).segment(z), Structure::cluster);
  ASSERT_EQ(objects.size(), 1U);
  EXPECT_EQ(pointsIn(z, objects[0], scene.boxes[box]), objects[0].points.size());
}

}  // namespace
}  // namespace hoctomap
