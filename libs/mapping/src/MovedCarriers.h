// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>

#include "MovedObjects.h"
#include "ScanSight.h"

namespace hoctomap {

/// A node that has moved with all that stands on it.
struct MovedCarrier {
  NodeId node;
  Eigen::Isometry3d motion;  ///< in the world
  double score = 0.0;        ///< of the child that gave it
};

/// Finds nodes that moved with their children (III-D: a table carries its objects). A plane slides along
/// itself, so its children say how it moved: all of them that this scan shows are elsewhere, by one motion,
/// and with that motion the scan contradicts less of the carrier's surface than without. Which of several
/// look-alikes is which does not matter: only one motion takes all of them to their places.
/// @param objects  candidates of `findMovedObjects`
/// @param support  evidence by node, from the whole scan
[[nodiscard]] std::vector<MovedCarrier> findMovedCarriers(const MapHierarchy& hierarchy,
                                                          std::span<const MovedObject> objects,
                                                          const std::map<NodeId, Evidence>& support,
                                                          const ScanSight& sight,
                                                          const ReidentificationConfig& config);

}  // namespace hoctomap
