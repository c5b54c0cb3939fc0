// SPDX-License-Identifier: BSD-3-Clause
#include "hoctomap/hierarchy/MapHierarchy.h"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <utility>

#include "NodeBoxes.h"

namespace hoctomap {

namespace {

void insertChild(std::vector<NodeId>& children, NodeId id) {
  children.insert(std::lower_bound(children.begin(), children.end(), id), id);
}

void eraseChild(std::vector<NodeId>& children, NodeId id) {
  std::erase(children, id);
}

}  // namespace

MapHierarchy::MapHierarchy(Label root_label, NodeMap root_map) : boxes_(std::make_unique<NodeBoxes>()) {
  nodes_.emplace(kRootId, std::make_unique<MapNode>(kRootId, std::move(root_label), std::move(root_map)));
  boxes_->touch(kRootId);
}

MapHierarchy::~MapHierarchy() = default;
MapHierarchy::MapHierarchy(MapHierarchy&&) noexcept = default;
MapHierarchy& MapHierarchy::operator=(MapHierarchy&&) noexcept = default;

const MapNode& MapHierarchy::node(NodeId id) const {
  const auto found = nodes_.find(id);
  if (found == nodes_.end()) throw std::out_of_range("no node " + std::to_string(id.value));
  return *found->second;
}

MapNode& MapHierarchy::node(NodeId id) {
  const MapNode& found = std::as_const(*this).node(id);
  boxes_->touch(id);
  return const_cast<MapNode&>(found);
}

Pose MapHierarchy::world_T_node(NodeId id) const {  // Eq. (4)
  const MapNode& n = node(id);
  return n.parent_ ? world_T_node(*n.parent_) + n.parent_T_node_ : n.parent_T_node_;
}

std::size_t MapHierarchy::depth(NodeId id) const {
  std::size_t depth = 0;
  for (const MapNode* n = &node(id); n->parent_; n = &node(*n->parent_)) ++depth;
  return depth;
}

bool MapHierarchy::isInSubtree(NodeId id, NodeId subtree_root) const {
  for (const MapNode* n = &node(id);; n = &node(*n->parent_)) {
    if (n->id() == subtree_root) return true;
    if (!n->parent_) return false;
  }
}

Obb MapHierarchy::box(NodeId id) const {
  const NodeMap& map = node(id).map();
  return Obb{toIsometry(world_T_node(id)), map.occupiedBox()}.padded(map.resolution());
}

NodeView MapHierarchy::view(NodeId id) const {
  return {node(id).label(), box(id), &node(id).map()};
}

std::vector<NodeId> MapHierarchy::preorder() const {
  std::vector<NodeId> order;
  order.reserve(nodes_.size());
  std::vector<NodeId> stack{kRootId};
  while (!stack.empty()) {
    order.push_back(stack.back());
    stack.pop_back();
    const auto& children = node(order.back()).children_;
    stack.insert(stack.end(), children.rbegin(), children.rend());
  }
  return order;
}

std::vector<NodeId> MapHierarchy::ids() const {
  std::vector<NodeId> ids;
  ids.reserve(nodes_.size());
  for (const auto& [id, unused] : nodes_) ids.push_back(id);
  return ids;
}

std::vector<NodeId> MapHierarchy::idsNear(const Eigen::AlignedBox3d& world) const {
  return boxes_->near(world, *this);
}

std::vector<NodeId> MapHierarchy::idsSince(std::uint64_t scan) const {
  return boxes_->since(scan, *this);
}

std::optional<NodeId> MapHierarchy::nearest(const Eigen::Vector3d& point,
                                            const std::function<bool(NodeId)>& which) const {
  return boxes_->nearest(point, which, *this);
}

std::vector<NodeKind> MapHierarchy::kinds() const {
  return boxes_->kinds(*this);
}

void MapHierarchy::touchSubtree(NodeId id) {
  boxes_->touch(id);
  for (const NodeId child : std::as_const(*this).node(id).children_) touchSubtree(child);
}

NodeId MapHierarchy::add(Label label, NodeMap map, const Pose& world_T_node, NodeId parent) {
  const Pose parent_T_node = orthonormalized(-this->world_T_node(parent) + world_T_node);
  const NodeId id = next_id_;
  restore(id, std::move(label), std::move(map), parent_T_node, parent);
  return id;
}

MapNode& MapHierarchy::restore(NodeId id, Label label, NodeMap map, const Pose& parent_T_node,
                               NodeId parent) {
  MapNode& parent_node = node(parent);
  auto added = std::make_unique<MapNode>(id, std::move(label), std::move(map));
  added->parent_ = parent;
  added->parent_T_node_ = parent_T_node;
  const auto [position, inserted] = nodes_.emplace(id, std::move(added));
  if (!inserted) throw std::invalid_argument("node id " + std::to_string(id.value) + " is taken");
  boxes_->touch(id);
  insertChild(parent_node.children_, id);
  next_id_ = std::max(next_id_, NodeId{id.value + 1});
  return *position->second;
}

void MapHierarchy::setNextId(NodeId id) {
  if (id < next_id_) throw std::invalid_argument("the next node id would repeat an id");
  next_id_ = id;
}

MapNode MapHierarchy::remove(NodeId id) {
  if (id == kRootId) throw std::invalid_argument("the root cannot be removed");
  const std::vector<NodeId> orphans = node(id).children_;
  const NodeId parent = *node(id).parent_;
  for (const NodeId orphan : orphans) reparent(orphan, parent);
  eraseChild(node(parent).children_, id);
  MapNode removed = std::move(node(id));
  nodes_.erase(id);
  boxes_->erase(id);
  return removed;
}

void MapHierarchy::move(NodeId id, const Pose& motion) {
  if (id == kRootId) throw std::invalid_argument("the root cannot be moved");
  MapNode& n = node(id);
  n.parent_T_node_ = orthonormalized(n.parent_T_node_ + motion);
  touchSubtree(id);
}

void MapHierarchy::relabel(NodeId id, Label label) {
  if (id == kRootId) throw std::invalid_argument("the root keeps its label");
  node(id).label_ = std::move(label);
}

void MapHierarchy::reparent(NodeId id, NodeId parent) {
  if (id == kRootId) throw std::invalid_argument("the root has no parent");
  if (isInSubtree(parent, id)) throw std::invalid_argument("a node cannot hang below itself");
  MapNode& n = node(id);
  const Pose world_T_n = world_T_node(id);
  eraseChild(node(*n.parent_).children_, id);
  insertChild(node(parent).children_, id);
  n.parent_ = parent;
  n.parent_T_node_ = orthonormalized(-world_T_node(parent) + world_T_n);
  touchSubtree(id);  // by rounding
}

}  // namespace hoctomap
