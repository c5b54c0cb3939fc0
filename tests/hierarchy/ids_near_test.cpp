// SPDX-License-Identifier: BSD-3-Clause
// MapHierarchy::idsNear, nearest, idsSince and kinds against a look at every node, through random lives of a
// hierarchy.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <set>

#include "hoctomap/hierarchy/MapHierarchy.h"
#include "support/RandomScenes.h"

namespace hoctomap {
namespace {

/// Marks a few voxels about the middle of the node's map.
void fill(MapHierarchy& h, NodeId id, test::Rng& rng) {
  PointCloud hits;
  for (int i = 0; i < 5; ++i) hits.push_back(test::uniformVector(rng, -0.4, 0.4).cast<float>());
  Beams beams;
  beams.origin = Eigen::Vector3f(0.0F, 0.0F, 1.0F);
  beams.hits = hits;
  h.node(id).map().update(*makeReferenceScanUpdate(), beams);
}

NodeId add(MapHierarchy& h, test::Rng& rng) {
  const auto ids = h.ids();
  const Label label = rng() % 3 == 0 ? labels::table : labels::object;
  const NodeId id = h.add(label, NodeMap(0.05, {}), test::randomPose(rng, 5.0), ids[rng() % ids.size()]);
  if (rng() % 8 != 0) fill(h, id, rng);  // some have no voxels, and no box
  return id;
}

NodeId anyOf(const MapHierarchy& h, test::Rng& rng) {
  const auto ids = h.ids();
  return ids[rng() % ids.size()];
}

/// One random change.
void change(MapHierarchy& h, test::Rng& rng) {
  const NodeId id = anyOf(h, rng);
  switch (rng() % 8) {
    case 0:
      add(h, rng);
      break;
    case 1:
      if (id != kRootId) h.remove(id);
      break;
    case 2:
      if (id != kRootId) h.move(id, test::randomPose(rng, 2.0));  // with its subtree
      break;
    case 3:
      fill(h, id, rng);
      break;
    case 4:
      h.node(id).confirmation.waits = rng() % 2 == 0;
      break;
    case 5:
      if (id != kRootId) h.relabel(id, rng() % 2 == 0 ? labels::table : labels::object);
      break;
    case 6:
      h.node(id).first_scan = rng() % 10;
      break;
    default:
      try {
        if (id != kRootId) h.reparent(id, anyOf(h, rng));
      } catch (const std::invalid_argument&) {
        // would close a cycle
      }
  }
}

void expectAsBruteForce(const MapHierarchy& h, test::Rng& rng) {
  const Eigen::Vector3d center = test::uniformVector(rng, -5.0, 5.0);
  const Eigen::Vector3d half = test::uniformVector(rng, 0.0, 2.0);
  const Eigen::AlignedBox3d box(center - half, center + half);
  std::vector<NodeId> expected;
  for (const NodeId id : h.ids()) {
    const Eigen::AlignedBox3d bounds = worldBounds(h.box(id));
    if (!bounds.isEmpty() && bounds.intersects(box)) expected.push_back(id);
  }
  EXPECT_EQ(h.idsNear(box), expected);
  const std::uint64_t scan = rng() % 10;
  std::vector<NodeId> later = h.ids();
  std::erase_if(later, [&](NodeId id) { return h.node(id).first_scan <= scan; });
  EXPECT_EQ(h.idsSince(scan), later);
  std::set<NodeKind, std::greater<>> kinds;
  h.forEachNode([&](const MapNode& node) {
    if (!node.confirmation.waits) kinds.insert({h.depth(node.id()), node.label()});
  });
  EXPECT_EQ(h.kinds(), std::vector<NodeKind>(kinds.begin(), kinds.end()));
  const auto isTable = [&](NodeId id) { return h.node(id).label() == labels::table; };
  double least = std::numeric_limits<double>::infinity();
  for (const NodeId id : h.ids()) {
    const Eigen::AlignedBox3d bounds = worldBounds(h.box(id));
    if (isTable(id) && !bounds.isEmpty()) least = std::min(least, bounds.exteriorDistance(center));
  }
  const auto nearest = h.nearest(center, isTable);
  ASSERT_EQ(nearest.has_value(), std::isfinite(least));
  if (!nearest) return;
  EXPECT_TRUE(isTable(*nearest));
  EXPECT_NEAR(worldBounds(h.box(*nearest)).exteriorDistance(center), least, 1e-5);
}

TEST(IdsNear, IsWhatALookAtEveryNodeFinds) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    test::Rng rng(seed);
    MapHierarchy h(labels::background, NodeMap(0.05, {}));
    for (int i = 0; i < 60; ++i) add(h, rng);
    for (int i = 0; i < 200; ++i) {
      if (rng() % 3 != 0) change(h, rng);  // several changes between two questions, or none
      if (rng() % 2 == 0) continue;
      ASSERT_NO_FATAL_FAILURE(expectAsBruteForce(h, rng));
    }
  }
}

TEST(IdsNear, EverythingIsInAnUnboundedBox) {
  test::Rng rng(7);
  MapHierarchy h(labels::background, NodeMap(0.05, {}));
  std::vector<NodeId> filled;
  for (int i = 0; i < 20; ++i) {
    const NodeId id = add(h, rng);
    if (!h.node(id).map().occupiedVoxels().empty()) filled.push_back(id);
  }
  const Eigen::Vector3d far = Eigen::Vector3d::Constant(std::numeric_limits<double>::infinity());
  EXPECT_EQ(h.idsNear({-far, far}), filled);
  EXPECT_TRUE(h.idsNear({}).empty());
}

TEST(IdsNear, GoesWithAHierarchyThatIsMoved) {
  test::Rng rng(9);
  MapHierarchy h(labels::background, NodeMap(0.05, {}));
  for (int i = 0; i < 20; ++i) add(h, rng);
  expectAsBruteForce(h, rng);
  MapHierarchy other = std::move(h);
  for (int i = 0; i < 20; ++i) {
    change(other, rng);
    expectAsBruteForce(other, rng);
  }
}

}  // namespace
}  // namespace hoctomap
