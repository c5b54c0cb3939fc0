// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <utility>

#include "hoctomap/mapping/HierarchyMapper.h"

namespace hoctomap {

/// What a scan says of the nodes in view, before anything of it is integrated (III-D).
struct HierarchyMapper::NodeEvidence {
  std::map<NodeId, Evidence> by_node;

  [[nodiscard]] bool contradicts(NodeId id) const {
    const auto found = by_node.find(id);
    return found != by_node.end() && found->second.contradicts();
  }
  /// The beams that end where the node was do so on something else.
  void contradict(NodeId id, double p_absent) {
    Evidence& e = by_node.at(id);
    e.absent += e.present;
    e.present = 0;
    e.p_measurement = p_absent;
  }
  /// The scan shows the node after all, though not where it was.
  void support(NodeId id, double p_present) {
    Evidence& e = by_node.at(id);
    if (e.contradicts()) std::swap(e.present, e.absent);
    e.p_measurement = p_present;
  }
};

}  // namespace hoctomap
