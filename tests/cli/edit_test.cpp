// SPDX-License-Identifier: BSD-3-Clause
// `hoctomap edit`: what each edit leaves in the map, that it is kept when the map is continued, and what is
// refused.
#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

#include "TableLogs.h"
#include "hoctomap/io/MapReader.h"
#include "hoctomap/io/MapTables.h"

namespace hoctomap {
namespace {

/// The first half of the demo's log, mapped: a table (1) and objects on it.
class Edit : public ::testing::Test {
 protected:
  Edit() {
    test::simulate("demo", log);
    test::build(log, map, {"--max-scans", "3"});
    object = test::nodesOf(map, "object").front().record.id.value;
  }
  test::Outcome edit(std::vector<std::string> arguments, int expected = 0) {
    arguments.insert(arguments.begin(), {"edit", map});
    auto outcome = test::hoctomap(arguments);
    EXPECT_EQ(outcome.exit_code, expected) << outcome.out << outcome.err;
    if (expected == 0) {
      const auto check = test::hoctomap({"verify", map});
      EXPECT_EQ(check.exit_code, 0) << check.out;
      EXPECT_EQ(check.out.find("foreign"), std::string::npos) << check.out;
      EXPECT_TRUE(readManifest(map).scene) << "the scene is renewed";
    }
    return outcome;
  }
  void goOn() { test::build(log, map, {"--continue"}); }
  EventRow lastEvent() { return readEvents(map, readManifest(map)).back(); }
  const NodeRecord& record(const Manifest& manifest, std::uint32_t id) {
    const NodeRecord* found = manifest.find(NodeId{id});
    if (found == nullptr) throw std::runtime_error("no node " + std::to_string(id));
    return *found;
  }

  test::TemporaryFolder folder;
  const std::string log = folder / "a.rawlog";
  const std::string map = folder / "map";
  std::uint32_t object = 0;
};

TEST_F(Edit, ARelabelledNodeKeepsItsLabel) {
  const auto before = readManifest(map);
  edit({"relabel", std::to_string(object), "table"});
  const auto after = readManifest(map);
  EXPECT_EQ(record(after, object).label.name, "table");
  EXPECT_EQ(record(after, object).ot, record(before, object).ot) << "the octree stays";
  EXPECT_EQ(after.edits, 1U);
  EXPECT_EQ(lastEvent().event, "updated");
  EXPECT_EQ(lastEvent().label.name, "table");
  goOn();
  EXPECT_EQ(record(readManifest(map), object).label.name, "table");
}

TEST_F(Edit, WhatStandsOnAMovedTableFollows) {
  const auto before = readManifest(map);
  edit({"move", "1", "--translate", "0.5,0,0", "--rotate", "90"});
  const auto after = readManifest(map);
  const Pose table = record(before, 1).world_T_node;
  // The table has turned in place.
  EXPECT_NEAR(record(after, 1).world_T_node.x(), table.x() + 0.5, 1e-9);
  EXPECT_NEAR(record(after, 1).world_T_node.y(), table.y(), 1e-9);
  ASSERT_EQ(record(before, object).parent, NodeId{1});
  EXPECT_LT((-record(after, 1).world_T_node + record(after, object).world_T_node -
             (-table + record(before, object).world_T_node))
                .norm(),
            1e-9);
  EXPECT_EQ(lastEvent().event, "moved");
  EXPECT_EQ(lastEvent().scan, 2U);
  // In the node's own frame the event is what a file of movements would tell.
  edit({"move", std::to_string(object), "--translate", "0,0,0.1", "--frame", "node"});
  EXPECT_EQ(lastEvent().detail, Pose(0.0, 0.0, 0.1, 0.0, 0.0, 0.0).asString());
  edit({"move", std::to_string(object), "--pose", "1,2,3,90,0,0"});
  const Pose at = record(readManifest(map), object).world_T_node;
  EXPECT_LT((at - Pose(1.0, 2.0, 3.0, std::numbers::pi / 2.0, 0.0, 0.0)).norm(), 1e-9);
  EXPECT_EQ(readManifest(map).edits, 3U);
}

TEST_F(Edit, ARemovedTableHandsItsObjectsOn) {
  const auto before = readManifest(map);
  edit({"remove", "1"});
  const auto after = readManifest(map);
  EXPECT_EQ(after.find(NodeId{1}), nullptr);
  ASSERT_EQ(after.removed.size(), before.removed.size() + 1);
  EXPECT_EQ(after.removed.back().id, NodeId{1});
  EXPECT_EQ(after.removed.back().removed_scan, 2U);
  EXPECT_EQ(record(after, object).parent, kRootId);
  EXPECT_LT((record(after, object).world_T_node - record(before, object).world_T_node).norm(), 1e-9);
  goOn();
  const auto later = readManifest(map);
  EXPECT_EQ(later.find(NodeId{1}), nullptr) << "the table is seen again, as a new node";
  EXPECT_EQ(later.removed.back().id, NodeId{1});
  const auto told = test::hoctomap({"explain", map, "1"});
  EXPECT_NE(told.out.find("by hand"), std::string::npos) << told.out;
}

TEST_F(Edit, MergedNodesAreOneAndStayOne) {
  const auto before = readManifest(map);
  const auto objects = test::nodesOf(map, "object");
  ASSERT_GE(objects.size(), 2U);
  const std::uint32_t whole = objects[0].record.id.value;
  const std::uint32_t piece = objects[1].record.id.value;
  edit({"merge", std::to_string(whole), std::to_string(piece)});
  const auto merged = readManifest(map);
  EXPECT_EQ(merged.find(NodeId{piece}), nullptr);
  EXPECT_GT(record(merged, whole).voxels.occupied, record(before, whole).voxels.occupied);
  EXPECT_NE(record(merged, whole).ot.path, record(before, whole).ot.path) << "files never change";
  EXPECT_EQ(lastEvent().event, "merged");
  EXPECT_EQ(lastEvent().node, NodeId{piece});
  goOn();
  const auto later = readManifest(map);
  EXPECT_EQ(later.find(NodeId{piece}), nullptr);
  EXPECT_NE(later.find(NodeId{whole}), nullptr);
  EXPECT_NE(record(later, whole).ot.path, record(merged, whole).ot.path);
  EXPECT_EQ(test::hoctomap({"verify", map}).exit_code, 0);
}

TEST_F(Edit, ManyEditsAndAContinuedRunLeaveOneLedger) {
  const auto events_before = readEvents(map, readManifest(map));
  edit({"move", "1", "--translate", "0,0,0.001"});
  edit({"relabel", std::to_string(object), "table"});
  edit({"relabel", std::to_string(object), "object"});
  goOn();
  const auto events = readEvents(map, readManifest(map));
  ASSERT_GT(events.size(), events_before.size() + 3);
  EXPECT_EQ(events[events_before.size()].event, "moved");
  EXPECT_TRUE(std::is_sorted(events.begin(), events.end(),
                             [](const EventRow& a, const EventRow& b) { return a.scan < b.scan; }));
  EXPECT_EQ(readManifest(map).scans, 6U);
  EXPECT_EQ(readManifest(map).edits, 3U);
}

TEST_F(Edit, AnEditIsTheSameForEveryCopyOfAMap) {
  std::filesystem::copy(map, folder / "copy", std::filesystem::copy_options::recursive);
  edit({"move", "1", "--translate", "0.1,0,0"});
  EXPECT_EQ(test::hoctomap({"edit", folder / "copy", "move", "1", "--translate", "0.1,0,0"}).exit_code, 0);
  EXPECT_EQ(test::reproducibleFiles(map), test::reproducibleFiles(folder / "copy"));
}

TEST_F(Edit, WhatCannotBeIsRefusedWithOneLineAndChangesNothing) {
  const auto before = test::readTree(map);
  const std::string id = std::to_string(object);
  for (const auto& arguments : std::vector<std::vector<std::string>>{{"remove", "0"},
                                                                     {"remove", "77"},
                                                                     {"remove", "x"},
                                                                     {"relabel", id, "no_such_label"},
                                                                     {"relabel", id, "background"},
                                                                     {"relabel", id, "object"},
                                                                     {"relabel", "0", "table"},
                                                                     {"move", id},
                                                                     {"move", "0", "--translate", "1,0,0"},
                                                                     {"move", "77", "--translate", "1,0,0"},
                                                                     {"move", id, "--translate", "1,0"},
                                                                     {"move", id, "--translate", "1,0,nan"},
                                                                     {"move", id, "--pose", "1,0,0"},
                                                                     {"merge", id, id},
                                                                     {"merge", id, "0"},
                                                                     {"merge", id, "1"},
                                                                     {"merge", id, "77"},
                                                                     {"paint", id},
                                                                     {}}) {
    const auto outcome = edit(arguments, 2);
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
  }
  EXPECT_EQ(test::readTree(map), before);
  EXPECT_EQ(test::hoctomap({"edit", folder / "nothing", "remove", "1"}).exit_code, 4);
  EXPECT_FALSE(std::filesystem::exists(folder / "nothing"));
  test::writeFile(map + "/config.ini", "[mapping]\n");
  edit({"remove", "1"}, 4);
}

}  // namespace
}  // namespace hoctomap
