// SPDX-License-Identifier: BSD-3-Clause
#include "hoctomap/io/MergedTree.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "hoctomap/geometry/Errors.h"
#include "hoctomap/hierarchy/LogOdds.h"

namespace hoctomap {

namespace {

constexpr double kMaxPoints = 5e8;

/// A node as points are asked about.
struct Source {
  const octomap::OcTree* tree;
  Eigen::Isometry3d world_T_node;
  Eigen::Isometry3d node_T_world;
  Eigen::AlignedBox3d box;  ///< of all that it knows, in its frame
  double existence;
};

Eigen::AlignedBox3d knownBox(const octomap::OcTree& tree) {
  Eigen::Vector3d low = Eigen::Vector3d::Zero();
  Eigen::Vector3d high = Eigen::Vector3d::Zero();
  tree.getMetricMin(low.x(), low.y(), low.z());
  tree.getMetricMax(high.x(), high.y(), high.z());
  return {low, high};
}

/// Finest first, equals by id.
std::vector<Source> sourcesOf(const MapHierarchy& hierarchy) {
  std::vector<Source> sources;
  for (const NodeId id : hierarchy.ids()) {
    const MapNode& node = hierarchy.node(id);
    if (node.map().tree().size() == 0) continue;
    const Eigen::Isometry3d pose = toIsometry(hierarchy.world_T_node(id));
    sources.push_back(
        {&node.map().tree(), pose, pose.inverse(), knownBox(node.map().tree()), node.existence()});
  }
  std::stable_sort(sources.begin(), sources.end(), [](const Source& a, const Source& b) {
    return a.tree->getResolution() < b.tree->getResolution();
  });
  return sources;
}

/// Nodes that may know a point of a cube, however it is turned, finest first.
std::vector<const Source*> sourcesAt(const std::vector<Source>& sources, const Eigen::Vector3d& world,
                                     double edge) {
  std::vector<const Source*> near;
  for (const Source& source : sources) {
    if (source.box.exteriorDistance(source.node_T_world * world) <= 0.5 * std::sqrt(3.0) * edge)
      near.push_back(&source);
  }
  return near;
}

/// What the finest node that knows a point says of it, as far as that node exists; of equally fine ones what
/// is nearest to occupied. One half where none knows.
double probabilityAt(const std::vector<const Source*>& sources, const Eigen::Vector3d& world) {
  std::optional<double> found;
  double finest = 0.0;
  for (const Source* source : sources) {
    if (found && source->tree->getResolution() > finest) break;
    const Eigen::Vector3d p = source->node_T_world * world;
    if (!source->box.contains(p)) continue;
    const auto* leaf = source->tree->search(p.x(), p.y(), p.z());
    if (leaf == nullptr) continue;
    finest = source->tree->getResolution();
    found = std::max(found.value_or(0.0), 0.5 + source->existence * (leaf->getOccupancy() - 0.5));
  }
  return found.value_or(0.5);
}

/// Points along an edge of a leaf at which the result is looked at: so near each other that every voxel of
/// the result inside, however it is turned, has one.
int pointsAlong(double edge, double resolution) {
  return std::max(1, static_cast<int>(std::ceil(std::sqrt(3.0) * edge / resolution - 1e-9)));
}

double pointsToLookAt(const std::vector<Source>& sources, double resolution) {
  double sum = 0.0;
  for (const Source& source : sources) {
    for (auto leaf = source.tree->begin_leafs(); leaf != source.tree->end_leafs(); ++leaf)
      sum += std::pow(pointsAlong(leaf.getSize(), resolution), 3);
  }
  return sum;
}

/// Raises the voxels of the result to what is found in them.
class Merging {
 public:
  Merging(octomap::OcTree& merged, const std::vector<Source>& sources) : merged_(merged), sources_(sources) {}

  void add(const Source& source) {
    for (auto leaf = source.tree->begin_leafs(); leaf != source.tree->end_leafs(); ++leaf)
      addLeaf(source, {leaf.getX(), leaf.getY(), leaf.getZ()}, leaf.getSize());
  }

 private:
  void addLeaf(const Source& source, const Eigen::Vector3d& center, double edge) {
    const auto near = sourcesAt(sources_, source.world_T_node * center, edge);
    const bool alone = near.size() == 1;  // then all of the leaf has one probability
    const double everywhere = alone ? probabilityAt(near, source.world_T_node * center) : 0.0;
    const int n = pointsAlong(edge, merged_.getResolution());
    const auto offset = [&](int i) { return edge * ((i + 0.5) / n - 0.5); };
    for (int x = 0; x < n; ++x) {
      for (int y = 0; y < n; ++y) {
        for (int z = 0; z < n; ++z) {
          const Eigen::Vector3d world =
              source.world_T_node * (center + Eigen::Vector3d(offset(x), offset(y), offset(z)));
          raise(world, alone ? everywhere : probabilityAt(near, world));
        }
      }
    }
  }

  void raise(const Eigen::Vector3d& world, double probability) {
    octomap::OcTreeKey key;
    if (!merged_.coordToKeyChecked(world.x(), world.y(), world.z(), key)) return;
    if (key == last_ && probability <= last_probability_) return;
    last_ = key;
    last_probability_ = probability;
    const auto value = static_cast<float>(logOdds(probability));
    const auto* known = merged_.search(key);
    if (known == nullptr || known->getLogOdds() < value) merged_.setNodeValue(key, value, true);
  }

  octomap::OcTree& merged_;
  const std::vector<Source>& sources_;
  octomap::OcTreeKey last_;  ///< the voxel raised last, and to what: points beside each other share one
  double last_probability_ = -1.0;
};

}  // namespace

std::unique_ptr<octomap::OcTree> mergedTree(const MapHierarchy& hierarchy, double resolution) {
  constexpr double kFinest = 1e-4;
  if (!std::isfinite(resolution) || resolution < kFinest)
    throw ConfigError("--resolution: must be at least 0.0001 m");
  const std::vector<Source> sources = sourcesOf(hierarchy);
  if (pointsToLookAt(sources, resolution) > kMaxPoints)
    throw LimitError("--resolution " + std::to_string(resolution) + ": too fine for a map of this size");
  auto merged = std::make_unique<octomap::OcTree>(resolution);
  Merging merging(*merged, sources);
  for (const Source& source : sources) merging.add(source);
  merged->updateInnerOccupancy();
  merged->prune();
  return merged;
}

}  // namespace hoctomap
