// SPDX-License-Identifier: BSD-3-Clause
#include "hoctomap/hierarchy/Relation.h"

#include <gtest/gtest.h>

#include "hoctomap/hierarchy/MapHierarchy.h"

namespace hoctomap {
namespace {

NodeMap anyMap() {
  return NodeMap(0.05, {});
}

/// A relation that holds from nodes labelled `above` to nodes labelled `below`.
std::unique_ptr<Relation> between(const std::string& above, const std::string& below) {
  return makeRelation(above + " over " + below, [above, below](const NodeView& a, const NodeView& b) {
    return a.label.name == above && b.label.name == below;
  });
}

NodeView nodeLabelled(const std::string& label) {
  return {Label{label}, {}, nullptr};
}

/// background > room > table, and a second table under the background.
struct House {
  MapHierarchy h{labels::background, anyMap()};
  NodeId room = h.add(Label{"room"}, anyMap(), Pose(), kRootId);
  NodeId table = h.add(labels::table, anyMap(), Pose(), room);
  NodeId other_table = h.add(labels::table, anyMap(), Pose(), kRootId);
};

TEST(RelationSet, CandidatesAreTheRelatedNodes) {  // Eq. (6)
  House house;
  RelationSet r;
  r.add(between("background", "object"));
  r.add(between("table", "object"));
  EXPECT_EQ(r.candidateAncestors(house.h, nodeLabelled("object")),
            (std::vector<NodeId>{kRootId, house.table, house.other_table}));
  EXPECT_TRUE(r.candidateAncestors(house.h, nodeLabelled("lamp")).empty());
}

TEST(RelationSet, TheDeepestCandidateIsTheParent) {  // Eq. (7)
  House house;
  RelationSet r;
  r.add(between("background", "object"));
  r.add(between("table", "object"));
  EXPECT_EQ(r.deepestAncestor(house.h, nodeLabelled("object")), house.table) << "deeper than the other table";
  EXPECT_EQ(r.deepestAncestor(house.h, nodeLabelled("lamp")), kRootId) << "unrelated: the root";
}

TEST(RelationSet, TiesGoToTheTieBreakThenToTheLowestId) {
  House house;
  const NodeId third = house.h.add(labels::table, anyMap(), Pose(), kRootId);
  house.h.reparent(house.table, kRootId);
  RelationSet r;
  r.add(between("table", "object"));
  EXPECT_EQ(r.deepestAncestor(house.h, nodeLabelled("object")), house.table) << "the lowest id";
  const NodeMap* wanted = &house.h.node(third).map();
  r.setTieBreak([wanted](const NodeView& a, const NodeView& b, const NodeView&) {
    return a.map == wanted ? -1 : b.map == wanted ? 1 : 0;
  });
  EXPECT_EQ(r.deepestAncestor(house.h, nodeLabelled("object")), third);
}

TEST(RelationSet, SeveralRelationsMustExcludeEachOther) {
  House house;
  RelationSet r;
  r.add(between("table", "object"));
  r.add(makeRelation("contains", [](const NodeView& a, const NodeView&) { return a.label.name == "room"; }));
  EXPECT_EQ(r.deepestAncestor(house.h, nodeLabelled("object")), house.table);
  r.add(makeRelation("near", [](const NodeView& a, const NodeView& b) {
    return a.label == labels::table && b.label == labels::object;
  }));
  try {
    static_cast<void>(r.deepestAncestor(house.h, nodeLabelled("object")));
    FAIL() << "the conflict was not noticed";
  } catch (const RelationConflict& e) {
    const std::string what = e.what();
    EXPECT_NE(what.find("'table over object'"), std::string::npos) << what;
    EXPECT_NE(what.find("'near'"), std::string::npos) << what;
  }
}

TEST(RelationSet, ANodeNeverHangsBelowItself) {
  House house;
  RelationSet r;
  r.add(makeRelation("any", [](const NodeView&, const NodeView&) { return true; }));
  const NodeId moved = house.room;
  EXPECT_EQ(r.deepestAncestor(house.h, house.h.view(moved), &moved), house.other_table);
}

TEST(RelationSet, ARelationOfLabelsHoldsWhereverTheNodesAre) {
  RelationSet relations;
  relations.add(makeLabelRelation("supports", [](const Label& above, const Label& below) {
    return above == labels::table && below == labels::object;
  }));
  EXPECT_TRUE(relations.mayHold(labels::table, labels::object));
  EXPECT_FALSE(relations.mayHold(labels::object, labels::table));
  EXPECT_TRUE(relations.holds({labels::table, {}, nullptr}, {labels::object, {}, nullptr}));
  EXPECT_FALSE(relations.holds({labels::object, {}, nullptr}, {labels::table, {}, nullptr}));
}

TEST(RelationSet, ANewNodeAdoptsWhatItIsTheBetterParentOf) {
  RelationSet relations;
  relations.add(makeLabelRelation("supports", [](const Label& above, const Label& below) {
    return below != labels::background && above != labels::object && above != below;
  }));
  MapHierarchy h(labels::background, NodeMap(0.05, {}));
  const NodeId object = h.add(labels::object, NodeMap(0.05, {}), Pose(), kRootId);
  const NodeId table = h.add(labels::table, NodeMap(0.05, {}), Pose(), kRootId);
  EXPECT_TRUE(relations.adopts(h, table, object)) << "it is deeper than the root";
  EXPECT_FALSE(relations.adopts(h, object, table)) << "they are not related";
  EXPECT_FALSE(relations.adopts(h, table, kRootId));
  h.reparent(object, table);
  EXPECT_FALSE(relations.adopts(h, table, object)) << "it is the parent already";
  const NodeId other = h.add(labels::table, NodeMap(0.05, {}), Pose(), kRootId);
  EXPECT_FALSE(relations.adopts(h, other, object)) << "of equals the first stays";
  relations.setTieBreak([](const NodeView&, const NodeView&, const NodeView&) { return -1; });
  EXPECT_TRUE(relations.adopts(h, other, object)) << "the tie-break prefers it";
}

}  // namespace
}  // namespace hoctomap
