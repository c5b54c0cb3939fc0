// SPDX-License-Identifier: BSD-3-Clause
#include "hoctomap/scenes/SceneConfig.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <string>

#include "hoctomap/geometry/Errors.h"
#include "hoctomap/simulation/FloorPlan.h"
#include "hoctomap/simulation/SurfaceCoverage.h"
#include "support/SharedData.h"

namespace hoctomap::test {
namespace {

constexpr const char* kMinimal = R"(
[solid.floor]
label = background
size = 4 4 0.1
position = 0 0 -0.1
[path.p]
views = 3
)";

Simulation read(const std::string& text) {
  IniDocument ini = IniDocument::fromText(text, "scene.ini");
  Simulation simulation = readScene(ini, ".");
  ini.finish();
  return simulation;
}

/// All that is wrong with a scene; empty if nothing is.
std::string problems(const std::string& text) {
  try {
    (void)read(text);
    return "";
  } catch (const ConfigError& error) {
    return error.what();
  }
}

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

TEST(SceneConfig, ReadsEverySectionKind) {
  const Simulation s = read(std::string(kMinimal) + R"(
[simulation]
seed = 9
scan_period = 0.1
[camera]
label = KINECT
width = 320
height = 240
fx = 262
noise_quadratic = 0.002
[solid.table]
label = table
shape = table
size = 0.8 1.2
height = 0.7
position = 1 0 0
orientation = 90 0 0
[solid.cup]
shape = turned
profile = 0.03 0, 0.04 0.1
wall = 0.003
on = table
position = 0.1 0.2 0
[solid.lid]
part_of = cup
shape = cylinder
radius = 0.04
height = 0.01
position = 0 0 0.1
[path.q]
type = bases
bases = 0 0 0  1 1 90
scans_per_view = 2
[event.e]
scan = 4
action = move
solid = cup
orientation = 45 0 0
)");
  EXPECT_EQ(s.seed, 9U);
  EXPECT_EQ(s.sensor_label, "KINECT");
  EXPECT_EQ(s.sensor.camera.width, 320);
  EXPECT_DOUBLE_EQ(s.sensor.camera.fy, 262.0);
  EXPECT_DOUBLE_EQ(s.sensor.camera.cx, 159.5);
  EXPECT_EQ(s.views.size(), 3U + 4U);
  EXPECT_EQ(s.scene.size(), 3U);  // the lid is a part of the cup

  const SolidId cup = s.scene.find("cup").value();
  EXPECT_NEAR(s.scene.solid(cup).top, 0.11, 1e-6);
  EXPECT_NEAR(s.scene.world_T_solid(cup).x(), 0.8, 1e-9);  // 1 - 0.2: the table is turned by 90 degrees
  EXPECT_NEAR(s.scene.world_T_solid(cup).y(), 0.1, 1e-9);
  EXPECT_NEAR(s.scene.world_T_solid(cup).z(), 0.7, 1e-6);
  const Pose turned = s.script.at(s.scene, 4).world_T_solid(cup);
  EXPECT_NEAR(turned.yaw(), (90 + 45) * 3.14159265358979 / 180.0, 1e-9);
}

TEST(SceneConfig, AllProblemsAreReportedTogether) {
  const std::string found = problems(R"(
[camera]
width = 12junk
max_range = 0.1
[solid.floor]
label = carpet
size = 1 1
colour = red
[solid.cup]
shape = turned
profile = 0.1 0.2 0.1 0.1
on = nothing
[solid.mesh]
shape = mesh
file = not_there.stl
[path.p]
type = poses
poses = 1 2 3
[event.e]
scan = 0
solid = nobody
action = vanish
[extra]
key = 1
)");
  for (const char* part : {"12junk", "max_range", "carpet", "colour", "bottom up", "nothing", "not_there.stl",
                           "multiple of 6", "nobody", "[extra]"})
    EXPECT_TRUE(contains(found, part)) << part << " in:\n" << found;
}

TEST(SceneConfig, OneMistakeIsOneProblem) {
  const std::string found = problems(std::string(kMinimal) + R"(
[solid.table]
label = table
shape = table
height = 0.01
[solid.cup]
on = table
)");
  EXPECT_TRUE(contains(found, "[solid.table]")) << found;
  EXPECT_FALSE(contains(found, "[solid.cup]")) << found;
}

TEST(SceneConfig, ContradictionsAreProblems) {
  EXPECT_EQ(problems(kMinimal), "");
  EXPECT_TRUE(contains(problems(""), "[solid.NAME]"));
  EXPECT_TRUE(contains(problems(""), "[path.NAME]"));
  const std::string base = kMinimal;
  EXPECT_TRUE(contains(problems(base + "[event.e]\nscan=3\naction=vanish\nsolid=floor\n"), "only 3 scans"));
  EXPECT_TRUE(contains(problems(base + "[event.e]\naction=vanish\nsolid=floor\n"), "needs a scan"));
  EXPECT_TRUE(contains(problems(base + "[event.e]\nscan=1\nsolid=floor\n"), "a move needs"));
  EXPECT_TRUE(contains(problems(base + "[solid.a b]\n"), "letters, digits"));
  EXPECT_TRUE(contains(problems(base + "[solid.a]\npart_of=b\n"), "no solid 'b'"));
  EXPECT_TRUE(contains(problems(base + "[path.q]\ntype=fixed\neye=0 0 2\nlook_at=0 0 0\n"), "straight"));
  EXPECT_TRUE(contains(problems(base + "[solid.a]\nshape=turned\nprofile=0.1 0 0.1\n"), "pairs"));
}

TEST(SceneConfig, AssignmentsChangeAFile) {
  const auto file = sourceDir() / "configs/scenes/demo.ini";
  EXPECT_EQ(loadScene(file, {"path.sweep.views=2"}).views.size(), 2U);
  EXPECT_THROW((void)loadScene(file, {"path.sweep.veiws=2"}), ConfigError);
}

// What ships.

/// An object grown by `half_gap` to all sides lies within its table and meets no other grown object.
void expectObjectsApart(const Scene& scene, double half_gap) {
  std::vector<std::pair<std::string, std::vector<Eigen::Vector3d>>> points;
  for (const SolidId id : scene.ids()) {
    const Solid& solid = scene.solid(id);
    if (solid.label != SolidLabel::object || !solid.support) continue;
    const Solid& table = scene.solid(*solid.support);
    const auto top = surfaceExtent(*table.surface, Eigen::Isometry3d::Identity()).box;
    const Eigen::Isometry3d table_T_solid = toIsometry(solid.support_T_solid);
    const Eigen::Isometry3d world_T_solid = toIsometry(scene.world_T_solid(id));
    auto& list = points.emplace_back(solid.name, std::vector<Eigen::Vector3d>{}).second;
    for (const auto& t : solid.surface->triangles)
      for (const double a : {0.0, 0.25, 0.5, 0.75, 1.0})  // along the edges: corners alone are too few
        for (unsigned i = 0; i < 3; ++i) {
          const Eigen::Vector3d p = (1.0 - a) * solid.surface->vertices[t[i]].cast<double>() +
                                    a * solid.surface->vertices[t[(i + 1) % 3]].cast<double>();
          list.push_back(world_T_solid * p);
          const Eigen::Vector3d on_table = table_T_solid * p;
          ASSERT_LT(std::abs(on_table.x()), top.max().x() - half_gap) << solid.name;
          ASSERT_LT(std::abs(on_table.y()), top.max().y() - half_gap) << solid.name;
        }
  }
  // Cells of half a gap in plan: two objects in cells nearer than three apart could be nearer than a gap.
  std::map<std::pair<long, long>, std::set<std::string>> cells;
  for (const auto& [name, list] : points)
    for (const auto& p : list)
      cells[{std::lround(p.x() / half_gap), std::lround(p.y() / half_gap)}].insert(name);
  for (const auto& [cell, names] : cells)
    for (long dx = -2; dx <= 2; ++dx)
      for (long dy = -2; dy <= 2; ++dy) {
        const auto other = cells.find({cell.first + dx, cell.second + dy});
        if (other == cells.end()) continue;
        std::set<std::string> both = names;
        both.insert(other->second.begin(), other->second.end());
        ASSERT_EQ(both.size(), 1U) << *both.begin() << " and " << *both.rbegin() << " are too near";
      }
}

class ShippedScene : public testing::TestWithParam<const char*> {
 protected:
  /// The scene with a quarter of the pixels each way, without noise: enough to see what is visible.
  [[nodiscard]] static Simulation coarse() {
    Simulation s = loadScene(sourceDir() / "configs/scenes" / (std::string(GetParam()) + ".ini"));
    const int reduction = s.sensor.camera.width > 200 ? 4 : 1;
    PinholeCamera& c = s.sensor.camera;
    c = {c.width / reduction,
         c.height / reduction,
         c.fx / reduction,
         c.fy / reduction,
         0.5 * (c.width / reduction - 1),
         0.5 * (c.height / reduction - 1)};
    s.sensor = ideal(s.sensor);
    return s;
  }
};

TEST_P(ShippedScene, EveryObjectIsVisibleInAtLeastThreeViews) {
  const Simulation simulation = coarse();
  std::map<std::uint16_t, int> views;
  simulateScene(simulation, 2, [&](const SimulatedScan& scan) {
    std::map<std::uint16_t, int> pixels;
    for (const std::uint16_t label : scan.labels) ++pixels[label];
    for (const auto& [label, count] : pixels)
      if (count >= 15) ++views[label];
  });
  for (const SolidId id : simulation.scene.ids())
    EXPECT_GE(views[simulation.scene.pixelValue(id)], 3) << simulation.scene.solid(id).name;
}

TEST_P(ShippedScene, ObjectsStandApartAndWithinTheirTable) {
  const Simulation simulation = coarse();
  expectObjectsApart(simulation.script.at(simulation.scene, simulation.views.size()), 0.02);
}

TEST_P(ShippedScene, TablesStandWhereTablesAreLookedFor) {
  const Simulation simulation = coarse();
  int tables = 0;
  for (const SolidId id : simulation.scene.ids()) {
    if (simulation.scene.solid(id).label != SolidLabel::table) continue;
    ++tables;
    EXPECT_GE(simulation.scene.solid(id).top, 0.6999);
    EXPECT_LE(simulation.scene.solid(id).top, 0.7501);
  }
  EXPECT_EQ(tables, std::string(GetParam()) == "room" ? 2 : 1);
}

INSTANTIATE_TEST_SUITE_P(All, ShippedScene,
                         testing::Values("small_objects", "big_objects", "occlusion", "room", "demo"),
                         [](const auto& scene) { return std::string(scene.param); });

class ExplorationScene : public testing::TestWithParam<const char*> {
 protected:
  Simulation simulation_ = loadScene(sourceDir() / "configs/scenes" / (std::string(GetParam()) + ".ini"));
};

TEST_P(ExplorationScene, ARobotCanStandAtItsStartAndSeeEveryObject) {
  ASSERT_TRUE(simulation_.robot);
  EXPECT_TRUE(simulation_.views.empty());
  const RobotModel& model = simulation_.robot->model;
  EXPECT_EQ(model.camera.width, simulation_.sensor.camera.width);
  const FloorPlan plan(simulation_.scene, model.radius, simulation_.robot->ground_clearance, model.height);
  EXPECT_TRUE(plan.fits({simulation_.robot->world_T_start.x(), simulation_.robot->world_T_start.y()}));
  CoverageConfig coarse;
  coarse.sample_spacing = 0.01;
  const SurfaceCoverage coverage(simulation_.scene, *simulation_.robot, coarse);
  EXPECT_GE(coverage.objects().size(), 10U);
  for (const auto& object : coverage.objects())
    EXPECT_GT(3 * object.world_visible.size(), object.samples) << object.name;
}

TEST_P(ExplorationScene, ObjectsStandApartAndWithinTheirTable) {
  expectObjectsApart(simulation_.scene, 0.012);
}

INSTANTIATE_TEST_SUITE_P(All, ExplorationScene,
                         testing::Values("explore_table", "explore_two_tables", "explore_wall",
                                         "explore_cluttered"),
                         [](const auto& scene) { return std::string(scene.param); });

TEST(SceneConfig, ARobotIsReadInMetresAndDegrees) {
  const std::string base =
      "[solid.floor]\nlabel=background\nsize=4 4 0.1\nposition=0 0 -0.1\n[camera]\nmax_range=3\n";
  const Simulation s = read(base + R"(
[robot]
start = 1 -0.5 90
radius = 0.3
min_sensor_height = 1.1
max_sensor_height = 1.5
max_tilt = 60
position_error = 0.01
heading_error = 1
move_failure = 0.2
)");
  ASSERT_TRUE(s.robot);
  const SimulatedRobotConfig& robot = *s.robot;
  EXPECT_NEAR(robot.world_T_start.x(), 1.0, 1e-12);
  EXPECT_NEAR(robot.world_T_start.yaw(), 1.5707963, 1e-6);
  EXPECT_DOUBLE_EQ(robot.model.radius, 0.3);
  EXPECT_DOUBLE_EQ(robot.model.min_range, s.sensor.min_range);
  EXPECT_DOUBLE_EQ(robot.model.max_range, 3.0);  // no farther than the camera
  EXPECT_NEAR(robot.model.max_tilt, 1.0471976, 1e-6);
  EXPECT_NEAR(robot.heading_error, 0.0174533, 1e-6);
  EXPECT_DOUBLE_EQ(robot.move_failure, 0.2);
  EXPECT_FALSE(read(kMinimal).robot);

  EXPECT_TRUE(contains(problems(base + "[robot]\nradius=0.3\n"), "needs a start"));
  EXPECT_TRUE(
      contains(problems(base + "[robot]\nstart=0 0 0\nmax_sensor_height=0.5\n"), "max_sensor_height"));
  EXPECT_TRUE(contains(problems(base + "[robot]\nstart=0 0 0\nmove_failure=2\n"), "move_failure"));
}

TEST(OcclusionScene, HasTheThreeStages) {
  const Simulation s = loadScene(sourceDir() / "configs/scenes/occlusion.ini");
  const SolidId a = s.scene.find("power_supply").value();
  const SolidId b = s.scene.find("tube").value();
  std::map<int, long> seen_a;
  std::map<int, long> seen_b;
  Simulation few = s;
  few.sensor = ideal(few.sensor);
  simulateScene(few, 2, [&](const SimulatedScan& scan) {
    const int stage = static_cast<int>(scan.scan / 4);
    seen_a[stage] = std::count(scan.labels.begin(), scan.labels.end(), s.scene.pixelValue(a));
    seen_b[stage] = std::count(scan.labels.begin(), scan.labels.end(), s.scene.pixelValue(b));
  });
  EXPECT_GT(seen_a[0], 1000);
  EXPECT_EQ(seen_b[0], 0);
  EXPECT_GT(seen_b[1], 1000);
  EXPECT_GT(seen_a[1], seen_a[0] / 4);      // partly hidden: neither whole
  EXPECT_LT(seen_a[1], seen_a[0] * 3 / 4);  // nor hardly touched
  EXPECT_EQ(seen_a[2], 0);
  EXPECT_EQ(seen_b[2], seen_b[1]);
}

}  // namespace
}  // namespace hoctomap::test
