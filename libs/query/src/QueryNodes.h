// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <deque>
#include <memory>
#include <mutex>
#include <optional>
#include <vector>

#include "BoxIndex.h"
#include "QueryNode.h"
#include "hoctomap/query/HierarchyQuery.h"

namespace hoctomap {

/// What stands behind a HierarchyQuery: the nodes in the order in which they decide, where they are, and
/// their octrees, each of which is asked for when a question touches it first.
class HierarchyQuery::Nodes {
 public:
  Nodes(std::shared_ptr<const NodeSource> source, const QueryConfig& config);

  [[nodiscard]] std::size_t size() const { return places_.size(); }
  [[nodiscard]] const NodePlace& place(std::size_t i) const { return source_->places()[places_[i]]; }
  [[nodiscard]] Label label(std::size_t i) const { return source_->label(places_[i]); }
  [[nodiscard]] bool isLoaded(std::size_t i) const { return nodes_[i].ready.load(std::memory_order_acquire); }
  [[nodiscard]] const QueryNode& operator[](std::size_t i) const {
    return isLoaded(i) ? *nodes_[i].node : load(i);
  }

 private:
  struct Slot {
    std::atomic<bool> ready{false};
    std::optional<QueryNode> node;
  };
  const QueryNode& load(std::size_t i) const;

  std::shared_ptr<const NodeSource> source_;
  std::vector<std::size_t> places_;  ///< of the source, in order
  mutable std::mutex loading_;
  mutable std::deque<Slot> nodes_;

 public:
  const BoxIndex known;          ///< boxes of the known voxels in the world, by index here
  const BoxIndex occupied;       ///< of the occupied ones
  Eigen::AlignedBox3d anything;  ///< around all that is known, in the world
};

}  // namespace hoctomap
