// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "SmallScenes.h"
#include "hoctomap/simulation/SurfaceCoverage.h"

namespace hoctomap::test {
namespace {

constexpr double kVoxel = 0.005;

SimulatedRobotConfig robotAt(double x, double y) {
  SimulatedRobotConfig robot;
  robot.world_T_start = at(x, y, 0.0);
  return robot;
}

MapHierarchy emptyMap() {
  return MapHierarchy(labels::background, NodeMap(0.05, OccupancyModel{}));
}

/// A node whose voxels at these points are occupied.
NodeId addNode(MapHierarchy& map, const Label& label, const std::vector<Eigen::Vector3d>& world_points,
               const Pose& world_T_node, double resolution = kVoxel) {
  auto tree = std::make_unique<octomap::OcTree>(resolution);
  const Eigen::Isometry3d node_T_world = toIsometry(world_T_node).inverse();
  for (const Eigen::Vector3d& point : world_points) {
    const Eigen::Vector3d p = node_T_world * point;
    tree->updateNode(p.x(), p.y(), p.z(), true);
  }
  return map.add(label, NodeMap(std::move(tree), OccupancyModel{}), world_T_node, kRootId);
}

const SurfaceCoverage::Object& objectOf(const SurfaceCoverage& coverage, const std::string& name) {
  return *std::find_if(coverage.objects().begin(), coverage.objects().end(),
                       [&](const auto& object) { return object.name == name; });
}

TEST(SurfaceCoverage, SamplesAreSpreadByArea) {
  const SurfaceCoverage coverage(tableScene().scene, robotAt(-1.0, 0.0));
  const double spot = CoverageConfig{}.sample_spacing * CoverageConfig{}.sample_spacing;
  const double box = 2.0 * (0.1 * 0.15 + 0.1 * 0.2 + 0.15 * 0.2);
  EXPECT_NEAR(static_cast<double>(objectOf(coverage, "box").samples) * spot, box, 2.0 * spot);
  const double sphere = 4.0 * std::numbers::pi * 0.06 * 0.06;
  EXPECT_NEAR(static_cast<double>(objectOf(coverage, "sphere").samples) * spot, sphere, 1e-3 * sphere + spot);
}

TEST(SurfaceCoverage, WhatNoCameraSeesDoesNotCount) {
  const TableScene t = tableScene();
  const SurfaceCoverage coverage(t.scene, robotAt(-1.0, 0.0));
  // Of the box all but the base: the camera is above the table and goes all around.
  const double base = 0.1 * 0.15 / (2.0 * (0.1 * 0.15 + 0.1 * 0.2 + 0.15 * 0.2));
  const auto& box = objectOf(coverage, "box");
  EXPECT_EQ(box.table, t.table);
  EXPECT_NEAR(static_cast<double>(box.world_visible.size()) / static_cast<double>(box.samples), 1.0 - base,
              0.02);
  for (const Eigen::Vector3d& p : box.world_visible) EXPECT_GT(p.z(), 0.7 + 1e-6);
}

TEST(SurfaceCoverage, OnlyPlacesThatCanBeReachedCount) {
  TableScene t = tableScene();
  // The robot cannot come behind the table: what faces away from it does not count any more.
  for (const double y : {-0.75, 0.75})
    t.scene.add(
        makeSolid(y < 0 ? "south" : "north", SolidLabel::background, BoxShape{{6, 0.1, 2}}, at(0, y, 0)));
  const SurfaceCoverage coverage(t.scene, robotAt(-1.0, 0.0));
  const Eigen::Isometry3d box_T_world = toIsometry(t.scene.world_T_solid(t.box)).inverse();
  const auto& box = objectOf(coverage, "box");
  EXPECT_GT(box.world_visible.size(), box.samples / 3);
  constexpr double kEdge = 1e-4;  // m: there, what lies behind an edge and what lies before it is one
  for (const Eigen::Vector3d& world_point : box.world_visible) {
    const Eigen::Vector3d p = box_T_world * world_point;
    const double to_edge = std::min(0.2 - p.z(), 0.075 - std::abs(p.y()));
    EXPECT_TRUE(p.x() < 0.05 - 1e-6 || to_edge < kEdge) << p.transpose();
  }
}

TEST(SurfaceCoverage, IsTheShareThatTheMapHolds) {
  const TableScene t = tableScene();
  const SurfaceCoverage coverage(t.scene, robotAt(-1.0, 0.0));
  MapHierarchy map = emptyMap();
  EXPECT_DOUBLE_EQ(coverage.of(map, kVoxel).all.value(), 0.0);

  const auto& box = objectOf(coverage, "box").world_visible;
  const auto& sphere = objectOf(coverage, "sphere").world_visible;
  addNode(map, labels::object, box, at(0.3, 0.2, 0.5, 0.7));
  const auto half = coverage.of(map, kVoxel);
  EXPECT_EQ(half.all.covered, half.all.visible - sphere.size());
  EXPECT_EQ(half.all.visible, box.size() + sphere.size());
  EXPECT_DOUBLE_EQ(coverage.ofTable(half, t.table).value(), half.all.value());
  EXPECT_DOUBLE_EQ(coverage.ofTable(half, t.floor).value(), 1.0);

  addNode(map, labels::object, sphere, at(0.0, 0.0, 0.0));
  EXPECT_DOUBLE_EQ(coverage.of(map, kVoxel).all.value(), 1.0);
}

TEST(SurfaceCoverage, ReachesAVoxelFarAndNoFarther) {
  const SurfaceCoverage coverage(tableScene().scene, robotAt(-1.0, 0.0));
  const auto& visible = objectOf(coverage, "sphere").world_visible;
  // One occupied voxel. By brute force: what is no farther from its cube than the tolerance.
  const Pose world_T_node = at(0.01, 0.02, 0.03, 0.4);
  MapHierarchy map = emptyMap();
  addNode(map, labels::object, {visible[visible.size() / 2]}, world_T_node);
  const Eigen::Isometry3d node_T_world = toIsometry(world_T_node).inverse();
  const Eigen::AlignedBox3d cube = map.node(NodeId{1}).map().occupiedBox();
  for (const double tolerance : {0.0, 0.002, 0.005, 0.012}) {
    std::size_t expected = 0;
    for (const auto& p : visible) expected += cube.exteriorDistance(node_T_world * p) <= tolerance ? 1U : 0U;
    EXPECT_EQ(coverage.of(map, tolerance).all.covered, expected) << tolerance;
    EXPECT_GT(expected, 0U);
  }
}

TEST(SurfaceCoverage, CountsObjectsAndTablesOfTheMapOnly) {
  const SurfaceCoverage coverage(tableScene().scene, robotAt(-1.0, 0.0));
  const auto& box = objectOf(coverage, "box").world_visible;
  const auto coveredBy = [&](const Label& label, bool waits, bool enough) {
    MapHierarchy map = emptyMap();
    MapNode& node = map.node(addNode(map, label, box, Pose{}));
    node.confirmation.waits = waits;
    node.confirmation.enough = enough;
    return coverage.of(map, kVoxel).all.covered;
  };
  EXPECT_EQ(coveredBy(labels::object, false, false), box.size());
  EXPECT_EQ(coveredBy(labels::table, false, false), box.size());
  EXPECT_EQ(coveredBy(labels::background, false, false), 0U);
  EXPECT_EQ(coveredBy(labels::object, true, false), 0U);  // would not enter the map now
  EXPECT_EQ(coveredBy(labels::object, true, true), box.size());
}

}  // namespace
}  // namespace hoctomap::test
