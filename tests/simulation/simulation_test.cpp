// SPDX-License-Identifier: BSD-3-Clause
#include "hoctomap/simulation/Simulation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "SmallScenes.h"
#include "hoctomap/geometry/Errors.h"
#include "hoctomap/simulation/VisibleSurface.h"

namespace hoctomap::test {
namespace {

std::vector<SimulatedScan> allScans(const Simulation& simulation, int threads) {
  std::vector<SimulatedScan> scans;
  simulateScene(simulation, threads, [&](const SimulatedScan& scan) { scans.push_back(scan); });
  return scans;
}

/// Distance of a point from the surface of the solid that its label names, from the solid's equation.
double distanceFromSurface(const TableScene& t, std::uint16_t label, const Eigen::Vector3d& world_point) {
  const auto in = [&](SolidId id) {
    return Eigen::Vector3d(toIsometry(t.scene.world_T_solid(id)).inverse() * world_point);
  };
  if (label == t.scene.pixelValue(t.sphere))
    return std::abs((in(t.sphere) - Eigen::Vector3d(0, 0, 0.06)).norm() - 0.06);
  if (label == t.scene.pixelValue(t.box)) {
    const Eigen::Vector3d p = in(t.box) - Eigen::Vector3d(0, 0, 0.1);
    return std::abs((p.cwiseAbs() - Eigen::Vector3d(0.05, 0.075, 0.1)).maxCoeff());
  }
  if (label == 1) return std::abs(world_point.z());  // the floor is all the background
  return 0.0;
}

TEST(Simulation, LabelsAgreeWithGeometry) {
  const TableScene t = tableScene();
  int compared = 0;
  for (const SimulatedScan& scan : allScans(tableSimulation(), 2)) {
    const Eigen::Isometry3d world_T_sensor = toIsometry(scan.world_T_sensor);
    const PinholeCamera& camera = scan.image.camera;
    for (int v = 0; v < camera.height; ++v)
      for (int u = 0; u < camera.width; ++u) {
        const std::uint16_t label = scan.labels[static_cast<std::size_t>(v * camera.width + u)];
        const auto depth = static_cast<double>(scan.image.at(u, v));
        ASSERT_EQ(label == 0, depth == 0.0);
        if (label == 0) continue;
        const Eigen::Vector3d p = world_T_sensor * camera.point(u, v, depth);
        ASSERT_LT(distanceFromSurface(t, label, p), 1e-4) << "label " << label;
        if (label >= 100) {
          ASSERT_GT(p.z(), 0.6999);
          ++compared;
        }
      }
  }
  EXPECT_GT(compared, 300);
}

TEST(Simulation, SameBytesForAnyNumberOfThreads) {
  Simulation simulation = tableSimulation();
  const PinholeCamera camera = simulation.sensor.camera;
  simulation.sensor = RangeSensorModel{};
  simulation.sensor.camera = camera;
  simulation.sensor.edge_mixed = 0.1;
  const auto one = allScans(simulation, 1);
  const auto many = allScans(simulation, 5);
  ASSERT_EQ(one.size(), many.size());
  for (std::size_t k = 0; k < one.size(); ++k) {
    EXPECT_EQ(one[k].image.depth, many[k].image.depth);
    EXPECT_EQ(one[k].labels, many[k].labels);
    EXPECT_EQ(one[k].rendering.image.depth, many[k].rendering.image.depth);
  }
  for (std::size_t i = 0; i < one[0].labels.size(); ++i) {
    EXPECT_EQ(one[0].labels[i] == 0, one[0].image.depth[i] == 0.0F);
    if (one[0].solids[i] == kMixedSolids) {
      EXPECT_EQ(one[0].labels[i], 1);
    }
  }
  simulation.seed = 2;
  EXPECT_NE(one[0].image.depth, allScans(simulation, 1)[0].image.depth);
}

TEST(Simulation, ScansCarryTheirTimeAndPoses) {
  Simulation simulation = tableSimulation();
  simulation.start_stamp = 100.0;
  simulation.scan_period = 0.25;
  const auto scans = allScans(simulation, 1);
  ASSERT_EQ(scans.size(), 3U);
  for (std::size_t k = 0; k < scans.size(); ++k) {
    EXPECT_EQ(scans[k].scan, k);
    EXPECT_DOUBLE_EQ(scans[k].stamp, 100.0 + 0.25 * static_cast<double>(k));
    const Pose composed = scans[k].view.world_T_base + scans[k].view.base_T_sensor;
    EXPECT_NEAR(composed.distanceTo(scans[k].world_T_sensor), 0.0, 1e-12);
  }
}

TEST(Simulation, WhatTheScriptTakesAwayIsNotSeen) {
  const TableScene t = tableScene();
  Simulation simulation = tableSimulation();
  simulation.script = SceneScript({{.scan = 1, .action = SceneAction::vanish, .solid = "box"},
                                   {.scan = 2, .action = SceneAction::vanish, .solid = "table"}});
  const auto scans = allScans(simulation, 1);
  const auto count = [&](std::size_t k, SolidId id) {
    return std::count(scans[k].labels.begin(), scans[k].labels.end(), t.scene.pixelValue(id));
  };
  EXPECT_GT(count(0, t.box), 50);
  EXPECT_EQ(count(1, t.box), 0);
  EXPECT_GT(count(1, t.sphere), 20);
  EXPECT_EQ(count(2, t.table), 0);
  EXPECT_EQ(count(2, t.sphere), 0);
}

TEST(Simulation, AMovedTableCarriesWhatTheCameraSees) {
  // Moving the table and moving the camera the other way show the same objects.
  const TableScene t = tableScene();
  const Pose motion = at(0.2, 0.1, 0.0);
  Simulation moved = tableSimulation();
  moved.script = SceneScript({{.scan = 0,
                               .action = SceneAction::move,
                               .solid = "table",
                               .position = Eigen::Vector3d(1.2, 0.1, 0.0)}});
  for (View& view : moved.views) view.world_T_base = motion + view.world_T_base;
  const auto expected = allScans(tableSimulation(), 1);
  const auto shifted = allScans(moved, 1);
  for (std::size_t k = 0; k < expected.size(); ++k) {
    int differing = 0;
    for (std::size_t i = 0; i < expected[k].labels.size(); ++i) {
      if (std::max(expected[k].labels[i], shifted[k].labels[i]) < 10) continue;  // the floor did not move
      if (expected[k].labels[i] != shifted[k].labels[i])
        ++differing;
      else
        EXPECT_NEAR(expected[k].image.depth[i], shifted[k].image.depth[i], 1e-4);
    }
    EXPECT_LE(differing, 10);  // beams along silhouettes
  }
}

TEST(Simulation, NeedsAView) {
  Simulation simulation = tableSimulation();
  simulation.views.clear();
  EXPECT_THROW(allScans(simulation, 1), ConfigError);
}

TEST(VisibleSurface, GrowsAndMovesWithTheSolid) {
  const TableScene t = tableScene();
  Simulation simulation = tableSimulation();
  simulation.script = SceneScript({{.scan = 1,
                                    .action = SceneAction::move,
                                    .solid = "sphere",
                                    .position = Eigen::Vector3d(0.0, 0.25, 0.0)}});
  VisibleSurface seen(0.002);
  EXPECT_FALSE(seen.centroid(t.sphere).has_value());
  std::size_t before = 0;
  simulateScene(simulation, 1, [&](const SimulatedScan& scan) {
    seen.add(scan);
    EXPECT_GT(seen.voxels(t.sphere), before);
    before = seen.voxels(t.sphere);
  });
  // In the sphere's own frame, whatever its place: on the side of the camera, within the sphere.
  const Eigen::Vector3d centroid = seen.centroid(t.sphere).value();
  EXPECT_LT((centroid - Eigen::Vector3d(0, 0, 0.06)).norm(), 0.06);
  EXPECT_LT(centroid.x(), 0.0);
  EXPECT_EQ(seen.voxels(t.floor), 0U);
}

}  // namespace
}  // namespace hoctomap::test
