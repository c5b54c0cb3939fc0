// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "vi_b/Ghosts.h"

namespace hoctomap {
namespace {

constexpr double kVoxel = 0.01;

Eigen::Vector3d worldPoint(int x, int y, int z) {
  return kVoxel * (Eigen::Vector3d(x, y, z) + Eigen::Vector3d::Constant(0.5));
}

NodeMap mapOf(const std::vector<Eigen::Vector3d>& occupied) {
  auto tree = std::make_unique<octomap::OcTree>(kVoxel);
  for (const Eigen::Vector3d& p : occupied) tree->updateNode(p.x(), p.y(), p.z(), true);
  return {std::move(tree), OccupancyModel()};
}

RemovedNode removedNode(const std::vector<Eigen::Vector3d>& occupied) {
  return {MapNode(NodeId{7}, labels::object, mapOf(occupied)), Pose(), 5};
}

TEST(CellSet, AgreesWithTheDistanceToEveryCell) {
  CellSet cells(kVoxel);
  cells.insert(worldPoint(-3, 0, 2));
  for (int x = -7; x < 2; ++x) {
    for (int y = -4; y < 4; ++y) {
      for (int z = -2; z < 6; ++z) {
        for (const int voxels : {1, 2}) {
          const int apart = std::max({std::abs(x + 3), std::abs(y), std::abs(z - 2)});
          EXPECT_EQ(cells.anyNear(worldPoint(x, y, z), (voxels + 0.5) * kVoxel), apart <= voxels)
              << x << " " << y << " " << z;
        }
      }
    }
  }
}

TEST(VacatedPlace, GhostsAreWhereTheObjectWasAndNothingIs) {
  const RemovedNode gone = removedNode({worldPoint(0, 0, 0), worldPoint(10, 0, 0), worldPoint(20, 0, 0)});
  MapHierarchy now(labels::background, mapOf({worldPoint(0, 1, 0), worldPoint(0, 2, 0)}));
  now.add(labels::table, mapOf({worldPoint(20, 0, -1)}), Pose(), kRootId);
  std::vector<Measurement> since(1);
  since.front().world_points = {worldPoint(10, 0, 1).cast<float>()};
  const VacatedPlace place(gone, now, since);
  EXPECT_TRUE(place.isGhost(worldPoint(0, 0, 0), kVoxel));
  EXPECT_TRUE(place.isGhost(worldPoint(1, 1, -1), kVoxel));
  EXPECT_FALSE(place.isGhost(worldPoint(2, 0, 0), kVoxel)) << "beside the place";
  EXPECT_FALSE(place.isGhost(worldPoint(10, 0, 0), kVoxel)) << "measured since";
  EXPECT_FALSE(place.isGhost(worldPoint(20, 0, 0), kVoxel)) << "at the table";
  // The root keeps one voxel within one voxel of the object.
  EXPECT_EQ(place.ghostsOf(now).size(), 1U);
}

TEST(VacatedPlace, HiddenIsWhatNoImageSeesThrough) {
  const RemovedNode gone = removedNode({worldPoint(100, 0, 0)});
  const MapHierarchy now(labels::background, NodeMap(kVoxel, OccupancyModel()));
  std::vector<Measurement> since(2);
  for (Measurement& z : since) z.image = DepthImage{{3, 1, 3.0, 3.0, 1.0, 0.0}, {0.0F, 0.5F, 2.0F}};
  const VacatedPlace place(gone, now, since);
  // Seen from the origin along x: the middle pixel ends at 0.5 m, the right one at 2 m, the left one nowhere.
  EXPECT_EQ(place.countHidden({{1.0F, 0.0F, 0.0F}}), 1U);
  EXPECT_EQ(place.countHidden({{0.4F, 0.0F, 0.0F}}), 0U);
  EXPECT_EQ(place.countHidden({{1.0F, -0.333F, 0.0F}}), 0U);
  EXPECT_EQ(place.countHidden({{2.1F, -0.7F, 0.0F}}), 1U);
  EXPECT_EQ(place.countHidden({{1.0F, 0.333F, 0.0F}}), 1U);
  // One image that sees through is enough.
  since.back().image->depth[1] = 3.0F;
  EXPECT_EQ(place.countHidden({{1.0F, 0.0F, 0.0F}}), 0U);
}

}  // namespace
}  // namespace hoctomap
