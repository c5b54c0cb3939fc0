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

}  // namespace
}  // namespace hoctomap
