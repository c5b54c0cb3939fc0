// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "ScanSight.h"
#include "hoctomap/existence/InverseExistenceModel.h"
#include "hoctomap/hierarchy/MapHierarchy.h"
#include "hoctomap/mapping/Reidentification.h"

namespace hoctomap {

/// A segment of the scan, and the node it would be associated to by its box.
struct SegmentInQuestion {
  Label label;
  const PointCloud* world_points = nullptr;
  std::optional<NodeId> node;
};

/// A segment that shows a node elsewhere than it was mapped.
struct MovedObject {
  NodeId node;
  std::size_t segment = 0;  ///< index
  Registration registration;
};

struct MovedObjects {
  std::vector<MovedObject> found;
  std::vector<MovedObject> candidates;  ///< all that fit, look-alikes too
  std::vector<std::string>
      ambiguous;  ///< one sentence for each segment that could be a node and was not taken
};

/// Parameters of a registration for a map of this resolution (m), seen at this range (m).
[[nodiscard]] RegistrationConfig registrationAt(const ReidentificationConfig& config, double resolution,
                                                double range);

/// Finds the nodes that this scan shows elsewhere (III-D): a node that loses its support is registered to
/// each segment of its label that is new, or that lies in the node's own box. What fits two is nobody's.
/// @param support  evidence by node, from the whole scan, before anything of it was integrated
/// @param origin   of the scan, in the world
[[nodiscard]] MovedObjects findMovedObjects(const MapHierarchy& hierarchy, const Eigen::Vector3d& origin,
                                            const ScanSight& sight,
                                            std::span<const SegmentInQuestion> segments,
                                            const std::map<NodeId, Evidence>& support,
                                            const ReidentificationConfig& config);

}  // namespace hoctomap
