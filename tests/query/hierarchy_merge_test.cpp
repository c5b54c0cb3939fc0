// SPDX-License-Identifier: BSD-3-Clause
#include "hoctomap/query/HierarchyMerge.h"

#include <gtest/gtest.h>

#include "TwoScenes.h"

namespace hoctomap {
namespace {

std::size_t objectsOf(const test::Solids& a, const test::Solids& b) {
  const MapHierarchy in_a = test::mapOf(a, test::viewsAround(3));
  const MapHierarchy in_b = test::mapOf(b, test::viewsAround(3, 60.0));
  const std::vector<MergePart> parts{{in_a, {}, 3, 1.0, "a"}, {in_b, {}, 3, 2.0, "b"}};
  const LabelProfiles profiles{{labels::background, {}}, {labels::table, {}}, {labels::object, {}}};
  const MergedMaps merged = mergeMaps(parts, profiles);
  std::size_t count = 0;
  for (const NodeId id : merged.hierarchy.ids()) {
    if (merged.hierarchy.node(id).label() == labels::object) ++count;
  }
  return count;
}

TEST(HierarchyMerge, NeighboursThatTouchStayApartAndTheSameObjectIsOne) {
  for (std::uint64_t seed = 1; seed <= 2; ++seed) {
    test::Rng rng(seed);
    const test::Solids table = test::randomTable(rng, 0);
    test::Solids left = table;
    test::Solids right = table;
    const double x = 0.02 * static_cast<double>(seed);
    left.push_back(test::onTable({0.1, 0.08, 0.12}, false, x, 0.0, 0.0));
    right.push_back(test::onTable({0.1, 0.08, 0.1}, false, x + 0.1, 0.0, 0.0));
    EXPECT_EQ(objectsOf(left, right), 2U) << seed;
    EXPECT_EQ(objectsOf(left, left), 1U) << seed;
    test::Solids both = left;
    both.push_back(right.back());
    EXPECT_EQ(objectsOf(both, right), 2U) << seed;
    EXPECT_EQ(objectsOf(both, both), 2U) << seed;
  }
}

/// The objects of a map, held back after so many scans that showed them.
MapHierarchy heldBack(MapHierarchy map, std::uint64_t shown) {
  for (const NodeId id : map.ids()) {
    MapNode& node = map.node(id);
    if (node.label() != labels::object) continue;
    node.confirmation.waits = true;
    node.confirmation.shown = shown;
  }
  return map;
}

/// As the end of a log leaves what was held back and enough speaks for.
MapHierarchy letIn(MapHierarchy map) {
  for (const NodeId id : map.ids()) {
    Confirmation& confirmation = map.node(id).confirmation;
    if (confirmation.waits) confirmation = confirmation.letInAtEnd();
  }
  return map;
}

TEST(HierarchyMerge, NodesThatWaitAreConfirmedByAnotherPart) {
  test::Rng rng(5);
  test::Solids with = test::randomTable(rng, 0);
  const test::Solids without = with;
  with.push_back(test::onTable({0.1, 0.08, 0.12}, false, 0.0, 0.0, 0.0));
  const auto mapped = [](const test::Solids& scene, double turn) {
    return test::mapOf(scene, test::viewsAround(2, turn));
  };
  struct Case {
    MapHierarchy first;
    MapHierarchy second;
    bool enters;
  };
  std::vector<Case> cases;
  cases.push_back({heldBack(mapped(with, 0.0), 1), mapped(with, 60.0), true});
  cases.push_back({mapped(with, 0.0), heldBack(mapped(with, 60.0), 1), true});
  cases.push_back({heldBack(mapped(with, 0.0), 1), heldBack(mapped(with, 60.0), 1), true});
  cases.push_back({letIn(heldBack(mapped(with, 0.0), 1)), mapped(without, 60.0), true});
  cases.push_back({heldBack(mapped(with, 0.0), 1), heldBack(mapped(with, 60.0), 0), false});
  cases.push_back({heldBack(mapped(with, 0.0), 1), mapped(without, 60.0), false});
  cases.push_back({mapped(without, 0.0), heldBack(mapped(with, 60.0), 1), false});
  for (std::size_t i = 0; i < cases.size(); ++i) {
    const Case& c = cases[i];
    const std::vector<MergePart> parts{{c.first, {}, 2, 1.0, "a"}, {c.second, {}, 2, 2.0, "b"}};
    const LabelProfiles profiles{{labels::background, {}}, {labels::table, {}}, {labels::object, {}}};
    const MergedMaps merged = mergeMaps(parts, profiles);
    std::size_t objects = 0;
    merged.hierarchy.forEachNode([&](const MapNode& node) {
      if (node.label() != labels::object) return;
      ++objects;
      EXPECT_EQ(node.confirmation.waits, !c.enters) << i;
      if (!c.enters) return;
      EXPECT_EQ(node.confirmation, Confirmation{}) << i;
    });
    EXPECT_EQ(objects, 1U) << i;  // a node that nobody confirms goes on waiting
    std::size_t created = 0;
    for (const UpdateReport& report : merged.reports) {
      for (const NodeEvent& event : report.events)
        created += event.label == labels::object && event.kind == NodeEventKind::created;
    }
    EXPECT_EQ(created, c.enters ? 1U : 0U) << i;
    EXPECT_TRUE(merged.removed.empty()) << i;
  }
}

}  // namespace
}  // namespace hoctomap
