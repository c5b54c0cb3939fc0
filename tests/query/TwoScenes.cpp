// SPDX-License-Identifier: BSD-3-Clause
#include "TwoScenes.h"

#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include "hoctomap/geometry/PcaFrame.h"
#include "hoctomap/octree/BlockScanUpdate.h"

namespace hoctomap::test {

namespace {

constexpr double kTop = 0.7;
constexpr double kFar = std::numeric_limits<double>::infinity();

/// Distance along the ray to a box about the origin; infinite if it misses.
double hitBox(const Eigen::Vector3d& from, const Eigen::Vector3d& ray, const Eigen::Vector3d& half) {
  double enter = 0.0;
  double leave = kFar;
  for (int i = 0; i < 3; ++i) {
    if (std::abs(ray[i]) < 1e-12) {
      if (std::abs(from[i]) > half[i]) return kFar;
      continue;
    }
    const double t1 = (-half[i] - from[i]) / ray[i];
    const double t2 = (half[i] - from[i]) / ray[i];
    enter = std::max(enter, std::min(t1, t2));
    leave = std::min(leave, std::max(t1, t2));
  }
  return enter < leave && enter > 0.0 ? enter : kFar;
}

double hitCylinder(const Eigen::Vector3d& from, const Eigen::Vector3d& ray, double radius, double half) {
  double nearest = kFar;
  const double a = ray.head<2>().squaredNorm();
  const double b = from.head<2>().dot(ray.head<2>());
  const double c = from.head<2>().squaredNorm() - radius * radius;
  if (b * b - a * c > 0.0 && a > 1e-12) {
    const double t = (-b - std::sqrt(b * b - a * c)) / a;
    if (t > 0.0 && std::abs(from.z() + t * ray.z()) <= half) nearest = t;
  }
  const double t = (half - from.z()) / ray.z();
  if (t > 0.0 && t < nearest && (from + t * ray).head<2>().norm() <= radius) nearest = t;
  return nearest;
}

double hit(const Solid& solid, const Eigen::Vector3d& eye, const Eigen::Vector3d& ray) {
  const Eigen::Isometry3d back = solid.world_T_centre.inverse();
  const Eigen::Vector3d from = back * eye;
  const Eigen::Vector3d along = back.linear() * ray;
  if (solid.round) return hitCylinder(from, along, 0.5 * solid.size.x(), 0.5 * solid.size.z());
  return hitBox(from, along, 0.5 * solid.size);
}

/// The endpoints of one view: of each solid, then of the floor.
std::vector<PointCloud> cast(const Solids& solids, const Eigen::Vector3d& eye) {
  std::vector<PointCloud> points(solids.size() + 1);
  const Eigen::Vector3d forward = (Eigen::Vector3d(0.0, 0.0, kTop) - eye).normalized();
  const Eigen::Vector3d left = Eigen::Vector3d::UnitZ().cross(forward).normalized();
  const Eigen::Vector3d up = forward.cross(left);
  for (int v = -120; v <= 120; ++v) {
    for (int u = -160; u <= 160; ++u) {
      const Eigen::Vector3d ray = forward + u * 0.0045 * left + v * 0.0045 * up;
      std::size_t what = solids.size();
      double nearest = ray.z() < 0.0 ? -eye.z() / ray.z() : kFar;
      for (std::size_t i = 0; i < solids.size(); ++i) {
        const double t = hit(solids[i], eye, ray);
        if (t < nearest) {
          nearest = t;
          what = i;
        }
      }
      if (nearest < 6.0) points[what].push_back((eye + nearest * ray).cast<float>());
    }
  }
  return points;
}

PointCloud inFrame(const Eigen::Isometry3d& frame_T_world, const PointCloud& points) {
  PointCloud moved;
  for (const auto& p : points) moved.push_back((frame_T_world * p.cast<double>()).cast<float>());
  return moved;
}

using Views = std::vector<std::vector<PointCloud>>;

void updateMap(NodeMap& map, const Eigen::Isometry3d& node_T_world, const std::vector<Eigen::Vector3d>& eyes,
               const Views& views, std::size_t what, bool is_background) {
  const auto engine = makeBlockScanUpdate();
  Eigen::AlignedBox3d bounds;
  for (const auto& view : views) {
    for (const auto& p : inFrame(node_T_world, view[what])) bounds.extend(p.cast<double>());
  }
  for (std::size_t k = 0; k < eyes.size(); ++k) {
    const PointCloud hits = inFrame(node_T_world, views[k][what]);
    PointCloud passing;
    if (is_background) {
      for (std::size_t i = 0; i < what; ++i) {
        const PointCloud more = inFrame(node_T_world, views[k][i]);
        passing.insert(passing.end(), more.begin(), more.end());
      }
    }
    Beams beams;
    beams.origin = (node_T_world * eyes[k]).cast<float>();
    beams.hits = hits;
    beams.passing = passing;
    if (!is_background) beams.bounds = bounds;
    map.update(*engine, beams);
  }
}

}  // namespace

Solid onTable(Eigen::Vector3d size, bool round, double x, double y, double yaw) {
  Solid solid;
  solid.size = std::move(size);
  solid.round = round;
  solid.world_T_centre.translation() = Eigen::Vector3d(x, y, kTop + 0.5 * solid.size.z());
  solid.world_T_centre.rotate(Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()));
  return solid;
}

Solids randomTable(Rng& rng, std::size_t count) {
  Solid table;
  table.label = labels::table;
  table.size = Eigen::Vector3d(1.0, 1.2, 0.04);
  table.world_T_centre.translation() = Eigen::Vector3d(0.0, 0.0, kTop - 0.02);
  Solids solids{table};
  for (std::size_t i = 0; i < count; ++i) {
    // One row of three on each side, 36 cm apart. Heights tell the objects apart.
    const double x = (i % 2 == 0 ? -0.2 : 0.2) + uniform(rng, -0.04, 0.04);
    const double y = 0.36 * (static_cast<double>(i / 2) - 1.0) + uniform(rng, -0.04, 0.04);
    const double height = 0.07 + 0.03 * static_cast<double>(i) + uniform(rng, 0.0, 0.01);
    const bool round = i % 3 == 2;
    const double width = uniform(rng, 0.06, 0.09);
    const double depth = round ? width : width + uniform(rng, 0.03, 0.06);
    solids.push_back(onTable({width, depth, height}, round, x, y, uniform(rng, -1.5, 1.5)));
  }
  return solids;
}

Eigen::Isometry3d slide(const Eigen::Vector3d& centre, double dx, double dy, double yaw) {
  Eigen::Isometry3d motion = Eigen::Isometry3d::Identity();
  motion.translate(Eigen::Vector3d(centre + Eigen::Vector3d(dx, dy, 0.0)));
  motion.rotate(Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()));
  motion.translate(Eigen::Vector3d(-centre));
  return motion;
}

std::vector<Eigen::Vector3d> viewsAround(std::size_t count, double degrees) {
  std::vector<Eigen::Vector3d> eyes;
  for (std::size_t i = 0; i < count; ++i) {
    const double angle =
        (degrees / 180.0 + 2.0 * static_cast<double>(i) / static_cast<double>(count)) * std::numbers::pi;
    eyes.emplace_back(1.1 * std::cos(angle), 1.1 * std::sin(angle), 1.5);
  }
  return eyes;
}

MapHierarchy mapOf(const Solids& solids, const std::vector<Eigen::Vector3d>& eyes, double resolution,
                   const Eigen::Isometry3d& map_T_world) {
  Views views;
  for (const auto& eye : eyes) views.push_back(cast(solids, eye));
  // Everything is given in the world; the map has its own.
  Views in_map;
  std::vector<Eigen::Vector3d> map_eyes;
  for (const auto& view : views) {
    auto& moved = in_map.emplace_back();
    for (const auto& points : view) moved.push_back(inFrame(map_T_world, points));
  }
  for (const auto& eye : eyes) map_eyes.push_back(map_T_world * eye);
  NodeMap background(0.05, {});
  updateMap(background, Eigen::Isometry3d::Identity(), map_eyes, in_map, solids.size(), true);
  MapHierarchy hierarchy(labels::background, std::move(background));

  std::optional<NodeId> table;
  for (std::size_t i = 0; i < solids.size(); ++i) {
    PointCloud all;
    for (const auto& view : in_map) all.insert(all.end(), view[i].begin(), view[i].end());
    if (all.size() < 30) continue;  // not seen
    const bool is_table = solids[i].label == labels::table;
    const Pose world_T_node = pcaFrame(all);
    NodeMap map(is_table ? 0.01 : resolution, {});
    updateMap(map, toIsometry(-world_T_node), map_eyes, in_map, i, false);
    const NodeId id =
        hierarchy.add(solids[i].label, std::move(map), world_T_node, table && !is_table ? *table : kRootId);
    if (is_table) table = id;
  }
  return hierarchy;
}

}  // namespace hoctomap::test
