// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <mrpt/containers/yaml.h>

#include <cmath>

#include "TableLogs.h"
#include "support/SharedData.h"

namespace hoctomap {
namespace {

using test::TemporaryFolder;

/// The demo scene, in which the mug moves and the tin vanishes before scan 3; one map of what was before, one
/// of what was after.
class DiffOfMaps : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = new TemporaryFolder;
    test::writeFile(file("scene.ini"), test::readFile(test::scene("demo")) +
                                           "\n[event.mug_moves]\nscan = 3\naction = move\nsolid = mug\n"
                                           "position = 0.12 -0.05 0\norientation = 20 0 0\n"
                                           "\n[event.tin_goes]\nscan = 3\naction = vanish\nsolid = tin\n");
    const auto made = test::hoctomap({"simulate", "-q", "-c", file("scene.ini"), "-o", file("a.rawlog")});
    ASSERT_EQ(made.exit_code, 0) << made.err;
    test::build(file("a.rawlog"), file("before"), {"--max-scans", "3"});
    test::build(file("a.rawlog"), file("after"), {"--start", "3"});
    test::build(file("a.rawlog"), file("coarse"), {"--start", "3", "--set", "label.object.resolution=0.004"});
  }
  static void TearDownTestSuite() { delete folder_; }
  static std::string file(const std::string& name) { return *folder_ / name; }

  /// The rows of diff.csv.
  static std::vector<std::map<std::string, std::string>> changes(const std::string& a, const std::string& b,
                                                                 const std::vector<std::string>& more = {}) {
    std::vector<std::string> arguments{"diff", file(a), file(b), "-o", file("diff.csv")};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const auto outcome = test::hoctomap(arguments);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    return test::parseCsv(test::readFile(file("diff.csv")));
  }
  static std::size_t count(const std::vector<std::map<std::string, std::string>>& rows,
                           const std::string& kind) {
    return static_cast<std::size_t>(
        std::count_if(rows.begin(), rows.end(), [&](const auto& row) { return row.at("change") == kind; }));
  }

 private:
  static inline const TemporaryFolder* folder_ = nullptr;
};

TEST_F(DiffOfMaps, FindsWhatMovedAndWhatVanished) {
  for (const char* after : {"after", "coarse"}) {
    const auto rows = changes("before", after);
    EXPECT_EQ(count(rows, "removed"), 1U) << after;
    EXPECT_EQ(count(rows, "added") + count(rows, "changed"), 0U) << after;
    // The mug is one node or, seen from few sides, two.
    EXPECT_GE(count(rows, "moved"), 1U) << after;
    for (const auto& row : rows) {
      if (row.at("change") == "removed") {
        EXPECT_NEAR(std::stod(row.at("px")), 0.10, 0.04);
        EXPECT_NEAR(std::stod(row.at("py")), 0.22, 0.04);
        continue;
      }
      ASSERT_EQ(row.at("change"), "moved") << after;
      const Eigen::Isometry3d motion =
          toIsometry(Pose(std::stod(row.at("x")), std::stod(row.at("y")), std::stod(row.at("z")),
                          std::stod(row.at("yaw")) * M_PI / 180.0, std::stod(row.at("pitch")) * M_PI / 180.0,
                          std::stod(row.at("roll")) * M_PI / 180.0));
      // The axis of the mug; how far a round thing has turned cannot be seen well.
      const Eigen::Vector3d from(0.10, -0.20, 0.75);
      EXPECT_LT((motion * from - Eigen::Vector3d(0.12, -0.05, 0.75)).norm(), 0.012) << after;
    }
  }
}

TEST_F(DiffOfMaps, TheOtherWayRoundIsTheMirrorImage) {
  const auto forward = changes("before", "after");
  const auto backward = changes("after", "before");
  ASSERT_EQ(forward.size(), backward.size());
  EXPECT_EQ(count(forward, "removed"), count(backward, "added"));
  EXPECT_EQ(count(forward, "moved"), count(backward, "moved"));
  for (const auto& row : forward) {
    EXPECT_TRUE(std::any_of(backward.begin(), backward.end(), [&](const auto& other) {
      return other.at("node_a") == row.at("node_b") && other.at("node_b") == row.at("node_a") &&
             other.at("score") == row.at("score");
    }));
  }
}

TEST_F(DiffOfMaps, OfAMapWithItselfIsEmpty) {
  for (const char* map : {"before", "after", "coarse"}) {
    const auto outcome = test::hoctomap({"diff", file(map), file(map), "--exit-code"});
    EXPECT_EQ(outcome.exit_code, 0);
    EXPECT_NE(outcome.out.find("no changes"), std::string::npos) << outcome.out;
  }
  EXPECT_EQ(test::hoctomap({"diff", file("before"), file("after"), "--exit-code"}).exit_code, 1);
}

TEST_F(DiffOfMaps, ATransformIsThePoseOfBsWorldInAs) {
  // Told that B's world lies 10 cm further along x, the whole table has moved there with its objects.
  const auto rows = changes("after", "after", {"--transform", "0.1 0 0 0 0 0"});
  ASSERT_EQ(rows.size(), 1U);
  EXPECT_EQ(rows[0].at("change"), "moved");
  EXPECT_EQ(rows[0].at("label"), "table");
  EXPECT_NEAR(std::stod(rows[0].at("x")), 0.1, 0.005);
  EXPECT_FALSE(rows[0].at("carried").empty());
  EXPECT_TRUE(changes("after", "after", {"--transform", "[0, 0, 0, 360, 0, 0]"}).empty());
}

TEST_F(DiffOfMaps, JsonSaysTheSame) {
  const auto outcome = test::hoctomap({"diff", file("before"), file("after"), "--json"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const auto json = mrpt::containers::yaml::FromText(outcome.out);
  const auto rows = changes("before", "after");
  ASSERT_EQ(json["changes"].asSequence().size(), rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    mrpt::containers::yaml change(json["changes"].asSequence()[i]);
    EXPECT_EQ(change["change"].as<std::string>(), rows[i].at("change"));
    EXPECT_NEAR(change["score"].as<double>(), std::stod(rows[i].at("score")), 1e-6);
  }
  EXPECT_EQ(json["counts"]["removed"].as<int>(), 1);
}

TEST_F(DiffOfMaps, WrongUseGetsItsExitCode) {
  EXPECT_EQ(test::hoctomap({"diff", file("before"), file("after"), "--transform", "1 2 3"}).exit_code, 2);
  EXPECT_EQ(test::hoctomap({"diff", file("before"), file("after"), "--transform", "a b c d e f"}).exit_code,
            2);
  EXPECT_EQ(test::hoctomap({"diff", file("before")}).exit_code, 2);
  EXPECT_EQ(test::hoctomap({"diff", file("before"), file("nothing")}).exit_code, 4);
  EXPECT_EQ(
      test::hoctomap({"diff", file("before"), file("after"), "-o", file("no/such/place.csv")}).exit_code, 5);
  EXPECT_EQ(test::hoctomap({"diff", file("before"), file("after"), "--at-scan-a", "0"}).exit_code, 4);
}

TEST(Diff, TellsWhatHappenedBetweenTwoStatesOfOneMap) {  // VI-B
  const TemporaryFolder folder;
  test::simulate("occlusion", folder / "a.rawlog");
  test::build(folder / "a.rawlog", folder / "map", {"--snapshot-every", "4"});
  const auto stage = [&](const std::string& a, const std::string& b) {
    const auto outcome =
        test::hoctomap({"diff", folder / "map", folder / "map", "--at-scan-a", a, "--at-scan-b", b});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    return outcome.out;
  };
  EXPECT_NE(stage("3", "7").find("1 added, 0 removed, 0 moved, 0 changed, 0 unobservable"),
            std::string::npos);
  EXPECT_NE(stage("7", "11").find("0 added, 1 removed, 0 moved, 0 changed, 0 unobservable"),
            std::string::npos);
  EXPECT_NE(stage("3", "11").find("1 added, 1 removed, 0 moved, 0 changed, 0 unobservable"),
            std::string::npos);
}

TEST(Diff, FindsTheMotionOfARealObject) {
  const auto data = test::sharedData();
  if (!data) GTEST_SKIP() << "no real data";
  const auto sequence = *data / "mosd_change/move_01_scene034/sequence.rawlog";
  if (!std::filesystem::exists(sequence)) GTEST_SKIP() << "no " << sequence;
  const TemporaryFolder folder;
  test::build(sequence.string(), folder / "before", {"--max-scans", "3"});
  test::build(sequence.string(), folder / "after", {"--start", "3"});
  const auto outcome = test::hoctomap({"diff", folder / "before", folder / "after", "-o", folder / "d.csv"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const auto rows = test::parseCsv(test::readFile(folder / "d.csv"));
  ASSERT_EQ(rows.size(), 1U) << outcome.out;
  EXPECT_EQ(rows[0].at("change"), "moved");
  EXPECT_NEAR(std::stod(rows[0].at("yaw")), 8.0, 2.0);
}

}  // namespace
}  // namespace hoctomap
