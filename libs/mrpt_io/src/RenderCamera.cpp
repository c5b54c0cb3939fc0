// SPDX-License-Identifier: BSD-3-Clause
#include "RenderCamera.h"

#include <mrpt/core/bits_math.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <locale>
#include <optional>
#include <sstream>
#include <utility>

#include "hoctomap/geometry/Errors.h"
#include "hoctomap/mrpt_io/RenderMap.h"

namespace hoctomap {
namespace {

using mrpt::DEG2RAD;

Eigen::Vector3d direction(double azimuth, double elevation) {
  const double a = DEG2RAD(azimuth);
  const double e = DEG2RAD(elevation);
  return {std::cos(e) * std::cos(a), std::cos(e) * std::sin(a), std::sin(e)};
}

/// World corners of what should fill the picture.
std::vector<Eigen::Vector3d> corners(const MapHierarchy& hierarchy, const std::set<Label>& hidden) {
  std::vector<Eigen::Vector3d> points;
  for (const NodeId id : hierarchy.ids()) {
    const Obb box = hierarchy.box(id);
    if (box.box.isEmpty() || (id == kRootId && hierarchy.size() > 1)) continue;
    if (hidden.contains(hierarchy.node(id).label())) continue;
    for (int i = 0; i < 8; ++i) {
      points.emplace_back(box.world_T_frame *
                          box.box.corner(static_cast<Eigen::AlignedBox3d::CornerType>(i)));
    }
  }
  if (points.empty()) points.emplace_back(Eigen::Vector3d::Zero());
  return points;
}

/// Distance from which all points are inside the picture.
double distanceFor(const RenderCamera& camera, const std::vector<Eigen::Vector3d>& points, double aspect) {
  const Eigen::Vector3d back = direction(camera.azimuth, camera.elevation);
  const Eigen::Vector3d right = direction(camera.azimuth + 90.0, 0.0);
  const Eigen::Vector3d up = back.cross(right);
  const double slope_y = std::tan(0.5 * DEG2RAD(camera.field_of_view));
  const double slope_x = slope_y * aspect;
  double distance = 0.2;
  for (const Eigen::Vector3d& point : points) {
    const Eigen::Vector3d p = point - camera.target;
    const double needed = std::max(std::abs(p.dot(right)) / slope_x, std::abs(p.dot(up)) / slope_y);
    distance = std::max(distance, needed + p.dot(back));
  }
  return 1.06 * distance;
}

/// Background voxels in the cone between the camera and what it looks at.
std::size_t inTheWay(const MapHierarchy& hierarchy, const RenderCamera& camera, double radius) {
  const Eigen::Vector3d back = direction(camera.azimuth, camera.elevation);
  const PointCloud& voxels = hierarchy.root().map().occupiedVoxels();
  return static_cast<std::size_t>(std::count_if(voxels.begin(), voxels.end(), [&](const auto& voxel) {
    const Eigen::Vector3d p = voxel.template cast<double>() - camera.target;
    const double along = p.dot(back);
    if (along < 0.3 * radius || along > camera.distance) return false;
    return (p - along * back).norm() < radius * (1.0 - along / camera.distance);
  }));
}

/// Azimuth of the side that the tables and objects were seen from, in degrees: free voxels of a node lie
/// between its surface and the sensor. 0 if there are none.
double seenFrom(const MapHierarchy& hierarchy) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const NodeId id : hierarchy.ids()) {
    const octomap::OcTree& tree = hierarchy.node(id).map().tree();
    Eigen::Vector3d occupied = Eigen::Vector3d::Zero();
    Eigen::Vector3d free = Eigen::Vector3d::Zero();
    double occupied_volume = 0.0;
    double free_volume = 0.0;
    if (id == kRootId) continue;
    for (auto leaf = tree.begin_leafs(); leaf != tree.end_leafs(); ++leaf) {
      const double volume = std::pow(leaf.getSize(), 3);
      const Eigen::Vector3d centre(leaf.getX(), leaf.getY(), leaf.getZ());
      const bool is_occupied = tree.isNodeOccupied(*leaf);
      (is_occupied ? occupied : free) += volume * centre;
      (is_occupied ? occupied_volume : free_volume) += volume;
    }
    if (occupied_volume == 0.0 || free_volume == 0.0) continue;
    sum +=
        toIsometry(hierarchy.world_T_node(id)).linear() * (free / free_volume - occupied / occupied_volume);
  }
  return mrpt::RAD2DEG(std::atan2(sum.y(), sum.x()));
}

struct View {
  const char* name;
  double azimuth;
  double elevation;
};
constexpr std::array kViews{View{"front", -90.0, 12.0}, View{"back", 90.0, 12.0}, View{"left", 180.0, 12.0},
                            View{"right", 0.0, 12.0}, View{"top", -90.0, 89.0}};

/// `AZIMUTH,ELEVATION` in degrees.
std::optional<View> parseDirection(const std::string& view) {
  View direction{"", 0.0, 0.0};
  char comma = 0;
  std::istringstream in(view);
  in.imbue(std::locale::classic());
  if (!(in >> direction.azimuth >> comma >> direction.elevation) || comma != ',' || in.peek() != EOF) {
    return std::nullopt;
  }
  const bool usable = std::abs(direction.azimuth) <= 360.0 && std::abs(direction.elevation) <= 89.0;
  return usable ? std::optional(direction) : std::nullopt;
}

}  // namespace

const std::vector<std::string>& renderViews() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all{"oblique"};
    for (const View& view : kViews) all.emplace_back(view.name);
    return all;
  }();
  return names;
}

RenderCamera cameraOf(const SensorView& sensor, const MapHierarchy& hierarchy, double aspect) {
  const Eigen::Isometry3d world_T_sensor = toIsometry(sensor.world_T_sensor);
  const Eigen::Vector3d eye = world_T_sensor.translation();
  const Eigen::Vector3d forward = world_T_sensor.linear().col(0);
  Eigen::AlignedBox3d bounds;
  for (const Eigen::Vector3d& point : corners(hierarchy, {})) bounds.extend(point);
  RenderCamera camera;
  camera.distance = std::max(0.3, (bounds.center() - eye).dot(forward));
  camera.target = eye + camera.distance * forward;
  camera.azimuth = mrpt::RAD2DEG(std::atan2(-forward.y(), -forward.x()));
  camera.elevation = mrpt::RAD2DEG(std::asin(std::clamp(-forward.z(), -1.0, 1.0)));
  const double slope =
      std::max(std::tan(0.5 * DEG2RAD(sensor.fov_y)), std::tan(0.5 * DEG2RAD(sensor.fov_x)) / aspect);
  camera.field_of_view = mrpt::RAD2DEG(2.0 * std::atan(slope));
  return camera;
}

RenderCamera cameraFor(const MapHierarchy& hierarchy, const std::string& view, double aspect,
                       const std::set<Label>& hidden) {
  const auto points = corners(hierarchy, hidden);
  Eigen::AlignedBox3d bounds;
  for (const Eigen::Vector3d& point : points) bounds.extend(point);
  RenderCamera camera;
  camera.target = bounds.center();
  std::optional<View> given = parseDirection(view);
  for (const View& fixed : kViews) {
    if (view == fixed.name) given = fixed;
  }
  if (given) {
    camera.azimuth = given->azimuth;
    camera.elevation = given->elevation;
    camera.distance = distanceFor(camera, points, aspect);
    return camera;
  }
  if (view != "oblique") throw ConfigError("there is no view `" + view + "`");
  const double radius = 0.5 * bounds.diagonal().norm();
  // From the side that was seen, unless something stands in the way: then from the nearest other side.
  const double seen = seenFrom(hierarchy);
  std::vector<std::pair<RenderCamera, std::size_t>> candidates;
  for (const double turn :
       {0.0, 30.0, -30.0, 60.0, -60.0, 90.0, -90.0, 120.0, -120.0, 150.0, -150.0, 180.0}) {
    camera.azimuth = seen + turn;
    camera.elevation = 38.0;
    camera.distance = distanceFor(camera, points, aspect);
    const bool background = !hidden.contains(hierarchy.root().label());
    candidates.emplace_back(camera, background ? inTheWay(hierarchy, camera, radius) : 0);
  }
  const auto by_blocked = [](const auto& a, const auto& b) { return a.second < b.second; };
  const std::size_t least = std::min_element(candidates.begin(), candidates.end(), by_blocked)->second;
  const std::size_t tolerable = least + hierarchy.root().map().occupiedVoxels().size() / 200;
  return std::find_if(candidates.begin(), candidates.end(),
                      [&](const auto& candidate) { return candidate.second <= tolerable; })
      ->first;
}

}  // namespace hoctomap
