// SPDX-License-Identifier: BSD-3-Clause
#include "hoctomap/octree/NodeMap.h"

#include <cmath>
#include <stdexcept>
#include <utility>

namespace hoctomap {

namespace {

std::unique_ptr<octomap::OcTree> emptyTree(double resolution) {
  if (!(resolution > 0.0) || !std::isfinite(resolution)) {
    throw std::invalid_argument("resolution of a node map must be positive and finite");
  }
  return std::make_unique<octomap::OcTree>(resolution);
}

/// Voxels along one edge of a leaf at `depth`.
std::uint64_t voxelsPerEdge(const octomap::OcTree& tree, unsigned depth) {
  return std::uint64_t{1} << (tree.getTreeDepth() - depth);
}

}  // namespace

NodeMap::NodeMap(double resolution, const OccupancyModel& model) : NodeMap(emptyTree(resolution), model) {}

NodeMap::NodeMap(std::unique_ptr<octomap::OcTree> tree, const OccupancyModel& model)
    : tree_(std::move(tree)), model_(model) {
  if (!tree_) throw std::invalid_argument("a node map needs a tree");
  model_.applyTo(*tree_);
}

ScanUpdateReport NodeMap::update(const ScanUpdate& engine, const Beams& beams) {
  occupied_valid_ = false;
  return engine.apply(*tree_, beams);
}

void NodeMap::absorb(const NodeMap& other, const Eigen::Isometry3d& this_T_other) {
  occupied_valid_ = false;
  octomap::OcTree source(*other.tree_);
  source.expand();
  for (const bool occupied : {true, false}) {
    for (auto leaf = source.begin_leafs(); leaf != source.end_leafs(); ++leaf) {
      if (source.isNodeOccupied(*leaf) != occupied) continue;
      const Eigen::Vector3d p = this_T_other * Eigen::Vector3d(leaf.getX(), leaf.getY(), leaf.getZ());
      octomap::OcTreeKey key;
      if (!tree_->coordToKeyChecked(p.x(), p.y(), p.z(), key)) continue;
      if (occupied || tree_->search(key) == nullptr) tree_->updateNode(key, leaf->getLogOdds());
    }
  }
}

void NodeMap::give(NodeMap& other, const Eigen::Isometry3d& other_T_this,
                   const std::function<bool(const Eigen::Vector3f&)>& which) {
  occupied_valid_ = other.occupied_valid_ = false;
  tree_->expand();
  // What stays goes into a new tree: stock `deleteNode` leaves empty inner nodes behind.
  auto rest = emptyTree(tree_->getResolution());
  model_.applyTo(*rest);
  for (auto leaf = tree_->begin_leafs(); leaf != tree_->end_leafs(); ++leaf) {
    const Eigen::Vector3d p(leaf.getX(), leaf.getY(), leaf.getZ());
    if (!tree_->isNodeOccupied(*leaf) || !which(p.cast<float>())) {
      rest->setNodeValue(leaf.getKey(), leaf->getLogOdds(), true);
      continue;
    }
    const Eigen::Vector3d q = other_T_this * p;
    octomap::OcTreeKey key;
    if (other.tree_->coordToKeyChecked(q.x(), q.y(), q.z(), key))
      other.tree_->updateNode(key, leaf->getLogOdds());
  }
  rest->updateInnerOccupancy();
  rest->prune();
  tree_ = std::move(rest);
}

const PointCloud& NodeMap::occupiedVoxels() const {
  if (!occupied_valid_) collectOccupied();
  return occupied_voxels_;
}

const Eigen::AlignedBox3d& NodeMap::occupiedBox() const {
  if (!occupied_valid_) collectOccupied();
  return occupied_box_;
}

void NodeMap::collectOccupied() const {
  occupied_voxels_.clear();
  occupied_box_.setEmpty();
  const double voxel = tree_->getResolution();
  for (auto leaf = tree_->begin_leafs(); leaf != tree_->end_leafs(); ++leaf) {
    if (!tree_->isNodeOccupied(*leaf)) continue;
    const auto edge = voxelsPerEdge(*tree_, leaf.getDepth());
    const Eigen::Vector3d center(leaf.getX(), leaf.getY(), leaf.getZ());
    const Eigen::Vector3d half = Eigen::Vector3d::Constant(0.5 * voxel * static_cast<double>(edge));
    occupied_box_.extend(Eigen::AlignedBox3d(center - half, center + half));
    const Eigen::Vector3d first = center - half + Eigen::Vector3d::Constant(0.5 * voxel);
    for (std::uint64_t x = 0; x < edge; ++x) {
      for (std::uint64_t y = 0; y < edge; ++y) {
        for (std::uint64_t z = 0; z < edge; ++z) {
          const Eigen::Vector3d step(static_cast<double>(x), static_cast<double>(y), static_cast<double>(z));
          occupied_voxels_.push_back((first + voxel * step).cast<float>());
        }
      }
    }
  }
  occupied_valid_ = true;
}

VoxelCounts NodeMap::countVoxels() const {
  VoxelCounts counts;
  for (auto leaf = tree_->begin_leafs(); leaf != tree_->end_leafs(); ++leaf) {
    const auto edge = voxelsPerEdge(*tree_, leaf.getDepth());
    (tree_->isNodeOccupied(*leaf) ? counts.occupied : counts.free) += edge * edge * edge;
  }
  return counts;
}

}  // namespace hoctomap
