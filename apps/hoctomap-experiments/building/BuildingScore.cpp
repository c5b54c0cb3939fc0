// SPDX-License-Identifier: BSD-3-Clause
#include "building/BuildingScore.h"

#include <algorithm>
#include <set>
#include <sstream>
#include <tuple>

namespace hoctomap {

namespace {

constexpr double kLeastOverlap = 0.25;  // of the union of two boxes

struct Place {
  std::string name;
  Eigen::AlignedBox3d box;
};

double overlap(const Eigen::AlignedBox3d& a, const Eigen::AlignedBox3d& b) {
  const Eigen::AlignedBox3d both = a.intersection(b);
  if (both.isEmpty()) return 0.0;
  return both.volume() / (a.volume() + b.volume() - both.volume());
}

std::vector<Place> solidsOf(const Scene& scene, SolidLabel label) {
  std::vector<Place> places;
  for (const SolidId id : scene.ids()) {
    const Solid& solid = scene.solid(id);
    if (solid.label != label || !scene.present(id)) continue;
    SurfaceExtent extent = surfaceExtent(*solid.surface, toIsometry(scene.world_T_solid(id)));
    if (label == SolidLabel::table) {  // the map's tables are tops
      constexpr double kTop = 0.03;    // m, thickness
      extent.box.min().z() = extent.box.max().z() - kTop;
    }
    places.push_back({solid.name, extent.box});
  }
  return places;
}

/// Box of the points without the outermost fiftieth on each side: a few stray voxels behind an edge say
/// nothing of where a thing is.
Eigen::AlignedBox3d middleOf(const PointCloud& points, const Eigen::Isometry3d& world_T_points) {
  Eigen::AlignedBox3d box;
  if (points.empty()) return box;
  constexpr std::size_t kStrayShare = 50;
  const std::size_t stray = points.size() / kStrayShare;
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    std::vector<double> along;
    for (const auto& p : points) along.push_back((world_T_points * p.cast<double>())[axis]);
    std::sort(along.begin(), along.end());
    box.min()[axis] = along[stray];
    box.max()[axis] = along[along.size() - 1 - stray];
  }
  return box;
}

std::vector<Place> nodesOf(const MapHierarchy& map, const Label& label) {
  std::vector<Place> places;
  for (const NodeId id : map.ids()) {
    const MapNode& node = map.node(id);
    if (node.label() != label || node.confirmation.waits) continue;
    const Eigen::AlignedBox3d box = middleOf(node.map().occupiedVoxels(), toIsometry(map.world_T_node(id)));
    if (!box.isEmpty()) places.push_back({"node " + std::to_string(id.value), box});
  }
  return places;
}

std::string line(const Place& place, const std::string& what) {
  std::ostringstream text;
  text << what << " " << place.name << " at " << place.box.center().transpose() << ", size "
       << place.box.sizes().transpose();
  return text.str();
}

}  // namespace

double BuildingScore::precision() const {
  return nodes == 0 ? 1.0 : static_cast<double>(matched) / static_cast<double>(nodes);
}

double BuildingScore::recall() const {
  return solids == 0 ? 1.0 : static_cast<double>(matched) / static_cast<double>(solids);
}

BuildingScore scoreBuilding(const MapHierarchy& map, const Scene& scene, SolidLabel label) {
  const bool is_table = label == SolidLabel::table;
  const double reach = is_table ? 0.15 : 0.03;  // m
  const std::vector<Place> solids = solidsOf(scene, label);
  const std::vector<Place> nodes = nodesOf(map, is_table ? labels::table : labels::object);
  std::vector<std::tuple<double, std::size_t, std::size_t>> pairs;
  for (std::size_t s = 0; s < solids.size(); ++s) {
    for (std::size_t n = 0; n < nodes.size(); ++n) {
      const double share = overlap(solids[s].box, nodes[n].box);
      if (share < kLeastOverlap || (solids[s].box.center() - nodes[n].box.center()).norm() > reach) continue;
      pairs.emplace_back(-share, s, n);
    }
  }
  std::sort(pairs.begin(), pairs.end());
  BuildingScore score{solids.size(), nodes.size(), 0, {}};
  std::set<std::size_t> taken_solids;
  std::set<std::size_t> taken_nodes;
  for (const auto& [unused, s, n] : pairs) {
    if (taken_solids.contains(s) || taken_nodes.contains(n)) continue;
    taken_solids.insert(s);
    taken_nodes.insert(n);
    ++score.matched;
  }
  for (std::size_t s = 0; s < solids.size(); ++s) {
    if (!taken_solids.contains(s)) score.mistakes.push_back(line(solids[s], "missed"));
  }
  for (std::size_t n = 0; n < nodes.size(); ++n) {
    if (!taken_nodes.contains(n)) score.mistakes.push_back(line(nodes[n], "too much"));
  }
  return score;
}

}  // namespace hoctomap
