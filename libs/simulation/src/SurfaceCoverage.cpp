// SPDX-License-Identifier: BSD-3-Clause
#include "hoctomap/simulation/SurfaceCoverage.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "SurfaceSamples.h"
#include "hoctomap/simulation/FloorPlan.h"
#include "hoctomap/simulation/SceneRaycaster.h"

namespace hoctomap {
namespace {

std::optional<SolidId> tableUnder(const Scene& scene, SolidId object) {
  for (auto s = scene.solid(object).support; s; s = scene.solid(*s).support)
    if (scene.solid(*s).label == SolidLabel::table) return s;
  return std::nullopt;
}

/// From the upright box around a table in its own frame, in the plan.
double distanceToTable(const Scene& scene, SolidId table, const Eigen::Vector2d& place) {
  const auto box = surfaceExtent(*scene.solid(table).surface, Eigen::Isometry3d::Identity()).box;
  const Eigen::Vector3d p =
      toIsometry(scene.world_T_solid(table)).inverse() * Eigen::Vector3d(place.x(), place.y(), 0.0);
  const Eigen::Vector2d beyond =
      (p.head<2>() - box.center().head<2>()).cwiseAbs() - 0.5 * box.sizes().head<2>();
  return beyond.cwiseMax(0.0).norm();
}

/// Where the camera can be near a table.
std::vector<Eigen::Vector3d> camerasAround(const Scene& scene, SolidId table,
                                           const std::vector<Eigen::Vector2d>& places,
                                           const RobotModel& robot, const CoverageConfig& config) {
  const double lift = robot.max_sensor_height - robot.min_sensor_height;
  const auto heights = static_cast<int>(std::ceil(lift / config.height_spacing)) + 1;
  std::vector<Eigen::Vector3d> cameras;
  for (const Eigen::Vector2d& place : places) {
    if (distanceToTable(scene, table, place) > config.radius) continue;
    for (int h = 0; h < heights; ++h) {
      const double share = heights == 1 ? 0.0 : static_cast<double>(h) / (heights - 1);
      cameras.emplace_back(place.x(), place.y(), robot.min_sensor_height + share * lift);
    }
  }
  return cameras;
}

bool sees(const SceneRaycaster& scene, const Eigen::Vector3d& camera, const SurfaceSample& sample,
          const RobotModel& robot, const CoverageConfig& config) {
  const Eigen::Vector3d beam = sample.point - camera;
  const double distance = beam.norm();
  if (distance > config.max_distance || distance < robot.min_range) return false;
  if (std::abs(beam.dot(sample.normal)) < distance * std::cos(config.max_incidence)) return false;
  constexpr double kOnIt = 5e-5;  // m: of surfaces that are flat to 1e-5
  const auto hit = scene.cast(camera, beam);
  return hit && std::abs(hit->t - 1.0) * distance < kOnIt;
}

/// The tree of a node and how to get into its frame.
struct MappedNode {
  const NodeMap* map;
  Eigen::Isometry3d node_T_world;
  Eigen::AlignedBox3d node_box;  ///< of occupied voxels
};

std::vector<MappedNode> nodesOf(const MapHierarchy& hierarchy) {
  std::vector<MappedNode> nodes;
  for (const NodeId id : hierarchy.ids()) {
    const MapNode& node = hierarchy.node(id);
    if (node.label() == labels::background || (node.confirmation.waits && !node.confirmation.enough))
      continue;
    nodes.push_back(
        {&node.map(), toIsometry(hierarchy.world_T_node(id)).inverse(), node.map().occupiedBox()});
  }
  return nodes;
}

/// True if an occupied voxel's cube is no farther away than `tolerance`.
bool holds(const MappedNode& node, const Eigen::Vector3d& world_point, double tolerance) {
  const Eigen::Vector3d p = node.node_T_world * world_point;
  if (node.node_box.isEmpty() || node.node_box.exteriorDistance(p) > tolerance) return false;
  const octomap::OcTree& tree = node.map->tree();
  const auto isOccupied = [&](const Eigen::Vector3d& q) {
    const auto* leaf = tree.search(q.x(), q.y(), q.z());
    return leaf != nullptr && tree.isNodeOccupied(leaf);
  };
  if (isOccupied(p)) return true;
  const double r = tree.getResolution();
  const int reach = static_cast<int>(std::ceil(tolerance / r));
  const Eigen::Vector3d low = (p / r).array().floor() * r;  // of the cube that the point is in
  for (int z = -reach; z <= reach; ++z)
    for (int y = -reach; y <= reach; ++y)
      for (int x = -reach; x <= reach; ++x) {
        const Eigen::Vector3d corner = low + r * Eigen::Vector3d(x, y, z);
        const Eigen::AlignedBox3d cube(corner, corner + Eigen::Vector3d::Constant(r));
        if (cube.exteriorDistance(p) <= tolerance && isOccupied(cube.center())) return true;
      }
  return false;
}

}  // namespace

double SurfaceCoverage::Share::value() const {
  return visible == 0 ? 1.0 : static_cast<double>(covered) / static_cast<double>(visible);
}

SurfaceCoverage::SurfaceCoverage(const Scene& scene, const SimulatedRobotConfig& robot,
                                 const CoverageConfig& config) {
  const FloorPlan plan(scene, robot.model.radius - robot.body_margin, robot.ground_clearance,
                       robot.model.height);
  const auto places =
      plan.reachableFrom({robot.world_T_start.x(), robot.world_T_start.y()}, config.place_spacing);
  const SceneRaycaster raycaster(scene);
  for (const SolidId id : scene.ids()) {
    const auto table = tableUnder(scene, id);
    if (!table || !scene.present(id) || scene.solid(id).label != SolidLabel::object) continue;
    const auto cameras = camerasAround(scene, *table, places, robot.model, config);
    const auto samples =
        sampleSurface(*scene.solid(id).surface, toIsometry(scene.world_T_solid(id)), config.sample_spacing);
    Object object{id, scene.solid(id).name, *table, {}, samples.size()};
    for (const SurfaceSample& sample : samples)
      if (std::any_of(cameras.begin(), cameras.end(), [&](const Eigen::Vector3d& camera) {
            return sees(raycaster, camera, sample, robot.model, config);
          }))
        object.world_visible.push_back(sample.point);
    objects_.push_back(std::move(object));
  }
}

SurfaceCoverage::Result SurfaceCoverage::of(const MapHierarchy& map, double tolerance) const {
  const auto nodes = nodesOf(map);
  Result result;
  for (const Object& object : objects_) {
    Share share{object.world_visible.size(), 0};
    for (const Eigen::Vector3d& point : object.world_visible)
      if (std::any_of(nodes.begin(), nodes.end(),
                      [&](const MappedNode& node) { return holds(node, point, tolerance); }))
        ++share.covered;
    result.objects.push_back(share);
    result.all += share;
  }
  return result;
}

SurfaceCoverage::Share SurfaceCoverage::ofTable(const Result& result, SolidId table) const {
  Share share;
  for (std::size_t i = 0; i < objects_.size(); ++i)
    if (objects_[i].table == table) share += result.objects[i];
  return share;
}

}  // namespace hoctomap
