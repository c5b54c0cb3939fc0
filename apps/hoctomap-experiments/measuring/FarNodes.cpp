// SPDX-License-Identifier: BSD-3-Clause
#include "measuring/FarNodes.h"

#include <memory>
#include <utility>

#include "hoctomap/existence/ExistenceFilter.h"

namespace hoctomap {

namespace {

constexpr std::size_t kNodesOfTable = 10;  // the table and nine objects on it

/// A flat block of occupied voxels around the origin, seen from above.
NodeMap block(const LabelProfile& profile, const ScanUpdate& engine, double half_x, double half_y) {
  NodeMap map(profile.resolution, profile.occupancy);
  PointCloud points;
  for (double x = -half_x; x <= half_x; x += profile.resolution) {
    for (double y = -half_y; y <= half_y; y += profile.resolution) {
      points.emplace_back(static_cast<float>(x), static_cast<float>(y), 0.0F);
    }
  }
  Beams beams;
  beams.origin = {0.0F, 0.0F, 0.05F};
  beams.hits = points;
  beams.bounds =
      Eigen::AlignedBox3d(Eigen::Vector3d(-half_x, -half_y, -0.02), Eigen::Vector3d(half_x, half_y, 0.02));
  static_cast<void>(map.update(engine, beams));
  return map;
}

NodeId addNode(MapHierarchy& map, const Settings& settings, const Label& label, NodeMap node_map,
               const Pose& world_T_node, NodeId parent) {
  const NodeId id = map.add(label, std::move(node_map), world_T_node, parent);
  map.node(id).existence_log_odds = ExistenceFilter(settings.labels.at(label).existence).initialLogOdds();
  return id;
}

}  // namespace

MapHierarchy makeFarNodes(const Settings& settings, std::size_t nodes) {
  const auto engine = makeReferenceScanUpdate();
  const LabelProfile& background = settings.labels.at(labels::background);
  MapHierarchy map(labels::background, NodeMap(background.resolution, background.occupancy));
  map.root().existence_log_odds = logOdds(background.existence.clamp_max);
  // Small ones, so that 100,000 of them fit into memory.
  const NodeMap table = block(settings.labels.at(labels::table), *engine, 0.04, 0.03);
  const NodeMap object = block(settings.labels.at(labels::object), *engine, 0.004, 0.004);
  const auto copyOf = [](const NodeMap& node) -> NodeMap {
    return {std::make_unique<octomap::OcTree>(node.tree()), node.model()};
  };
  NodeId parent = kRootId;
  for (std::size_t i = 0; i < nodes; ++i) {
    const auto place = static_cast<double>(i / kNodesOfTable);
    const Pose on_floor(100.0 + 3.0 * place, 0.0, 0.75, 0.0, 0.0, 0.0);
    const std::size_t number = i % kNodesOfTable;
    if (number == 0) {
      parent = addNode(map, settings, labels::table, copyOf(table), on_floor, kRootId);
      continue;
    }
    const double y = -0.25 + 0.05 * static_cast<double>(number);
    const Pose on_table = on_floor + Pose(0.0, y, 0.05, 0.0, 0.0, 0.0);
    addNode(map, settings, labels::object, copyOf(object), on_table, parent);
  }
  return map;
}

}  // namespace hoctomap
