// SPDX-License-Identifier: BSD-3-Clause
#include "hoctomap/hierarchy/MapNode.h"

#include <utility>

#include "hoctomap/hierarchy/LogOdds.h"

namespace hoctomap {

MapNode::MapNode(NodeId id, Label label, NodeMap map)
    : id_(id), label_(std::move(label)), map_(std::move(map)) {}

double MapNode::existence() const {
  return probability(existence_log_odds);
}

}  // namespace hoctomap
