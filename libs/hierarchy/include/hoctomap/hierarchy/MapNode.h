// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "hoctomap/geometry/Obb.h"
#include "hoctomap/geometry/Pose.h"
#include "hoctomap/hierarchy/Label.h"
#include "hoctomap/hierarchy/NodeId.h"
#include "hoctomap/octree/NodeMap.h"

namespace hoctomap {

/// How often scans showed a node apart from a neighbour of its label, and joined to it: whether the two are
/// one (docs/decisions/0006).
struct PieceVotes {
  std::uint64_t apart = 0;   ///< scans in which the node took a segment of its own
  std::uint64_t joined = 0;  ///< scans in which it was seen as part of a segment of `with`
  NodeId with;
  bool operator==(const PieceVotes&) const = default;
};

/// Whether a node is held back until other views confirm it (docs/decisions/0022). A node that waits takes
/// segments and evidence as any other, but is no part of the map that is written, has no children, and emits
/// no events.
struct Confirmation {
  bool waits = false;
  bool entered_at_end = false;  ///< of the log, unconfirmed: waits again if the log goes on
  std::uint64_t shown = 0;      ///< scans that gave it a segment, while it waits
  std::uint64_t missed = 0;     ///< scans that had its surface in sight and gave it none
  std::uint64_t points = 0;     ///< of the segment that it was made of
  bool enough = false;          ///< speaks for it to let it in if the log ended now
  bool operator==(const Confirmation&) const = default;

  /// The same after the end of the log has let the node in.
  [[nodiscard]] Confirmation letInAtEnd() const {
    Confirmation after = *this;
    after.waits = false;
    after.entered_at_end = true;
    return after;
  }
  /// The same when the log goes on after all.
  [[nodiscard]] Confirmation heldBack() const {
    Confirmation before = *this;
    before.waits = true;
    before.entered_at_end = false;
    return before;
  }
};

/// A node n_i = (m_i, t_i, p_i, C_i, l_i) of Eq. 2, with its probability of existence (Section III-D).
/// The tree structure (t, p, C) is changed by `MapHierarchy` only.
class MapNode {
 public:
  MapNode(NodeId id, Label label, NodeMap map);

  [[nodiscard]] NodeId id() const { return id_; }
  [[nodiscard]] const Label& label() const { return label_; }                      ///< l_i
  [[nodiscard]] const std::optional<NodeId>& parent() const { return parent_; }    ///< p_i
  [[nodiscard]] const std::vector<NodeId>& children() const { return children_; }  ///< C_i, ascending
  [[nodiscard]] const Pose& parent_T_node() const { return parent_T_node_; }       ///< t_i
  [[nodiscard]] const NodeMap& map() const { return map_; }                        ///< m_i
  [[nodiscard]] NodeMap& map() { return map_; }

  /// logit P(n | z_1:t). Log-odds, because Eq. 8 is a sum there.
  double existence_log_odds = 0.0;
  [[nodiscard]] double existence() const;

  std::uint64_t first_scan = 0;  ///< first scan in its map
  std::uint64_t last_scan = 0;   ///< last scan that updated its map
  std::uint64_t version = 0;     ///< last scan that changed the node's map; names its file
  std::uint64_t edition = 0;     ///< last edit by hand that changed it, if any; names its file, too
  PieceVotes votes;
  Confirmation confirmation;

 private:
  friend class MapHierarchy;
  NodeId id_;
  Label label_;
  std::optional<NodeId> parent_;
  std::vector<NodeId> children_;
  Pose parent_T_node_;
  NodeMap map_;
};

}  // namespace hoctomap
