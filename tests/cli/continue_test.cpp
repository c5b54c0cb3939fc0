// SPDX-License-Identifier: BSD-3-Clause
// `build --continue`: what it takes up, what it refuses, and that nobody can tell afterwards.
#include <gtest/gtest.h>

#include "TableLogs.h"
#include "hoctomap/geometry/Pose.h"
#include "hoctomap/io/PipeLogWriter.h"

namespace hoctomap {
namespace {

using test::TemporaryFolder;

const std::string kEventsHead = "scan,time,node,x,y,z,yaw,pitch,roll\n";

/// Two logs of one table, one after the other.
class Continue : public ::testing::Test {
 protected:
  Continue() {
    test::simulate("demo", a);
    test::simulate("demo", b, {"simulation.seed=99"});
  }
  /// A run over both logs that nothing interrupts.
  std::map<std::string, std::string> whole(const std::vector<std::string>& more = {}) {
    std::vector<std::string> arguments{"-i", b};
    arguments.insert(arguments.end(), more.begin(), more.end());
    test::build(a, folder / "whole", arguments);
    return test::reproducibleFiles(folder / "whole");
  }
  void expectRefused(const std::vector<std::string>& more, const std::string& why) {
    std::vector<std::string> arguments{"--continue"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const auto before = test::readTree(map);
    const auto refused = test::build(a, map, arguments, 3);
    EXPECT_NE(refused.err.find(why), std::string::npos) << refused.err;
    EXPECT_EQ(test::readTree(map), before) << "a refused run changes nothing";
  }

  TemporaryFolder folder;
  const std::string a = folder / "a.rawlog";
  const std::string b = folder / "b.rawlog";
  const std::string map = folder / "map";
};

TEST_F(Continue, FurtherLogsExtendAFinishedMap) {
  test::build(a, map);
  test::build(a, map, {"-i", b, "--continue"});
  EXPECT_EQ(test::reproducibleFiles(map), whole());
  EXPECT_EQ(readManifest(map).scans, 12U);
}

TEST_F(Continue, OtherLogsAreRefused) {
  test::build(a, map, {"-i", b, "--max-scans", "2"});
  expectRefused({}, "more logs");
  expectRefused({"-i", a}, "log number 2");
  test::build(b, map, {"-i", a, "--continue"}, 3);
}

TEST_F(Continue, AnotherWayToReadThemIsRefused) {
  test::build(a, map, {"--max-scans", "2"});
  for (const auto& [option, value] : std::map<std::string, std::string>{
           {"--every", "2"}, {"--start", "1"}, {"--up", "0,1,0"}, {"--poses", "identity"}}) {
    expectRefused({option, value}, "another way");
  }
}

TEST_F(Continue, SnapshotsAreThoseOfAnUninterruptedRun) {
  test::build(a, map, {"-i", b, "--max-scans", "4", "--snapshot-every", "3"});
  test::build(a, map, {"-i", b, "--max-scans", "5", "--snapshot-every", "3", "--continue"});
  test::build(a, map, {"-i", b, "--snapshot-every", "3", "--continue"});
  EXPECT_EQ(test::reproducibleFiles(map), whole({"--snapshot-every", "3"}));
  EXPECT_TRUE(std::filesystem::exists(map + "/hierarchy-000002.yaml"));
}

TEST_F(Continue, MovementsToldByTimeAreAppliedOnce) {
  // The stamps of a scan are 0.5 s apart; those of both logs begin at 1300000000.
  const std::string events = folder / "events.csv";
  test::writeFile(events, kEventsHead + ",1300000001.2,1,0.1,0,0,0,0,0\n9,,1,0,0.1,0,0,0,0\n");
  const std::vector<std::string> more{"-i", b, "--events", events};
  for (const char* scans : {"2", "3", "4", "9"}) {
    auto arguments = more;
    arguments.insert(arguments.end(), {"--continue", "--max-scans", scans});
    test::build(a, map, arguments);
  }
  test::build(a, map, {"-i", b, "--events", events, "--continue"});
  EXPECT_EQ(test::reproducibleFiles(map), whole({"--events", events}));
  const std::string ledger = test::readFile(map + "/events.csv");
  EXPECT_NE(ledger.find("3,1300000001.5,moved,1,table,"), std::string::npos) << ledger;
  EXPECT_NE(ledger.find("9,1300000001.5,moved,1,table,"), std::string::npos) << ledger;
}

TEST_F(Continue, WhatWasToldOfThePastCannotBeChanged) {
  const std::string events = folder / "events.csv";
  test::writeFile(events, kEventsHead + "2,,1,0.1,0,0,0,0,0\n");
  test::build(a, map, {"--events", events, "--max-scans", "4"});
  expectRefused({}, "missing now");
  test::writeFile(events, kEventsHead + "2,,1,0.2,0,0,0,0,0\n");
  expectRefused({"--events", events}, "cannot be changed");
  // Of what is still to come more may be told.
  test::writeFile(events, kEventsHead + "2,,1,0.1,0,0,0,0,0\n5,,1,0.1,0,0,0,0,0\n");
  test::build(a, map, {"--events", events, "--continue"});
  EXPECT_NE(test::readFile(map + "/events.csv").find("5,1300000002.5,moved,1,"), std::string::npos);
}

TEST_F(Continue, MovementsOfTheLogAreAppliedOnce) {
  // The first log ends with a movement, behind its last scan.
  const std::string moving = folder / "moving.rawlog";
  test::copyLog(a, moving, ObjectMotion{1300000002.6, NodeId{1}, Pose(0.1, 0.0, 0.0, 0.0, 0.0, 0.0)});
  test::build(moving, map);
  test::build(moving, map, {"--continue"});
  test::build(moving, map, {"-i", b, "--continue"});
  test::build(moving, folder / "whole", {"-i", b});
  EXPECT_EQ(test::reproducibleFiles(map), test::reproducibleFiles(folder / "whole"));
  const std::string events = test::readFile(map + "/events.csv");
  const auto first = events.find(",moved,1,");
  ASSERT_NE(first, std::string::npos) << events;
  EXPECT_EQ(events.find(",moved,1,", first + 1), std::string::npos) << events;
}

}  // namespace
}  // namespace hoctomap
