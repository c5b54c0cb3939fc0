// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>

#include "hoctomap/scenes/SceneConfig.h"
#include "hoctomap/simulation/SceneRaycaster.h"
#include "support/SharedData.h"
#include "vi_c/JitteredScene.h"
#include "vi_c/Results.h"
#include "vi_c/Statistics.h"

namespace hoctomap {
namespace {

TEST(Statistics, MeanHasStudentsInterval) {
  const std::vector<double> values{1.0, 2.0, 3.0, 4.0, 5.0};
  const MeanWithInterval mean = meanOf(values);
  EXPECT_DOUBLE_EQ(mean.mean, 3.0);
  EXPECT_NEAR(mean.half_width, 2.776 * std::sqrt(2.5 / 5.0), 0.01);  // t of a table, 4 degrees of freedom
  const std::vector<double> one{7.0};
  EXPECT_DOUBLE_EQ(meanOf(one).half_width, 0.0);
  EXPECT_THROW((void)meanOf({}), std::invalid_argument);
}

TEST(Statistics, RankCorrelationLooksAtTheOrderOnly) {
  const std::vector<double> a{1.0, 2.0, 3.0, 4.0};
  const std::vector<double> cubes{1.0, 8.0, 27.0, 64.0};
  const std::vector<double> down{9.0, 7.0, 5.0, 1.0};
  const std::vector<double> swapped{1.0, 3.0, 2.0, 4.0};
  EXPECT_DOUBLE_EQ(rankCorrelation(a, cubes).value(), 1.0);
  EXPECT_DOUBLE_EQ(rankCorrelation(a, down).value(), -1.0);
  EXPECT_NEAR(rankCorrelation(a, swapped).value(), 1.0 - 6.0 * 2.0 / (4.0 * 15.0),
              1e-12);  // Spearman's formula
  const std::vector<double> ties{1.0, 1.0, 2.0, 2.0};
  EXPECT_NEAR(rankCorrelation(ties, ties).value(), 1.0, 1e-12);
  const std::vector<double> constant{1.0, 1.0, 1.0, 1.0};
  EXPECT_FALSE(rankCorrelation(a, constant));
}

TEST(JitteredScene, MovesObjectsALittleAndNothingElse) {
  const Scene scene = loadScene(test::sourceDir() / "configs/scenes/explore_cluttered.ini").scene;
  const Scene a = jittered(scene, 1);
  const Scene again = jittered(scene, 1);
  const Scene b = jittered(scene, 2);
  int moved = 0;
  for (const SolidId id : scene.ids()) {
    const Pose was = scene.world_T_solid(id);
    const Pose is = a.world_T_solid(id);
    const double shift = std::hypot(is.x() - was.x(), is.y() - was.y());
    EXPECT_LT(shift, 0.0567);
    EXPECT_DOUBLE_EQ(is.z(), was.z());
    if (scene.solid(id).label != SolidLabel::object) {
      EXPECT_EQ(is.asString(), was.asString());
    }
    moved += shift > 0.0 ? 1 : 0;
    EXPECT_EQ(is.asString(), again.world_T_solid(id).asString());
  }
  EXPECT_GT(moved, 10);
  EXPECT_NE(a.world_T_solid(scene.find("jar").value()).asString(),
            b.world_T_solid(scene.find("jar").value()).asString());
}

/// A table whose coverage is 0.5 after the look around, then as given.
Trial trialWith(const std::vector<double>& coverage) {
  Trial trial;
  trial.scene = "scene";
  trial.tables = {"table"};
  trial.views.push_back({std::nullopt, 0.0, 21.0, 0.5, {0.5}});
  for (const double c : coverage) {
    const double n = static_cast<double>(trial.views.size());
    trial.views.push_back({0, 2.0 * n, 21.0 + 7.0 * n, c, {c}});
  }
  return trial;
}

TEST(Trial, TellsWhenCoverageWasReached) {
  const Trial trial = trialWith({0.8, 0.96, 0.961});
  EXPECT_DOUBLE_EQ(trial.tableCoverage(0, 0), 0.5);
  EXPECT_DOUBLE_EQ(trial.tableCoverage(0, 2), 0.96);
  EXPECT_DOUBLE_EQ(trial.tableCoverage(0, 8), 0.961);
  EXPECT_EQ(trial.viewsUntil(0, 0.95), 2);
  EXPECT_EQ(trial.viewsUntil(0, 0.98), std::nullopt);
  ASSERT_NE(trial.firstWith(0.95), nullptr);
  EXPECT_DOUBLE_EQ(trial.firstWith(0.95)->travel, 4.0);
  EXPECT_EQ(trial.firstWith(0.98), nullptr);
  EXPECT_TRUE(trial.lastTripWasUseless());
  EXPECT_FALSE(trialWith({0.8, 0.96}).lastTripWasUseless());
}

TEST(ViCResults, HaveARowAMethodAndALineAView) {
  std::vector<Trial> trials{trialWith({0.8, 0.96}), trialWith({0.9, 0.98})};
  trials[1].seed = 1;
  const std::string text = viCMarkdown(trials);
  EXPECT_NE(text.find("| scene | recommended |"), std::string::npos) << text;
  EXPECT_NE(text.find("97.0 ± "), std::string::npos) << text;  // mean of 96 and 98 after two views
  EXPECT_EQ(text.find("random"), std::string::npos);
  const std::string csv = viewsCsv(trials);
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 1 + 6);
}

TEST(Trial, GoesAroundTheTable) {
  Simulation simulation = loadScene(test::sourceDir() / "configs/scenes/explore_table.ini",
                                    {"camera.width=320", "camera.height=240", "camera.fx=270"});
  const Settings settings =
      loadSettings(std::nullopt, {"label.object.resolution=0.005", "exploration.max_views=3"});
  const TrialScene scene("table", simulation, 3);
  for (const ViewMethod method : {ViewMethod::recommended, ViewMethod::circle_4}) {
    const Trial trial = runTrial(scene, settings, method, {3, method == ViewMethod::recommended});
    ASSERT_GE(trial.views.size(), 3U) << toString(trial.method);
    EXPECT_LE(trial.views.size(), 4U);
    EXPECT_GT(trial.views.back().coverage, trial.views.front().coverage + 0.1) << toString(trial.method);
    for (std::size_t i = 1; i < trial.views.size(); ++i) {
      EXPECT_EQ(trial.views[i].table, std::optional<std::size_t>(0));
      EXPECT_GT(trial.views[i].travel, trial.views[i - 1].travel);
      EXPECT_NEAR(trial.views[i].seconds, 3.0 * static_cast<double>(7 + i) + trial.views[i].travel / 0.5,
                  1e-6);
    }
    if (method != ViewMethod::recommended) continue;
    // The gain foretells what a view would show.
    ASSERT_FALSE(trial.checks.empty());
    std::vector<double> gains;
    std::vector<double> cells;
    for (const GainCheck& check : trial.checks.front()) {
      gains.push_back(check.gain);
      cells.push_back(check.cells);
    }
    EXPECT_EQ(gains.size(), static_cast<std::size_t>(settings.exploration.viewpoints.candidates));
    EXPECT_GT(rankCorrelation(gains, cells).value(), 0.5);
  }
}

}  // namespace
}  // namespace hoctomap
