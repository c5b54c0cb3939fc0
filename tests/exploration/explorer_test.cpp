// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

#include "BoxWorld.h"
#include "TableScene.h"
#include "hoctomap/exploration/Explorer.h"
#include "hoctomap/geometry/Errors.h"

namespace hoctomap {
namespace {

using testing::BoxRobot;
using testing::BoxWorld;

/// An exploration with all that came of it.
struct Exploration {
  explicit Exploration(const BoxWorld& w, const Eigen::Vector2d& start = {-1.8, -1.6})
      : world(w), robot(world, start), mapper(testing::truthfulMapper(world)) {
    config.first_look = 8;
    config.cell = 0.01;
    config.tau = 0.05;  // its camera is coarse: some cells are met by no beam from anywhere
  }

  void run() {
    Explorer explorer(config, robot, robot, mapper);
    explorer.onStep([this](const ExplorationStep& step) { steps.push_back(step); });
    explorer.onMeasurement([this](const Measurement& z, const UpdateReport&) { scans.push_back(z.scan); });
    result = explorer.run();
  }
  [[nodiscard]] std::size_t count(StepKind kind) const {
    return static_cast<std::size_t>(std::count_if(
        steps.begin(), steps.end(), [kind](const ExplorationStep& s) { return s.kind == kind; }));
  }
  /// Share of the sides and tops of the objects, sampled, next to which the map has an occupied voxel.
  [[nodiscard]] double coverage() const {
    std::vector<Eigen::Vector3d> occupied;
    for (const NodeId id : mapper.hierarchy().ids()) {
      const MapNode& node = mapper.hierarchy().node(id);
      if (node.label() != labels::object) continue;
      const Eigen::Isometry3d world_T_node = toIsometry(mapper.hierarchy().world_T_node(id));
      for (const auto& voxel : node.map().occupiedVoxels())
        occupied.push_back(world_T_node * voxel.cast<double>());
    }
    int covered = 0;
    int all = 0;
    for (const auto& thing : world.things) {
      if (thing.label != labels::object) continue;
      for (int axis = 0; axis < 3; ++axis) {
        for (const bool upper : {false, true}) {
          if (axis == 2 && !upper) continue;  // it stands on that side
          for (double a = 0.05; a < 1.0; a += 0.1) {
            for (double b = 0.05; b < 1.0; b += 0.1) {
              Eigen::Vector3d share;
              share[axis] = upper ? 1.0 : 0.0;
              share[(axis + 1) % 3] = a;
              share[(axis + 2) % 3] = b;
              const Eigen::Vector3d p = thing.box.min() + share.cwiseProduct(thing.box.sizes());
              ++all;
              covered += std::any_of(occupied.begin(), occupied.end(), [&](const Eigen::Vector3d& q) {
                return (p - q).cwiseAbs().maxCoeff() <= 0.016;
              });
            }
          }
        }
      }
    }
    return static_cast<double>(covered) / all;
  }
  [[nodiscard]] std::string text() const {
    std::ostringstream out;
    out.precision(17);
    for (const ExplorationStep& s : steps) {
      out << s.step << ' ' << toString(s.kind) << ' ' << s.entropy << ' ' << s.unknown_in_boxes << ' '
          << s.travel;
      for (const auto& c : s.candidates) out << ' ' << c.gain << '/' << c.cost << '/' << c.utility;
      out << '\n';
    }
    return out.str();
  }

  BoxWorld world;
  BoxRobot robot;
  HierarchyMapper mapper;
  ExplorationConfig config;
  std::vector<ExplorationStep> steps;
  std::vector<std::uint64_t> scans;
  ExplorationResult result;
};

BoxWorld oneTable() {
  BoxWorld world = BoxWorld::room();
  world.addTable(0.3, 0.2);
  return world;
}

// Near and useful for its price, and yet not worth a trip.
TEST(ExplorationStep, ChoosesTheMostUsefulOfTheCandidatesWorthATrip) {
  ExplorationStep step;
  const auto add = [&step](double gain, double utility) {
    step.candidates.push_back({.viewpoint = {}, .gain = gain, .cost = gain / utility, .utility = utility});
  };
  add(30.0, 9.0);
  add(80.0, 5.0);
  add(100.0, 4.0);
  add(81.0, 5.0);
  EXPECT_DOUBLE_EQ(step.mostGain(), 100.0);
  step.choose(20.0);
  EXPECT_EQ(step.chosen, 0U);
  step.choose(30.0);  // exceeds
  EXPECT_EQ(step.chosen, 1U);
  step.choose(90.0);
  EXPECT_EQ(step.chosen, 2U);
  step.choose(100.0);
  EXPECT_FALSE(step.chosen);
}

TEST(Explorer, AcquiresTheModelOfATableAndEnds) {
  Exploration exploration(oneTable());
  exploration.run();
  ASSERT_EQ(exploration.result.tables.size(), 1U);
  EXPECT_EQ(exploration.result.tables.begin()->second, TableOutcome::explored);
  EXPECT_EQ(exploration.count(StepKind::look_around), 8U);
  EXPECT_EQ(exploration.count(StepKind::first_view), 1U);
  EXPECT_EQ(exploration.count(StepKind::explored), 1U);
  EXPECT_GT(exploration.coverage(), 0.95);
  EXPECT_LE(exploration.count(StepKind::view), 8U);
  EXPECT_EQ(exploration.scans.size(), exploration.result.measurements);
  for (std::size_t i = 0; i < exploration.scans.size(); ++i) EXPECT_EQ(exploration.scans[i], i);
}

TEST(Explorer, GoesWhereTheUtilityIsLargest) {
  Exploration exploration(oneTable());
  exploration.run();
  std::size_t chosen = 0;
  for (const ExplorationStep& step : exploration.steps) {
    if (step.kind != StepKind::view && step.kind != StepKind::first_view) continue;
    const auto& v = step.candidates.at(step.chosen.value());
    ++chosen;
    for (const auto& other : step.candidates) {
      EXPECT_LE(other.utility, v.utility);
      EXPECT_DOUBLE_EQ(other.utility, other.gain / other.cost);
    }
    EXPECT_NEAR(v.cost, 3.0 + step.travel / 0.5, 0.3);
    EXPECT_EQ(step.path.back(), Eigen::Vector2d(v.viewpoint.world_T_base.x(), v.viewpoint.world_T_base.y()));
  }
  EXPECT_GE(chosen, 3U);
}

TEST(Explorer, TheSameSeedGivesTheSameSteps) {
  Exploration a(oneTable());
  Exploration b(oneTable());
  Exploration c(oneTable());
  c.config.seed = 99;
  a.run();
  b.run();
  c.run();
  EXPECT_EQ(a.text(), b.text());
  EXPECT_NE(a.text(), c.text());
}

TEST(Explorer, ThePapersGainAndUtilityWorkToo) {
  Exploration exploration(oneTable());
  exploration.config.gain.measure = GainMeasure::entropy;
  exploration.config.gain.unknown_space = UnknownSpace::transparent;
  exploration.config.utility = UtilityForm::additive;
  exploration.config.alpha = 0.9;
  exploration.run();
  EXPECT_EQ(exploration.result.tables.begin()->second, TableOutcome::explored);
  EXPECT_GT(exploration.coverage(), 0.9);
}

TEST(Explorer, AFailedMoveIsDroppedAndExplorationGoesOn) {
  Exploration exploration(oneTable());
  std::optional<Eigen::Vector2d> first_goal;
  exploration.robot.refuses = [&first_goal](const Eigen::Vector2d& place) {
    if (!first_goal) first_goal = place;
    return (place - *first_goal).norm() < 0.5;
  };
  exploration.run();
  EXPECT_GE(exploration.count(StepKind::move_failed), 1U);
  EXPECT_EQ(exploration.result.tables.begin()->second, TableOutcome::explored);
  std::vector<Eigen::Vector2d> failed;
  for (const ExplorationStep& step : exploration.steps) {
    if (!step.chosen || step.path.empty()) continue;
    for (const auto& place : failed)
      EXPECT_GT((step.path.back() - place).norm(), 0.3) << "it was tried again";
    if (step.kind == StepKind::move_failed) {
      failed.push_back(step.path.back());
      EXPECT_FALSE(step.scan);
    }
  }
  EXPECT_GT(exploration.coverage(), 0.6);
}

TEST(Explorer, AWayThatEndsSomewhereIsNotTriedAgain) {
  Exploration exploration(oneTable());
  exploration.robot.stops = [](const Eigen::Vector2d& place) {
    return (place - Eigen::Vector2d(0.3, -0.9)).norm() < 0.25;  // of something that its camera does not see
  };
  exploration.run();
  EXPECT_EQ(exploration.result.tables.begin()->second, TableOutcome::explored);
  EXPECT_LE(exploration.count(StepKind::move_failed), 8U);
  EXPECT_GT(exploration.coverage(), 0.9);
}

TEST(Explorer, ARobotThatGetsNowhereEnds) {
  Exploration exploration(oneTable());
  exploration.robot.refuses = [](const Eigen::Vector2d&) { return true; };
  exploration.run();
  ASSERT_EQ(exploration.result.tables.size(), 1U);
  EXPECT_EQ(exploration.result.tables.begin()->second, TableOutcome::unreachable);
  EXPECT_LT(exploration.robot.drives, 20);
}

TEST(Explorer, ATableBehindALowWallCannotBeReached) {
  BoxWorld world = BoxWorld::room();
  world.addTable(1.8, 1.8);
  // High enough to keep the robot out, low enough to look over; further from the table than the camera's
  // range.
  world.add(labels::background, testing::box(-3, -1.2, 0, 3, -1.15, 0.5));
  Exploration exploration(world, {-2.4, -2.2});
  exploration.config.traversability.unknown_is_free = false;
  exploration.run();
  for (const auto& [id, outcome] : exploration.result.tables) EXPECT_NE(outcome, TableOutcome::out_of_views);
  EXPECT_LT(exploration.steps.size(), 40U);
  for (const ExplorationStep& step : exploration.steps) {
    if (step.path.empty()) continue;
    EXPECT_LT(step.path.back().y(), -1.2) << "through the wall";
  }
}

TEST(Explorer, TheNearestOfTwoTablesComesFirst) {
  BoxWorld world = BoxWorld::room();
  world.addTable(1.7, 1.6);
  world.addTable(-1.2, -0.6);
  Exploration exploration(world, {-2.2, -2.0});
  exploration.run();
  ASSERT_EQ(exploration.result.tables.size(), 2U);
  for (const auto& [id, outcome] : exploration.result.tables) EXPECT_EQ(outcome, TableOutcome::explored);
  const auto first = std::find_if(exploration.steps.begin(), exploration.steps.end(),
                                  [](const ExplorationStep& s) { return s.table.has_value(); });
  EXPECT_LT(exploration.mapper.hierarchy().world_T_node(*first->table).x(), 0.0);
  EXPECT_GT(exploration.coverage(), 0.95);
}

TEST(Explorer, ARoomWithoutTables) {
  Exploration exploration(BoxWorld::room());
  exploration.run();
  EXPECT_TRUE(exploration.result.tables.empty());
  EXPECT_EQ(exploration.result.measurements, 8U);
}

TEST(Explorer, NoMeasurementIsAnError) {
  Exploration exploration(oneTable());
  exploration.robot.blind = true;
  EXPECT_THROW(exploration.run(), InputError);
}

TEST(Explorer, RefusesSenselessSettings) {
  Exploration exploration(oneTable());
  exploration.config.alpha = 2.0;
  EXPECT_THROW(exploration.run(), ConfigError);
}

}  // namespace
}  // namespace hoctomap
