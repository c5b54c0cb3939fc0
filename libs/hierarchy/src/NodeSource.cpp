// SPDX-License-Identifier: BSD-3-Clause
#include "hoctomap/hierarchy/NodeSource.h"

namespace hoctomap {

HierarchyNodes::HierarchyNodes(const MapHierarchy& hierarchy) : hierarchy_(hierarchy) {
  places_.reserve(hierarchy.size());
  for (const NodeId id : hierarchy.ids()) {
    const MapNode& node = hierarchy.node(id);
    places_.push_back({id, hierarchy.depth(id), node.map().resolution(), node.existence(),
                       toIsometry(hierarchy.world_T_node(id)), node.map().extent()});
  }
}

Label HierarchyNodes::label(std::size_t index) const {
  return hierarchy_.node(places_.at(index).id).label();
}

std::shared_ptr<const NodeMap> HierarchyNodes::map(std::size_t index) const {
  // The hierarchy stays its owner.
  return {std::shared_ptr<const NodeMap>(), &hierarchy_.node(places_.at(index).id).map()};
}

}  // namespace hoctomap
