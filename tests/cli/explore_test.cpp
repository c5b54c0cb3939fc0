// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <mrpt/containers/yaml.h>
#include <mrpt/maps/COccupancyGridMap2D.h>

#include <algorithm>

#include "TableLogs.h"
#include "hoctomap/config/Settings.h"

namespace hoctomap {
namespace {

using test::TemporaryFolder;
using Rows = std::vector<std::map<std::string, std::string>>;

/// A table of Fig. 7a, seen by a camera of 320 x 240.
test::Outcome explore(const std::string& map, const std::vector<std::string>& more = {},
                      const std::string& scene = "explore_table") {
  std::vector<std::string> arguments{"explore", "-q",
                                     "-c",      test::scene(scene),
                                     "-o",      map,
                                     "--set",   "camera.width=320",
                                     "--set",   "camera.height=240",
                                     "--set",   "camera.fx=270"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return test::hoctomap(arguments);
}

Rows table(const std::string& map) {
  return test::parseCsv(test::readFile(std::filesystem::path(map) / "exploration.csv"));
}

double number(const std::map<std::string, std::string>& row, const std::string& key) {
  return std::stod(row.at(key));
}

/// One exploration that several tests look at.
class Explore : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = std::make_unique<TemporaryFolder>();
    outcome_ = explore(map());
  }
  static void TearDownTestSuite() { folder_.reset(); }
  static std::string map() { return *folder_ / "map"; }

  inline static std::unique_ptr<TemporaryFolder> folder_;
  inline static test::Outcome outcome_;
};

TEST_F(Explore, EndsByItselfWithTheSurfaceOfTheObjects) {  // VI-C
  ASSERT_EQ(outcome_.exit_code, 0) << outcome_.err;
  EXPECT_NE(outcome_.out.find("table 1    explored"), std::string::npos) << outcome_.out;
  const Rows rows = table(map());
  EXPECT_EQ(rows.back().at("kind"), "explored");
  EXPECT_GT(number(rows.back(), "coverage"), 0.93);
  EXPECT_EQ(test::nodesOf(map(), "table").size(), 1U);
  EXPECT_GE(test::nodesOf(map(), "object").size(), 8U);
  for (const auto& node : test::nodesOf(map(), "object")) EXPECT_DOUBLE_EQ(node.record.resolution, 0.005);
}

TEST_F(Explore, WritesARowAStep) {
  const Rows rows = table(map());
  double travel = 0.0;
  std::uint64_t scans = 0;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const auto& row = rows[i];
    EXPECT_EQ(row.at("step"), std::to_string(i));
    travel += number(row, "travel_m");
    EXPECT_NEAR(number(row, "total_travel_m"), travel, 1e-5);
    if (row.at("scan").empty()) continue;
    EXPECT_EQ(row.at("scan"), std::to_string(scans++));
    EXPECT_NEAR(number(row, "total_s"), 3.0 * static_cast<double>(scans) + travel / 0.5, 1e-4);
    if (row.at("kind") == "look_around") continue;
    EXPECT_EQ(row.at("candidates"), std::to_string(Settings{}.exploration.viewpoints.candidates));
    EXPECT_NEAR(number(row, "utility"), number(row, "gain") / number(row, "cost_s"), 1e-3);
    EXPECT_DOUBLE_EQ(number(row, "sensor_height"), 1.2);
  }
  EXPECT_GT(scans, static_cast<std::uint64_t>(Settings{}.exploration.first_look));
  EXPECT_EQ(readManifest(map()).scans, scans);
  // What is held of each object at the end, and of all.
  double visible = 0.0;
  double covered = 0.0;
  for (const auto& row : test::parseCsv(test::readFile(map() + "/coverage.csv"))) {
    visible += number(row, "visible");
    covered += number(row, "covered");
  }
  EXPECT_NEAR(covered / visible, number(rows.back(), "coverage"), 0.01);
}

TEST_F(Explore, BuildOfItsLogGivesTheSameMap) {
  const TemporaryFolder folder;
  test::build(map() + "/exploration.rawlog", folder / "built", {"-c", map() + "/config.ini"});
  const auto explored = test::reproducibleFiles(map());
  const auto built = test::reproducibleFiles(folder / "built");
  EXPECT_EQ(explored.at("hierarchy.yaml"), built.at("hierarchy.yaml"));
  EXPECT_GT(built.size(), 10U);
  for (const auto& [name, bytes] : built) {
    ASSERT_TRUE(explored.contains(name)) << name;
    EXPECT_TRUE(explored.at(name) == bytes) << name;
  }
}

TEST_F(Explore, MrptReadsTheTraversabilityMaps) {
  const Rows rows = table(map());
  std::size_t maps = 0;
  for (const auto& row : rows) {
    if (row.at("kind") == "look_around") continue;
    ++maps;
    const std::string name = std::string(6 - row.at("step").size(), '0') + row.at("step");
    const auto yaml = mrpt::containers::yaml::FromFile(map() + "/traversability/" + name + ".yaml");
    const auto origin = yaml["origin"].asSequence();
    mrpt::maps::COccupancyGridMap2D grid;
    ASSERT_TRUE(grid.loadFromBitmapFile(map() + "/traversability/" + yaml["image"].as<std::string>(),
                                        yaml["resolution"].as<float>(),
                                        {-origin[0].as<double>() / yaml["resolution"].as<double>(),
                                         -origin[1].as<double>() / yaml["resolution"].as<double>()}));
    EXPECT_NEAR(grid.getXMin(), origin[0].as<float>(), 0.03F);
    EXPECT_NEAR(grid.getYMin(), origin[1].as<float>(), 0.03F);
    EXPECT_LT(grid.getPos(0.0F, 0.0F), 0.1F);           // the table
    EXPECT_LT(grid.getPos(2.82F, 0.5F), 0.1F);          // a wall
    EXPECT_NEAR(grid.getPos(3.2F, 0.0F), 0.5F, 0.05F);  // behind it
    EXPECT_GT(grid.getPos(-1.9F, -0.4F), 0.9F);         // where the robot started
    if (row.at("x").empty()) continue;                  // where it went
    EXPECT_GT(grid.getPos(static_cast<float>(number(row, "x")), static_cast<float>(number(row, "y"))), 0.9F);
  }
  EXPECT_GE(maps, 3U);
}

TEST_F(Explore, DrawsWhatItDid) {
  for (const char* picture : {"exploration.png", "model.png"})
    EXPECT_EQ(test::readFile(map() + "/" + picture).substr(1, 3), "PNG") << picture;
}

TEST_F(Explore, SameSeedSameBytesForAnyNumberOfThreads) {
  const TemporaryFolder folder;
  ASSERT_EQ(explore(folder / "again", {"--threads", "1"}).exit_code, 0);
  EXPECT_TRUE(test::reproducibleFiles(map()) == test::reproducibleFiles(folder / "again"));
  ASSERT_EQ(explore(folder / "other", {"--seed", "5", "--set", "exploration.max_views=1"}).exit_code, 0);
  EXPECT_NE(test::readFile(map() + "/exploration.csv"),
            test::readFile(folder / "other" + "/exploration.csv"));
}

TEST(ExploreInDifficulties, SurvivesWrongPosesAndDrivesThatFail) {
  const TemporaryFolder folder;
  const auto outcome = explore(folder / "map", {"--set", "robot.position_error=0.01", "--set",
                                                "robot.heading_error=1", "--set", "robot.move_failure=0.3"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const Rows rows = table(folder / "map");
  const auto kinds = [&](const std::string& kind) {
    return std::count_if(rows.begin(), rows.end(), [&](const auto& row) { return row.at("kind") == kind; });
  };
  EXPECT_GT(kinds("move_failed"), 0);
  EXPECT_GE(kinds("view"), 2);
  EXPECT_EQ(rows.back().at("kind"), "explored");
  EXPECT_GE(test::nodesOf(folder / "map", "object").size(), 6U);
  // A degree is 26 mm at the distance of a table: much of the surface is there, but not within a voxel.
  EXPECT_GT(number(rows.back(), "coverage"), 0.6);
}

TEST(ExploreInDifficulties, OfATableThatItSeesFromOneSideItMapsThatSide) {
  const TemporaryFolder folder;
  const auto outcome =
      explore(folder / "map", {"--set", "solid.barrier.label=background", "--set",
                               "solid.barrier.size=0.1 4.6 0.5", "--set", "solid.barrier.position=-1.1 0 0"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const Rows rows = table(folder / "map");
  for (const auto& row : rows) {
    if (!row.at("x").empty()) {
      EXPECT_LT(number(row, "x"), -1.1);
    }
  }
  EXPECT_GT(number(rows.back(), "coverage"), 0.85);
}

TEST(ExploreInDifficulties, WrongUseIsExit2) {
  const TemporaryFolder folder;
  test::writeFile(folder / "map" + "_taken", "");
  std::filesystem::create_directory(folder / "full");
  test::writeFile(folder / "full" + "/file", "");
  EXPECT_EQ(explore(folder / "map", {}, "demo").exit_code, 2);  // no robot
  EXPECT_EQ(explore(folder / "full").exit_code, 2);             // not empty
  EXPECT_EQ(explore(folder / "map", {"--set", "robot.radius=-1"}).exit_code, 2);
  EXPECT_EQ(explore(folder / "map", {"--set", "exploration.tau=2"}).exit_code, 2);
  EXPECT_EQ(explore(folder / "map", {"--set", "mapping.monolithic=true"}).exit_code, 2);
  EXPECT_FALSE(std::filesystem::exists(folder / "map"));
}

}  // namespace
}  // namespace hoctomap
