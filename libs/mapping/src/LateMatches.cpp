// SPDX-License-Identifier: BSD-3-Clause
#include "LateMatches.h"

#include "MovedObjects.h"
#include "SurfacePoints.h"

namespace hoctomap {

std::optional<LateMatch> findLateMatch(const MapHierarchy& hierarchy, NodeId known, std::uint64_t scan,
                                       const std::map<NodeId, Evidence>& support,
                                       const ReidentificationConfig& config) {
  if (!config.enabled) return std::nullopt;
  const MapNode& old = hierarchy.node(known);
  const auto isContradicted = [&](NodeId id) {
    const auto found = support.find(id);
    return found != support.end() && found->second.contradicts();
  };
  constexpr double kMetre = 1.0;  // both maps are means of many scans: their noise is that of near ranges
  const RegistrationConfig registration = registrationAt(config, old.map().resolution(), kMetre);
  const PointCloud surface = worldSurface(hierarchy, known);
  std::optional<LateMatch> match;
  for (const NodeId id : hierarchy.ids()) {
    const MapNode& node = hierarchy.node(id);
    if (id == known || node.label() != old.label() || node.first_scan <= old.last_scan) continue;
    if (node.first_scan >= scan || isContradicted(id)) continue;
    const Registration r = registerPoints(surface, worldSurface(hierarchy, id), registration);
    if (r.verdict != Match::same) continue;
    if (match) return std::nullopt;  // look-alikes: nobody knows
    match = LateMatch{known, id, r};
  }
  return match;
}

}  // namespace hoctomap
