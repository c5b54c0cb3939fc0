// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "hoctomap/existence/InverseExistenceModel.h"
#include "hoctomap/hierarchy/MapNode.h"

namespace hoctomap {

enum class NodeEventKind { created, updated, removed, moved, merged, split, reidentified };
[[nodiscard]] std::string toString(NodeEventKind kind);

/// What `created` says of a node: the points it was made of, the scan they are of, and what it hangs under.
[[nodiscard]] std::string createdDetail(std::uint64_t points, std::uint64_t scan, NodeId parent);

/// One change of one node.
struct NodeEvent {
  NodeEventKind kind = NodeEventKind::created;
  NodeId node;
  Label label;
  double existence = 0.0;  ///< after the event
  std::string detail;
};

/// One line of the existence ledger.
struct ExistenceEntry {
  NodeId node;
  Evidence evidence;
  double p_posterior = 0.0;
};

/// Wall seconds of the stages of one update.
struct StageSeconds {
  double segment = 0.0;
  double associate = 0.0;
  double update = 0.0;
  double existence = 0.0;
};

/// What one call of `HierarchyMapper::integrate` did.
struct UpdateReport {
  std::uint64_t scan = 0;
  double stamp = 0.0;
  std::size_t points = 0;
  std::vector<NodeEvent> events;
  std::vector<ExistenceEntry> existence;
  std::size_t beyond_key_range = 0;   ///< endpoints outside what a node's octree can address
  std::vector<std::string> warnings;  ///< what was ignored, and why
  StageSeconds seconds;
};

/// A node that is no longer part of the hierarchy, as it was.
struct RemovedNode {
  MapNode node;
  Pose world_T_node;
  std::uint64_t removed_scan = 0;
};

}  // namespace hoctomap
