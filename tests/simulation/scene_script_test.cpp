// SPDX-License-Identifier: BSD-3-Clause
#include "hoctomap/simulation/SceneScript.h"

#include <gtest/gtest.h>

#include "SmallScenes.h"
#include "hoctomap/geometry/Errors.h"

namespace hoctomap::test {
namespace {

using Action = SceneAction;

Eigen::Matrix4d matrix(const Pose& pose) {
  return toIsometry(pose).matrix();
}

// Heights of tops come from vertices in single precision.
void expectSame(const Pose& a, const Pose& b) {
  EXPECT_LT((matrix(a) - matrix(b)).norm(), 1e-7);
}

TEST(Scene, PixelValuesCountTablesFromTenAndObjectsFromHundred) {
  const TableScene t = tableScene();
  EXPECT_EQ(t.scene.pixelValue(t.floor), 1);
  EXPECT_EQ(t.scene.pixelValue(t.table), 10);
  EXPECT_EQ(t.scene.pixelValue(t.box), 100);
  EXPECT_EQ(t.scene.pixelValue(t.sphere), 101);
}

TEST(Scene, SolidsStandOnTheTopOfTheirSupport) {
  const TableScene t = tableScene();
  expectSame(t.scene.world_T_solid(t.box), at(1.1, -0.2, 0.7, 0.3));
}

TEST(Scene, AMovedTableCarriesItsObjects) {
  TableScene t = tableScene();
  const Pose motion = at(0.3, -0.1, 0.0, 0.5);
  const Pose box_before = t.scene.world_T_solid(t.box);
  const Pose table_before = t.scene.world_T_solid(t.table);
  t.scene.place(t.table, std::nullopt, motion + table_before);
  expectSame(t.scene.world_T_solid(t.table), motion + table_before);
  expectSame(t.scene.world_T_solid(t.box), motion + box_before);
}

TEST(Scene, WhatStandsOnAVanishedSolidIsGoneToo) {
  TableScene t = tableScene();
  t.scene.setPresent(t.table, false);
  EXPECT_FALSE(t.scene.present(t.box));
  EXPECT_TRUE(t.scene.present(t.floor));
  t.scene.setPresent(t.table, true);
  EXPECT_TRUE(t.scene.present(t.box));
}

TEST(Scene, CopiesAreIndependent) {
  const TableScene t = tableScene();
  Scene copy = t.scene;
  copy.place(t.box, std::nullopt, at(9, 9, 9));
  copy.setPresent(t.sphere, false);
  expectSame(t.scene.world_T_solid(t.box), at(1.1, -0.2, 0.7, 0.3));
  EXPECT_TRUE(t.scene.present(t.sphere));
}

TEST(Scene, RefusesWhatMakesNoSense) {
  TableScene t = tableScene();
  EXPECT_THROW(t.scene.add(t.scene.solid(t.box)), ConfigError);  // name taken
  Solid solid = makeSolid("a,b", SolidLabel::object, BoxShape{}, Pose());
  EXPECT_THROW(t.scene.add(solid), ConfigError);
  solid.name = "empty";
  solid.surface = std::make_shared<const TriangleMesh>();
  EXPECT_THROW(t.scene.add(solid), ConfigError);
  solid = makeSolid("lost", SolidLabel::object, BoxShape{}, Pose(), SolidId{77});
  EXPECT_THROW(t.scene.add(solid), ConfigError);
  EXPECT_THROW(t.scene.place(t.table, t.box, Pose()), ConfigError);
  EXPECT_THROW(t.scene.place(t.box, t.box, Pose()), ConfigError);
}

TEST(SceneScript, EventsHappenBeforeTheirScanAndLast) {
  const TableScene t = tableScene();
  const SceneScript script(
      {{.scan = 5, .action = Action::appear, .solid = "box"},
       {.scan = 2, .action = Action::vanish, .solid = "box"},
       {.scan = 3, .action = Action::move, .solid = "sphere", .position = Eigen::Vector3d(0.2, 0.1, 0.0)}});
  for (std::uint64_t k = 0; k < 8; ++k) {
    const Scene scene = script.at(t.scene, k);
    EXPECT_EQ(scene.present(t.box), k < 2 || k >= 5) << k;
    EXPECT_NEAR(scene.world_T_solid(t.sphere).x(), k < 3 ? 0.9 : 1.2, 1e-12) << k;
  }
}

TEST(SceneScript, ApplyScanByScanEqualsAt) {
  const TableScene t = tableScene();
  const SceneScript script(
      {{.scan = 1, .action = Action::swap, .solid = "box", .other = "sphere"},
       {.scan = 1, .action = Action::vanish, .solid = "sphere"},
       {.scan = 2, .action = Action::move, .solid = "table", .position = Eigen::Vector3d(0, 0, 0)}});
  Scene scene = t.scene;
  for (std::uint64_t k = 0; k < 4; ++k) {
    script.apply(scene, k);
    const Scene direct = script.at(t.scene, k);
    for (const SolidId id : scene.ids()) {
      expectSame(scene.world_T_solid(id), direct.world_T_solid(id));
      EXPECT_EQ(scene.present(id), direct.present(id));
    }
  }
}

TEST(SceneScript, WhatAMoveDoesNotTellStays) {
  const TableScene t = tableScene();
  const SceneScript turned({{.scan = 0, .solid = "box", .yaw_pitch_roll = Eigen::Vector3d(1.0, 0.0, 0.0)}});
  expectSame(turned.at(t.scene, 0).world_T_solid(t.box), at(1.1, -0.2, 0.7, 1.0));
  const SceneScript to_floor({{.scan = 0, .solid = "box", .support = "world"}});
  expectSame(to_floor.at(t.scene, 0).world_T_solid(t.box), at(0.1, -0.2, 0.0, 0.3));
  const SceneScript onto_sphere(
      {{.scan = 0, .solid = "box", .position = Eigen::Vector3d::Zero(), .support = "sphere"}});
  EXPECT_NEAR(onto_sphere.at(t.scene, 0).world_T_solid(t.box).z(), 0.7 + 0.12, 1e-6);
}

TEST(SceneScript, SwapExchangesPlaces) {
  const TableScene t = tableScene();
  const SceneScript script({{.scan = 0, .action = Action::swap, .solid = "box", .other = "sphere"}});
  const Scene after = script.at(t.scene, 0);
  expectSame(after.world_T_solid(t.box), t.scene.world_T_solid(t.sphere));
  expectSame(after.world_T_solid(t.sphere), t.scene.world_T_solid(t.box));
}

TEST(SceneScript, EventsThatMakeNoSenseAreRefused) {
  const TableScene t = tableScene();
  const std::vector<SceneEvent> wrong{
      {.scan = 0, .action = Action::vanish, .solid = "nobody"},
      {.scan = 0, .action = Action::appear, .solid = "box"},
      {.scan = 0, .action = Action::move, .solid = "box"},
      {.scan = 0, .action = Action::move, .solid = "box", .support = "nobody"},
      {.scan = 0, .action = Action::move, .solid = "table", .support = "box"},
      {.scan = 0, .action = Action::swap, .solid = "box", .other = "box"},
      {.scan = 0, .action = Action::swap, .solid = "box", .other = "table"}};
  for (const SceneEvent& event : wrong)
    EXPECT_THROW((void)SceneScript({event}).at(t.scene, 0), ConfigError) << event.solid;

  SceneEvent twice{.scan = 0, .action = Action::vanish, .solid = "box"};
  EXPECT_THROW((void)SceneScript({twice, twice}).at(t.scene, 0), ConfigError);
}

}  // namespace
}  // namespace hoctomap::test
