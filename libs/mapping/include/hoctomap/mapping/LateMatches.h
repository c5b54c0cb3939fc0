// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <map>
#include <optional>
#include <utility>

#include "hoctomap/existence/InverseExistenceModel.h"
#include "hoctomap/hierarchy/MapHierarchy.h"
#include "hoctomap/mapping/Reidentification.h"

namespace hoctomap {

/// A node that was made when its object appeared in a new place, before the old place was seen to be empty.
struct LateMatch {
  NodeId known;  ///< the object's first node, which this scan contradicts
  NodeId again;  ///< its node in the new place
  Registration registration;
};

/// Looks for late matches, and remembers how two nodes compared until one of them changes: a node that is
/// contradicted scan after scan is not compared with all of the map each time. What it finds does not depend
/// on what it remembers.
class LateMatches {
 public:
  /// The node that shows where `known` has gone (III-D): younger than all that was seen of `known` in its old
  /// place, made before this scan, of its label, and of its shape. Nothing if none fits, or several.
  /// @param scan     number of this scan: what is new in it is `findMovedObjects`' to judge
  /// @param support  evidence by node, from the whole scan
  [[nodiscard]] std::optional<LateMatch> find(const MapHierarchy& hierarchy, NodeId known, std::uint64_t scan,
                                              const std::map<NodeId, Evidence>& support,
                                              const ReidentificationConfig& config);

 private:
  /// A node as it was compared: its map is that of `version` if no later scan, nor this one, has changed it.
  struct State {
    std::uint64_t version;
    Eigen::Matrix4d world_T_node;
  };
  struct Comparison {
    State known;
    State other;
    Registration registration;
  };

  [[nodiscard]] static State stateOf(const MapHierarchy& hierarchy, NodeId id);

  std::map<std::pair<NodeId, NodeId>, Comparison> compared_;
};

}  // namespace hoctomap
