// SPDX-License-Identifier: BSD-3-Clause
#include "hoctomap/mapping/LateMatches.h"

#include <algorithm>

#include "MovedObjects.h"
#include "SurfacePoints.h"

namespace hoctomap {

LateMatches::State LateMatches::stateOf(const MapHierarchy& hierarchy, NodeId id) {
  return {hierarchy.node(id).version, toIsometry(hierarchy.world_T_node(id)).matrix()};
}

std::optional<LateMatch> LateMatches::find(const MapHierarchy& hierarchy, NodeId known, std::uint64_t scan,
                                           const std::map<NodeId, Evidence>& support,
                                           const ReidentificationConfig& config) {
  if (!config.enabled) return std::nullopt;
  std::erase_if(compared_, [&](const auto& entry) {
    return !hierarchy.contains(entry.first.first) || !hierarchy.contains(entry.first.second);
  });
  const MapNode& old = hierarchy.node(known);
  const auto isContradicted = [&](NodeId id) {
    const auto found = support.find(id);
    return found != support.end() && found->second.contradicts();
  };
  constexpr double kMetre = 1.0;  // both maps are means of many scans: their noise is that of near ranges
  const RegistrationConfig registration = registrationAt(config, old.map().resolution(), kMetre);
  const auto isSame = [](const State& a, const State& b) {
    return a.version == b.version && a.world_T_node == b.world_T_node;
  };
  const State known_state = stateOf(hierarchy, known);
  std::optional<PointCloud> surface;
  const auto compare = [&](NodeId id) {
    const State state = stateOf(hierarchy, id);
    const auto found = compared_.find({known, id});
    if (found != compared_.end() && isSame(found->second.known, known_state) &&
        isSame(found->second.other, state)) {
      return found->second.registration;
    }
    if (!surface) surface = worldSurface(hierarchy, known);
    const Registration r = registerPoints(*surface, worldSurface(hierarchy, id), registration);
    // What this scan has changed it may change again.
    if (std::max(known_state.version, state.version) < scan) {
      compared_.insert_or_assign({known, id}, Comparison{known_state, state, r});
    }
    return r;
  };
  std::optional<LateMatch> match;
  for (const NodeId id : hierarchy.idsSince(old.last_scan)) {
    const MapNode& node = hierarchy.node(id);
    if (id == known || node.label() != old.label()) continue;
    if (node.first_scan >= scan || isContradicted(id)) continue;
    const Registration r = compare(id);
    if (r.verdict != Match::same) continue;
    if (match) return std::nullopt;  // look-alikes: nobody knows
    match = LateMatch{known, id, r};
  }
  return match;
}

}  // namespace hoctomap
