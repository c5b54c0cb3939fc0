// SPDX-License-Identifier: BSD-3-Clause
#include "hoctomap/scenes/SceneConfig.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "SceneSolids.h"
#include "hoctomap/geometry/Errors.h"

namespace hoctomap {
namespace {

constexpr Range kPixels{1, 8192};
constexpr Range kProbability{0.0, 1.0};
constexpr Range kRightAngle{0.0, 90.0};
constexpr Range kScans{1, 100000};

RangeSensorModel readCamera(IniDocument& ini) {
  const std::string s = "camera";
  RangeSensorModel m;
  PinholeCamera& c = m.camera;
  c.width = static_cast<int>(ini.integer(s, "width", c.width, kPixels));
  c.height = static_cast<int>(ini.integer(s, "height", c.height, kPixels));
  c.fx = ini.number(s, "fx", c.fx, kPositive);
  c.fy = ini.number(s, "fy", c.fx, kPositive);
  c.cx = ini.number(s, "cx", 0.5 * (c.width - 1), kAnyNumber);
  c.cy = ini.number(s, "cy", 0.5 * (c.height - 1), kAnyNumber);
  m.min_range = ini.number(s, "min_range", m.min_range, kNotNegative);
  m.max_range = ini.number(s, "max_range", m.max_range, kPositive);
  m.noise_constant = ini.number(s, "noise_constant", m.noise_constant, kNotNegative);
  m.noise_quadratic = ini.number(s, "noise_quadratic", m.noise_quadratic, kNotNegative);
  m.disparity_baseline = ini.number(s, "disparity_baseline", m.disparity_baseline, kPositive);
  m.disparity_step = ini.number(s, "disparity_step", m.disparity_step, kNotNegative);
  m.depth_unit = ini.number(s, "depth_unit", m.depth_unit, kNotNegative);
  m.dropout = ini.number(s, "dropout", m.dropout, kProbability);
  m.grazing_begin = ini.number(s, "grazing_begin", m.grazing_begin, kRightAngle);
  m.grazing_end = ini.number(s, "grazing_end", m.grazing_end, kRightAngle);
  m.edge_jump = ini.number(s, "edge_jump", m.edge_jump, kPositive);
  m.edge_dropout = ini.number(s, "edge_dropout", m.edge_dropout, kProbability);
  m.edge_mixed = ini.number(s, "edge_mixed", m.edge_mixed, kProbability);
  try {
    check(m);  // keys that contradict each other
  } catch (const ConfigError& error) {
    ini.problem(s, "", error.what());
  }
  return m;
}

std::vector<View> readArc(IniDocument& ini, const std::string& s, bool whole_circle) {
  ArcPath arc;
  const auto centre = ini.numbers(s, "centre", {0.0, 0.0}, 2, kAnyNumber);
  arc.centre = {centre[0], centre[1]};
  arc.radius = ini.number(s, "radius", arc.radius, kPositive);
  arc.height = ini.number(s, "height", arc.height, kPositive);
  arc.angle_begin = kDegree * ini.number(s, "angle_begin", -45.0, kAnyNumber);
  if (!whole_circle) arc.angle_end = kDegree * ini.number(s, "angle_end", 45.0, kAnyNumber);
  arc.target = readVector(ini, s, "look_at", {arc.centre.x(), arc.centre.y(), 0.75});
  arc.views = static_cast<int>(ini.integer(s, "views", arc.views, kScans));
  return whole_circle ? circle(arc) : sweep(arc);
}

std::vector<View> readFixed(IniDocument& ini, const std::string& s) {
  const Eigen::Vector3d eye = readVector(ini, s, "eye", {1.3, 0.0, 1.3});
  return {lookAt(eye, readVector(ini, s, "look_at", {0.0, 0.0, 0.75}))};
}

/// The numbers of a key in groups of `size`.
std::vector<std::vector<double>> readGroups(IniDocument& ini, const std::string& s, const std::string& key,
                                            std::size_t size) {
  const auto numbers = ini.numbers(s, key, {}, std::nullopt, kAnyNumber);
  if (numbers.empty() || numbers.size() % size != 0) {
    ini.problem(s, key, "needs a multiple of " + std::to_string(size) + " numbers");
    return {};
  }
  std::vector<std::vector<double>> groups;
  for (auto n = numbers.begin(); n != numbers.end(); n += static_cast<std::ptrdiff_t>(size))
    groups.emplace_back(n, n + static_cast<std::ptrdiff_t>(size));
  return groups;
}

std::vector<View> readPoses(IniDocument& ini, const std::string& s) {
  std::vector<View> views;
  for (const auto& p : readGroups(ini, s, "poses", 6))
    views.push_back(viewOfSensor(Pose(p[0], p[1], p[2], kDegree * p[3], kDegree * p[4], kDegree * p[5])));
  return views;
}

std::vector<View> readBases(IniDocument& ini, const std::string& s) {
  const double height = ini.number(s, "height", 1.3, kPositive);
  const double tilt = kDegree * ini.number(s, "tilt", 25.0, {-90.0, 90.0});
  std::vector<View> views;
  for (const auto& b : readGroups(ini, s, "bases", 3))
    views.push_back(viewOfBase(b[0], b[1], kDegree * b[2], height, tilt));
  return views;
}

std::vector<View> readPath(IniDocument& ini, const std::string& s) {
  const std::string type = ini.choice(s, "type", "arc", {"arc", "circle", "fixed", "poses", "bases"});
  const auto scans = static_cast<std::size_t>(ini.integer(s, "scans_per_view", 1, kScans));
  std::vector<View> views;
  try {
    if (type == "fixed")
      views = readFixed(ini, s);
    else if (type == "poses")
      views = readPoses(ini, s);
    else if (type == "bases")
      views = readBases(ini, s);
    else
      views = readArc(ini, s, type == "circle");
  } catch (const ConfigError& error) {
    ini.problem(s, "", error.what());
  }
  std::vector<View> repeated;
  for (const View& view : views) repeated.insert(repeated.end(), scans, view);
  return repeated;
}

/// @param sensor whose camera and nearest range the robot's are
std::optional<SimulatedRobotConfig> readRobot(IniDocument& ini, const RangeSensorModel& sensor) {
  const std::string s = "robot";
  SimulatedRobotConfig robot;
  RobotModel& m = robot.model;
  m.camera = sensor.camera;
  m.min_range = sensor.min_range;
  m.radius = ini.number(s, "radius", m.radius, kPositive);
  m.height = ini.number(s, "height", m.height, kPositive);
  m.speed = ini.number(s, "speed", m.speed, kPositive);
  m.measuring_time = ini.number(s, "measuring_time", m.measuring_time, kNotNegative);
  m.max_range = ini.number(s, "max_range", std::min(m.max_range, sensor.max_range), kPositive);
  m.min_sensor_height = ini.number(s, "min_sensor_height", m.min_sensor_height, kPositive);
  m.max_sensor_height =
      ini.number(s, "max_sensor_height", std::max(m.max_sensor_height, m.min_sensor_height), kPositive);
  m.min_tilt = kDegree * ini.number(s, "min_tilt", m.min_tilt / kDegree, {-90.0, 90.0});
  m.max_tilt = kDegree * ini.number(s, "max_tilt", 45.0, {-90.0, 90.0});
  const auto start = ini.numbers(s, "start", {0.0, 0.0, 0.0}, 3, kAnyNumber);
  robot.world_T_start = Pose(start[0], start[1], 0.0, kDegree * start[2], 0.0, 0.0);
  robot.body_margin = ini.number(s, "body_margin", robot.body_margin, kNotNegative);
  robot.ground_clearance = ini.number(s, "ground_clearance", robot.ground_clearance, kNotNegative);
  robot.position_error = ini.number(s, "position_error", robot.position_error, kNotNegative);
  robot.heading_error = kDegree * ini.number(s, "heading_error", 0.0, kNotNegative);
  robot.move_failure = ini.number(s, "move_failure", robot.move_failure, kProbability);
  if (!ini.hasSection(s)) return std::nullopt;
  if (!ini.has(s, "start")) ini.problem(s, "start", "a robot needs a start: x y yaw");
  try {
    check(robot);
  } catch (const ConfigError& error) {
    ini.problem(s, "", error.what());
  }
  return robot;
}

std::vector<View> readPaths(IniDocument& ini) {
  std::vector<View> views;
  bool any = ini.hasSection("robot");  // which chooses its own views
  for (const std::string& section : ini.sections()) {
    if (nameAfter("path.", section).empty()) continue;
    any = true;
    const auto more = readPath(ini, section);
    views.insert(views.end(), more.begin(), more.end());
  }
  if (!any) ini.problem("", "", "a scene needs at least one section [path.NAME], or a [robot]");
  return views;
}

std::optional<Eigen::Vector3d> readIfGiven(IniDocument& ini, const std::string& s, const std::string& key) {
  const Eigen::Vector3d value = readVector(ini, s, key, Eigen::Vector3d::Zero());
  return ini.has(s, key) ? std::optional(value) : std::nullopt;
}

SceneEvent readEvent(IniDocument& ini, const std::string& s) {
  SceneEvent event;
  event.scan = static_cast<std::uint64_t>(ini.integer(s, "scan", 0, {0, 1e9}));
  if (!ini.has(s, "scan")) ini.problem(s, "scan", "an event needs a scan");
  event.solid = ini.text(s, "solid", "");
  const std::string action = ini.choice(s, "action", "move", {"appear", "vanish", "move", "swap"});
  if (action == "vanish") event.action = SceneAction::vanish;
  if (action == "swap") {
    event.action = SceneAction::swap;
    event.other = ini.text(s, "with", "");
  }
  if (action == "vanish" || action == "swap") return event;

  event.action = action == "appear" ? SceneAction::appear : SceneAction::move;
  event.position = readIfGiven(ini, s, "position");
  event.yaw_pitch_roll = readIfGiven(ini, s, "orientation");
  if (event.yaw_pitch_roll) *event.yaw_pitch_roll *= kDegree;
  if (const std::string on = ini.text(s, "on", ""); !on.empty()) event.support = on;
  return event;
}

/// Tries the events in their order and notes those that make no sense.
SceneScript readScript(IniDocument& ini, Scene scene, std::size_t scans) {
  std::vector<std::pair<std::string, SceneEvent>> named;
  for (const std::string& section : ini.sections())
    if (!nameAfter("event.", section).empty()) named.emplace_back(section, readEvent(ini, section));
  std::stable_sort(named.begin(), named.end(),
                   [](const auto& a, const auto& b) { return a.second.scan < b.second.scan; });

  std::vector<SceneEvent> events;
  for (const auto& [section, event] : named) {
    events.push_back(event);
    if (scans > 0 && event.scan >= scans)
      ini.problem(section, "scan", "there are only " + std::to_string(scans) + " scans");
    try {
      SceneScript({event}).apply(scene, event.scan);
    } catch (const ConfigError& error) {
      ini.problem(section, "", error.what());
    }
  }
  return SceneScript(std::move(events));
}

}  // namespace

Simulation readScene(IniDocument& ini, const std::filesystem::path& mesh_folder) {
  Simulation simulation;
  const std::string s = "simulation";
  simulation.seed = static_cast<std::uint64_t>(ini.integer(s, "seed", 1, {0, 9e15}));
  simulation.start_stamp = ini.number(s, "start_stamp", simulation.start_stamp, {0.0, 4e9});
  simulation.scan_period = ini.number(s, "scan_period", simulation.scan_period, kPositive);
  simulation.sensor_label = ini.text("camera", "label", simulation.sensor_label);
  simulation.sensor = readCamera(ini);
  simulation.scene = readSolids(ini, mesh_folder);
  simulation.robot = readRobot(ini, simulation.sensor);
  simulation.views = readPaths(ini);
  simulation.script = readScript(ini, simulation.scene, simulation.views.size());
  return simulation;
}

Simulation loadScene(const std::filesystem::path& path, const std::vector<std::string>& assignments) {
  IniDocument ini = IniDocument::fromFile(path);
  for (const std::string& assignment : assignments) ini.set(assignment);
  Simulation simulation = readScene(ini, path.parent_path());
  ini.finish();
  return simulation;
}

}  // namespace hoctomap
