// SPDX-License-Identifier: BSD-3-Clause
// Nodes that one view alone has shown are held back until others confirm them (docs/decisions/0022).
#include <algorithm>
#include <utility>

#include "NodeEvidence.h"

namespace hoctomap {

namespace {

/// Whether what is known of a node that no second view has confirmed is enough at the end of a log: no view
/// spoke against it, and not more of them passed it over than showed it.
bool isWellSupported(const MapNode& node, const ExistenceParameters& existence) {
  return node.existence_log_odds >= ExistenceFilter(existence).initialLogOdds() && node.votes.joined == 0 &&
         node.confirmation.missed <= node.confirmation.shown;
}

}  // namespace

void HierarchyMapper::confirmNodes(const std::vector<LabelledPart>& parts, const NodeEvidence& evidence,
                                   UpdateReport& report) {
  const std::set<NodeId> waiting = waiting_;  // those that enter leave it
  for (const NodeId id : waiting) {
    Confirmation& confirmation = hierarchy_.node(id).confirmation;
    if (std::any_of(parts.begin(), parts.end(),
                    [id](const auto& part) { return part.node == id && !part.joined_with; })) {
      if (++confirmation.shown >= config_.confirm_scans) enterMap(id, report);
    } else if (const auto seen = evidence.by_node.find(id); seen != evidence.by_node.end()) {
      confirmation.missed += seen->second.informative || seen->second.in_sight ? 1U : 0U;
    }
  }
  for (const NodeId id : waiting_) {
    MapNode& node = hierarchy_.node(id);
    node.confirmation.enough = isWellSupported(node, profile(node.label()).existence);
  }
}

UpdateReport HierarchyMapper::finish(std::uint64_t scan, double stamp) {
  UpdateReport report;
  report.scan = scan;
  report.stamp = stamp;
  const std::set<NodeId> waiting = waiting_;
  for (const NodeId id : waiting) {
    MapNode& node = hierarchy_.node(id);
    if (!node.confirmation.enough) continue;
    const Confirmation before = node.confirmation;
    enterMap(id, report);
    node.confirmation = before.letInAtEnd();
  }
  return report;
}

void HierarchyMapper::enterMap(NodeId id, UpdateReport& report) {
  MapNode& node = hierarchy_.node(id);
  waiting_.erase(id);
  const std::uint64_t points = node.confirmation.points;
  node.confirmation = {};
  note(report, NodeEventKind::created, id,
       createdDetail(points, node.first_scan, node.parent().value_or(kRootId)));
  adoptRelated({id});
}

void HierarchyMapper::takeOut(NodeId id, std::uint64_t scan) {
  const Pose world_T_node = hierarchy_.world_T_node(id);
  MapNode node = hierarchy_.remove(id);
  if (waiting_.erase(id) > 0) return;  // nobody has heard of it
  removed_.push_back({std::move(node), world_T_node, scan});
}

void HierarchyMapper::note(UpdateReport& report, NodeEventKind kind, NodeId id, std::string detail) const {
  const MapNode& node = hierarchy_.node(id);
  if (node.confirmation.waits) return;
  report.events.push_back({kind, id, node.label(), node.existence(), std::move(detail)});
}

}  // namespace hoctomap
