// SPDX-License-Identifier: BSD-3-Clause
#include "BulkUpdate.h"

#include <tbb/task_arena.h>

#include <vector>

#include "SubtreeUpdate.h"
#include "hoctomap/geometry/ForEachIndex.h"

namespace hoctomap::engine {

namespace {

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
  UpperNodes(SubtreeUpdate& updater, std::span<const BlockMarks> blocks, std::span<BlockJob> jobs)
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

  SubtreeUpdate& updater_;
  std::span<const BlockMarks> blocks_;
  std::span<BlockJob> jobs_;
};

void updateBlocks(const OccupancyOdds& odds, std::span<const BlockMarks> blocks, std::span<BlockJob> jobs) {
  // Isolated, lest a thread that waits here takes up another node's update, with memory of its own.
  tbb::this_task_arena::isolate([&] {
    forEachIndex(jobs.size(), [&](std::size_t i) {
      BlockJob& job = jobs[i];
      if (job.node == nullptr) return;
      SubtreeUpdate updater(odds);
      job.touched = updater.updateBlock(*job.node, job.created, blocks[i]);
      job.grown = updater.grown();
    });
  });
}

}  // namespace

void updateTree(octomap::OcTree& tree, std::span<const BlockMarks> blocks) {
  if (blocks.empty()) return;
  const OccupancyOdds odds(tree);
  SubtreeUpdate updater(odds);
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
