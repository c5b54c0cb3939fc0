// SPDX-License-Identifier: BSD-3-Clause
#include "hoctomap/octree/BlockScanUpdate.h"

#include <algorithm>

#include "BulkUpdate.h"
#include "RayClip.h"
#include "RayMarker.h"
#include "RayTraversal.h"
#include "VoxelBlocks.h"

namespace hoctomap {

namespace engine {
namespace {

using Eigen::Vector3f;

/// Keys that the beams of a scan can reach.
KeyBox reach(const VoxelGrid& grid, const Beams& beams) {
  // A cell beyond an endpoint may come from rounding, never a second one.
  constexpr int kMargin = 2;
  Vector3f low = beams.origin;
  Vector3f high = beams.origin;
  for (const auto points : {beams.hits, beams.passing}) {
    for (const Vector3f& p : points) {
      low = low.cwiseMin(p);
      high = high.cwiseMax(p);
    }
  }
  KeyBox box;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto axis = static_cast<Eigen::Index>(i);
    const int min = grid.clampedKey(low[axis]) - kMargin;
    const int max = grid.clampedKey(high[axis]) + kMargin;
    // At the ends of the key range that cell may wrap to the other end, as in octomap.
    if (min < 0 || max > kMaxKey) continue;
    box.min[i] = min;
    box.max[i] = max;
  }
  return box;
}

/// Calls f(point) for each point, hopping between the parts of the scan: rays marked at the same time should
/// not be neighbours, or they wait for each other's writes to the same word.
template <class F>
void forEachSpread(std::span<const Vector3f> points, F&& f) {
  constexpr std::size_t kParts = RayMarker::kLanes;
  const std::size_t part = (points.size() + kParts - 1) / kParts;
  for (std::size_t i = 0; i < part; ++i) {
    for (std::size_t j = i; j < points.size(); j += part) f(points[j]);
  }
}

/// Collects the voxels of one scan.
class ScanMarks {
 public:
  ScanMarks(const VoxelGrid& grid, const Beams& beams, bool best_instructions)
      : grid_(grid),
        beams_(beams),
        bounded_(beams.bounds.has_value()),
        box_(reach(grid, beams).intersection(grid.keyBox(beams.bounds))),
        frame_(box_),
        free_(frame_),
        occupied_(frame_),
        caster_(grid, beams.origin),
        filter_(grid, beams.origin, box_),
        marker_(frame_, free_, best_instructions) {
    forEachSpread(beams.hits, [this](const Vector3f& p) { addHit(p); });
    forEachSpread(beams.passing, [this](const Vector3f& p) { carve(isTooLong(p) ? cut(p) : p); });
    marker_.finish();
  }

  [[nodiscard]] const ScanUpdateReport& report() const { return report_; }

  /// The blocks in the order of the octree.
  [[nodiscard]] std::vector<BlockMarks> blocks() const {
    std::vector<BlockMarks> blocks;
    blocks.reserve(free_.created().size());
    for (const Code b : free_.created())
      blocks.push_back({frame_.treeCode(b), free_.find(b), occupied_.find(b)});
    for (const Code b : occupied_.created()) {
      if (free_.find(b) == nullptr) blocks.push_back({frame_.treeCode(b), nullptr, occupied_.find(b)});
    }
    std::sort(blocks.begin(), blocks.end(),
              [](const BlockMarks& a, const BlockMarks& b) { return a.tree_code < b.tree_code; });
    return blocks;
  }

 private:
  void addHit(const Vector3f& end) {
    if (isTooLong(end)) {
      carve(cut(end));
      return;
    }
    Key key;
    if (!grid_.checkedKey(end, key)) {
      ++report_.beyond_key_range;
      return;
    }
    if (box_.contains(key)) occupied_.mark(frame_.localCode(key));
    carve(end, key);
  }

  // As octomap, with its order of operations: they decide the last bit of the new end.
  [[nodiscard]] static double norm(const Vector3f& v) {
    return std::sqrt(static_cast<double>(v.x() * v.x() + v.y() * v.y() + v.z() * v.z()));
  }
  [[nodiscard]] bool isTooLong(const Vector3f& end) const {
    return beams_.max_range >= 0.0 && norm(end - beams_.origin) > beams_.max_range;
  }
  [[nodiscard]] Vector3f cut(const Vector3f& end) const {
    Vector3f direction = end - beams_.origin;
    const double length = norm(direction);
    if (length > 0.0) direction /= static_cast<float>(length);
    return beams_.origin + direction * static_cast<float>(beams_.max_range);
  }

  void carve(const Vector3f& end) {
    Key key;
    if (grid_.checkedKey(end, key)) carve(end, key);
  }

  void carve(const Vector3f& end, const Key& end_key) {
    if (!caster_.originValid() || end_key == caster_.originKey()) return;
    if (bounded_ && !filter_.mayMeet(end)) return;
    const Ray ray = caster_.prepare(end, end_key);
    if (!isRegular(ray)) {
      walkAsOctomap(ray, [this](const Key& key) {
        if (box_.contains(key)) free_.mark(frame_.localCode(key));
      });
    } else if (!bounded_) {
      marker_.add(ray, wholeRay(ray));
    } else if (const auto inside = clipRegularRay(ray, box_)) {
      marker_.add(ray, *inside);
    }
  }

  const VoxelGrid& grid_;
  const Beams& beams_;
  bool bounded_;
  KeyBox box_;
  BlockFrame frame_;
  VoxelBlocks free_;
  VoxelBlocks occupied_;
  RayCaster caster_;
  BoxFilter filter_;
  RayMarker marker_;
  ScanUpdateReport report_;
};

}  // namespace
}  // namespace engine

namespace {

class BlockScanUpdate : public ScanUpdate {
 public:
  explicit BlockScanUpdate(Instructions instructions) : instructions_(instructions) {}

  ScanUpdateReport apply(octomap::OcTree& tree, const Beams& beams) const override {
    if (tree.isChangeDetectionEnabled()) return reference_->apply(tree, beams);
    const engine::VoxelGrid grid(tree.getResolution());
    const engine::ScanMarks marks(grid, beams, instructions_ == Instructions::best);
    engine::updateTree(tree, marks.blocks());
    return marks.report();
  }

 private:
  Instructions instructions_;
  std::unique_ptr<ScanUpdate> reference_ = makeReferenceScanUpdate();
};

}  // namespace

std::unique_ptr<ScanUpdate> makeBlockScanUpdate(Instructions instructions) {
  return std::make_unique<BlockScanUpdate>(instructions);
}

}  // namespace hoctomap
