// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

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

/// Looks for the node that shows where `known` has gone (III-D): younger than all that was seen of `known` in
/// its old place, made before this scan, of its label, and of its shape. Nothing if none fits, or several.
/// @param scan     number of this scan: what is new in it is `findMovedObjects`' to judge
/// @param support  evidence by node, from the whole scan
[[nodiscard]] std::optional<LateMatch> findLateMatch(const MapHierarchy& hierarchy, NodeId known,
                                                     std::uint64_t scan,
                                                     const std::map<NodeId, Evidence>& support,
                                                     const ReidentificationConfig& config);

}  // namespace hoctomap
