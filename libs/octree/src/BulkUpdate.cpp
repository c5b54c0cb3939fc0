// SPDX-License-Identifier: BSD-3-Clause
#include "BulkUpdate.h"

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <limits>
#include <vector>

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
  explicit Updater(const Odds& odds) : odds_(odds) {}

  /// Nodes made less nodes pruned so far.
  [[nodiscard]] std::ptrdiff_t grown() const { return grown_; }

  Node* create(float value) {
    ++grown_;
    auto* node = new Node();
    node->setValue(value);
    return node;
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
    auto**& children = NodeAccess::childrenOf(node);
    float greatest = std::numeric_limits<float>::lowest();
    unsigned leaves = 0;
    bool equal = true;
    float first = 0.0F;
    for (unsigned i = 0; i < kOctants; ++i) {
      auto* c = static_cast<Node*>(children[i]);
      if (c == nullptr) continue;
      const float value = c->getValue();
      greatest = std::max(greatest, value);
      if (leaves == 0) first = value;
      equal = equal && value == first;
      if (equal && !hasChildren(*c)) ++leaves;
    }
    node.setValue(greatest);
    if (leaves < kOctants || !equal) return;
    node.setValue(first);
    for (unsigned i = 0; i < kOctants; ++i) delete static_cast<Node*>(children[i]);
    delete[] children;
    children = nullptr;
    grown_ -= kOctants;
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
    for (unsigned i = 0; i < kOctants; ++i) {
      const std::size_t kind = (free >> i & 1U) != 0 ? 0 : (occupied >> i & 1U) != 0 ? 1 : 2;
      if (kind < 2 || !created) children[i] = create(values[kind]);
    }
    return true;
  }

  bool updateVoxels(Node& node, unsigned free, unsigned occupied) {
    bool touched = false;
    for (unsigned i = 0; i < kOctants; ++i) {
      if (((free | occupied) >> i & 1U) == 0) continue;
      const bool hit = (occupied >> i & 1U) != 0;
      Node* voxel = child(node, i);
      if (voxel == nullptr) {
        childrenOrNew(node)[i] = create(odds_.created(hit));
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

  static octomap::AbstractOcTreeNode** childrenOrNew(Node& node) {
    auto**& children = NodeAccess::childrenOf(node);
    if (children == nullptr) children = new octomap::AbstractOcTreeNode*[kOctants]();
    return children;
  }

  Odds odds_;
  std::ptrdiff_t grown_ = 0;
};

/// One block of the tree to be brought up to date. Different blocks have no node in common.
struct BlockJob {
  Node* node = nullptr;  ///< null: an ancestor is a leaf that the marks do not change
  bool created = false;
  bool touched = false;
  std::ptrdiff_t grown = 0;
};

/// The nodes above the blocks: down to the blocks, and, once these are up to date, back up.
class UpperNodes {
 public:
  UpperNodes(Updater& updater, std::span<const BlockMarks> blocks, std::span<BlockJob> jobs)
      : updater_(updater), blocks_(blocks), jobs_(jobs) {}

  /// Creates and expands the nodes that lead to the blocks [first, last).
  /// @param created the node has just been made: it has neither children nor a value of its own.
  void descend(Node& node, bool created, unsigned level, std::size_t first, std::size_t last) {
    if (level == kBlockLevel) {
      jobs_[first] = {&node, created};
      return;
    }
    if (!created && !hasChildren(node)) {
      if (updater_.keepsAll(node.getValue(), blocks_.subspan(first, last - first))) return;
      updater_.expand(node);
    }
    forEachOctant(level, first, last, [&](unsigned octant, std::size_t from, std::size_t to) {
      const auto [next, next_created] = updater_.childOrNew(node, octant);
      descend(*next, next_created, level - 1, from, to);
    });
  }

  /// Brings the inner nodes up to date. True if a block below was touched.
  bool ascend(Node& node, unsigned level, std::size_t first, std::size_t last) {
    if (level == kBlockLevel) return jobs_[first].touched;
    if (!hasChildren(node)) return false;
    bool touched = false;
    forEachOctant(level, first, last, [&](unsigned octant, std::size_t from, std::size_t to) {
      touched |= ascend(*child(node, octant), level - 1, from, to);
    });
    if (touched) updater_.settle(node);
    return touched;
  }

 private:
  template <class F>
  void forEachOctant(unsigned level, std::size_t first, std::size_t last, F&& f) {
    const unsigned shift = 3 * (level - 1 - kBlockLevel);
    const auto octant = [&](std::size_t i) {
      return static_cast<unsigned>(blocks_[i].tree_code >> shift) & 7U;
    };
    while (first < last) {
      std::size_t end = first + 1;
      while (end < last && octant(end) == octant(first)) ++end;
      f(octant(first), first, end);
      first = end;
    }
  }

  Updater& updater_;
  std::span<const BlockMarks> blocks_;
  std::span<BlockJob> jobs_;
};

void updateBlocks(const Odds& odds, std::span<const BlockMarks> blocks, std::span<BlockJob> jobs) {
  // Isolated, lest a thread that waits here takes up another node's update, with memory of its own.
  tbb::this_task_arena::isolate([&] {
    tbb::parallel_for(std::size_t{0}, jobs.size(), [&](std::size_t i) {
      BlockJob& job = jobs[i];
      if (job.node == nullptr) return;
      Updater updater(odds);
      job.touched = updater.updateBlock(*job.node, job.created, blocks[i]);
      job.grown = updater.grown();
    });
  });
}

}  // namespace

void updateTree(octomap::OcTree& tree, std::span<const BlockMarks> blocks) {
  if (blocks.empty()) return;
  const Odds odds(tree);
  Updater updater(odds);
  std::vector<BlockJob> jobs(blocks.size());
  UpperNodes upper(updater, blocks, jobs);
  Node*& root = TreeAccess::rootOf(tree);
  const bool created = root == nullptr;
  if (created) root = updater.create(0.0F);
  upper.descend(*root, created, kTreeLevels, 0, blocks.size());
  updateBlocks(odds, blocks, jobs);
  if (upper.ascend(*root, kTreeLevels, 0, blocks.size())) TreeAccess::sizeChanged(tree) = true;

  std::ptrdiff_t grown = updater.grown();
  for (const BlockJob& job : jobs) grown += job.grown;
  TreeAccess::sizeOf(tree) += static_cast<std::size_t>(grown);
}

}  // namespace hoctomap::engine
