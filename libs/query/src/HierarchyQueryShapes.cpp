// SPDX-License-Identifier: BSD-3-Clause
// Collisions, distances, regions: every occupied voxel of every node counts, with its whole cube.
#include <algorithm>
#include <array>
#include <cmath>

#include "QueryNodes.h"

namespace hoctomap {

namespace {

/// A box in the world, as the octree of a node sees it.
class BoxInNode {
 public:
  BoxInNode(const QueryNode& node, const Obb& box)
      : resolution_(node.resolution),
        box_{node.node_T_world * box.world_T_frame, box.box},
        box_T_node_(box_.world_T_frame.inverse()),
        bounds_(worldBounds(box_)) {}

  [[nodiscard]] bool meets(const OctreeCell& cell) const {
    const Eigen::AlignedBox3d cube = cell.cube(resolution_);
    return bounds_.intersects(cube) && intersects({Eigen::Isometry3d::Identity(), cube}, box_);
  }

  /// Voxels of the cell whose centre lies in the box.
  [[nodiscard]] std::uint64_t centresInside(const OctreeCell& cell) const {
    const Eigen::AlignedBox3d cube = cell.cube(resolution_);
    if (cell.edge == 1) return box_.box.contains(box_T_node_ * cube.center()) ? 1 : 0;
    if (!meets(cell)) return 0;
    if (contains(cube)) {
      const auto edge = static_cast<std::uint64_t>(cell.edge);
      return edge * edge * edge;
    }
    std::uint64_t inside = 0;
    OctreeCell part;
    part.edge = cell.edge / 2;
    for (int octant = 0; octant < static_cast<int>(OctreeCell::kOctants); ++octant) {
      part.low = cell.low + part.edge * Eigen::Array3i(octant & 1, octant >> 1 & 1, octant >> 2 & 1);
      inside += centresInside(part);
    }
    return inside;
  }

 private:
  [[nodiscard]] bool contains(const Eigen::AlignedBox3d& cube) const {
    for (int corner = 0; corner < 8; ++corner) {
      const auto which = static_cast<Eigen::AlignedBox3d::CornerType>(corner);
      if (!box_.box.contains(box_T_node_ * cube.corner(which))) return false;
    }
    return true;
  }

  double resolution_;
  Obb box_;  // its "world" is the node's frame
  Eigen::Isometry3d box_T_node_;
  Eigen::AlignedBox3d bounds_;  // in the node's frame
};

/// The nearest occupied voxel so far.
struct Nearest {
  double squared = 0.0;   ///< m^2
  std::size_t index = 0;  ///< of the node; of equally near voxels the first node's counts
  Eigen::Vector3d world_point = Eigen::Vector3d::Zero();

  [[nodiscard]] bool isBeatenBy(double other_squared, std::size_t other_index) const {
    return other_squared < squared || (other_squared == squared && other_index < index);
  }
};

void search(const QueryNode& node, std::size_t index, const OctreeCell& cell, const Eigen::Vector3d& p,
            Nearest& best) {
  if (cell.isLeaf(*node.tree)) {
    const Eigen::AlignedBox3d cube = cell.cube(node.resolution);
    const double squared = cube.squaredExteriorDistance(p);
    if (!best.isBeatenBy(squared, index)) return;
    best = {squared, index, node.world_T_node * p.cwiseMax(cube.min()).cwiseMin(cube.max())};
    return;
  }
  std::array<std::pair<double, OctreeCell>, OctreeCell::kOctants> children;
  std::size_t count = 0;
  for (unsigned octant = 0; octant < OctreeCell::kOctants; ++octant) {
    const OctreeCell child = cell.child(*node.tree, octant);
    if (child.node == nullptr || !node.isOccupied(child)) continue;
    const double squared = child.cube(node.resolution).squaredExteriorDistance(p);
    const auto end = children.begin() + static_cast<std::ptrdiff_t>(count++);
    const auto place = std::find_if(children.begin(), end, [&](const auto& c) { return squared < c.first; });
    std::move_backward(place, end, end + 1);
    *place = {squared, child};
  }
  const auto end = children.begin() + static_cast<std::ptrdiff_t>(count);
  for (auto child = children.begin(); child != end && best.isBeatenBy(child->first, index); ++child) {
    search(node, index, child->second, p, best);
  }
}

}  // namespace

std::optional<NodeId> HierarchyQuery::collision(const Obb& box) const {
  std::size_t first = nodes_->size();
  nodes_->occupied.meeting(worldBounds(box), [&](std::size_t i) {
    if (i > first) return;
    const QueryNode& node = (*nodes_)[i];
    const BoxInNode here(node, box);
    const bool missed = node.forEachOccupiedLeaf(
        node.top, [&](const OctreeCell& cell) { return here.meets(cell); },
        [](const OctreeCell&) { return false; });
    if (!missed) first = i;
  });
  if (first == nodes_->size()) return std::nullopt;
  return nodes_->place(first).id;
}

std::optional<NodeId> HierarchyQuery::collision(const Eigen::Vector3d& centre, double radius) const {
  std::size_t first = nodes_->size();
  const Eigen::Vector3d reach = Eigen::Vector3d::Constant(radius);
  nodes_->occupied.meeting({centre - reach, centre + reach}, [&](std::size_t i) {
    if (i > first) return;
    const QueryNode& node = (*nodes_)[i];
    const Eigen::Vector3d p = node.node_T_world * centre;
    const bool missed = node.forEachOccupiedLeaf(
        node.top,
        [&](const OctreeCell& cell) {
          return cell.cube(node.resolution).squaredExteriorDistance(p) <= radius * radius;
        },
        [](const OctreeCell&) { return false; });
    if (!missed) first = i;
  });
  if (first == nodes_->size()) return std::nullopt;
  return nodes_->place(first).id;
}

std::optional<NearestVoxel> HierarchyQuery::nearestOccupied(const Eigen::Vector3d& world_point,
                                                            double max_distance) const {
  const Nodes& nodes = *nodes_;
  Nearest best{max_distance * max_distance, nodes.size()};
  const auto look = [&](std::size_t i) {
    search(nodes[i], i, nodes[i].top, nodes[i].node_T_world * world_point, best);
  };
  // The node whose box is nearest says how far off the others may be.
  const auto nearest = nodes_->occupied.nearest(world_point);
  if (!nearest) return std::nullopt;
  look(*nearest);
  const Eigen::Vector3d reach = Eigen::Vector3d::Constant(std::sqrt(best.squared));
  nodes_->occupied.meeting({world_point - reach, world_point + reach}, look);
  if (best.index == nodes.size()) return std::nullopt;
  return NearestVoxel{std::sqrt(best.squared), best.world_point, nodes.place(best.index).id};
}

std::vector<NodeInRegion> HierarchyQuery::nodesIn(const Obb& region) const {
  std::vector<NodeInRegion> found;
  nodes_->occupied.meeting(worldBounds(region), [&](std::size_t i) {
    if (nodes_->place(i).id == kRootId) return;
    const QueryNode& node = (*nodes_)[i];
    const BoxInNode here(node, region);
    bool meets = false;
    std::uint64_t inside = 0;
    node.forEachOccupiedLeaf(
        node.top, [&](const OctreeCell& cell) { return here.meets(cell); },
        [&](const OctreeCell& leaf) {
          meets = true;
          inside += here.centresInside(leaf);
          return true;
        });
    if (meets) {
      const double share = static_cast<double>(inside) / static_cast<double>(node.occupied_voxels);
      found.push_back({node.id, share, nodes_->label(i), node.existence});
    }
  });
  std::sort(found.begin(), found.end(), [](const auto& a, const auto& b) { return a.node < b.node; });
  return found;
}

}  // namespace hoctomap
