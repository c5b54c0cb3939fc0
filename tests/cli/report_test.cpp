// SPDX-License-Identifier: BSD-3-Clause
// The page of `hoctomap report`: as a file, and in Debian's Chromium (tests/report), where both are
// installed.
#include <gtest/gtest.h>

#include "TableLogs.h"

namespace hoctomap {
namespace {

using test::TemporaryFolder;

/// A log and a map of one scene for all tests of a suite.
class MapOfScene : public testing::Test {
 protected:
  static void prepare(const std::string& scene) {
    folder_ = new TemporaryFolder;
    test::simulate(scene, file("a.rawlog"));
    test::build(file("a.rawlog"), map());
  }
  static void TearDownTestSuite() { delete folder_; }
  static std::string file(const std::string& name) { return *folder_ / name; }
  static std::string map() { return file("map"); }

  static void make(const std::vector<std::string>& arguments) {
    std::vector<std::string> all{"report"};
    all.insert(all.end(), arguments.begin(), arguments.end());
    const auto outcome = test::hoctomap(all);
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  }

  /// Runs a script of tests/report; what it prints is what is wrong.
  static void tryOut(const std::string& script, const std::vector<std::string>& arguments) {
    const std::filesystem::path folder(HOCTOMAP_REPORT_TEST);
    if (!std::filesystem::exists(folder / "node_modules/playwright-core") ||
        !std::filesystem::exists("/usr/bin/chromium")) {
      GTEST_SKIP() << "needs Chromium and playwright-core (scripts/install_dependencies.sh)";
    }
    std::vector<std::string> all{(folder / script).string()};
    all.insert(all.end(), arguments.begin(), arguments.end());
    const auto outcome = test::runProgram("/usr/bin/env", [&] {
      std::vector<std::string> line{"node"};
      line.insert(line.end(), all.begin(), all.end());
      return line;
    }());
    EXPECT_EQ(outcome.exit_code, 0) << outcome.out << outcome.err;
  }

 private:
  static inline const TemporaryFolder* folder_ = nullptr;
};

class Report : public MapOfScene {
 protected:
  static void SetUpTestSuite() { prepare("demo"); }
};

/// Object 2 is removed after scan 9.
class ReportInChromium : public MapOfScene {
 protected:
  static void SetUpTestSuite() { prepare("occlusion"); }
};

TEST_F(Report, SameMapSameBytesWhichNeedNothingElse) {
  make({map(), "-o", file("one.html")});
  make({map(), "-o", file("two.html")});
  const std::string page = test::readFile(file("one.html"));
  EXPECT_EQ(page, test::readFile(file("two.html")));
  EXPECT_NE(page.find("id=\"a0\""), std::string::npos);
  EXPECT_NE(page.find("id=\"a1\""), std::string::npos);
  for (const char* loads : {"src=\"http", "href=\"http", "@import", "url(http", "<link rel=\"stylesheet"}) {
    EXPECT_EQ(page.find(loads), std::string::npos) << loads;
  }
  EXPECT_LT(page.size(), 4'000'000U);
}

TEST_F(Report, BadUseIsNamed) {
  const auto two = test::hoctomap({"report", map(), map(), "-o", file("x.html")});
  EXPECT_EQ(two.exit_code, 2) << two.err;
  EXPECT_NE(two.err.find("--compare"), std::string::npos) << two.err;
  EXPECT_EQ(test::hoctomap({"report", "--compare", map(), "-o", file("x.html")}).exit_code, 2);
  EXPECT_EQ(test::hoctomap({"report", file("none"), "-o", file("x.html")}).exit_code, 4);
  EXPECT_EQ(test::hoctomap({"report", "--experiments", file("none"), "-o", file("x.html")}).exit_code, 5);
  std::filesystem::create_directory(file("empty"));
  EXPECT_EQ(test::hoctomap({"report", "--experiments", file("empty"), "-o", file("x.html")}).exit_code, 3);
  EXPECT_EQ(test::hoctomap({"report", map(), "-o", file("none/x.html")}).exit_code, 5);
  EXPECT_FALSE(std::filesystem::exists(file("x.html")));
}

TEST_F(Report, APictureAsAScanSawIt) {
  const auto render = [](const std::string& view) {
    return test::hoctomap({"render", map(), "--size", "320x240", "--view", view, "-o", file(view + ".png")});
  };
  ASSERT_EQ(render("sensor").exit_code, 0);
  ASSERT_EQ(render("sensor:5").exit_code, 0);
  ASSERT_EQ(render("sensor:0").exit_code, 0);
  ASSERT_EQ(render("top").exit_code, 0);
  // The last one of six.
  EXPECT_EQ(test::readFile(file("sensor.png")), test::readFile(file("sensor:5.png")));
  EXPECT_NE(test::readFile(file("sensor.png")), test::readFile(file("sensor:0.png")));
  EXPECT_NE(test::readFile(file("sensor.png")), test::readFile(file("top.png")));
  const auto none = render("sensor:99");
  EXPECT_EQ(none.exit_code, 2);
  EXPECT_NE(none.err.find("sensor:99"), std::string::npos) << none.err;
}

TEST_F(Report, ASummaryAtTheEndAndColoursOnlyOnTerminals) {
  const auto outcome = test::build(file("a.rawlog"), file("summary"), {"--max-scans", "2"});
  for (const char* row : {"label ", "free voxels", "background ", "all ", "scans ", "2 used, 0 skipped",
                          "stage ", "segment "}) {
    EXPECT_NE(outcome.out.find(row), std::string::npos) << row << " in\n" << outcome.out;
  }
  EXPECT_EQ((outcome.out + outcome.err).find('\033'), std::string::npos);
}

TEST_F(ReportInChromium, ShowsAMap) {
  make({map(), "-o", file("map.html")});
  tryOut("look.mjs", {file("map.html"), HOCTOMAP_REPORT_TEST "/reference"});
}

TEST_F(ReportInChromium, ShowsAComparison) {
  test::build(file("a.rawlog"), file("before"), {"--max-scans", "4"});
  make({"--compare", file("before"), map(), "-o", file("compare.html")});
  tryOut("opens.mjs", {file("compare.html"), ".stage", ".change"});
}

/// Of one map, which the report of an earlier state of each side shows as it was then.
TEST_F(Report, ComparesTwoStatesOfAMap) {
  test::build(file("a.rawlog"), file("states"), {"--snapshot-every", "2"});
  make({"--compare", file("states"), file("states"), "--at-scan-a", "1", "-o", file("since.html")});
  make({"--compare", file("states"), file("states"), "-o", file("same.html")});
  EXPECT_NE(test::readFile(file("since.html")), test::readFile(file("same.html")));
  EXPECT_EQ(test::hoctomap({"report", map(), "--at-scan-a", "1", "-o", file("x.html")}).exit_code, 2);
}

TEST_F(Report, ExperimentsInChromium) {
  std::filesystem::create_directory(file("vi-a"));
  test::writeFile(file("vi-a/vi_a.csv"),
                  "set,resolution_mm,method,seconds,seconds_origin,spread,bytes,bytes_origin,runs\n"
                  "table,8,hierarchy,0.5,measured,0.1,1000000,measured,3\n"
                  "table,4,hierarchy,0.9,measured,0.1,2000000,measured,3\n"
                  "table,8,monolithic,3,measured,0.1,9000000,measured,3\n"
                  "table,4,monolithic,30,measured,0.1,80000000,measured,3\n");
  make({"--experiments", file("vi-a"), "-o", file("experiments.html")});
  tryOut("opens.mjs", {file("experiments.html"), ".tableplot", ".controls input"});
}

}  // namespace
}  // namespace hoctomap
