// SPDX-License-Identifier: BSD-3-Clause
#include "hoctomap/exploration/KnowledgeGrid.h"

#include <limits>

namespace hoctomap {

namespace {

constexpr double kCoarseCell = 0.05;  // m, as the background's voxels
constexpr double kCeiling = 2.5;      // m above the floor: no camera of a robot is higher

float entropyOf(double p) {
  return static_cast<float>(-p * std::log2(p) - (1.0 - p) * std::log2(1.0 - p));
}

std::uint8_t byte(Knowledge knowledge) {
  return static_cast<std::uint8_t>(knowledge);
}

}  // namespace

Eigen::AlignedBox3d KnowledgeGrid::Grid::box() const {
  return {corner, corner + cell * Eigen::Vector3d(size[0], size[1], size[2])};
}

KnowledgeGrid::Grid KnowledgeGrid::Grid::around(const Eigen::AlignedBox3d& world, double cell) {
  Grid grid;
  grid.corner = world.min();
  grid.cell = cell;
  std::size_t cells = 1;
  for (int i = 0; i < 3; ++i) {
    constexpr double kHair = 1e-9;  // no further cell for rounding
    const auto n = std::max(1, static_cast<int>(std::ceil(world.sizes()[i] / cell - kHair)));
    grid.size[static_cast<std::size_t>(i)] = n;
    cells *= static_cast<std::size_t>(n);
  }
  grid.cells.assign(cells, 0);
  return grid;
}

KnowledgeGrid::KnowledgeGrid(const MapHierarchy& map, const TableArea& table, const ClearedSpace& cleared,
                             double cell, double range)
    : fine_(Grid::around(table.space, cell)),
      box_resolution_(std::numeric_limits<double>::infinity()),
      open_resolution_(cleared.map().resolution()) {
  std::fill(fine_.cells.begin(), fine_.cells.end(), byte(Knowledge::unknown));
  std::vector<float> bits(fine_.cells.size(), 1.0F);
  takeCleared(cleared, bits);
  for (const NodeId id : map.idsNear(table.space)) {
    const Label& label = map.node(id).label();
    if (label != labels::background && label != labels::table) takeNode(map, id, table, bits);
  }
  box_resolution_ = std::min(box_resolution_, open_resolution_);
  for (const float b : bits) entropy_ += static_cast<double>(b);
  takeSurroundings(map, table, range);
}

void KnowledgeGrid::takeCleared(const ClearedSpace& cleared, std::vector<float>& bits) {
  const octomap::OcTree& tree = cleared.map().tree();
  if (tree.size() == 0) return;
  for (auto leaf = tree.begin_leafs(); leaf != tree.end_leafs(); ++leaf) {
    const Eigen::Vector3d half = Eigen::Vector3d::Constant(0.5 * leaf.getSize());
    const Eigen::Vector3d center(leaf.getX(), leaf.getY(), leaf.getZ());
    const std::uint8_t state = byte(tree.isNodeOccupied(*leaf) ? Knowledge::occupied : Knowledge::free);
    const float entropy = entropyOf(leaf->getOccupancy());
    fine_.forEachIn({center - half, center + half}, [&](int x, int y, int z) {
      fine_.cells[fine_.index(x, y, z)] = state;
      bits[fine_.index(x, y, z)] = entropy;
    });
  }
}

void KnowledgeGrid::takeNode(const MapHierarchy& map, NodeId id, const TableArea& table,
                             std::vector<float>& bits) {
  const Obb box = map.box(id);
  if (box.box.isEmpty()) return;
  const octomap::OcTree& tree = map.node(id).map().tree();
  box_resolution_ = std::min(box_resolution_, tree.getResolution());
  const Eigen::Isometry3d node_T_world = toIsometry(map.world_T_node(id)).inverse();
  Eigen::AlignedBox3d reach = worldBounds(box);
  const double middle = reach.center().z();
  reach.min().z() = std::min(reach.min().z(), table.top);
  fine_.forEachIn(reach, [&](int x, int y, int z) {
    const Eigen::Vector3d p = fine_.center(x, y, z);
    const Eigen::Vector3d q = node_T_world * p;
    const bool inside = box.box.contains(q);
    // Between the box and the table there is more of the object: it stands on something.
    const Eigen::Vector3d above(p.x(), p.y(), middle);
    if (!inside && !(p.z() < middle && box.box.contains(node_T_world * above))) return;
    std::uint8_t& cell = fine_.cells[fine_.index(x, y, z)];
    const octomap::OcTreeNode* voxel = inside ? tree.search(q.x(), q.y(), q.z()) : nullptr;
    if (voxel != nullptr) {
      cell = byte(tree.isNodeOccupied(voxel) ? Knowledge::occupied : Knowledge::free);
      bits[fine_.index(x, y, z)] = entropyOf(voxel->getOccupancy());
    } else if (cell == byte(Knowledge::unknown)) {
      cell = byte(Knowledge::unknown_in_box);
    }
  });
}

void KnowledgeGrid::takeSurroundings(const MapHierarchy& map, const TableArea& table, double range) {
  const Eigen::Vector3d grown(range, range, 0.0);
  Eigen::AlignedBox3d around(table.space.min() - grown, table.space.max() + grown);
  around.min().z() = 0.0;
  around.max().z() = std::max(around.max().z(), kCeiling);
  coarse_ = Grid::around(around, kCoarseCell);
  const octomap::OcTree& background = map.root().map().tree();
  if (background.size() > 0) {
    for (auto leaf = background.begin_leafs(); leaf != background.end_leafs(); ++leaf) {
      if (!background.isNodeOccupied(*leaf)) continue;
      const Eigen::Vector3d half = Eigen::Vector3d::Constant(0.5 * leaf.getSize());
      const Eigen::Vector3d center(leaf.getX(), leaf.getY(), leaf.getZ());
      coarse_.forEachIn({center - half, center + half},
                        [this](int x, int y, int z) { coarse_.cells[coarse_.index(x, y, z)] = 1; });
    }
  }
  // The table itself and what stands on it are in the fine grid, and its voxels reach over its border.
  for (const NodeId id : map.idsNear(coarse_.box())) {
    const MapNode& node = map.node(id);
    if (id == kRootId || id == table.node || node.parent() == table.node) continue;
    const Eigen::Isometry3d world_T_node = toIsometry(map.world_T_node(id));
    for (const Eigen::Vector3f& voxel : node.map().occupiedVoxels()) {
      const Eigen::Vector3d at =
          ((world_T_node * voxel.cast<double>() - coarse_.corner) / kCoarseCell).array().floor();
      const bool inside = at.x() >= 0 && at.y() >= 0 && at.z() >= 0 && at.x() < coarse_.size[0] &&
                          at.y() < coarse_.size[1] && at.z() < coarse_.size[2];
      if (!inside) continue;
      coarse_.cells[coarse_.index(static_cast<int>(at.x()), static_cast<int>(at.y()),
                                  static_cast<int>(at.z()))] = 1;
    }
  }
}

std::size_t KnowledgeGrid::count(Knowledge knowledge) const {
  return static_cast<std::size_t>(std::count(fine_.cells.begin(), fine_.cells.end(), byte(knowledge)));
}

}  // namespace hoctomap
