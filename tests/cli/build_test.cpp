// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "TableLogs.h"

namespace hoctomap {
namespace {

using test::TemporaryFolder;

TEST(Build, EveryObjectOfASimulatedTableIsOneNode) {
  const TemporaryFolder folder;
  test::simulate("demo", folder / "a.rawlog");
  const auto outcome = test::build(folder / "a.rawlog", folder / "map");
  test::expectTruth(folder / "map", folder / "a.truth", 0.01);
  EXPECT_EQ(test::nodesOf(folder / "map", "table").size(), 1U);
  EXPECT_NE(outcome.out.find("6 used, 0 skipped"), std::string::npos) << outcome.out;
}

TEST(Build, TheOrderOfViewsDoesNotMatter) {
  const TemporaryFolder folder;
  test::simulate("demo", folder / "a.rawlog");
  test::reverseLog(folder / "a.rawlog", folder / "b.rawlog");
  test::build(folder / "b.rawlog", folder / "map");
  test::expectTruth(folder / "map", folder / "a.truth", 0.01);
}

TEST(Build, TwoTablesHaveTheirOwnObjects) {
  const TemporaryFolder folder;
  test::simulate("room", folder / "a.rawlog");
  test::build(folder / "a.rawlog", folder / "map");
  EXPECT_EQ(test::nodesOf(folder / "map", "table").size(), 2U);
  test::expectTruth(folder / "map", folder / "a.truth", 0.01);
}

TEST(Build, TheTwoSetsOfThePaperAreOneNodeAnObject) {  // VI-A
  for (const char* set : {"small_objects", "big_objects"}) {
    const TemporaryFolder folder;
    test::simulate(set, folder / "a.rawlog");
    test::build(folder / "a.rawlog", folder / "map");
    EXPECT_EQ(test::nodesOf(folder / "map", "table").size(), 1U) << set;
    test::expectTruth(folder / "map", folder / "a.truth", 0.01);
  }
}

TEST(Build, WhatVanishedBehindAnOccluderIsRemoved) {  // VI-B
  const TemporaryFolder folder;
  test::simulate("occlusion", folder / "a.rawlog");
  test::build(folder / "a.rawlog", folder / "map");
  test::expectTruth(folder / "map", folder / "a.truth", 0.01);
  const Manifest manifest = readManifest(folder / "map");
  ASSERT_EQ(manifest.removed.size(), 1U);
  EXPECT_EQ(manifest.removed[0].label, labels::object);
  EXPECT_LT(manifest.removed[0].existence, 0.5);
}

TEST(Build, SameLogSameBytesForAnyNumberOfThreads) {
  const TemporaryFolder folder;
  test::simulate("demo", folder / "a.rawlog");
  test::build(folder / "a.rawlog", folder / "one", {"--threads", "1"});
  test::build(folder / "a.rawlog", folder / "two", {"--threads", "2"});
  const auto one = test::reproducibleFiles(folder / "one");
  EXPECT_EQ(one, test::reproducibleFiles(folder / "two"));
  for (const char* file :
       {"hierarchy.yaml", "hierarchy.3Dscene", "events.csv", "existence.csv", "config.ini"}) {
    EXPECT_TRUE(one.contains(file)) << file;
  }
}

TEST(Build, TheConfigurationInTheOutputReproducesTheRun) {
  const TemporaryFolder folder;
  test::simulate("demo", folder / "a.rawlog");
  test::build(folder / "a.rawlog", folder / "one", {"--set", "label.object.resolution=0.004"});
  test::build(folder / "a.rawlog", folder / "two", {"-c", folder / "one/config.ini"});
  EXPECT_EQ(test::reproducibleFiles(folder / "one"), test::reproducibleFiles(folder / "two"));
}

TEST(Build, AContinuedRunEndsWithTheBytesOfAnUninterruptedOne) {
  const TemporaryFolder folder;
  test::simulate("demo", folder / "a.rawlog");
  test::build(folder / "a.rawlog", folder / "whole");
  test::build(folder / "a.rawlog", folder / "parts", {"--max-scans", "2"});
  test::build(folder / "a.rawlog", folder / "parts", {"--continue"});
  EXPECT_EQ(test::reproducibleFiles(folder / "parts"), test::reproducibleFiles(folder / "whole"));
  // After one scan no object is confirmed: the end of the log lets them in, and going on takes that back.
  test::build(folder / "a.rawlog", folder / "one", {"--max-scans", "1"});
  EXPECT_FALSE(test::nodesOf(folder / "one", "object").empty());
  test::build(folder / "a.rawlog", folder / "one", {"--continue"});
  EXPECT_EQ(test::reproducibleFiles(folder / "one"), test::reproducibleFiles(folder / "whole"));
  test::build(folder / "a.rawlog", folder / "one", {"--continue"});
  EXPECT_EQ(test::reproducibleFiles(folder / "one"), test::reproducibleFiles(folder / "whole"))
      << "nothing new";
  // Another configuration contradicts the map; another log is not the one it was built from.
  test::build(folder / "a.rawlog", folder / "parts", {"--continue", "--set", "label.object.resolution=0.004"},
              2);
  test::simulate("demo", folder / "b.rawlog", {"simulation.seed=99"});
  test::build(folder / "b.rawlog", folder / "parts", {"--continue"}, 3);
}

TEST(Build, SnapshotsShowTheMapAtAnEarlierScan) {
  const TemporaryFolder folder;
  test::simulate("occlusion", folder / "a.rawlog");
  test::build(folder / "a.rawlog", folder / "map", {"--snapshot-every", "4"});
  EXPECT_EQ(readManifest(folder / "map", 3).nodes.size(), 3U) << "background, table, the first object";
  EXPECT_EQ(readManifest(folder / "map", 7).removed.size(), 0U);
  const auto outcome = test::hoctomap({"info", folder / "map", "--at-scan", "3"});
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_NE(outcome.out.find("after 4 scans"), std::string::npos) << outcome.out;
}

TEST(Build, ANonEmptyDirectoryNeedsOverwrite) {
  const TemporaryFolder folder;
  test::simulate("demo", folder / "a.rawlog");
  test::build(folder / "a.rawlog", folder / "map", {"--max-scans", "1"});
  test::build(folder / "a.rawlog", folder / "map", {}, 2);
  test::build(folder / "a.rawlog", folder / "map", {"--overwrite"});
  EXPECT_EQ(readManifest(folder / "map").scans, 6U);
}

TEST(Build, MonolithicIsOneNode) {
  const TemporaryFolder folder;
  test::simulate("demo", folder / "a.rawlog");
  test::build(folder / "a.rawlog", folder / "map", {"--monolithic"});
  const Manifest manifest = readManifest(folder / "map");
  EXPECT_EQ(manifest.nodes.size(), 1U);
  EXPECT_GT(manifest.nodes[0].voxels.occupied, 100U);
  // The INI says the same as the flag.
  test::build(folder / "a.rawlog", folder / "again", {"-c", folder / "map/config.ini"});
  EXPECT_EQ(test::reproducibleFiles(folder / "map"), test::reproducibleFiles(folder / "again"));
}

TEST(Build, ScansAreChosenByNumber) {
  const TemporaryFolder folder;
  test::simulate("demo", folder / "a.rawlog");
  test::build(folder / "a.rawlog", folder / "map", {"--start", "1", "--every", "2", "--max-scans", "2"});
  const auto rows = test::parseCsv(test::readFile(folder / "map/timing.csv"));
  ASSERT_EQ(rows.size(), 2U);
  EXPECT_EQ(rows[0].at("scan"), "1");
  EXPECT_EQ(rows[1].at("scan"), "3");
}

TEST(Build, AMovementToldMovesTheTableWithItsObjects) {  // III-D
  const TemporaryFolder folder;
  test::simulate("demo", folder / "a.rawlog");
  test::build(folder / "a.rawlog", folder / "still");
  const auto before = readManifest(folder / "still");
  test::writeFile(folder / "events.csv", "scan,node,x,y,z,yaw,pitch,roll\n5,1,0.5,0,0,0,0,0\n");
  test::build(folder / "a.rawlog", folder / "moved",
              {"--events", folder / "events.csv", "--set", "label.object.existence=false", "--set",
               "label.table.existence=false"});
  const auto events = test::readFile(folder / "moved/events.csv");
  EXPECT_NE(events.find(",moved,1,table,"), std::string::npos) << events;
  const auto after = readManifest(folder / "moved");
  for (const NodeRecord& node : before.nodes) {
    if (node.id == kRootId) continue;
    const NodeRecord* moved = after.find(node.id);
    ASSERT_NE(moved, nullptr);
    EXPECT_NEAR(
        (toIsometry(moved->world_T_node).translation() - toIsometry(node.world_T_node).translation()).norm(),
        0.5, 1e-6);
  }
}

}  // namespace
}  // namespace hoctomap
