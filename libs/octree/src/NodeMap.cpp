// SPDX-License-Identifier: BSD-3-Clause
#include "hoctomap/octree/NodeMap.h"

#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

#include "OccupiedCorners.h"
#include "OccupiedLeaves.h"
#include "VoxelTransfer.h"
#include "hoctomap/octree/TreeBytes.h"

namespace hoctomap {

namespace {

std::unique_ptr<octomap::OcTree> emptyTree(double resolution) {
  if (!(resolution > 0.0) || !std::isfinite(resolution)) {
    throw std::invalid_argument("resolution of a node map must be positive and finite");
  }
  return std::make_unique<octomap::OcTree>(resolution);
}

/// Centre of a voxel, a few voxels on from the one with the key.
Eigen::Vector3d centerOf(const octomap::OcTree& tree, const octomap::OcTreeKey& key,
                         const Eigen::Array3i& steps = Eigen::Array3i::Zero()) {
  const auto at = [&](unsigned axis) {
    return tree.keyToCoord(static_cast<octomap::key_type>(key[axis] + steps[axis]));
  };
  return {at(0), at(1), at(2)};
}

/// The voxels `level` levels below: 2^level along each edge, the first with the key.
Eigen::AlignedBox3d cubeOf(const octomap::OcTree& tree, const octomap::OcTreeKey& first, unsigned level) {
  const Eigen::Vector3d half = Eigen::Vector3d::Constant(0.5 * tree.getResolution());
  return {centerOf(tree, first) - half,
          centerOf(tree, first, Eigen::Array3i::Constant((1 << level) - 1)) + half};
}

/// Adds the centres of the occupied voxels of leaves that `enter` lets in.
template <typename Enter>
void collectOccupied(const octomap::OcTree& tree, PointCloud& voxels, const Enter& enter) {
  const auto visit = [&](const octomap::OcTreeKey& first, unsigned level) {
    const int edge = 1 << level;
    for (int x = 0; x < edge; ++x)
      for (int y = 0; y < edge; ++y)
        for (int z = 0; z < edge; ++z) voxels.push_back(centerOf(tree, first, {x, y, z}).cast<float>());
  };
  engine::OccupiedLeaves(tree, visit, enter);
}

bool isBesideOccupied(const octomap::OcTree& tree, const octomap::OcTreeKey& key) {
  for (int i = 0; i < 27; ++i) {
    octomap::OcTreeKey there = key;
    there[0] = static_cast<octomap::key_type>(key[0] + i % 3 - 1);
    there[1] = static_cast<octomap::key_type>(key[1] + i / 3 % 3 - 1);
    there[2] = static_cast<octomap::key_type>(key[2] + i / 9 - 1);
    const auto* voxel = tree.search(there);
    if (voxel != nullptr && tree.isNodeOccupied(voxel)) return true;
  }
  return false;
}

/// The tree, all leaves at its resolution, in another grid: of voxels that fall into one, the largest counts.
octomap::OcTree resampled(const octomap::OcTree& source, const Eigen::Isometry3d& there_T_source) {
  octomap::OcTree there(source.getResolution());
  for (auto leaf = source.begin_leafs(); leaf != source.end_leafs(); ++leaf) {
    if (!source.isNodeOccupied(*leaf) && isBesideOccupied(source, leaf.getKey())) continue;
    const Eigen::Vector3d p = there_T_source * Eigen::Vector3d(leaf.getX(), leaf.getY(), leaf.getZ());
    octomap::OcTreeKey key;
    if (!there.coordToKeyChecked(p.x(), p.y(), p.z(), key)) continue;
    const auto* taken = there.search(key);
    if (taken == nullptr || taken->getLogOdds() < leaf->getLogOdds()) {
      there.setNodeValue(key, leaf->getLogOdds(), true);
    }
  }
  return there;
}

/// Keys that are occupied after a scan and were not before: of ends of beams. What is no number has none.
engine::KeyBox keysOfEnds(const octomap::OcTree& tree, const Beams& beams) {
  Eigen::Array3f low = Eigen::Array3f::Constant(std::numeric_limits<float>::infinity());
  Eigen::Array3f high = -low;
  for (const auto ends : {beams.hits, beams.endpoints}) {
    for (const auto& p : ends) {
      for (Eigen::Index i = 0; i < 3; ++i) {
        if (p[i] < low[i]) low[i] = p[i];
        if (p[i] > high[i]) high[i] = p[i];
      }
    }
  }
  if ((low > high).any()) return engine::kNoKeys;
  return engine::VoxelGrid(tree.getResolution())
      .keyBox(Eigen::AlignedBox3d(low.matrix().cast<double>(), high.matrix().cast<double>()));
}

}  // namespace

// Here, where OccupiedCorners is known.
NodeMap::NodeMap(NodeMap&&) noexcept = default;
NodeMap& NodeMap::operator=(NodeMap&&) noexcept = default;
NodeMap::~NodeMap() = default;

void NodeMap::changed(const engine::KeyBox& occupied) {
  voxels_valid_ = false;
  corners_->changed(occupied);
}

NodeMap::NodeMap(double resolution, const OccupancyModel& model) : NodeMap(emptyTree(resolution), model) {}

NodeMap::NodeMap(std::unique_ptr<octomap::OcTree> tree, const OccupancyModel& model)
    : tree_(std::move(tree)), model_(model), corners_(std::make_unique<engine::OccupiedCorners>()) {
  if (!tree_) throw std::invalid_argument("a node map needs a tree");
  model_.applyTo(*tree_);
}

ScanUpdateReport NodeMap::update(const ScanUpdate& engine, const Beams& beams) {
  changed(keysOfEnds(*tree_, beams));
  return engine.apply(*tree_, beams);
}

void NodeMap::absorb(const NodeMap& other, const Eigen::Isometry3d& this_T_other) {
  changed(engine::kAllKeys);
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

void NodeMap::add(const NodeMap& other, const Eigen::Isometry3d& this_T_other) {
  changed(engine::kAllKeys);
  octomap::OcTree source(*other.tree_);
  source.expand();
  const bool same_grid = this_T_other.matrix().isIdentity(0.0) && source.getResolution() == resolution();
  const octomap::OcTree here = same_grid ? source : resampled(source, this_T_other);
  for (auto leaf = here.begin_leafs(); leaf != here.end_leafs(); ++leaf) {
    tree_->updateNode(leaf.getCoordinate(), leaf->getLogOdds(), true);
  }
  tree_->updateInnerOccupancy();
  tree_->prune();
}

void NodeMap::give(NodeMap& other, const Eigen::Isometry3d& other_T_this,
                   const std::function<bool(const Eigen::Vector3f&)>& which) {
  changed(engine::kNoKeys);
  other.changed(engine::kAllKeys);
  const auto center = [this](const octomap::OcTreeKey& key) { return centerOf(*tree_, key); };
  engine::takeVoxels(
      *tree_, [&](const octomap::OcTreeKey& key) { return which(center(key).cast<float>()); },
      [&](const octomap::OcTreeKey& key, float log_odds) {
        const Eigen::Vector3d p = other_T_this * center(key);
        octomap::OcTreeKey there;
        if (other.tree_->coordToKeyChecked(p.x(), p.y(), p.z(), there))
          other.tree_->updateNode(there, log_odds);
      });
}

void NodeMap::cede(const PointCloud& points) {
  octomap::KeySet near;
  for (const auto& p : points) {
    octomap::OcTreeKey key;
    if (!tree_->coordToKeyChecked(p.x(), p.y(), p.z(), key)) continue;
    for (int n = 0; n < 27; ++n) {
      const auto beside = [n, &key](unsigned axis, int step) {
        return static_cast<octomap::key_type>(key[axis] + n / step % 3 - 1);
      };
      near.insert({beside(0, 9), beside(1, 3), beside(2, 1)});
    }
  }
  octomap::KeySet lost;
  for (const auto& key : near) {
    const octomap::OcTreeNode* voxel = tree_->search(key);
    if (voxel == nullptr || !tree_->isNodeOccupied(voxel)) continue;
    changed(engine::kNoKeys);
    if (voxel->getLogOdds() - tree_->getProbHitLog() < tree_->getOccupancyThresLog()) {
      lost.insert(key);
    } else {
      tree_->updateNode(key, -tree_->getProbHitLog());
    }
  }
  if (lost.empty()) return;
  engine::takeVoxels(
      *tree_, [&](const octomap::OcTreeKey& key) { return lost.count(key) > 0; },
      [](const octomap::OcTreeKey&, float) {});
}

const PointCloud& NodeMap::occupiedVoxels() const {
  if (!voxels_valid_) {
    occupied_voxels_.clear();
    collectOccupied(*tree_, occupied_voxels_, [](const octomap::OcTreeKey&, unsigned) { return true; });
    voxels_valid_ = true;
  }
  return occupied_voxels_;
}

PointCloud NodeMap::occupiedVoxelsIn(const Eigen::AlignedBox3d& box) const {
  PointCloud voxels;
  collectOccupied(*tree_, voxels, [&](const octomap::OcTreeKey& first, unsigned level) {
    return cubeOf(*tree_, first, level).intersects(box);
  });
  return voxels;
}

Eigen::AlignedBox3d NodeMap::occupiedBox() const {
  const auto& corners = corners_->of(*tree_);
  if (!corners) return {};
  return cubeOf(*tree_, corners->first, 0).merged(cubeOf(*tree_, corners->second, 0));
}

VoxelExtent NodeMap::extent() const {
  return extentOf(otNodes(*tree_), tree_->getResolution(), tree_->getOccupancyThresLog());
}

}  // namespace hoctomap
