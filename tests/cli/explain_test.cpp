// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "TableLogs.h"
#include "hoctomap/config/Settings.h"
#include "hoctomap/io/MapTables.h"

namespace hoctomap {
namespace {

using test::TemporaryFolder;

/// One run of the occlusion scene for all tests of this file: node 1 the table, 2 what vanishes, 3 the tube.
class Explain : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = new TemporaryFolder;
    test::simulate("occlusion", *folder_ / "a.rawlog");
    test::build(*folder_ / "a.rawlog", *folder_ / "map", {"--snapshot-every", "4"});
  }
  static void TearDownTestSuite() { delete folder_; }
  static std::string map() { return *folder_ / "map"; }
  static std::string file(const std::string& name) { return *folder_ / name; }

 private:
  static inline const TemporaryFolder* folder_ = nullptr;
};

TEST_F(Explain, TheLedgerGivesTheStoredProbabilities) {  // Eq. (8), recomputed from the files alone
  const Manifest manifest = readManifest(map());
  const Settings settings = loadSettings(map() + "/config.ini");
  std::map<NodeId, double> log_odds;
  std::map<NodeId, ExistenceParameters> parameters;
  for (const EventRow& event : readEvents(map(), manifest)) {
    if (event.event != "created") continue;
    log_odds[event.node] = std::log(event.existence / (1.0 - event.existence));
    parameters[event.node] = settings.labels.at(event.label).existence;
  }
  const auto logit = [](double p) { return std::log(p / (1.0 - p)); };
  const auto probability_of = [](double l) { return 1.0 / (1.0 + std::exp(-l)); };
  const auto rows = readExistence(map(), manifest);
  EXPECT_GT(rows.size(), 20U);
  for (const ExistenceRow& row : rows) {
    const ExistenceParameters& p = parameters.at(row.node);
    double& l = log_odds.at(row.node);
    l += logit(row.p_measurement) - logit(p.prior);
    l = std::min(std::max(l, logit(p.clamp_min)), logit(p.clamp_max));
    EXPECT_NEAR(probability_of(l), row.p_posterior, 1e-9)
        << "scan " << row.scan << " node " << row.node.value;
  }
  std::size_t compared = 0;
  for (const auto* list : {&manifest.nodes, &manifest.removed}) {
    for (const NodeRecord& node : *list) {
      if (node.id == kRootId) continue;
      EXPECT_NEAR(probability_of(log_odds.at(node.id)), node.existence, 1e-9) << node.id.value;
      ++compared;
    }
  }
  EXPECT_EQ(compared, 3U);
}

TEST_F(Explain, TellsWhyANodeIsGone) {
  const auto outcome = test::hoctomap({"explain", map(), "2"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  for (const char* expected :
       {"node 2 object: removed after scan", "from scan 1:", "points of scan 0, parent 1",
        "existence below 0.5: scans 8, 9 saw through it", "not there", "updated:"}) {
    EXPECT_NE(outcome.out.find(expected), std::string::npos) << expected << "\n" << outcome.out;
  }
  const auto json = test::hoctomap({"explain", map(), "2", "--json"});
  EXPECT_NE(json.out.find("\"in_map\": false"), std::string::npos);
  EXPECT_NE(json.out.find("\"event\": \"removed\""), std::string::npos);
}

TEST_F(Explain, TellsOfNodesThatAreThere) {
  for (const char* node : {"0", "1", "3"}) {
    const auto outcome = test::hoctomap({"explain", map(), node});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_NE(outcome.out.find("in the map, existence 0.97"), std::string::npos) << outcome.out;
  }
}

TEST_F(Explain, AtAnEarlierScanNothingOfLaterIsTold) {
  const auto outcome = test::hoctomap({"explain", map(), "2", "--at-scan", "7"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("in the map"), std::string::npos) << outcome.out;
  EXPECT_EQ(outcome.out.find("not there"), std::string::npos) << outcome.out;
  EXPECT_TRUE(outcome.err.empty()) << outcome.err;
  // Between two kept states the older one is shown, and said to be.
  const auto between = test::hoctomap({"explain", map(), "2", "--at-scan", "6"});
  EXPECT_NE(between.err.find("after scan 3"), std::string::npos) << between.err;
  EXPECT_EQ(test::hoctomap({"explain", map(), "3", "--at-scan", "3"}).exit_code, 4) << "it came later";
}

TEST_F(Explain, PlotsTheExistence) {
  const auto probe = test::runProgram("gnuplot", {"--version"});
  if (probe.exit_code == 127) GTEST_SKIP() << "gnuplot (package gnuplot-nox) is not installed";
  const auto outcome = test::hoctomap({"explain", map(), "2", "--plot", file("life.svg")});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const std::string svg = test::readFile(file("life.svg"));
  EXPECT_NE(svg.find("<svg"), std::string::npos);
  EXPECT_NE(svg.find("removed"), std::string::npos);
  // A node without any evidence can be drawn, too.
  EXPECT_EQ(test::hoctomap({"explain", map(), "0", "--plot", file("root.svg")}).exit_code, 0);
}

TEST_F(Explain, WithoutGnuplotItSaysWhatToInstall) {
  const auto outcome = test::runProgram(HOCTOMAP_PROGRAM, {"explain", map(), "2", "--plot", file("no.svg")},
                                        {{"PATH", "/nonexistent"}, {"HOCTOMAP_GNUPLOT", ""}});
  EXPECT_EQ(outcome.exit_code, 5);
  EXPECT_NE(outcome.err.find("gnuplot-nox"), std::string::npos) << outcome.err;
  EXPECT_FALSE(std::filesystem::exists(file("no.svg")));
}

TEST_F(Explain, RefusesWhatIsNoNode) {
  EXPECT_EQ(test::hoctomap({"explain", map(), "99"}).exit_code, 4);
  EXPECT_EQ(test::hoctomap({"explain", map(), "two"}).exit_code, 2);
  EXPECT_EQ(test::hoctomap({"explain", map()}).exit_code, 2);
  EXPECT_EQ(test::hoctomap({"explain", file("nothing"), "1"}).exit_code, 4);
}

TEST_F(Explain, ADamagedLedgerIsNoticed) {
  std::filesystem::copy(map(), file("damaged"), std::filesystem::copy_options::recursive);
  std::string rows = test::readFile(file("damaged/existence.csv"));
  rows[rows.size() / 2] = rows[rows.size() / 2] == '1' ? '2' : '1';
  test::writeFile(file("damaged/existence.csv"), rows);
  const auto outcome = test::hoctomap({"explain", file("damaged"), "2"});
  EXPECT_EQ(outcome.exit_code, 4);
  EXPECT_NE(outcome.err.find("existence.csv"), std::string::npos) << outcome.err;
}

TEST(AtScan, AKeptStateIsThatOfARunThatStoppedThere) {
  const TemporaryFolder folder;
  test::simulate("demo", folder / "a.rawlog");
  test::build(folder / "a.rawlog", folder / "map", {"--snapshot-every", "1"});
  for (std::uint64_t k = 0; k < 5; ++k) {
    const std::string scan = std::to_string(k);
    const std::string stopped = folder / ("stopped" + scan);
    test::build(folder / "a.rawlog", stopped, {"--max-scans", std::to_string(k + 1)});
    Manifest kept = readManifest(folder / "map", k);
    Manifest end = readManifest(stopped);
    // Names, sizes and hashes of all files are in the manifest. The scene, and the events of what the end of
    // the log lets in, are written at the end of a run only.
    EXPECT_FALSE(kept.scene);
    end.scene.reset();
    end.events = end.events_before_end.value_or(end.events);
    end.events_before_end.reset();
    // Each names the index of its own nodes; those that the end of the log lets in wait in the kept state.
    kept.index.reset();
    end.index.reset();
    EXPECT_EQ(toYaml(kept), toYaml(end)) << "scan " << k;
    const auto lines = [](const test::Outcome& outcome) { return outcome.out; };
    EXPECT_EQ(lines(test::hoctomap({"explain", folder / "map", "2", "--json", "--at-scan", scan})),
              lines(test::hoctomap({"explain", stopped, "2", "--json"})));
    const auto changes =
        test::hoctomap({"diff", folder / "map", stopped, "--at-scan-a", scan, "--exit-code"});
    EXPECT_EQ(changes.exit_code, 0) << changes.out << changes.err;
  }
  const auto picture = [&](const std::string& map, const std::vector<std::string>& more) {
    std::vector<std::string> arguments{"render", map, "-o", folder / "a.png", "--size", "160x100"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const auto outcome = test::hoctomap(arguments);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    return test::readFile(folder / "a.png");
  };
  EXPECT_EQ(picture(folder / "map", {"--at-scan", "2"}), picture(folder / "stopped2", {}));
  EXPECT_NE(picture(folder / "map", {"--at-scan", "0"}), picture(folder / "map", {}));
}

}  // namespace
}  // namespace hoctomap
