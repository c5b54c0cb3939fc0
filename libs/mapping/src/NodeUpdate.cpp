// SPDX-License-Identifier: BSD-3-Clause
#include "NodeUpdate.h"

#include <cstddef>
#include <string>
#include <utility>

#include "GrazingBeams.h"
#include "hoctomap/octree/UpdateMemory.h"

namespace hoctomap {

namespace {

/// The points of `z` in the node's frame: its own, and those of the rest of the scan.
struct NodePoints {
  PointCloud own;
  PointCloud others;
};

NodePoints toNodeFrame(const NodeUpdate& update, const Measurement& z) {  // Eq. (12)
  const Eigen::Isometry3d node_T_world = toIsometry(update.world_T_node).inverse();
  const auto in_node = [&](std::size_t i) -> Eigen::Vector3f {
    return (node_T_world * z.world_points[i].cast<double>()).cast<float>();
  };
  NodePoints points;
  points.own.reserve(update.points.size());
  for (const auto i : update.points) points.own.push_back(in_node(i));
  if (update.profile->carve == Carve::scan && update.bounded) {
    points.others.reserve(z.world_points.size() - update.points.size());
    std::size_t next_own = 0;
    for (std::size_t i = 0; i < z.world_points.size(); ++i) {
      if (next_own < update.points.size() && update.points[next_own] == i) {
        ++next_own;
      } else {
        points.others.push_back(in_node(i));
      }
    }
  }
  return points;
}

/// The box of the node grown by the endpoints that this scan will mark, padded by one voxel.
Eigen::AlignedBox3d grownBox(const NodeMap& map, const PointCloud& own, const Eigen::Vector3f& origin,
                             double max_range) {
  Eigen::AlignedBox3d box = map.occupiedBox();
  for (const auto& p : own) {
    if (max_range < 0.0 || (p - origin).norm() <= max_range) box.extend(p.cast<double>());
  }
  const Eigen::Vector3d voxel = Eigen::Vector3d::Constant(map.resolution());
  if (!box.isEmpty()) box = Eigen::AlignedBox3d(box.min() - voxel, box.max() + voxel);
  return box;
}

/// Refuses the update before it fills the memory, if the label has a limit.
void requireMemory(const NodeUpdate& update, const Beams& beams) {
  if (update.profile->max_memory < 0.0) return;
  constexpr double kMegabyte = 1e6;
  requireUpdateMemory(update.node->map().tree(), beams,
                      static_cast<std::size_t>(update.profile->max_memory * kMegabyte),
                      "node " + std::to_string(update.node->id().value) + ", [label." +
                          update.node->label().name + "] max_memory");
}

}  // namespace

ScanUpdateReport updateNodeMap(const NodeUpdate& update, const Measurement& z, const ScanUpdate& engine) {
  NodeMap& map = update.node->map();
  if (!update.ceded.empty()) map.cede(update.ceded);
  NodePoints points = toNodeFrame(update, z);
  Beams beams;
  beams.origin = (toIsometry(update.world_T_node).inverse() * z.origin()).cast<float>();
  beams.max_range = update.max_range;
  if (update.bounded) {
    beams.bounds = grownBox(map, points.own, beams.origin, update.max_range);
    if (beams.bounds->isEmpty()) return {};  // nothing mapped yet, nothing to map
  }
  OwnBeams own;
  if (update.bounded && update.profile->grazing == Grazing::spare) {
    own = spareSurface(points.own, beams.origin, map.resolution(), update.max_range);
    points.others.insert(points.others.end(), own.cleared.begin(), own.cleared.end());
  } else {
    own.hits = std::move(points.own);
  }
  beams.hits = own.hits;
  beams.endpoints = own.endpoints;
  beams.passing = points.others;
  requireMemory(update, beams);
  const ScanUpdateReport report = map.update(engine, beams);
  update.node->last_scan = z.scan;
  update.node->version = z.scan;
  return report;
}

}  // namespace hoctomap
