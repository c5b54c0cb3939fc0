// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <utility>

#include "hoctomap/hierarchy/MapHierarchy.h"
#include "hoctomap/query/HierarchyQuery.h"

namespace hoctomap::python {

/// A hierarchy that does not change any more, so that arrays may look into it and any thread may ask it.
class Map {
 public:
  Map(MapHierarchy hierarchy, std::uint64_t scans) : hierarchy_(std::move(hierarchy)), scans_(scans) {
    // What nodes compute on first use is there before several threads ask for it.
    for (const NodeId id : hierarchy_.ids()) (void)std::as_const(hierarchy_).node(id).map().occupiedVoxels();
  }

  [[nodiscard]] const MapHierarchy& hierarchy() const { return hierarchy_; }
  [[nodiscard]] std::uint64_t scans() const { return scans_; }  ///< taken in, skipped ones included

 private:
  MapHierarchy hierarchy_;
  std::uint64_t scans_;
};

/// A node of a map, which it keeps alive.
struct Node {
  std::shared_ptr<Map> map;
  NodeId id;

  [[nodiscard]] const MapNode& operator*() const { return map->hierarchy().node(id); }
  [[nodiscard]] const MapNode* operator->() const { return &**this; }
};

/// A copy of what of a hierarchy at work is in the map: without nodes that wait for confirmation.
[[nodiscard]] MapHierarchy copyOf(const MapHierarchy& hierarchy);

}  // namespace hoctomap::python
