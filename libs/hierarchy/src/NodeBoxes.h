// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "hoctomap/hierarchy/NodeId.h"

namespace hoctomap {

class MapHierarchy;
struct NodeKind;

/// Where the nodes of a hierarchy are, since when, and of what kinds: an R-tree over their boxes in the
/// world, an order by first scans, and a count of kinds, kept up to date lazily. Only nodes that were touched
/// since the last question are looked at again.
class NodeBoxes {
 public:
  NodeBoxes();
  ~NodeBoxes();
  NodeBoxes(const NodeBoxes&) = delete;
  NodeBoxes& operator=(const NodeBoxes&) = delete;

  /// The node is new, or its pose or map may change from now on.
  void touch(NodeId id);
  void erase(NodeId id);

  /// Nodes of `hierarchy` whose box in the world meets `world`, and some that miss it by a hair; ascending.
  [[nodiscard]] std::vector<NodeId> near(const Eigen::AlignedBox3d& world, const MapHierarchy& hierarchy);
  /// Nodes whose first scan is later than `scan`, ascending.
  [[nodiscard]] std::vector<NodeId> since(std::uint64_t scan, const MapHierarchy& hierarchy);
  /// See `MapHierarchy`.
  [[nodiscard]] std::optional<NodeId> nearest(const Eigen::Vector3d& point,
                                              const std::function<bool(NodeId)>& which,
                                              const MapHierarchy& hierarchy);
  [[nodiscard]] std::vector<NodeKind> kinds(const MapHierarchy& hierarchy);

 private:
  struct Index;
  std::unique_ptr<Index> index_;
};

}  // namespace hoctomap
