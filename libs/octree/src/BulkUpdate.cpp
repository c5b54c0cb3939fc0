// SPDX-License-Identifier: BSD-3-Clause
#include "BulkUpdate.h"

#include <algorithm>
#include <limits>

#include "TreeAccess.h"

namespace hoctomap::engine {

namespace {

using Node = octomap::OcTreeNode;

constexpr unsigned kTreeLevels = 16;
constexpr unsigned kOctants = 8;

Node* child(Node& node, unsigned octant) {
  auto* const* children = NodeAccess::childrenOf(node);
  return children == nullptr ? nullptr : static_cast<Node*>(children[octant]);
}

bool hasChildren(Node& node) {
  auto* const* children = NodeAccess::childrenOf(node);
  return children != nullptr &&
         std::any_of(children, children + kOctants, [](const auto* c) { return c != nullptr; });
}

/// The tree's sensor model: what a miss and a hit make of a voxel's log-odds.
class Odds {
 public:
  explicit Odds(const octomap::OcTree& tree)
      : miss_(tree.getProbMissLog()),
        hit_(tree.getProbHitLog()),
        min_(tree.getClampingThresMinLog()),
        max_(tree.getClampingThresMaxLog()) {}

  [[nodiscard]] float created(bool hit) const { return add(0.0F, hit); }
  /// As octomap's updateNode of an existing voxel, early abort included.
  [[nodiscard]] float updated(float value, bool hit) const {
    return keeps(value, hit) ? value : add(value, hit);
  }
  /// True if octomap would not touch a voxel of this value.
  [[nodiscard]] bool keeps(float value, bool hit) const {
    const float update = hit ? hit_ : miss_;
    return (update >= 0.0F && value >= max_) || (update <= 0.0F && value <= min_);
  }

 private:
  [[nodiscard]] float add(float value, bool hit) const {
    const float sum = value + (hit ? hit_ : miss_);
    if (sum < min_) return min_;
    return sum > max_ ? max_ : sum;
  }

  float miss_;
  float hit_;
  float min_;
  float max_;
};

/// The recursion. Each function brings one node up to date and tells whether octomap would have touched it;
/// what it would not touch stays as it is, even if it could be pruned.
class Updater {
 public:
  explicit Updater(octomap::OcTree& tree) : odds_(tree), size_(TreeAccess::sizeOf(tree)) {}

  Node* create(float value) {
    ++size_;
    auto* node = new Node();
    node->setValue(value);
    return node;
  }

  /// A node above the blocks. @param created it has just been made: it has neither children nor a value of
  /// its own.
  bool updateUpper(Node& node, bool created, unsigned level, std::span<const BlockMarks> blocks) {
    if (level == kBlockLevel) return updateBlock(node, created, blocks.front());
    if (!created && !hasChildren(node)) {
      if (keepsAll(node.getValue(), blocks)) return false;
      expand(node);
    }
    bool touched = false;
    const unsigned shift = 3 * (level - 1 - kBlockLevel);
    while (!blocks.empty()) {
      const auto octant = [shift](const BlockMarks& b) {
        return static_cast<unsigned>(b.tree_code >> shift) & 7U;
      };
      const unsigned first = octant(blocks.front());
      const auto end =
          std::find_if(blocks.begin(), blocks.end(), [&](const auto& b) { return octant(b) != first; });
      const auto count = static_cast<std::size_t>(end - blocks.begin());
      const auto [next, next_created] = childOrNew(node, first);
      touched |= updateUpper(*next, next_created, level - 1, blocks.first(count));
      blocks = blocks.subspan(count);
    }
    if (touched) settle(node);
    return touched;
  }

 private:
  bool updateBlock(Node& node, bool created, const BlockMarks& marks) {
    const BlockView view(marks);
    return update<kBlockLevel>(node, created, view, 0, view.coverage<kBlockLevel>(0));
  }

  /// A node `level` levels above the voxels, whose first voxel is at `offset` in its block.
  template <unsigned level>
  bool update(Node& node, bool created, const BlockView& block, unsigned offset, const Coverage& coverage) {
    if (created || !hasChildren(node)) {
      if (!created && keepsAll(node.getValue(), coverage)) return false;
      if (coverage.all_free || coverage.all_occupied) {
        const bool hit = coverage.all_occupied;
        node.setValue(created ? odds_.created(hit) : odds_.updated(node.getValue(), hit));
        return true;
      }
      if (!created) expand(node);
    }
    bool touched = false;
    for (unsigned octant = 0; octant < kOctants; ++octant) {
      touched |= updateOctant<level - 1>(node, octant, block, offset + (octant << (3 * (level - 1))));
    }
    if (touched) settle(node);
    return touched;
  }

  template <unsigned level>
  bool updateOctant(Node& parent, unsigned octant, const BlockView& block, unsigned offset) {
    if constexpr (level == 1) {
      const unsigned free = block.freeCube(offset);
      const unsigned occupied = block.occupiedCube(offset);
      if ((free | occupied) == 0) return false;
      const auto [node, created] = childOrNew(parent, octant);
      return updateCube(*node, created, free, occupied);
    } else {
      const Coverage coverage = block.coverage<level>(offset);
      if (!coverage.any()) return false;
      const auto [node, created] = childOrNew(parent, octant);
      return update<level>(*node, created, block, offset, coverage);
    }
  }

  /// A node of 2^3 voxels; one bit a voxel in `free` and `occupied`.
  bool updateCube(Node& node, bool created, unsigned free, unsigned occupied) {
    if (!created && hasChildren(node)) return updateVoxels(node, free, occupied);
    const float value = node.getValue();
    if (!created && keepsAll(value, Coverage{free != 0, false, occupied != 0, false})) return false;

    // The values first: where they turn out equal, no voxel is ever made.
    const unsigned known = created ? free | occupied : 0xFFU;
    std::array<float, kOctants> values{};
    bool equal = known == 0xFFU;
    for (unsigned i = 0; i < kOctants; ++i) {
      const bool hit = (occupied >> i & 1U) != 0;
      const bool marked = ((free | occupied) >> i & 1U) != 0;
      values[i] = created ? odds_.created(hit) : marked ? odds_.updated(value, hit) : value;
      equal = equal && values[i] == values[0];
    }
    if (equal) {
      node.setValue(values[0]);
      return true;
    }
    for (unsigned i = 0; i < kOctants; ++i) {
      if ((known >> i & 1U) != 0) slot(node, i) = create(values[i]);
    }
    node.updateOccupancyChildren();
    return true;
  }

  bool updateVoxels(Node& node, unsigned free, unsigned occupied) {
    bool touched = false;
    for (unsigned i = 0; i < kOctants; ++i) {
      if (((free | occupied) >> i & 1U) == 0) continue;
      const bool hit = (occupied >> i & 1U) != 0;
      Node* voxel = child(node, i);
      if (voxel == nullptr) {
        slot(node, i) = create(odds_.created(hit));
      } else if (!odds_.keeps(voxel->getValue(), hit)) {
        voxel->setValue(odds_.updated(voxel->getValue(), hit));
      } else {
        continue;
      }
      touched = true;
    }
    if (touched) settle(node);
    return touched;
  }

  /// True if the marks change nothing in a leaf of this value: nor do they make octomap expand it.
  [[nodiscard]] bool keepsAll(float value, const Coverage& coverage) const {
    return (!coverage.any_free || odds_.keeps(value, false)) &&
           (!coverage.any_occupied || odds_.keeps(value, true));
  }
  [[nodiscard]] bool keepsAll(float value, std::span<const BlockMarks> blocks) const {
    return std::all_of(blocks.begin(), blocks.end(), [&](const BlockMarks& marks) {
      return keepsAll(value, BlockView(marks).coverage<kBlockLevel>(0));
    });
  }

  octomap::AbstractOcTreeNode*& slot(Node& node, unsigned octant) {
    auto**& children = NodeAccess::childrenOf(node);
    if (children == nullptr) children = new octomap::AbstractOcTreeNode*[kOctants]();
    return children[octant];
  }

  struct Descent {
    Node* node;
    bool created;
  };
  Descent childOrNew(Node& node, unsigned octant) {
    auto*& place = slot(node, octant);
    if (place != nullptr) return {static_cast<Node*>(place), false};
    Node* made = create(0.0F);
    place = made;
    return {made, true};
  }

  void expand(Node& node) {
    for (unsigned i = 0; i < kOctants; ++i) slot(node, i) = create(node.getValue());
  }

  /// As octomap on its way back up: prunes the node if its children are eight equal leaves, else takes their
  /// maximum.
  void settle(Node& node) {
    auto**& children = NodeAccess::childrenOf(node);
    const Node* first = static_cast<Node*>(children[0]);
    const bool prunable = std::all_of(children, children + kOctants, [&](auto* c) {
      auto* n = static_cast<Node*>(c);
      return n != nullptr && n->getValue() == first->getValue() && !hasChildren(*n);
    });
    if (!prunable) {
      node.updateOccupancyChildren();
      return;
    }
    node.setValue(first->getValue());
    for (unsigned i = 0; i < kOctants; ++i) delete static_cast<Node*>(children[i]);
    delete[] children;
    children = nullptr;
    size_ -= kOctants;
  }

  Odds odds_;
  std::size_t& size_;
};

}  // namespace

void updateTree(octomap::OcTree& tree, std::span<const BlockMarks> blocks) {
  if (blocks.empty()) return;
  Updater updater(tree);
  Node*& root = TreeAccess::rootOf(tree);
  const bool created = root == nullptr;
  if (created) root = updater.create(0.0F);
  if (updater.updateUpper(*root, created, kTreeLevels, blocks)) TreeAccess::sizeChanged(tree) = true;
}

}  // namespace hoctomap::engine
