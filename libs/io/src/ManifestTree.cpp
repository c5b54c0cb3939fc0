// SPDX-License-Identifier: BSD-3-Clause
#include "ManifestTree.h"

#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include "PoseText.h"
#include "hoctomap/geometry/Errors.h"

namespace hoctomap {
namespace {

std::string text(NodeId id) {
  return std::to_string(id.value);
}

using Records = std::map<NodeId, NodeRecord*>;
using Children = std::map<NodeId, std::vector<NodeId>>;

Records byId(std::vector<NodeRecord>& nodes, const std::string& name) {
  Records records;
  for (NodeRecord& node : nodes) {
    if (!records.emplace(node.id, &node).second) {
      throw MapError(name + ": nodes: id " + text(node.id) + " occurs twice");
    }
  }
  return records;
}

void checkRoot(const std::vector<NodeRecord>& nodes, const std::string& name) {
  const NodeRecord* root = nullptr;
  for (const NodeRecord& node : nodes) {
    if (node.parent) continue;
    if (root != nullptr) {
      throw MapError(name + ": nodes: two roots, " + text(root->id) + " and " + text(node.id));
    }
    root = &node;
  }
  if (root == nullptr) throw MapError(name + ": nodes: there is no root (a node with `parent: null`)");
  if (root->id != kRootId) throw MapError(name + ": node " + text(root->id) + ": the root must have id 0");
  if (!nearlyEqual(root->parent_T_node, Pose(), 0.0)) {
    throw MapError(name + ": node 0: pose: the root's frame must be the world's");
  }
}

Children childrenByParents(const Records& records, const std::string& name) {
  Children children;
  for (const auto& [id, node] : records) {
    if (!node->parent) continue;
    if (!records.contains(*node->parent)) {
      throw MapError(name + ": node " + text(id) + ": parent: there is no node " + text(*node->parent));
    }
    children[*node->parent].push_back(id);
  }
  for (const auto& [id, node] : records) {
    if (node->children != children[id]) {
      throw MapError(name + ": node " + text(id) + ": children: not the nodes that have it as parent");
    }
  }
  return children;
}

void checkWorldPose(const NodeRecord& parent, const NodeRecord& node, const std::string& name) {
  const double reach = 1.0 + parent.world_T_node.norm() + node.parent_T_node.norm();
  if (!nearlyEqual(parent.world_T_node + node.parent_T_node, node.world_T_node, 1e-6 * reach)) {
    throw MapError(name + ": node " + text(node.id) + ": world_pose: not the parent's world pose and `pose`");
  }
}

}  // namespace

std::vector<NodeRecord> orderedTree(std::vector<NodeRecord> nodes, const std::string& name) {
  const Records records = byId(nodes, name);
  checkRoot(nodes, name);
  const Children children = childrenByParents(records, name);

  std::vector<NodeId> order;
  std::vector<std::pair<NodeId, std::size_t>> todo{{kRootId, 0}};  // with depths; last is next
  while (!todo.empty()) {
    const auto [id, depth] = todo.back();
    todo.pop_back();
    if (depth > kMaxMapDepth) {
      throw LimitError(name + ": node " + text(id) + ": deeper than " + std::to_string(kMaxMapDepth));
    }
    order.push_back(id);
    const auto& below = children.at(id);
    for (auto child = below.rbegin(); child != below.rend(); ++child) {
      checkWorldPose(*records.at(id), *records.at(*child), name);
      todo.emplace_back(*child, depth + 1);
    }
  }
  if (order.size() != nodes.size()) {
    std::set<NodeId> lost;
    for (const NodeRecord& node : nodes) lost.insert(node.id);
    for (const NodeId id : order) lost.erase(id);
    throw MapError(name + ": node " + text(*lost.begin()) + ": parent: a cycle, no way up to the root");
  }

  std::vector<NodeRecord> ordered;
  ordered.reserve(nodes.size());
  for (const NodeId id : order) ordered.push_back(std::move(*records.at(id)));
  return ordered;
}

void checkIds(const Manifest& manifest, const std::string& name) {
  std::set<NodeId> ids;
  for (const auto* list : {&manifest.nodes, &manifest.removed, &manifest.waiting}) {
    for (const NodeRecord& node : *list) {
      if (!ids.insert(node.id).second) {
        throw MapError(name + ": removed, waiting: id " + text(node.id) + " occurs twice");
      }
      if (node.id >= manifest.next_id) {
        throw MapError(name + ": next_id: " + text(manifest.next_id) + " is not above id " + text(node.id));
      }
    }
  }
  for (const NodeRecord& node : manifest.waiting) {
    if (!node.parent || manifest.find(*node.parent) == nullptr || !node.children.empty()) {
      throw MapError(name + ": waiting: node " + text(node.id) +
                     ": must hang under a node of the tree, alone");
    }
  }
}

void endLog(Manifest& manifest) {
  for (NodeRecord& node : manifest.waiting) {
    if (!node.confirmation.enough) continue;
    node.confirmation = node.confirmation.letInAtEnd();
    const auto parent = std::find_if(manifest.nodes.begin(), manifest.nodes.end(),
                                     [&](const NodeRecord& other) { return other.id == node.parent; });
    auto& siblings = parent->children;  // it is there: see checkIds
    siblings.insert(std::lower_bound(siblings.begin(), siblings.end(), node.id), node.id);
    manifest.let_in_at_end.push_back(node.id);
    manifest.nodes.push_back(std::move(node));
  }
  manifest.waiting.clear();
  manifest.nodes = orderedTree(std::move(manifest.nodes), "kept state");
}

}  // namespace hoctomap
