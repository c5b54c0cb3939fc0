// SPDX-License-Identifier: BSD-3-Clause
// `build --estimate`: that it lies near what a build takes, and leaves nothing behind.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "TableLogs.h"

namespace hoctomap {
namespace {

using test::TemporaryFolder;

nlohmann::json estimateOf(const std::string& log, const std::vector<std::string>& more = {}) {
  std::vector<std::string> arguments{"build", "--estimate", "--json", "-i", log};
  arguments.insert(arguments.end(), more.begin(), more.end());
  const test::Outcome outcome = test::hoctomap(arguments);
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  return nlohmann::json::parse(outcome.out);
}

/// Of all nodes, those removed as well.
double octreeBytes(const Manifest& manifest) {
  double bytes = 0.0;
  for (const auto& node : manifest.nodes) bytes += static_cast<double>(node.memory_bytes);
  for (const auto& node : manifest.removed) bytes += static_cast<double>(node.memory_bytes);
  return bytes;
}

double bytesOnDisk(const std::string& map) {
  double bytes = 0.0;
  for (const auto& [name, text] : test::readTree(map)) bytes += static_cast<double>(text.size());
  return bytes;
}

TEST(Estimate, LiesWithinAFactorOfTwo) {
  const std::vector<std::pair<std::string, std::vector<std::string>>> scenes{
      {"demo", {}},       // looked at as a whole
      {"occlusion", {}},  // something is removed
      {"demo", {"path.sweep.views=40"}},
      {"room",
       {"path.kitchen_table.views=14", "path.desk.views=14", "camera.width=320", "camera.height=240",
        "camera.fx=270"}}};
  for (const auto& [scene, settings] : scenes) {
    const TemporaryFolder folder;
    const std::string log = folder / "a.rawlog";
    test::simulate(scene, log, settings);
    const auto estimate = estimateOf(log);
    const auto built = test::build(log, folder / "map");
    const Manifest manifest = readManifest(folder / "map");
    SCOPED_TRACE(scene + ": " + estimate.dump());
    EXPECT_EQ(estimate["scans"], manifest.scans);
    EXPECT_LE(estimate["sampled_scans"], 12U);
    double points = 0.0;
    for (const auto& row : test::parseCsv(test::readFile(folder / "map/timing.csv"))) {
      points += std::stod(row.at("points"));
    }
    EXPECT_NEAR(estimate["points"].get<double>() / points, 1.0, 0.1);
    const double octrees = estimate["map_bytes"].get<double>() / octreeBytes(manifest);
    EXPECT_GT(octrees, 0.5);
    EXPECT_LT(octrees, 2.0);
    const double disk = estimate["disk_bytes"].get<double>() / bytesOnDisk(folder / "map");
    EXPECT_GT(disk, 0.5);
    EXPECT_LT(disk, 2.0);
    // Measured is the larger one of program and helper; both together are what a scheduler counts.
    const double memory =
        estimate["peak_memory_bytes"].get<double>() / static_cast<double>(built.peak_memory);
    EXPECT_GT(memory, 1.0);
    EXPECT_LT(memory, 4.0);
  }
}

TEST(Estimate, IsOfTheScansThatABuildWouldTake) {
  const TemporaryFolder folder;
  test::simulate("demo", folder / "a.rawlog", {"path.sweep.views=30"});
  const auto estimate = estimateOf(folder / "a.rawlog", {"--start", "10", "--end", "20", "--every", "2"});
  EXPECT_EQ(estimate["scans"], 5);
  EXPECT_EQ(estimate["sampled_scans"], 5);
}

TEST(Estimate, LeavesNothingBehind) {
  const TemporaryFolder folder;
  test::simulate("demo", folder / "a.rawlog");
  const auto before = test::readTree(folder / "");
  const auto said = test::hoctomap({"build", "--estimate", "-i", folder / "a.rawlog", "-o", folder / "map"});
  EXPECT_EQ(said.exit_code, 0) << said.err;
  EXPECT_NE(said.out.find("6 (judged by 6)"), std::string::npos) << said.out;
  EXPECT_EQ(test::readTree(folder / ""), before);
}

TEST(Estimate, SaysWhatABuildWouldSayOfABadLog) {
  const TemporaryFolder folder;
  test::writeFile(folder / "bad.rawlog", "no log");
  EXPECT_EQ(test::hoctomap({"build", "--estimate", "-i", folder / "bad.rawlog"}).exit_code, 3);
  EXPECT_EQ(test::hoctomap({"build", "-i", folder / "bad.rawlog"}).exit_code, 2) << "-o is missing";
  EXPECT_EQ(test::hoctomap({"build", "--json", "-i", "a", "-o", "b"}).exit_code, 2)
      << "--json is of estimates";
}

}  // namespace
}  // namespace hoctomap
