// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <limits>
#include <vector>

#include "QueryNode.h"
#include "hoctomap/query/HierarchyQuery.h"

namespace hoctomap {

/// A ray on its way through the octree of one node: what lies along it, piece by piece. Cells that touch
/// share the plane between them, so that no piece is lost to rounding.
class RayWalk {
 public:
  /// @param direction of length 1; both in the world
  RayWalk(const QueryNode& node, const Eigen::Vector3d& origin, const Eigen::Vector3d& direction);

  struct Piece {
    Occupancy state = Occupancy::unknown;
    double leave = std::numeric_limits<double>::infinity();  ///< m along the ray
  };
  /// What is at `t` (m along the ray), and where that ends. `t` must not decrease from call to call.
  [[nodiscard]] Piece at(double t);

  [[nodiscard]] const QueryNode& node() const { return *node_; }

 private:
  struct Step {
    OctreeCell cell;
    double enter;
    double leave;
  };
  void push(const OctreeCell& cell);
  void advance();

  const QueryNode* node_;
  Eigen::Vector3d origin_;     // in the node's frame
  Eigen::Vector3d direction_;  // the same
  std::vector<Step> ahead_;    // the nearest last; the last one is a leaf
};

}  // namespace hoctomap
