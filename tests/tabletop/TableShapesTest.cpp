// SPDX-License-Identifier: BSD-3-Clause
// What kinds of tables there are, and what only looks like one.
#include <gtest/gtest.h>

#include "BoxScene.h"
#include "hoctomap/tabletop/TableSearch.h"
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

TEST(TableShapes, ThinThingsAreFoundIfTheyAreAskedFor) {
  TabletopSegmentationConfig config;
  config.min_object_height = 0.004;
  for (const double thickness : {0.007, 0.010, 0.013}) {
    BoxScene scene;
    scene.add(0.9, 0.0, 0.67, 0.7, 1.0, 0.03);
    const auto thing = scene.add(0.8, 0.1, 0.70, 0.08, 0.15, thickness);
    Rng rng(5);
    const auto z = scene.look({0.2, 0.0, 1.25}, {0.85, 0.05, 0.7}, &rng);
    const auto objects = ofKind(TabletopSegmentation(config).segment(z), Structure::cluster);
    ASSERT_EQ(objects.size(), 1U) << thickness;
    EXPECT_GT(pointsIn(z, objects[0], scene.boxes[thing]), objects[0].points.size() * 8 / 10);
  }
}

}  // namespace
}  // namespace hoctomap
