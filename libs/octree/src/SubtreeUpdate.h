// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <bit>
#include <limits>
#include <span>

#include "BlockView.h"
#include "VoxelCube.h"

namespace hoctomap::engine {

/// The recursion. Each function brings one node up to date and tells whether octomap would have touched it;
/// what it would not touch stays as it is, even if it could be pruned.
class SubtreeUpdate {
 public:
  explicit SubtreeUpdate(const OccupancyOdds& odds) : odds_(odds), quad_odds_(odds) {}

  /// Nodes made less nodes pruned so far.
  [[nodiscard]] std::ptrdiff_t grown() const { return grown_; }

  Node* create(float value) {
    ++grown_;
    prototype_.setValue(value);
    return new Node(prototype_);  // copied, because the other constructors are calls into a shared library
  }

  struct Descent {
    Node* node;
    bool created;
  };
  Descent childOrNew(Node& node, unsigned octant) {
    auto*& place = childrenOrNew(node)[octant];
    if (place != nullptr) return {static_cast<Node*>(place), false};
    Node* made = create(0.0F);
    place = made;
    return {made, true};
  }

  void expand(Node& node) {
    auto** children = childrenOrNew(node);
    for (unsigned i = 0; i < kOctants; ++i) children[i] = create(node.getValue());
  }

  /// As octomap on its way back up: prunes the node if its children are eight equal leaves, else takes their
  /// maximum.
  void settle(Node& node) {
    auto* const* children = NodeAccess::childrenOf(node);
    float greatest = std::numeric_limits<float>::lowest();
    float least = std::numeric_limits<float>::max();
    bool full = true;
    for (unsigned i = 0; i < kOctants; ++i) {
      const auto* c = static_cast<const Node*>(children[i]);
      full = full && c != nullptr;
      if (c == nullptr) continue;
      greatest = std::max(greatest, c->getValue());
      least = std::min(least, c->getValue());
    }
    node.setValue(greatest);
    // Rarely so far: the children's own children are not read before.
    if (full && least == greatest && std::none_of(children, children + kOctants, [](auto* c) {
          return hasChildren(*static_cast<Node*>(c));
        })) {
      prune(node);
    }
  }

  bool updateBlock(Node& node, bool created, const BlockMarks& marks) {
    const BlockView view(marks);
    return update<kBlockLevel>(node, created, view, 0, view.coverage<kBlockLevel>(0));
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

 private:
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

    // The values first: where they turn out equal, no voxel is ever made. There are three kinds of voxels.
    const std::array<float, 3> values{created ? odds_.created(false) : odds_.updated(value, false),
                                      created ? odds_.created(true) : odds_.updated(value, true), value};
    const std::array<unsigned, 3> sets{free, occupied, created ? 0U : 0xFFU & ~(free | occupied)};
    float least = std::numeric_limits<float>::max();
    float greatest = std::numeric_limits<float>::lowest();
    for (std::size_t kind = 0; kind < sets.size(); ++kind) {
      if (sets[kind] == 0) continue;
      least = std::min(least, values[kind]);
      greatest = std::max(greatest, values[kind]);
    }
    node.setValue(greatest);
    if ((sets[0] | sets[1] | sets[2]) == 0xFFU && least == greatest) return true;
    auto** children = childrenOrNew(node);
    for (std::size_t kind = 0; kind < sets.size(); ++kind) {
      for (unsigned bits = sets[kind]; bits != 0; bits &= bits - 1) {
        children[std::countr_zero(bits)] = create(values[kind]);
      }
    }
    return true;
  }

  bool updateVoxels(Node& node, unsigned free, unsigned occupied) {
    auto** children = NodeAccess::childrenOf(node);
    VoxelCube cube(children);
    bool touched = cube.update(quad_odds_, free, occupied);
    for (unsigned missing = (free | occupied) & ~cube.present(); missing != 0; missing &= missing - 1) {
      const auto octant = static_cast<unsigned>(std::countr_zero(missing));
      Node* voxel = create(odds_.created((occupied >> octant & 1U) != 0));
      children[octant] = voxel;
      cube.insert(octant, voxel);
      touched = true;
    }
    if (!touched) return false;
    node.setValue(cube.greatest());
    if (cube.uniform()) prune(node);
    return true;
  }

  /// Takes the eight children away, which have none themselves.
  void prune(Node& node) {
    auto**& children = NodeAccess::childrenOf(node);
    for (unsigned i = 0; i < kOctants; ++i) delete static_cast<Node*>(children[i]);
    delete[] children;
    children = nullptr;
    grown_ -= kOctants;
  }

  OccupancyOdds odds_;
  QuadOdds quad_odds_;
  Node prototype_;
  std::ptrdiff_t grown_ = 0;
};

}  // namespace hoctomap::engine
