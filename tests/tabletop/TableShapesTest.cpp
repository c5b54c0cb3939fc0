// SPDX-License-Identifier: BSD-3-Clause
// What kinds of tables there are, and what only looks like one.
#include <gtest/gtest.h>

#include "BoxScene.h"
#include "hoctomap/mapping/HierarchyMapper.h"
#include "hoctomap/tabletop/TableSearch.h"
#include "hoctomap/tabletop/Tabletop.h"
#include "hoctomap/tabletop/TabletopSegmentation.h"

namespace hoctomap {
namespace {

using test::BoxScene;
using test::ofKind;
using test::pointsIn;
using test::Rng;

const Eigen::Vector3d kEye(0.0, 0.0, 1.5);
const Eigen::Vector3d kTarget(1.2, 0.0, 0.7);

std::vector<TableSurface> tablesOf(const BoxScene& scene, std::uint64_t seed,
                                   const Eigen::Vector3d& eye = kEye) {
  Rng rng(seed);
  return findTables(scene.look(eye, kTarget, &rng), TabletopSegmentationConfig{});
}

bool reaches(const TableSurface& table, double x, double y) {
  const auto cell = table.grid.cellOf(x, y);
  return cell < table.grid.size() && table.extent[cell];
}

TEST(TableShapes, AnLShapedCounterIsOneTable) {
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    BoxScene scene;
    scene.add(1.5, 0.0, 0.70, 0.4, 1.6, 0.03);
    scene.add(1.05, 0.6, 0.70, 0.5, 0.4, 0.03);
    const auto tables = tablesOf(scene, seed);
    ASSERT_EQ(tables.size(), 1U);
    EXPECT_TRUE(reaches(tables[0], 1.5, -0.5));
    EXPECT_TRUE(reaches(tables[0], 1.0, 0.6));
    EXPECT_FALSE(reaches(tables[0], 1.0, -0.3)) << "the notch";
  }
}

TEST(TableShapes, ALargeFlatBoxIsAnObjectWithOrWithoutSomethingOnIt) {
  for (const bool loaded : {false, true}) {
    BoxScene scene;
    scene.add(1.1, 0.0, 0.67, 0.8, 1.2, 0.03);
    const auto box = scene.add(1.0, 0.0, 0.70, 0.35, 0.4, 0.12);
    if (loaded) scene.add(1.0, 0.05, 0.82, 0.08, 0.1, 0.1);
    Rng rng(3);
    const auto z = scene.look(kEye, kTarget, &rng);
    const auto segments = TabletopSegmentation(TabletopSegmentationConfig{}).segment(z);
    EXPECT_EQ(ofKind(segments, Structure::plane).size(), 1U);
    const auto objects = ofKind(segments, Structure::cluster);
    ASSERT_EQ(objects.size(), loaded ? 2U : 1U);
    EXPECT_GT(pointsIn(z, objects[0], scene.boxes[box]), objects[0].points.size() * 9 / 10);
  }
}

TEST(TableShapes, StripsBetweenBoxesAreOneTable) {
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    BoxScene scene;
    scene.add(1.2, 0.0, 0.70, 0.6, 1.8, 0.03);
    scene.add(1.2, -0.35, 0.73, 0.6, 0.40, 0.15);  // from the front to the back
    scene.add(1.2, 0.35, 0.73, 0.6, 0.35, 0.20);
    const auto tables = tablesOf(scene, seed);
    ASSERT_EQ(tables.size(), 1U) << seed;
    for (const double y : {-0.75, 0.0, 0.75}) EXPECT_TRUE(reaches(tables[0], 1.2, y)) << y;
  }
}

TEST(TableShapes, TablesWithAnOpenGapBetweenThemAreTwoAlsoBehindABox) {
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    BoxScene scene;
    scene.add(0.0, 0.0, -0.1, 8.0, 8.0, 0.1);
    scene.add(1.2, 0.70, 0.70, 0.6, 0.8, 0.03);
    scene.add(1.2, -0.70, 0.70, 0.6, 0.8, 0.03);
    scene.add(0.95, 0.35, 0.73, 0.10, 0.10, 0.35);  // hides a part of the gap
    EXPECT_EQ(tablesOf(scene, seed).size(), 2U) << seed;
  }
}

TEST(TableShapes, AShelfOverATableIsATable) {
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    BoxScene scene;
    scene.add(1.3, 0.0, 0.57, 0.8, 1.4, 0.03);
    const auto shelf = scene.add(1.45, 0.0, 0.88, 0.4, 1.0, 0.02);
    scene.add(1.45, -0.49, 0.60, 0.4, 0.02, 0.28);  // its sides
    scene.add(1.45, 0.49, 0.60, 0.4, 0.02, 0.28);
    const auto on = scene.add(1.40, 0.1, 0.90, 0.08, 0.10, 0.10);
    const auto under = scene.add(1.05, -0.1, 0.60, 0.08, 0.10, 0.10);
    Rng rng(seed);
    const auto z = scene.look(kEye, kTarget, &rng);
    ASSERT_EQ(findTables(z, TabletopSegmentationConfig{}).size(), 2U) << seed;
    for (const auto thing : {on, under}) {
      std::size_t holders = 0;
      for (const auto& s :
           ofKind(TabletopSegmentation(TabletopSegmentationConfig{}).segment(z), Structure::cluster)) {
        holders += pointsIn(z, s, scene.boxes[thing]) > s.points.size() * 8 / 10;
      }
      EXPECT_EQ(holders, 1U) << thing;
    }
    static_cast<void>(shelf);
  }
}

TEST(TableShapes, ABoxThatHidesMostOfItsTableIsAnObject) {
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    BoxScene scene;
    scene.add(1.1, 0.0, 0.67, 0.6, 0.6, 0.03);
    scene.add(1.1, 0.0, 0.70, 0.42, 0.45, 0.10);
    const auto tables = tablesOf(scene, seed);
    ASSERT_EQ(tables.size(), 1U);
    EXPECT_NEAR(-tables[0].plane.offset() / tables[0].plane.normal().z(), 0.70, 0.02);
  }
}

TEST(TableShapes, WithoutABandOfHeightsLowTablesAreTablesAndTheFloorIsNone) {
  TabletopSegmentationConfig config;
  config.table_height_min = -1000.0;
  config.table_height_max = 1000.0;
  BoxScene scene;
  scene.add(0.0, 0.0, -0.1, 8.0, 8.0, 0.1);    // floor
  scene.add(2.6, 0.0, 0.0, 0.1, 8.0, 2.5);     // wall
  scene.add(1.3, 0.5, 0.32, 0.6, 0.7, 0.03);   // 0.35 m
  scene.add(1.3, -0.5, 1.12, 0.6, 0.6, 0.03);  // 1.15 m
  Rng rng(4);
  const auto tables = findTables(scene.look(kEye, kTarget, &rng), config);
  ASSERT_EQ(tables.size(), 2U);
  for (const auto& table : tables) {
    const bool low = reaches(table, 1.3, 0.5);
    EXPECT_NEAR(-table.plane.signedDistance({1.3, low ? 0.5 : -0.5, 0.0}), low ? 0.35 : 1.15, 0.005);
  }
}

TEST(TableShapes, WhatObjectsEncloseOfATableIsTable) {
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    BoxScene scene;
    scene.add(1.0, 0.0, 0.70, 1.0, 1.4, 0.03);
    // Four boxes around a yard of 12 x 12 cm.
    scene.add(0.89, 0.0, 0.73, 0.10, 0.32, 0.04);
    scene.add(1.11, 0.0, 0.73, 0.10, 0.32, 0.09);
    scene.add(1.0, -0.11, 0.73, 0.12, 0.10, 0.06);
    scene.add(1.0, 0.11, 0.73, 0.12, 0.10, 0.06);
    Rng rng(seed);
    const auto z = scene.look({0.3, 0.0, 1.7}, {1.0, 0.0, 0.73}, &rng);
    const Eigen::AlignedBox3d yard(Eigen::Vector3d(0.97, -0.03, 0.71), Eigen::Vector3d(1.03, 0.03, 0.73));
    const auto segments = TabletopSegmentation(TabletopSegmentationConfig{}).segment(z);
    std::size_t table = 0;
    for (const auto& s : ofKind(segments, Structure::plane)) table += pointsIn(z, s, yard);
    EXPECT_GT(table, 50U);
    for (const auto& s : ofKind(segments, Structure::cluster)) EXPECT_LT(pointsIn(z, s, yard), table / 10);
  }
}

/// The kitchen's table tilts by 1.4 degrees and sinks by 2 cm over its sweep.
TEST(TableShapes, ATableThatTiltsAndSinksIsOneNode) {
  BoxScene scene;
  scene.add(1.0, 0.0, 0.70, 0.8, 1.4, 0.03);
  scene.add(0.9, 0.2, 0.73, 0.10, 0.12, 0.15);
  MappingStrategies strategies;
  strategies.segmentation = std::make_unique<TabletopSegmentation>(TabletopSegmentationConfig{});
  strategies.labeling = makeTabletopLabeling();
  strategies.relations = makeTabletopRelations();
  strategies.association = makeTabletopAssociation(0.02);
  LabelProfiles profiles;
  profiles[labels::background].resolution = 0.05;
  profiles[labels::table].resolution = 0.01;
  profiles[labels::object].resolution = 0.01;
  HierarchyMapper mapper(MappingConfig{}, profiles, std::move(strategies));
  constexpr int kScans = 10;
  for (int k = 0; k < kScans; ++k) {
    const double share = static_cast<double>(k) / (kScans - 1);
    Rng rng(static_cast<std::uint64_t>(k));
    auto z = scene.look({0.0, -0.5 + share, 1.5}, {1.0, 0.0, 0.7}, &rng);
    // What the pose of the sensor is wrong by moves all that it sees.
    const Pose error(0, 0, -0.02 * share, 0, 0.0244 * share, 0);
    const Eigen::Isometry3d moved = toIsometry(error);
    for (auto& p : z.world_points) p = (moved * p.cast<double>()).cast<float>();
    z.world_T_sensor = error + z.world_T_sensor;
    z.scan = static_cast<std::uint64_t>(k);
    mapper.integrate(z);
  }
  const MapHierarchy& map = mapper.hierarchy();
  const auto ids = map.ids();
  EXPECT_EQ(
      std::count_if(ids.begin(), ids.end(), [&](NodeId id) { return map.node(id).label() == labels::table; }),
      1);
}

}  // namespace
}  // namespace hoctomap
