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

TEST(Experiments, WrongUseIsExit2) {
  EXPECT_EQ(experiments({"vi-a"}).exit_code, 2);
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
#ifndef __SANITIZE_ADDRESS__
  EXPECT_EQ(experiments({"measure", "whole", "--variant", "stock", "--log", log, "--resolution", "0.002",
                         "--limit-memory", "400000000"})
                .exit_code,
            6);
#endif
}

}  // namespace
}  // namespace hoctomap::test
