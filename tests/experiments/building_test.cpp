// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <map>
#include <memory>

#include "building/BuildingScene.h"
#include "building/BuildingScore.h"
#include "hoctomap/geometry/Errors.h"

namespace hoctomap {
namespace {

BuildingPlan smallPlan() {
  BuildingPlan plan;
  plan.rooms = 4;
  plan.tables = 10;
  plan.objects = 45;
  plan.scans = 300;
  return plan;
}

Eigen::AlignedBox3d boxOf(const Scene& scene, SolidId id) {
  return surfaceExtent(*scene.solid(id).surface, toIsometry(scene.world_T_solid(id))).box;
}

TEST(Building, HasWhatThePlanSays) {
  const Simulation building = makeBuilding(smallPlan());
  EXPECT_EQ(building.views.size(), 300U);
  std::map<SolidLabel, int> count;
  std::vector<SolidId> objects;
  for (const SolidId id : building.scene.ids()) {
    ++count[building.scene.solid(id).label];
    if (building.scene.solid(id).label == SolidLabel::object) objects.push_back(id);
  }
  EXPECT_EQ(count[SolidLabel::table], 10);
  EXPECT_EQ(count[SolidLabel::object], 45);
  for (const SolidId a : objects) {
    for (const SolidId b : objects) {
      if (a == b) continue;
      EXPECT_FALSE(boxOf(building.scene, a).intersects(boxOf(building.scene, b)));
    }
  }
  EXPECT_EQ(makeBuilding(smallPlan()).scene.world_T_solid(objects[7]).asString(),
            building.scene.world_T_solid(objects[7]).asString());
}

TEST(Building, ImpossiblePlansAreRefused) {
  BuildingPlan plan = smallPlan();
  plan.scans = 50;
  EXPECT_THROW(static_cast<void>(makeBuilding(plan)), ConfigError);
  plan = smallPlan();
  plan.objects = 81;
  EXPECT_THROW(static_cast<void>(makeBuilding(plan)), ConfigError);
}

/// A map with a node for every object, moved by `shift`: occupied where the surface's vertices are.
MapHierarchy mapOf(const Scene& scene, double shift) {
  MapHierarchy map(labels::background, NodeMap(0.05, OccupancyModel()));
  for (const SolidId id : scene.ids()) {
    const Solid& solid = scene.solid(id);
    if (solid.label != SolidLabel::object) continue;
    auto tree = std::make_unique<octomap::OcTree>(0.002);
    for (const auto& v : solid.surface->vertices)
      tree->updateNode(octomap::point3d(v.x(), v.y(), v.z()), true);
    map.add(labels::object, NodeMap(std::move(tree), OccupancyModel()),
            Pose(shift, 0, 0, 0, 0, 0) + scene.world_T_solid(id), kRootId);
  }
  return map;
}

TEST(Building, TheScoreCountsWhatIsMissedAndWhatIsTooMuch) {
  const Scene scene = makeBuilding(smallPlan()).scene;
  const BuildingScore all = scoreBuilding(mapOf(scene, 0.0), scene, SolidLabel::object);
  EXPECT_EQ(all.matched, 45U);
  EXPECT_TRUE(all.mistakes.empty());
  EXPECT_EQ(scoreBuilding(mapOf(scene, 0.05), scene, SolidLabel::object).matched, 0U);
  MapHierarchy less = mapOf(scene, 0.0);
  less.remove(NodeId{1});
  const BuildingScore score = scoreBuilding(less, scene, SolidLabel::object);
  EXPECT_EQ(score.matched, 44U);
  EXPECT_EQ(score.precision(), 1.0);
  EXPECT_LT(score.recall(), 1.0);
  EXPECT_EQ(score.mistakes.size(), 1U);
}

}  // namespace
}  // namespace hoctomap
