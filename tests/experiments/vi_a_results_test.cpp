// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>

#include "hoctomap/geometry/Errors.h"
#include "vi_a/Plots.h"
#include "vi_a/Prediction.h"
#include "vi_a/Results.h"
#include "vi_a/Runs.h"

namespace hoctomap {
namespace {

TEST(Prediction, IsExactForEveryPowerLaw) {
  for (const double exponent : {1.0, 2.0, 2.6, 3.0}) {
    for (const double r : {0.001, 0.004, 0.016}) {
      const auto law = [&](double resolution) { return 7.0 * std::pow(resolution, -exponent); };
      EXPECT_NEAR(predictFiner(law(4 * r), law(2 * r)) / law(r), 1.0, 1e-12);
    }
  }
}

TEST(Prediction, FromAPartGoesByThePoints) {
  EXPECT_DOUBLE_EQ(predictAll(3.0, 1000, 1000), 3.0);
  EXPECT_DOUBLE_EQ(predictAll(3.0, 1000, 20'000), 60.0);
}

TEST(Prediction, NeedsSomethingToStartFrom) {
  EXPECT_THROW(static_cast<void>(predictFiner(0.0, 1.0)), std::invalid_argument);
  EXPECT_THROW(static_cast<void>(predictAll(1.0, 0, 10)), std::invalid_argument);
}

ViAResults someResults() {
  ViAResults results;
  const auto add = [&](double mm, MapMethod method, Origin origin) {
    results.points.push_back({"some_set", mm, method, Figure{4.0, origin}, 0.1, Figure{2e6, origin}, 1, {}});
  };
  for (const double mm : {8.0, 4.0}) {
    add(mm, MapMethod::hierarchy, Origin::measured);
    add(mm, MapMethod::monolithic, Origin::measured);
    add(mm, MapMethod::stock, mm == 4.0 ? Origin::law : Origin::measured);
  }
  return results;
}

TEST(ViAResults, PredictedFiguresAreMarked) {
  const ViAResults results = someResults();
  const std::string tables = markdownTables(results);
  EXPECT_NE(tables.find("| some_set | 8 mm | 4 | 4 | 4 | 1x | 1x |"), std::string::npos) << tables;
  EXPECT_NE(tables.find("| some_set | 4 mm | 2 | 2 | ~2 | ~1x | 1x |"), std::string::npos) << tables;
  const std::string csv = pointsCsv(results);
  EXPECT_NE(csv.find("some_set,4,stock,4,predicted_by_law,0.1,2000000,predicted_by_law,1\n"),
            std::string::npos)
      << csv;
}

TEST(ViAResults, PlotsHaveEveryPointAndOpenSymbolsForPredictions) {
  const std::string plot = plotCommands(someResults(), Quantity::runtime);
  EXPECT_NE(plot.find("$stock << EOD\n8 4 0\n4 4 1\nEOD"), std::string::npos) << plot;
  EXPECT_NE(plot.find("$hierarchy << EOD\n8 4 0\n4 4 0\nEOD"), std::string::npos) << plot;
}

TEST(KnownRuns, AreWhatWasWrittenWithoutAHalfLine) {
  const std::string row = "small,16,stock,20,0,1000,1.5,1.75,2,4096,8192,,abc\n";
  const KnownRuns runs = parseRuns(runsCsvHeader() + row + "small,8,stock,20,0,1000,1.5");
  ASSERT_EQ(runs.size(), 1U);
  const Figures& run = runs.at("small,16,stock,20,0");
  EXPECT_EQ(run.number("points"), 1000);
  EXPECT_EQ(run.number("cpu_s"), 1.75);
  EXPECT_EQ(run.number("map_bytes"), 4096);
  EXPECT_EQ(run.text("ot_sha256"), "abc");
  EXPECT_FALSE(run.contains("nodes"));
  EXPECT_THROW(static_cast<void>(parseRuns("set,other\n" + row)), InputError);
}

}  // namespace
}  // namespace hoctomap
