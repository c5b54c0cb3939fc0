// SPDX-License-Identifier: BSD-3-Clause
#include "QueryOracle.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <tuple>

namespace hoctomap::test {

namespace {

NodeMap randomMap(Rng& rng, double resolution) {
  auto tree = std::make_unique<octomap::OcTree>(resolution);
  const auto set = [&](int x, int y, int z, float log_odds) {
    const auto key = [](int k) { return static_cast<octomap::key_type>(32768 + k); };
    tree->setNodeValue(octomap::OcTreeKey(key(x), key(y), key(z)), log_odds);
  };
  const auto anywhere = [&] { return static_cast<int>(rng() % 8) - 4; };
  const auto logOdds = [&] { return static_cast<float>(uniform(rng, -2.0, 3.0)); };
  for (int cube = 0; cube < 6; ++cube) {  // eight alike become one leaf
    const int x = 2 * (anywhere() / 2);
    const int y = 2 * (anywhere() / 2);
    const int z = 2 * (anywhere() / 2);
    const float value = logOdds();
    for (int i = 0; i < 8; ++i) set(x + (i & 1), y + (i >> 1 & 1), z + (i >> 2 & 1), value);
  }
  for (int voxel = 0; voxel < 40; ++voxel) set(anywhere(), anywhere(), anywhere(), logOdds());
  return {std::move(tree), OccupancyModel{}};
}

/// Where a line is inside a box, m along it.
std::pair<double, double> spanIn(const Eigen::AlignedBox3d& box, const Eigen::Vector3d& origin,
                                 const Eigen::Vector3d& direction) {
  const Eigen::Array3d a = (box.min() - origin).array() / direction.array();
  const Eigen::Array3d b = (box.max() - origin).array() / direction.array();
  return {a.min(b).maxCoeff(), a.max(b).minCoeff()};
}

}  // namespace

MapHierarchy randomHierarchy(Rng& rng) {
  MapHierarchy map(labels::background, randomMap(rng, 0.08));
  for (const double resolution : {0.05, 0.03, 0.03, 0.02}) {
    const auto ids = map.ids();
    const NodeId id =
        map.add(labels::object, randomMap(rng, resolution), randomPose(rng, 0.15), ids[rng() % ids.size()]);
    map.node(id).existence_log_odds = uniform(rng, 0.0, 3.0);
  }
  map.root().existence_log_odds = 3.0;
  return map;
}

QueryOracle::QueryOracle(const MapHierarchy& map, double min_existence) {
  for (const NodeId id : map.ids()) {
    const MapNode& node = map.node(id);
    if (node.existence() < min_existence) continue;
    octomap::OcTree tree(node.map().tree());
    tree.expand();
    Node entry{id, map.depth(id), tree.getResolution(), node.existence(), toIsometry(map.world_T_node(id)),
               {}};
    for (auto leaf = tree.begin_leafs(); leaf != tree.end_leafs(); ++leaf) {
      const Eigen::Vector3d centre(leaf.getX(), leaf.getY(), leaf.getZ());
      entry.voxels.push_back({centre - Eigen::Vector3d::Constant(0.5 * entry.resolution),
                              entry.world_T_node * centre, tree.isNodeOccupied(*leaf), leaf->getOccupancy()});
    }
    nodes_.push_back(std::move(entry));
  }
  std::sort(nodes_.begin(), nodes_.end(), [](const Node& a, const Node& b) {
    if (a.resolution != b.resolution) return a.resolution < b.resolution;
    if (a.depth != b.depth) return a.depth > b.depth;
    return a.id < b.id;
  });
}

Obb QueryOracle::Node::cube(const Voxel& voxel) const {
  return {world_T_node, Eigen::AlignedBox3d(voxel.low, voxel.low + Eigen::Vector3d::Constant(resolution))};
}

bool QueryOracle::Node::meets(const Voxel& voxel, const Obb& box) const {
  const double far = 0.5 * box.box.diagonal().norm() + resolution;
  return (voxel.world - box.center()).norm() <= far && intersects(cube(voxel), box);
}

PointAnswer QueryOracle::at(const Eigen::Vector3d& p) const {
  for (const Node& node : nodes_) {
    const Eigen::Vector3d local = node.world_T_node.inverse() * p;
    for (const Voxel& voxel : node.voxels) {
      const Eigen::Array3d offset = local - voxel.low;
      if ((offset < 0.0).any() || (offset >= node.resolution).any()) continue;
      return {voxel.occupied ? Occupancy::occupied : Occupancy::free,
              node.existence * voxel.probability + (1.0 - node.existence) * 0.5, node.id};
    }
  }
  return {};
}

RayAnswer QueryOracle::castRay(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction,
                               const RayOptions& options) const {
  struct Piece {
    double enter;
    double leave;
    std::size_t rank;
    bool occupied;
  };
  const Eigen::Vector3d along = direction.normalized();
  std::vector<Piece> pieces;
  std::set<double> ends{0.0};
  for (std::size_t rank = 0; rank < nodes_.size(); ++rank) {
    const Node& node = nodes_[rank];
    const Eigen::Vector3d o = node.world_T_node.inverse() * origin;
    const Eigen::Vector3d d = node.world_T_node.linear().transpose() * along;
    for (const Voxel& voxel : node.voxels) {
      const auto [a, b] = spanIn({voxel.low, voxel.low + Eigen::Vector3d::Constant(node.resolution)}, o, d);
      const double enter = std::max(a, 0.0);
      const double leave = std::min(b, options.max_range);
      if (enter >= leave) continue;
      pieces.push_back({enter, leave, rank, voxel.occupied});
      ends.insert({enter, leave});
    }
  }
  // Between two neighbouring ends nothing changes.
  for (auto from = ends.begin(); from != ends.end(); ++from) {
    const auto to = std::next(from);
    constexpr double kSliver = 1e-9;  // rounding
    if (to != ends.end() && *to - *from < kSliver) continue;
    const double middle = to == ends.end() ? *from + kSliver : 0.5 * (*from + *to);
    const Piece* decides = nullptr;
    for (const Piece& piece : pieces) {
      const bool here = piece.enter < middle && middle < piece.leave;
      if (here && (decides == nullptr || piece.rank < decides->rank)) decides = &piece;
    }
    if (middle > options.max_range) break;
    if (decides == nullptr && !options.ignore_unknown)
      return {RayAnswer::End::unknown, *from, origin + *from * along, {}};
    if (decides != nullptr && decides->occupied)
      return {RayAnswer::End::hit, *from, origin + *from * along, nodes_[decides->rank].id};
  }
  return {RayAnswer::End::nothing, options.max_range, origin, {}};
}

std::optional<NodeId> QueryOracle::collision(const Obb& box) const {
  for (const Node& node : nodes_) {
    for (const Voxel& voxel : node.voxels) {
      if (voxel.occupied && node.meets(voxel, box)) return node.id;
    }
  }
  return std::nullopt;
}

std::optional<NodeId> QueryOracle::collision(const Eigen::Vector3d& centre, double radius) const {
  for (const Node& node : nodes_) {
    const Eigen::Vector3d local = node.world_T_node.inverse() * centre;
    for (const Voxel& voxel : node.voxels) {
      if (voxel.occupied && node.cube(voxel).box.exteriorDistance(local) <= radius) return node.id;
    }
  }
  return std::nullopt;
}

std::optional<NearestVoxel> QueryOracle::nearestOccupied(const Eigen::Vector3d& p,
                                                         double max_distance) const {
  std::optional<NearestVoxel> best;
  for (const Node& node : nodes_) {
    const Eigen::Vector3d local = node.world_T_node.inverse() * p;
    for (const Voxel& voxel : node.voxels) {
      const Eigen::AlignedBox3d cube = node.cube(voxel).box;
      const double distance = cube.exteriorDistance(local);
      if (!voxel.occupied || distance > max_distance || (best && distance >= best->distance)) continue;
      best = NearestVoxel{distance, node.world_T_node * local.cwiseMax(cube.min()).cwiseMin(cube.max()),
                          node.id};
    }
  }
  return best;
}

double QueryOracle::unknownShare(const Obb& box, double step) const {
  Eigen::Array3i cells;
  for (int axis = 0; axis < 3; ++axis) {
    cells[axis] = std::clamp(static_cast<int>(std::ceil(box.box.sizes()[axis] / step)), 1, 100);
  }
  int unknown = 0;
  for (int i = 0; i < cells.prod(); ++i) {
    const Eigen::Array3d number(i % cells.x(), i / cells.x() % cells.y(), i / cells.x() / cells.y());
    const Eigen::Array3d share = (number + 0.5) / cells.cast<double>();
    const Eigen::Vector3d p = box.box.min() + (share * box.box.sizes().array()).matrix();
    unknown += at(box.world_T_frame * p).node ? 0 : 1;
  }
  return static_cast<double>(unknown) / cells.prod();
}

std::vector<NodeInRegion> QueryOracle::nodesIn(const Obb& region) const {
  std::vector<NodeInRegion> found;
  for (const Node& node : nodes_) {
    if (node.id == kRootId) continue;
    bool meets = false;
    int inside = 0;
    int occupied = 0;
    for (const Voxel& voxel : node.voxels) {
      if (!voxel.occupied) continue;
      ++occupied;
      meets = meets || node.meets(voxel, region);
      inside += region.contains(voxel.world) ? 1 : 0;
    }
    if (meets) found.push_back({node.id, static_cast<double>(inside) / occupied});
  }
  std::sort(found.begin(), found.end(), [](const auto& a, const auto& b) { return a.node < b.node; });
  return found;
}

}  // namespace hoctomap::test
