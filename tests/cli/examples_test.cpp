// SPDX-License-Identifier: BSD-3-Clause
// The programs of apps/examples say something true.
#include <gtest/gtest.h>

#include <algorithm>
#include <regex>

#include "TableLogs.h"

namespace hoctomap {
namespace {

/// What an example prints; fails the test unless it ends well.
std::string outputOf(const std::string& name, const std::vector<std::string>& arguments = {}) {
  const auto outcome = test::runProgram(std::string(HOCTOMAP_EXAMPLES "/example_") + name, arguments);
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  return outcome.out;
}

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

TEST(Example, ACloudBecomesATableWithAParcel) {
  const std::string out = outputOf("01_map_a_cloud");
  EXPECT_TRUE(contains(out, "table 1 created: ")) << out;
  EXPECT_TRUE(std::regex_search(out, std::regex("object 2 created: [0-9]+ points of scan 0, parent 1\n")))
      << out;
  EXPECT_FALSE(contains(out, "object 3")) << out;
}

TEST(Example, TheTreeIsThatOfTheManifest) {
  const test::TemporaryFolder folder;
  test::simulate("demo", folder / "a.rawlog");
  test::build(folder / "a.rawlog", folder / "map");
  const std::string out = outputOf("02_walk_the_tree", {folder / "map"});
  const Manifest manifest = readManifest(folder / "map");
  EXPECT_EQ(static_cast<std::size_t>(std::count(out.begin(), out.end(), '\n')), manifest.nodes.size());
  for (const NodeRecord& node : manifest.nodes) {
    EXPECT_TRUE(contains(out, std::to_string(node.id.value) + " " + node.label.name + ", ")) << out;
  }
  EXPECT_TRUE(contains(out, "\n  1 table, 0.01 m, existence 0.97, ")) << out;
  EXPECT_NE(test::runProgram(HOCTOMAP_EXAMPLES "/example_02_walk_the_tree", {folder / "none"}).exit_code, 0);
}

TEST(Example, RaysFromAboveEndOnTheObjectsOrBeforeTheirTable) {
  const test::TemporaryFolder folder;
  test::simulate("demo", folder / "a.rawlog");
  test::build(folder / "a.rawlog", folder / "map");
  const std::string out = outputOf("03_query", {folder / "map"});
  const auto objects = test::nodesOf(folder / "map", "object");
  ASSERT_FALSE(objects.empty());
  int own = 0;
  for (const auto& object : objects) {
    const std::string id = std::to_string(object.record.id.value);
    const std::regex line(
        "object " + id +
        ": from above a ray meets ([a-z]+ [0-9]+) after ([0-9.]+) m, the point is occupied\n");
    std::smatch found;
    ASSERT_TRUE(std::regex_search(out, found, line)) << out;
    own += found[1] == "object " + id ? 1 : 0;
    // It starts 30 cm above the highest of the padded box; nothing hangs over the table of this scene.
    EXPECT_GE(std::stod(found[2]), 0.3);
    EXPECT_LE(std::stod(found[2]), 0.3 + 2.0 * object.record.box_half_extents.norm());
  }
  EXPECT_GE(own, 1);
  EXPECT_TRUE(contains(out, "a gripper over it is free")) << out;
}

TEST(Example, AnOwnRelationMakesItsTree) {
  const std::string out = outputOf("04_own_relation");
  EXPECT_TRUE(contains(out, "background 0")) << out;
  EXPECT_TRUE(contains(out, "\n  shelf 1")) << out;
  EXPECT_TRUE(contains(out, "\n    object 2")) << out;
  EXPECT_TRUE(contains(out, "\n    object 3")) << out;
}

TEST(Example, OwnLabelsHaveTheirOwnProfiles) {
  const std::string out = outputOf("05_own_labels");
  EXPECT_EQ(out,
            "0 background at 0.05 m, hits count 0.7\n"
            "1 book at 0.01 m, hits count 0.7\n"
            "2 bottle at 0.002 m, hits count 0.9\n");
}

TEST(Example, AnOwnRobotExploresItsTable) {
  const std::string out = outputOf("06_own_robot");
  EXPECT_TRUE(contains(out, "\nfirst_view\nview\n")) << out;
  EXPECT_TRUE(contains(out, "\ntable 1 explored\n")) << out;
}

}  // namespace
}  // namespace hoctomap
