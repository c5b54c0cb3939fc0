// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "Program.h"
#include "support/SharedData.h"

namespace hoctomap::test {
namespace {

Outcome experiments(const std::vector<std::string>& arguments) {
  return runProgram(HOCTOMAP_EXPERIMENTS, arguments, {{"HOCTOMAP_MRPT", HOCTOMAP_HELPER}});
}

TEST(Experiments, ViAFillsEveryPointOfBothFigures) {
  const TemporaryFolder folder;
  const std::vector<std::string> command{"vi-a",     "--quick",
                                         "-o",       folder / "out",
                                         "--scenes", (sourceDir() / "configs/scenes").string(),
                                         "-c",       (sourceDir() / "configs/paper.ini").string()};
  const Outcome outcome = experiments(command);
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const auto points = parseCsv(readFile(folder / "out/vi_a.csv"));
  EXPECT_EQ(points.size(), 2U * 4U * 3U);  // sets, resolutions, methods
  std::set<std::string> origins;
  for (const auto& point : points) {
    EXPECT_GT(std::stod(point.at("seconds")), 0.0);
    EXPECT_GT(std::stod(point.at("bytes")), 0.0);
    origins.insert(point.at("seconds_origin"));
    if (point.at("method") == "hierarchy") {
      EXPECT_EQ(point.at("bytes_origin"), "measured");
    }
  }
  EXPECT_EQ(origins, (std::set<std::string>{"measured", "predicted_from_part", "predicted_by_law"}));
  EXPECT_NE(outcome.out.find("equal maps of stock and ours: 4 of 4"), std::string::npos) << outcome.out;
  EXPECT_GE(parseCsv(readFile(folder / "out/vi_a_checks.csv")).size(), 6U);
  // With all runs known, nothing is measured again, and the points are the same.
  const std::string first = readFile(folder / "out/vi_a.csv");
  std::vector<std::string> resume = command;
  resume.emplace_back("--continue");
  const Outcome again = experiments(resume);
  ASSERT_EQ(again.exit_code, 0) << again.err;
  EXPECT_EQ(readFile(folder / "out/vi_a.csv"), first);
  for (const std::string figure : {"fig4_memory", "fig5_runtime"}) {
    EXPECT_NE(readFile(folder / ("out/" + figure + ".svg")).find("</svg>"), std::string::npos);
    EXPECT_EQ(readFile(folder / ("out/" + figure + ".png")).substr(1, 3), "PNG");
  }
}

TEST(Experiments, PerformanceMeasuresEveryRowAndEqualTrees) {
  const TemporaryFolder folder;
  const Outcome outcome = experiments({"performance", "--quick", "-o", folder / "out", "--scenes",
                                       (sourceDir() / "configs/scenes").string(), "--many-scene",
                                       (sourceDir() / "tests/benchmarks/many_objects.ini").string()});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err << outcome.out;
  const std::string table = readFile(folder / "out/performance.csv");
  EXPECT_EQ(std::count(table.begin(), table.end(), '\n'), 1 + 13);
  EXPECT_EQ(table.find(",NO\n"), std::string::npos) << table;
  EXPECT_GT(parseCsv(readFile(folder / "out/measurements.csv")).size(), 100U);
}

TEST(Experiments, ViBLeavesGhostsInTheSingleMapOnly) {
  const TemporaryFolder folder;
  const Outcome outcome = experiments({"vi-b", "--quick", "--scans", "12", "-o", folder / "out", "--scene",
                                       (sourceDir() / "configs/scenes/occlusion.ini").string(), "-c",
                                       (sourceDir() / "configs/tabletop.ini").string()});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const auto rows = parseCsv(readFile(folder / "out/vi_b.csv"));
  ASSERT_EQ(rows.size(), 1U);
  const auto& row = rows.front();
  EXPECT_EQ(row.at("removed_objects"), "1");
  EXPECT_EQ(row.at("objects_left"), "1");  // the tube
  EXPECT_EQ(row.at("ghosts_hierarchy"), "0");
  EXPECT_GT(std::stoi(row.at("ghosts_monolithic")), std::stoi(row.at("node_voxels")) / 10);
  EXPECT_GT(std::stoi(row.at("hidden_monolithic")), 0);
  // Out of the map exactly from the scan on that takes its probability below 0.5.
  const auto states = parseCsv(readFile(folder / "out/vi_b_existence.csv"));
  ASSERT_EQ(states.size(), std::stoul(row.at("scans")));
  const auto removed = std::stoul(row.at("removed_scan"));
  EXPECT_GE(removed, 8U);  // when the power supply goes
  for (std::size_t scan = 0; scan < states.size(); ++scan) {
    const bool confirmed = scan >= 1;  // by a second view
    EXPECT_EQ(states[scan].at("in_map"), confirmed && scan < removed ? "1" : "0") << scan;
    if (confirmed && scan <= removed) {
      EXPECT_EQ(std::stod(states[scan].at("existence")) < 0.5, scan == removed) << scan;
    }
  }
  for (const std::string picture : {"monolithic", "hierarchy"}) {
    EXPECT_EQ(readFile(folder / ("out/simulated/" + picture + ".png")).substr(1, 3), "PNG");
  }
  EXPECT_NE(outcome.out.find("| simulated |"), std::string::npos) << outcome.out;
}

TEST(Experiments, ViCComparesTheWaysToChooseViews) {
  const TemporaryFolder folder;
  const Outcome outcome = experiments(
      {"vi-c", (sourceDir() / "configs/scenes/explore_table.ini").string(), "--quick", "-o", folder / "out"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const auto trials = parseCsv(readFile(folder / "out/trials.csv"));
  ASSERT_EQ(trials.size(), 5U);
  std::size_t views = 0;
  for (const auto& trial : trials) {
    EXPECT_GT(std::stod(trial.at("coverage")), 0.6) << trial.at("method");
    EXPECT_LE(std::stoi(trial.at("views")), 4);
    views += 1 + std::stoul(trial.at("views"));  // and after the look around
  }
  EXPECT_GT(std::stod(trials[0].at("gain_correlation")), 0.7);  // recommended
  EXPECT_EQ(parseCsv(readFile(folder / "out/views.csv")).size(), views);
  const auto steps = parseCsv(readFile(folder / "out/steps.csv"));
  ASSERT_GE(steps.size(), 4U);  // of two methods
  EXPECT_EQ(steps[0].at("kind"), "first_view");
  EXPECT_LE(std::stod(steps[1].at("chosen_gain")), std::stod(steps[1].at("best_gain")));
  EXPECT_NE(outcome.out.find("| explore_table | circle of 4 |"), std::string::npos) << outcome.out;
  for (const char* plot : {"coverage_views", "coverage_travel"})
    EXPECT_EQ(readFile(folder / (std::string("out/") + plot + ".png")).substr(1, 3), "PNG");
}

TEST(Experiments, WrongUseIsExit2) {
  EXPECT_EQ(experiments({"vi-c"}).exit_code, 2);
  EXPECT_EQ(experiments({"vi-a"}).exit_code, 2);
  EXPECT_EQ(experiments({"vi-b"}).exit_code, 2);
  EXPECT_EQ(experiments({"measure", "hole"}).exit_code, 2);
  EXPECT_EQ(experiments({"measure", "whole", "--variant", "ours", "--log", "/nowhere"}).exit_code, 3);
}

TEST(Experiments, MeasurementBeyondItsMemoryIsExit6) {
  const TemporaryFolder folder;
  const std::string log = folder / "log.rawlog";
  ASSERT_EQ(hoctomap({"simulate", "-q", "-c", (sourceDir() / "configs/scenes/small_objects.ini").string(),
                      "-o", log, "--set", "path.sweep.views=1"})
                .exit_code,
            0);
#ifndef HOCTOMAP_SANITIZED
  EXPECT_EQ(experiments({"measure", "whole", "--variant", "stock", "--log", log, "--resolution", "0.002",
                         "--limit-memory", "400000000"})
                .exit_code,
            6);
#endif
}

}  // namespace
}  // namespace hoctomap::test
