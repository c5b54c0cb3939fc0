// SPDX-License-Identifier: BSD-3-Clause
#include "NodeBoxes.h"

#include <algorithm>
#include <boost/geometry.hpp>
#include <boost/geometry/index/rtree.hpp>
#include <functional>
#include <iterator>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <unordered_map>
#include <utility>

#include "hoctomap/hierarchy/MapHierarchy.h"

namespace hoctomap {

namespace {

namespace bg = boost::geometry;
using Point = bg::model::point<double, 3, bg::cs::cartesian>;
using Box = bg::model::box<Point>;

constexpr double kHair = 1e-6;  // m: more than rounding makes of the corners of an oriented box
constexpr double kFar = 1e9;    // m: the R-tree's arithmetic does not like infinity

Box toBox(const Eigen::AlignedBox3d& box) {
  const Eigen::Vector3d low = (box.min().array() - kHair).max(-kFar).min(kFar);
  const Eigen::Vector3d high = (box.max().array() + kHair).max(-kFar).min(kFar);
  return {{low.x(), low.y(), low.z()}, {high.x(), high.y(), high.z()}};
}

}  // namespace

struct NodeBoxes::Index {
  using Entry = std::pair<Box, std::uint32_t>;
  struct Node {
    bool touched = false;
    Eigen::AlignedBox3d indexed;  ///< as it is in the tree; empty: it is not
    std::optional<std::uint64_t> first_scan;
    std::optional<NodeKind> kind;
  };

  bg::index::rtree<Entry, bg::index::quadratic<16>> tree;
  std::set<std::pair<std::uint64_t, std::uint32_t>> by_first_scan;
  std::map<NodeKind, std::size_t, std::greater<>> kinds;
  std::unordered_map<std::uint32_t, Node> nodes;
  std::vector<NodeId> touched;

  void takeOut(NodeId id, Node& node) {
    if (!node.indexed.isEmpty()) tree.remove(Entry{toBox(node.indexed), id.value});
    node.indexed.setEmpty();
  }

  void order(NodeId id, Node& node, std::optional<std::uint64_t> first_scan) {
    if (node.first_scan == first_scan) return;
    if (node.first_scan) by_first_scan.erase({*node.first_scan, id.value});
    if (first_scan) by_first_scan.insert({*first_scan, id.value});
    node.first_scan = first_scan;
  }

  void count(Node& node, const std::optional<NodeKind>& kind) {
    if (node.kind == kind) return;
    if (node.kind && --kinds.at(*node.kind) == 0) kinds.erase(*node.kind);
    if (kind) ++kinds[*kind];
    node.kind = kind;
  }

  void refresh(const MapHierarchy& hierarchy) {
    for (const NodeId id : touched) {
      const auto found = nodes.find(id.value);
      if (found == nodes.end()) continue;  // removed meanwhile
      Node& node = found->second;
      node.touched = false;
      const MapNode& now = hierarchy.node(id);
      order(id, node, now.first_scan);
      count(node, now.confirmation.waits ? std::nullopt
                                         : std::optional<NodeKind>({hierarchy.depth(id), now.label()}));
      const Eigen::AlignedBox3d bounds = worldBounds(hierarchy.box(id));
      if (bounds.min() == node.indexed.min() && bounds.max() == node.indexed.max()) continue;
      takeOut(id, node);
      node.indexed = bounds;
      if (!bounds.isEmpty()) tree.insert(Entry{toBox(bounds), id.value});
    }
    touched.clear();
  }
};

NodeBoxes::NodeBoxes() : index_(std::make_unique<Index>()) {}
NodeBoxes::~NodeBoxes() = default;

void NodeBoxes::touch(NodeId id) {
  Index::Node& node = index_->nodes[id.value];
  if (std::exchange(node.touched, true)) return;
  index_->touched.push_back(id);
}

void NodeBoxes::erase(NodeId id) {
  const auto found = index_->nodes.find(id.value);
  if (found == index_->nodes.end()) return;
  index_->takeOut(id, found->second);
  index_->order(id, found->second, std::nullopt);
  index_->count(found->second, std::nullopt);
  index_->nodes.erase(found);
}

std::vector<NodeId> NodeBoxes::near(const Eigen::AlignedBox3d& world, const MapHierarchy& hierarchy) {
  index_->refresh(hierarchy);
  std::vector<NodeId> ids;
  if (world.isEmpty()) return ids;
  for (auto found = index_->tree.qbegin(bg::index::intersects(toBox(world))); found != index_->tree.qend();
       ++found)
    ids.push_back(NodeId{found->second});
  std::sort(ids.begin(), ids.end());
  return ids;
}

std::vector<NodeId> NodeBoxes::since(std::uint64_t scan, const MapHierarchy& hierarchy) {
  index_->refresh(hierarchy);
  std::vector<NodeId> ids;
  constexpr auto kLast = std::numeric_limits<std::uint32_t>::max();
  const auto& ordered = index_->by_first_scan;
  for (auto it = ordered.upper_bound({scan, kLast}); it != ordered.end(); ++it)
    ids.push_back(NodeId{it->second});
  std::sort(ids.begin(), ids.end());
  return ids;
}

std::optional<NodeId> NodeBoxes::nearest(const Eigen::Vector3d& point,
                                         const std::function<bool(NodeId)>& which,
                                         const MapHierarchy& hierarchy) {
  index_->refresh(hierarchy);
  const Eigen::Vector3d p = point.array().max(-kFar).min(kFar);
  const auto found = index_->tree.qbegin(
      bg::index::nearest(Point(p.x(), p.y(), p.z()), 1) &&
      bg::index::satisfies([&which](const Index::Entry& entry) { return which(NodeId{entry.second}); }));
  if (found == index_->tree.qend()) return std::nullopt;
  return NodeId{found->second};
}

std::vector<NodeKind> NodeBoxes::kinds(const MapHierarchy& hierarchy) {
  index_->refresh(hierarchy);
  std::vector<NodeKind> kinds;
  for (const auto& [kind, count] : index_->kinds) kinds.push_back(kind);
  return kinds;
}

}  // namespace hoctomap
