// SPDX-License-Identifier: BSD-3-Clause
#include "hoctomap/octree/TreeBytes.h"

#include <array>
#include <cstring>
#include <optional>
#include <vector>

#include "TreeAccess.h"

namespace hoctomap {
namespace {

using engine::kOctants;
using engine::kTreeLevels;
using engine::Node;
using engine::NodeAccess;

const Node* child(const Node& node, unsigned octant) {
  auto* const* children = NodeAccess::childrenOf(node);
  return children == nullptr ? nullptr : static_cast<const Node*>(children[octant]);
}

void appendOt(const Node& node, std::string& bytes) {
  const float log_odds = node.getValue();
  std::array<char, sizeof log_odds + 1> own{};
  std::memcpy(own.data(), &log_odds, sizeof log_odds);
  unsigned children = 0;
  for (unsigned octant = 0; octant < kOctants; ++octant)
    children |= (child(node, octant) != nullptr ? 1U : 0U) << octant;
  own.back() = static_cast<char>(children);
  bytes.append(own.data(), own.size());
  for (unsigned octant = 0; octant < kOctants; ++octant)
    if (const Node* next = child(node, octant)) appendOt(*next, bytes);
}

/// Writes the maximum-likelihood tree. OctoMap prunes it level by level from below and stops at the first
/// level at which there is nothing to prune; the root is never pruned.
class BtWriter {
 public:
  explicit BtWriter(const octomap::OcTree& tree) : tree_(tree) {
    const Node* root = tree.getRoot();
    if (root == nullptr) return;
    seen_.reserve(tree.size());
    look(*root, 0);
    for (unsigned depth = kTreeLevels - 1; depth > 0 && prunable_[depth] > 0; --depth) pruned_from_ = depth;
    out_.bytes.reserve(tree.size() / 2);
    out_.nodes = 1;
    write(*root, 0, 0);
  }

  [[nodiscard]] TreeBytes take() && { return std::move(out_); }

 private:
  /// A node, in the order of the file.
  struct Seen {
    bool prunable = false;  ///< all eight children are leaves, or prunable, of one value
    bool occupied = false;
    std::uint32_t next = 0;  ///< index of the first that is not below it
  };

  /// The value that a leaf has, or would have if it was pruned.
  std::optional<bool> look(const Node& node, unsigned depth) {
    const std::size_t at = seen_.size();
    seen_.emplace_back();
    unsigned children = 0;
    unsigned leaves = 0;
    unsigned occupied = 0;
    for (unsigned octant = 0; octant < kOctants; ++octant) {
      const Node* next = child(node, octant);
      if (next == nullptr) continue;
      ++children;
      const auto value = look(*next, depth + 1);
      leaves += value.has_value();
      occupied += value.value_or(false);
    }
    Seen& seen = seen_[at];
    seen.next = static_cast<std::uint32_t>(seen_.size());
    seen.prunable = leaves == kOctants && (occupied == 0 || occupied == kOctants);
    if (seen.prunable) ++prunable_[depth];
    seen.occupied = seen.prunable ? occupied > 0 : tree_.isNodeOccupied(node);
    if (children > 0 && !seen.prunable) return std::nullopt;
    return seen.occupied;
  }

  void write(const Node& node, std::uint32_t at, unsigned depth) {
    unsigned kinds = 0;
    unsigned inner = 0;
    std::array<std::uint32_t, kOctants> places{};
    std::uint32_t place = at + 1;
    for (unsigned octant = 0; octant < kOctants; ++octant) {
      const Node* next = child(node, octant);
      if (next == nullptr) continue;
      const Seen& seen = seen_[place];
      const bool is_leaf = seen.next == place + 1 || (seen.prunable && depth + 1 >= pruned_from_);
      kinds |= (is_leaf ? (seen.occupied ? kOccupied : kFree) : kInner) << (2 * octant);
      if (!is_leaf) inner |= 1U << octant;
      places[octant] = place;
      place = seen.next;
      ++out_.nodes;
    }
    out_.bytes.push_back(static_cast<char>(kinds & 0xFFU));
    out_.bytes.push_back(static_cast<char>(kinds >> 8U));
    for (unsigned octant = 0; octant < kOctants; ++octant)
      if ((inner >> octant & 1U) != 0) write(*child(node, octant), places[octant], depth + 1);
  }

  static constexpr unsigned kFree = 1;
  static constexpr unsigned kOccupied = 2;
  static constexpr unsigned kInner = 3;

  const octomap::OcTree& tree_;
  std::vector<Seen> seen_;
  std::array<std::uint64_t, kTreeLevels + 1> prunable_{};  ///< by depth
  unsigned pruned_from_ = kTreeLevels;                     ///< nodes of this depth and deeper are pruned
  TreeBytes out_;
};

}  // namespace

TreeBytes otNodes(const octomap::OcTree& tree) {
  TreeBytes out;
  out.nodes = tree.size();
  out.bytes.reserve(tree.size() * 5);
  if (const Node* root = tree.getRoot()) appendOt(*root, out.bytes);
  return out;
}

TreeBytes btNodes(const octomap::OcTree& tree) {
  return BtWriter(tree).take();
}

}  // namespace hoctomap
