// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "hoctomap/config/Settings.h"
#include "identity/IdentityRun.h"

namespace hoctomap {
namespace {

/// A wall of points every 4 mm, 10 cm wide and high, from y on.
PointCloud wall(float y) {
  PointCloud points;
  for (int i = 0; i < 25; ++i) {
    for (int k = 0; k < 25; ++k)
      points.emplace_back(0.0F, y + 0.004F * static_cast<float>(i), 0.004F * static_cast<float>(k));
  }
  return points;
}

MappedObject object(std::uint32_t id, const PointCloud& voxels) {
  MappedObject o{NodeId{id}, Eigen::Vector3d::Zero(), voxels};
  for (const auto& p : voxels) o.centroid += p.cast<double>() / static_cast<double>(voxels.size());
  return o;
}

PointCloud both(PointCloud a, const PointCloud& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

SeenScene twoWalls() {
  SeenScene scene;
  scene.world_surface = both(wall(0.0F), wall(0.1F));
  scene.object.assign(625, 0);
  scene.object.resize(1250, 1);
  scene.objects = 2;
  scene.names = {"left", "right"};
  return scene;
}

TEST(Identity, OneNodeAnObjectIsPerfect) {
  const MappedLog map{{object(1, wall(0.1F)), object(2, wall(0.0F))}, 1, {}};
  const SegmentationScore score = scoreIdentity(map, twoWalls());
  EXPECT_GT(score.f, 0.97);
  EXPECT_EQ(score.share75, 1.0);
}

TEST(Identity, TwoObjectsInOneNodeAreOneMissed) {
  const MappedLog map{{object(1, both(wall(0.0F), wall(0.1F)))}, 1, {}};
  const SegmentationScore score = scoreIdentity(map, twoWalls());
  EXPECT_NEAR(score.precision, 0.5, 0.02);
  EXPECT_NEAR(score.recall, 0.5, 0.02);
}

TEST(Identity, WhatBecameOfAnObjectIsNamed) {
  const MappedLog joined{{object(1, both(wall(0.0F), wall(0.1F)))}, 1, {}};
  const auto together = objectFates(joined, twoWalls());
  ASSERT_EQ(together.size(), 2U);
  // Both are one node: it is one of them, and the other is joined with that.
  EXPECT_EQ((together[0].joined_with == "right") + (together[1].joined_with == "left"), 1);
  for (const ObjectFate& fate : together) EXPECT_NEAR(fate.found + fate.in_another, 1.0, 1e-9);

  const PointCloud right = wall(0.1F);
  const PointCloud lower(right.begin(), right.begin() + static_cast<std::ptrdiff_t>(right.size() / 3));
  const PointCloud upper(right.begin() + static_cast<std::ptrdiff_t>(right.size() / 3), right.end());
  const MappedLog halves{{object(1, lower), object(2, upper)}, 1, {}};
  const auto parted = objectFates(halves, twoWalls());
  EXPECT_NEAR(parted[0].nowhere, 1.0, 0.1);
  EXPECT_NEAR(parted[1].found, 2.0 / 3.0, 0.1);
  EXPECT_NEAR(parted[1].in_other_half, 1.0 / 3.0, 0.1);
  EXPECT_EQ(parted[1].joined_with, "");
}

TEST(Identity, ObjectsOfTwoMapsAreMatchedOneToOne) {
  const MappedLog a{{object(1, wall(0.0F)), object(2, wall(0.1F))}, 1, {}};
  const MappedLog b{{object(7, wall(0.105F)), object(8, wall(0.104F))}, 1, {}};
  EXPECT_EQ(matchedObjects(a, b, 0.01), 1U);
  EXPECT_EQ(matchedObjects(a, a, 0.01), 2U);
}

TEST(Identity, ReorderedScansKeepThePlacesInTheLog) {
  std::vector<Measurement> scans(5);
  for (std::size_t k = 0; k < scans.size(); ++k) {
    scans[k].scan = 2 * k;
    scans[k].stamp = 10.0 + static_cast<double>(k);
    scans[k].sensor = std::to_string(k);
  }
  const auto reverse = reordered(scans, ScanOrder::reverse, 1);
  EXPECT_EQ(reverse[0].sensor, "4");
  const auto shuffled = reordered(scans, ScanOrder::shuffled, 1);
  std::set<std::string> all;
  for (std::size_t k = 0; k < scans.size(); ++k) {
    EXPECT_EQ(reverse[k].scan, scans[k].scan);
    EXPECT_EQ(shuffled[k].stamp, scans[k].stamp);
    all.insert(shuffled[k].sensor);
  }
  EXPECT_EQ(all.size(), scans.size());
}

TEST(Identity, OtherSidesOfABoxAreNoTurnByAHalf) {
  // A box that is seen from one side, then from the other, which a turn would put where the first was.
  const SeenScene seen = see(makeCrowdedScene(19, 10));
  const MappedLog map =
      mapScans(reordered(seen.scans, ScanOrder::reverse, 0), loadSettings(std::nullopt, {}));
  for (const std::string& event : map.events)
    EXPECT_EQ(event.find("reidentified"), std::string::npos) << event;
}

TEST(CrowdedScene, OfTheSameSeedIsTheSame) {
  const auto a = makeCrowdedScene(3, 4).simulation;
  const auto b = makeCrowdedScene(3, 4).simulation;
  ASSERT_EQ(a.scene.size(), b.scene.size());
  EXPECT_GE(a.scene.size(), 4U);
  EXPECT_EQ(a.views.size(), 4U);
  for (const SolidId id : a.scene.ids())
    EXPECT_EQ(a.scene.world_T_solid(id).asString(), b.scene.world_T_solid(id).asString());
}

}  // namespace
}  // namespace hoctomap
