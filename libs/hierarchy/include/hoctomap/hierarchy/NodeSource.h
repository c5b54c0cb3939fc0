// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <memory>
#include <vector>

#include "hoctomap/hierarchy/MapHierarchy.h"

namespace hoctomap {

/// What is known of a node before one looks at its octree.
struct NodePlace {
  NodeId id;
  std::size_t depth = 0;  ///< distance to the root
  double resolution = 0.0;
  double existence = 0.5;
  Eigen::Isometry3d world_T_node = Eigen::Isometry3d::Identity();
  VoxelExtent extent;  ///< of its octree
};

/// The nodes of a hierarchy for those who only look: of a map in memory, or of one on disk, whose octrees are
/// read when somebody asks for them. All members may be called by any number of threads at once.
class NodeSource {
 public:
  virtual ~NodeSource() = default;

  /// By id. Nodes are known by their index here.
  [[nodiscard]] virtual const std::vector<NodePlace>& places() const = 0;
  [[nodiscard]] virtual Label label(std::size_t index) const = 0;
  /// Each call may read it again.
  /// @throws MapError and FileError if it is on disk and damaged.
  [[nodiscard]] virtual std::shared_ptr<const NodeMap> map(std::size_t index) const = 0;
};

/// The nodes of a hierarchy in memory, which has to outlive this unchanged.
class HierarchyNodes final : public NodeSource {
 public:
  explicit HierarchyNodes(const MapHierarchy& hierarchy);

  [[nodiscard]] const std::vector<NodePlace>& places() const override { return places_; }
  [[nodiscard]] Label label(std::size_t index) const override;
  [[nodiscard]] std::shared_ptr<const NodeMap> map(std::size_t index) const override;

 private:
  const MapHierarchy& hierarchy_;
  std::vector<NodePlace> places_;
};

}  // namespace hoctomap
