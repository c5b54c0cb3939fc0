// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <optional>
#include <set>
#include <span>
#include <vector>

#include "SurfaceRegions.h"
#include "hoctomap/hierarchy/MapHierarchy.h"

namespace hoctomap {

/// Which regions of the surface the known nodes hold. A node's main region is the one that most of its cells
/// are in. It holds another one, too, if it reaches well into it: along a seam, cells are of both sides.
class NodeRegions {
 public:
  using Region = SurfaceRegions::Region;

  NodeRegions(const MapHierarchy& hierarchy, std::span<const NodeId> nodes, const SurfaceRegions& regions);

  [[nodiscard]] std::vector<NodeId> nodes() const;
  [[nodiscard]] std::optional<Region> mainOf(NodeId node) const;
  /// Nodes whose main region it is, by id.
  [[nodiscard]] std::vector<NodeId> ownersOf(Region region) const;
  /// Whether some node holds it.
  [[nodiscard]] bool isHeld(Region region) const;
  /// Regions beside its main one that a node holds.
  [[nodiscard]] std::set<Region> othersOf(NodeId node) const;

  /// `piece` is a part of `whole` now.
  void merge(NodeId whole, NodeId piece);
  /// `from` has given a region to `to`, whose main one it is if it had none.
  void give(NodeId from, NodeId to, Region region);

 private:
  struct Held {
    std::optional<Region> main;
    std::set<Region> others;
  };
  std::map<NodeId, Held> held_;
};

}  // namespace hoctomap
