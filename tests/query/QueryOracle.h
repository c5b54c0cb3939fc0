// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "hoctomap/query/HierarchyQuery.h"
#include "support/RandomScenes.h"

namespace hoctomap::test {

/// A root and a few nodes at random poses that lie over each other: several resolutions (two nodes share
/// one), several depths, existence from 0.5 to 0.95, pruned cubes beside single voxels, occupied and free.
MapHierarchy randomHierarchy(Rng& rng);

/// Answers the questions of `HierarchyQuery` by looking at every voxel of every node.
class QueryOracle {
 public:
  explicit QueryOracle(const MapHierarchy& map, double min_existence = 0.0);

  [[nodiscard]] PointAnswer at(const Eigen::Vector3d& p) const;
  [[nodiscard]] RayAnswer castRay(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction,
                                  const RayOptions& options) const;
  [[nodiscard]] std::optional<NodeId> collision(const Obb& box) const;
  [[nodiscard]] std::optional<NodeId> collision(const Eigen::Vector3d& centre, double radius) const;
  [[nodiscard]] std::optional<NearestVoxel> nearestOccupied(const Eigen::Vector3d& p,
                                                            double max_distance) const;
  [[nodiscard]] double unknownShare(const Obb& box, double step) const;
  [[nodiscard]] std::vector<NodeInRegion> nodesIn(const Obb& region) const;

 private:
  struct Voxel {
    Eigen::Vector3d low;    // in the node's frame
    Eigen::Vector3d world;  // its centre
    bool occupied;
    double probability;
  };
  struct Node {
    NodeId id;
    std::size_t depth;
    double resolution;
    double existence;
    Eigen::Isometry3d world_T_node;
    std::vector<Voxel> voxels;
    [[nodiscard]] Obb cube(const Voxel& voxel) const;
    [[nodiscard]] bool meets(const Voxel& voxel, const Obb& box) const;
  };
  std::vector<Node> nodes_;  // in the order in which they decide
};

}  // namespace hoctomap::test
