// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <compare>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "hoctomap/hierarchy/MapNode.h"
#include "hoctomap/hierarchy/Relation.h"

namespace hoctomap {

class NodeBoxes;

/// What a node is among others.
struct NodeKind {
  std::size_t depth = 0;
  Label label;
  auto operator<=>(const NodeKind&) const = default;
};

/// The map M = {n_1, ..., n_k} of Eq. 1: a tree of map nodes, and their only owner.
///
/// Properties:
///  1. there is always exactly one root; its id is 0, its frame the world frame;
///  2. every other node has a parent in the hierarchy, and `children` mirrors `parent`;
///  3. ids are given in order of creation and never again;
///  4. `remove` and `reparent` keep the world pose of every remaining node; `move` moves a node with its
///  whole
///     subtree rigidly;
///  5. traversal is parents before children, siblings by id.
class MapHierarchy {
 public:
  explicit MapHierarchy(Label root_label, NodeMap root_map);

  ~MapHierarchy();
  MapHierarchy(MapHierarchy&&) noexcept;
  MapHierarchy& operator=(MapHierarchy&&) noexcept;

  [[nodiscard]] std::size_t size() const { return nodes_.size(); }
  [[nodiscard]] bool contains(NodeId id) const { return nodes_.contains(id); }
  /// @throws std::out_of_range if there is no such node.
  [[nodiscard]] const MapNode& node(NodeId id) const;
  /// The reference is for changing the node now: one kept beyond the next call of `idsNear` must not change
  /// the map m_i.
  [[nodiscard]] MapNode& node(NodeId id);
  [[nodiscard]] const MapNode& root() const { return node(kRootId); }
  [[nodiscard]] MapNode& root() { return node(kRootId); }

  /// t_i^global (Eq. 4): the composition of the transforms from the root down to the node.
  [[nodiscard]] Pose world_T_node(NodeId id) const;
  /// Distance to the root, which has depth 0.
  [[nodiscard]] std::size_t depth(NodeId id) const;
  /// Whether a node is in the subtree of another, or is that node.
  [[nodiscard]] bool isInSubtree(NodeId id, NodeId subtree_root) const;
  /// The node's oriented box in the world: occupied voxels padded by one voxel. Empty without any.
  [[nodiscard]] Obb box(NodeId id) const;
  /// What relations are asked about.
  [[nodiscard]] NodeView view(NodeId id) const;
  /// All ids, parents before children, siblings ascending.
  [[nodiscard]] std::vector<NodeId> preorder() const;
  /// All ids, ascending.
  [[nodiscard]] std::vector<NodeId> ids() const;
  /// Calls `visit(node)` for all nodes, ids ascending.
  template <typename Visit>
  void forEachNode(const Visit& visit) const {
    for (const auto& [unused, node] : nodes_) visit(std::as_const(*node));
  }
  /// Ids of the nodes whose box in the world meets `world` (touching, up to a hair), ascending. The cost
  /// grows with their number and with that of the nodes changed since the last call, not with that of all
  /// nodes. Not for several threads at once.
  [[nodiscard]] std::vector<NodeId> idsNear(const Eigen::AlignedBox3d& world) const;
  /// Ids of the nodes whose first scan is later than `scan`, ascending; at the same cost.
  [[nodiscard]] std::vector<NodeId> idsSince(std::uint64_t scan) const;
  /// The node whose box in the world is nearest to a point, of those for which `which` is true; none if no
  /// such node has a box. The cost grows with the number of nodes that are nearer.
  [[nodiscard]] std::optional<NodeId> nearest(const Eigen::Vector3d& point,
                                              const std::function<bool(NodeId)>& which) const;
  /// Kinds of the nodes that do not wait for confirmation, deepest first; at the cost of `idsNear`.
  [[nodiscard]] std::vector<NodeKind> kinds() const;
  [[nodiscard]] NodeId nextId() const { return next_id_; }

  /// Adds a node under `parent` so that its frame in the world is `world_T_node`: t_i = t_p^global^-1 o it.
  /// @throws std::out_of_range if there is no such parent.
  NodeId add(Label label, NodeMap map, const Pose& world_T_node, NodeId parent);

  /// Adds a node of a stored map, with its own id. Parents come first.
  /// @throws std::invalid_argument if the id is taken; std::out_of_range if there is no such parent.
  MapNode& restore(NodeId id, Label label, NodeMap map, const Pose& parent_T_node, NodeId parent);
  void setNextId(NodeId id);

  /// Removes a node and hands it out; its children go to the deepest remaining ancestor, its parent.
  /// @throws std::invalid_argument for the root.
  MapNode remove(NodeId id);

  /// t_i <- t_i o t (Section III-D); children follow.
  /// @throws std::invalid_argument for the root.
  void move(NodeId id, const Pose& motion);

  /// @throws std::invalid_argument for the root.
  void relabel(NodeId id, Label label);

  /// Hangs a node under another parent and keeps its world pose.
  /// @throws std::invalid_argument if that would close a cycle, or for the root.
  void reparent(NodeId id, NodeId parent);

 private:
  void touchSubtree(NodeId id);

  std::map<NodeId, std::unique_ptr<MapNode>> nodes_;
  NodeId next_id_{1};
  std::unique_ptr<NodeBoxes> boxes_;  ///< derived from the nodes, brought up to date by `idsNear`
};

}  // namespace hoctomap
