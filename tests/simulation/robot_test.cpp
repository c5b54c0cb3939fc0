// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>

#include "SmallScenes.h"
#include "hoctomap/geometry/Errors.h"
#include "hoctomap/simulation/SimulatedRobot.h"

namespace hoctomap::test {
namespace {

using Way = std::vector<Eigen::Vector2d>;

/// The table scene (table of 0.8 x 1.0 m at (1, 0)) with a robot at (-1, 0) that faces it.
Simulation robotSimulation() {
  Simulation simulation = tableSimulation();
  simulation.views.clear();
  simulation.robot.emplace();
  simulation.robot->model.camera = simulation.sensor.camera;
  simulation.robot->world_T_start = at(-1.0, 0.0, 0.0);
  return simulation;
}

Viewpoint goal(double x, double y, double yaw = 0.0) {
  return viewOfBase(x, y, yaw, 1.3, 0.4);
}

Measurement measure(SimulatedRobot& robot) {
  return std::get<Measurement>(robot.next().value());
}

double distance(const Pose& a, const Pose& b) {
  return std::hypot(a.x() - b.x(), a.y() - b.y());
}

TEST(FloorPlan, FitsWhereADiscMeetsNothing) {
  const TableScene t = tableScene();
  constexpr double kRadius = 0.3;
  const FloorPlan plan(t.scene, kRadius, 0.1, 1.5);
  const FloorPlan low(t.scene, kRadius, 0.1, 0.5);  // goes under the table, not through its legs
  // The table covers x 0.6 to 1.4, y -0.5 to 0.5; cells are of 2 cm.
  for (double x = -2.0; x < 2.0; x += 0.09)
    for (double y = -2.0; y < 2.0; y += 0.09) {
      const double beside = std::hypot(std::max({0.6 - x, x - 1.4, 0.0}), std::max({-0.5 - y, y - 0.5, 0.0}));
      if (std::abs(beside - kRadius) < 0.045) continue;
      EXPECT_EQ(plan.fits({x, y}), beside > kRadius) << x << " " << y;
    }
  EXPECT_TRUE(low.fits({1.0, 0.0}));
  EXPECT_FALSE(low.fits({0.65, 0.45}));
  EXPECT_FALSE(plan.fits({3.1, 0.0}));  // no floor there
}

TEST(FloorPlan, ReachesWhatNothingShutsOff) {
  TableScene t = tableScene();
  for (const double y : {-0.8, 0.8})  // a corridor, shut by the table: its way out is 0.3 m wide on each side
    t.scene.add(
        makeSolid(y < 0 ? "south" : "north", SolidLabel::background, BoxShape{{6, 0.1, 2}}, at(0, y, 0)));
  const FloorPlan plan(t.scene, 0.2, 0.1, 1.5);
  const auto places = plan.reachableFrom({-1.0, 0.0}, 0.1);
  EXPECT_GT(places.size(), 100U);
  for (const Eigen::Vector2d& p : places) {
    EXPECT_LT(p.x(), 0.6);
    EXPECT_LT(std::abs(p.y()), 0.8);
    EXPECT_TRUE(plan.fits(p));
  }
  EXPECT_TRUE(plan.reachableFrom({1.0, 0.0}, 0.1).empty());
}

TEST(SimulatedRobot, ArrivesAndMeasuresFromThere) {
  const Simulation simulation = robotSimulation();
  SimulatedRobot robot(simulation);
  EXPECT_NEAR(robot.world_T_base().x(), -1.0, 1e-12);
  ASSERT_TRUE(robot.moveTo(goal(0.0, 0.8, -0.6), Way{{-1.0, 0.0}, {-0.5, 0.8}, {0.0, 0.8}}));
  EXPECT_NEAR(distance(robot.world_T_base(), goal(0.0, 0.8).world_T_base), 0.0, 1e-12);
  const Measurement z = measure(robot);
  EXPECT_EQ(z.scan, 0U);
  EXPECT_EQ(z.sensor, "RGBD");
  EXPECT_NEAR(z.world_T_sensor.z(), 1.3, 1e-12);
  // What it reports lies on the surfaces of the scene: the floor, or the table and what stands on it.
  ASSERT_GT(z.world_points.size(), 1000U);
  std::size_t on_table = 0;
  for (const auto& p : z.world_points) {
    const bool is_floor = std::abs(p.z()) < 1e-3F;
    on_table += is_floor ? 0U : 1U;
    EXPECT_TRUE(is_floor || (p.x() > 0.59F && p.x() < 1.41F && std::abs(p.y()) < 0.51F)) << p.transpose();
  }
  EXPECT_GT(on_table, 300U);
}

TEST(SimulatedRobot, TimeGoesByDrivingAndMeasuring) {
  Simulation simulation = robotSimulation();
  simulation.robot->model.speed = 0.5;
  simulation.robot->model.measuring_time = 3.0;
  SimulatedRobot robot(simulation);
  const double first = measure(robot).stamp;
  EXPECT_NEAR(first, simulation.start_stamp + 3.0, 0.02);
  ASSERT_TRUE(robot.moveTo(goal(-1.0, 1.0), Way{}));
  const double second = measure(robot).stamp;
  EXPECT_NEAR(second - first, 3.0 + 1.0 / 0.5, 0.05);
  for (const double stamp : {first, second}) EXPECT_EQ(stamp * 64.0, std::round(stamp * 64.0));
}

TEST(SimulatedRobot, StopsBeforeWhatIsInItsWay) {
  SimulatedRobot robot(robotSimulation());
  EXPECT_FALSE(robot.moveTo(goal(2.5, 0.0), Way{{-1.0, 0.0}, {2.5, 0.0}}));  // through the table
  EXPECT_GT(robot.world_T_base().x(), 0.2);
  EXPECT_LT(robot.world_T_base().x(), 0.6 - 0.25);
  EXPECT_NEAR(robot.world_T_base().y(), 0.0, 1e-12);
  EXPECT_TRUE(robot.moveTo(goal(0.0, 1.0), Way{}));  // and can leave
}

TEST(SimulatedRobot, FailsAsOftenAsTold) {
  Simulation simulation = robotSimulation();
  simulation.robot->move_failure = 0.3;
  SimulatedRobot robot(simulation);
  int failed = 0;
  constexpr int kDrives = 2000;
  for (int i = 0; i < kDrives; ++i) {
    const Viewpoint there = goal(-1.0, i % 2 == 0 ? 1.0 : -1.0);
    const Pose before = robot.world_T_base();
    const bool arrived = robot.moveTo(there, Way{});
    failed += arrived ? 0 : 1;
    if (distance(before, there.world_T_base) < 1e-9) continue;  // it had not got away
    EXPECT_EQ(arrived, distance(robot.world_T_base(), there.world_T_base) < 1e-9);
  }
  EXPECT_NEAR(failed, 0.3 * kDrives, 4.0 * std::sqrt(0.3 * 0.7 * kDrives));
}

TEST(SimulatedRobot, BelievesToBeWhereItMeantToGo) {
  Simulation simulation = robotSimulation();
  simulation.robot->position_error = 0.01;
  simulation.robot->heading_error = 0.0175;
  SimulatedRobot robot(simulation);
  double position = 0.0;
  double heading = 0.0;
  constexpr int kDrives = 2000;
  for (int i = 0; i < kDrives; ++i) {
    const Viewpoint there = goal(-1.0, 0.001 * i - 1.0, 0.3);
    ASSERT_TRUE(robot.moveTo(there, Way{}));
    EXPECT_LT(distance(robot.world_T_base(), there.world_T_base), 1e-9);
    const Pose error = -robot.world_T_base() + robot.world_T_trueBase();
    position += 0.5 * (error.x() * error.x() + error.y() * error.y());
    heading += error.yaw() * error.yaw();
    EXPECT_NEAR(error.z(), 0.0, 1e-12);
  }
  EXPECT_NEAR(std::sqrt(position / kDrives), 0.01, 5e-4);
  EXPECT_NEAR(std::sqrt(heading / kDrives), 0.0175, 1e-3);
}

TEST(SimulatedRobot, AnErrorShiftsWhatItSees) {
  Simulation simulation = robotSimulation();
  simulation.robot->position_error = 0.02;
  SimulatedRobot robot(simulation);
  SimulatedRobot sure(robotSimulation());
  const Measurement z = measure(robot);
  const Measurement truth = measure(sure);
  EXPECT_EQ(z.world_T_sensor.asString(), truth.world_T_sensor.asString());
  EXPECT_NE(z.image->depth, truth.image->depth);
}

TEST(SimulatedRobot, SameSeedSameBytes) {
  Simulation simulation = robotSimulation();
  simulation.sensor.noise_quadratic = 0.0015;
  simulation.robot->position_error = 0.01;
  simulation.robot->move_failure = 0.2;
  const auto run = [&](std::uint64_t seed, int threads) {
    simulation.seed = seed;
    SimulatedRobot robot(simulation, {}, threads);
    std::vector<float> depths;
    for (int i = 0; i < 5; ++i) {
      (void)robot.moveTo(goal(-1.0 + 0.1 * i, 1.0 - 0.4 * i), Way{});
      const auto depth = measure(robot).image->depth;
      depths.insert(depths.end(), depth.begin(), depth.end());
    }
    return depths;
  };
  EXPECT_EQ(run(3, 1), run(3, 2));
  EXPECT_NE(run(3, 1), run(4, 1));
}

TEST(SimulatedRobot, TheScriptIsDoneByScans) {
  Simulation simulation = robotSimulation();
  simulation.script = SceneScript({SceneEvent{.scan = 1, .action = SceneAction::vanish, .solid = "table"}});
  SimulatedRobot robot(simulation);
  const auto high = [](const Measurement& z) {
    return std::count_if(z.world_points.begin(), z.world_points.end(),
                         [](const auto& p) { return p.z() > 0.6F; });
  };
  EXPECT_GT(high(measure(robot)), 100);
  EXPECT_EQ(high(measure(robot)), 0);
  EXPECT_TRUE(robot.moveTo(goal(2.5, 0.0), Way{}));  // nothing is in the way any more
}

TEST(SimulatedRobot, WithoutARobotOrSenseIsRefused) {
  EXPECT_THROW(SimulatedRobot{tableSimulation()}, ConfigError);
  const auto refused = [](const std::function<void(SimulatedRobotConfig&)>& spoil) {
    Simulation simulation = robotSimulation();
    spoil(*simulation.robot);
    EXPECT_THROW(SimulatedRobot{simulation}, ConfigError);
  };
  refused([](auto& r) { r.model.radius = 0.0; });
  refused([](auto& r) { r.model.max_sensor_height = 0.5; });
  refused([](auto& r) { r.model.max_range = 0.1; });
  refused([](auto& r) { r.model.max_tilt = -0.1; });
  refused([](auto& r) { r.body_margin = 0.4; });
  refused([](auto& r) { r.move_failure = 1.5; });
  refused([](auto& r) { r.position_error = -1.0; });
}

}  // namespace
}  // namespace hoctomap::test
