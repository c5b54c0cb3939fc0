// SPDX-License-Identifier: BSD-3-Clause
#include "hoctomap/octree/BlockScanUpdate.h"

#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <mutex>

#include "BeamDensity.h"
#include "BulkUpdate.h"
#include "ScanMarks.h"
#include "hoctomap/geometry/ForEachIndex.h"

namespace hoctomap {

namespace {

using engine::KeyBox;
using engine::ScanBeams;
using engine::ScanMarks;
using engine::Scratch;

using Points = std::span<const Eigen::Vector3f>;

/// Beams of a part of a scan, see `Beams`.
struct BeamsOfPart {
  Points hits;
  Points passing;
  Points endpoints;

  [[nodiscard]] bool empty() const { return hits.empty() && passing.empty() && endpoints.empty(); }
  [[nodiscard]] std::size_t beams() const { return hits.size() + passing.size(); }

  /// The `task`th of so many shares.
  [[nodiscard]] BeamsOfPart share(std::size_t task, std::size_t tasks) const {
    const auto of = [&](Points points) {
      const std::size_t first = points.size() * task / tasks;
      return points.subspan(first, points.size() * (task + 1) / tasks - first);
    };
    return {of(hits), of(passing), of(endpoints)};
  }
};

/// Those of a part that may meet a box.
class BeamsNear {
 public:
  BeamsNear(const ScanBeams& scan, const BeamsOfPart& part, const KeyBox& box) {
    const engine::BoxFilter filter(scan.grid(), scan.origin(), box);
    const auto take = [&filter](Points points, std::vector<Eigen::Vector3f>& near) {
      std::copy_if(points.begin(), points.end(), std::back_inserter(near),
                   [&filter](const Eigen::Vector3f& end) { return filter.mayMeet(end); });
    };
    take(part.hits, hits_);
    take(part.passing, passing_);
    take(part.endpoints, endpoints_);
  }
  [[nodiscard]] BeamsOfPart part() const { return {hits_, passing_, endpoints_}; }

 private:
  std::vector<Eigen::Vector3f> hits_;
  std::vector<Eigen::Vector3f> passing_;
  std::vector<Eigen::Vector3f> endpoints_;
};

/// The two halves of a box, cut across its longest edge at a border of blocks.
std::array<KeyBox, 2> halves(const KeyBox& box) {
  std::size_t axis = 0;
  for (std::size_t i = 1; i < 3; ++i) {
    if (box.max[i] - box.min[i] > box.max[axis] - box.min[axis]) axis = i;
  }
  constexpr int kBlockEdge = 1 << engine::kBlockLevel;
  const int middle = ((box.min[axis] + box.max[axis]) / 2 + kBlockEdge) & ~(kBlockEdge - 1);
  std::array<KeyBox, 2> both{box, box};
  both[0].max[axis] = middle - 1;
  both[1].min[axis] = middle;
  return both;
}

/// Scratch memory of the updates under way; given back, it serves the next ones.
class ScratchPool {
 public:
  std::unique_ptr<Scratch> take() {
    const std::lock_guard lock(mutex_);
    if (unused_.empty()) return std::make_unique<Scratch>();
    auto scratch = std::move(unused_.back());
    unused_.pop_back();
    return scratch;
  }
  void giveBack(std::unique_ptr<Scratch> scratch) {
    const std::lock_guard lock(mutex_);
    unused_.push_back(std::move(scratch));
  }

 private:
  std::mutex mutex_;
  std::vector<std::unique_ptr<Scratch>> unused_;
};

/// One scan into one tree. What does not fit one bitmap is done in parts, one after the other: the voxels of
/// different parts do not depend on each other.
class ScanPass {
 public:
  ScanPass(octomap::OcTree& tree, const ScanBeams& scan, engine::InstructionSet set, ScratchPool& pool)
      : tree_(tree), scan_(scan), set_(set), pool_(pool), max_pages_(maxPages(scan)) {}

  void run() {
    const Beams& beams = scan_.beams();
    if (!scan_.box().empty())
      updatePart(scan_.box(), scan_.bounded(), {beams.hits, beams.passing, beams.endpoints});
    for (const engine::Key& key : scan_.strays()) updateStray(key);
  }

 private:
  void updatePart(const KeyBox& box, bool bounded, const BeamsOfPart& beams) {
    if (beams.empty()) return;
    if (isTooLarge(box, beams)) {
      for (const KeyBox& half : halves(box)) {
        const BeamsNear near(scan_, beams, half);
        updatePart(half, true, near.part());
      }
      return;
    }
    const std::size_t tasks = tasksFor(beams.beams());
    std::vector<std::unique_ptr<Scratch>> scratch(tasks);
    for (auto& s : scratch) {
      s = pool_.take();
      s->keepAtMost(static_cast<std::size_t>(max_pages_));  // of all parts together
    }
    {
      std::vector<std::unique_ptr<ScanMarks>> marks(tasks);
      const auto mark = [&](std::size_t task) {
        marks[task] = std::make_unique<ScanMarks>(scan_, box, bounded, set_, *scratch[task]);
        const BeamsOfPart share = beams.share(task, tasks);
        marks[task]->addHits(share.hits);
        marks[task]->addPassing(share.passing);
        marks[task]->addEndpoints(share.endpoints);
        marks[task]->finish();
      };
      if (tasks == 1) {
        mark(0);
      } else {
        tbb::this_task_arena::isolate([&] { forEachIndex(tasks, mark); });
      }
      for (std::size_t task = 1; task < tasks; ++task) {
        marks[0]->unite(*marks[task]);
        marks[task].reset();
      }
      engine::updateTree(tree_, marks[0]->blocks());
    }
    for (auto& s : scratch) pool_.giveBack(std::move(s));
  }

  /// Pages that the box could take.
  static double pagesIn(const KeyBox& box) {
    constexpr double kPageEdge = 32.0;
    double pages = 1.0;
    for (std::size_t i = 0; i < 3; ++i) pages *= (box.max[i] - box.min[i]) / kPageEdge + 1.0;
    return pages;
  }

  /// Pages of a bitmap at a time. Beams that are far apart make as much of a tree as of a bitmap: then a
  /// small share of the tree. (Many beams are not gone through part by part for that: it would cost time.)
  static double maxPages(const ScanBeams& scan) {
    constexpr std::size_t kFewBeams = 20000;
    constexpr double kLeast = 768.0;  // 3 MB
    constexpr double kShare = 0.03;
    constexpr double kSamples = 1 << 14;
    const auto& [hits, passing] = std::pair(scan.beams().hits, scan.beams().passing);
    if (hits.size() + passing.size() > kFewBeams || scan.box().empty() ||
        pagesIn(scan.box()) < 2.0 * kLeast) {
      return engine::kMaxPagesAPart;
    }
    const double tree = engine::BeamDensity(scan, scan.box(), hits, passing, kSamples).treeBytes();
    constexpr double kPageBytes = engine::kPageWords * sizeof(engine::BlockBits);
    return std::clamp(kShare * tree / kPageBytes, kLeast, engine::kMaxPagesAPart);
  }

  /// True if the box does not fit a bitmap, or the bitmap would take too much memory.
  bool isTooLarge(const KeyBox& box, const BeamsOfPart& beams) const {
    if (engine::BlockFrame(box).levels() > engine::BlockFrame::kMaxLevels) return true;
    constexpr double kSamples = 1 << 16;
    return pagesIn(box) > max_pages_ &&
           engine::BeamDensity(scan_, box, beams.hits, beams.passing, kSamples).pages() > max_pages_;
  }

  /// Shares of the beams marked at the same time, each with bitmaps of its own: few, and none too small.
  static std::size_t tasksFor(std::size_t beams) {
    constexpr std::size_t kBeamsATask = 4000;
    const std::size_t threads =
        std::min(static_cast<std::size_t>(tbb::this_task_arena::max_concurrency()),
                 tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism));
    return std::clamp(beams / kBeamsATask, std::size_t{1}, threads);
  }

  void updateStray(const engine::Key& key) {
    auto scratch = pool_.take();
    {
      ScanMarks marks(scan_, {key, key}, true, set_, *scratch);
      marks.addFree(key);
      engine::updateTree(tree_, marks.blocks());
    }
    pool_.giveBack(std::move(scratch));
  }

  octomap::OcTree& tree_;
  const ScanBeams& scan_;
  engine::InstructionSet set_;
  ScratchPool& pool_;
  double max_pages_;
};

class BlockScanUpdate : public ScanUpdate {
 public:
  explicit BlockScanUpdate(Instructions instructions)
      : set_(std::min(engine::bestInstructionSet(), limit(instructions))) {}

  ScanUpdateReport apply(octomap::OcTree& tree, const Beams& beams) const override {
    if (tree.isChangeDetectionEnabled()) return reference_->apply(tree, beams);
    const engine::VoxelGrid grid(tree.getResolution());
    const ScanBeams scan(grid, beams);
    ScanPass(tree, scan, set_, pool_).run();
    return {scan.beyondKeyRange()};
  }

 private:
  static engine::InstructionSet limit(Instructions instructions) {
    switch (instructions) {
      case Instructions::best:
        break;
      case Instructions::avx2:
        return engine::InstructionSet::avx2;
      case Instructions::baseline:
        return engine::InstructionSet::baseline;
    }
    return engine::InstructionSet::avx512;
  }

  engine::InstructionSet set_;
  std::unique_ptr<ScanUpdate> reference_ = makeReferenceScanUpdate();
  mutable ScratchPool pool_;
};

}  // namespace

std::unique_ptr<ScanUpdate> makeBlockScanUpdate(Instructions instructions) {
  return std::make_unique<BlockScanUpdate>(instructions);
}

}  // namespace hoctomap
