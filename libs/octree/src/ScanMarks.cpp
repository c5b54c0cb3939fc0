// SPDX-License-Identifier: BSD-3-Clause
#include "ScanMarks.h"

#include <algorithm>

#include "DenseScan.h"

namespace hoctomap::engine {

using Eigen::Vector3f;

ScanMarks::ScanMarks(const ScanBeams& scan, const KeyBox& box, bool bounded, InstructionSet set,
                     Scratch& scratch)
    : scan_(scan),
      box_(box),
      bounded_(bounded),
      frame_(box),
      scratch_(scratch),
      caster_(scan.grid(), scan.origin()),
      mark_endpoints_(chooseMarkEndpoints(set)) {
  scratch_.free.open(frame_);
  scratch_.occupied.open(frame_);
  if (!caster_.originValid()) return;
  fan_.emplace(scan.grid(), scan.origin(), box_, frame_, bounded_);
  marker_.emplace(*fan_, scratch_.free, set);
}

ScanMarks::~ScanMarks() {
  scratch_.free.clear();
  scratch_.occupied.clear();
}

void ScanMarks::addHits(std::span<const Vector3f> points) {
  addEndpoints(points);
  addBeams(points);
}

void ScanMarks::addEndpoints(std::span<const Vector3f> points) {
  const EndpointField field(scan_.grid(), scan_.origin(), scan_.beams().max_range, box_, frame_);
  mark_endpoints_(field, points, scratch_.occupied);
}

void ScanMarks::addPassing(std::span<const Vector3f> points) {
  addBeams(points);
}

void ScanMarks::addBeams(std::span<const Vector3f> points) {
  if (!fan_) return;
  if (!box_.contains(caster_.originKey()) || !isDense(scan_, points)) {
    for (const Vector3f& p : points) marker_->add(scan_.end(p));
    return;
  }
  if (!reach_) reach_.emplace(scan_.grid(), scan_.origin(), frame_, scratch_.free);
  for (std::size_t round = 0; round < kRounds.size(); ++round) {
    marker_->finish();
    reach_->refresh();
    forEachOfRound(round, points.size(), [&](std::size_t i) {
      const Vector3f way = points[i] - scan_.origin();
      if (!hasDirection(way)) return;
      const Direction direction = directionOf(way);
      const int steps = round == 0 ? 0 : reach_->stepsMarked(direction);
      marker_->add(scan_.end(points[i]), MarkedReach::axisOf(direction), steps);
    });
  }
}

/// A ray that cannot be marked with others, or not for certain.
void ScanMarks::addExactly(const Vector3f& end) {
  Key key;
  if (!scan_.grid().checkedKey(end, key)) return;
  const Ray ray = caster_.prepare(end, key);
  if (!isRegular(ray)) {
    walkAsOctomap(ray, [this](const Key& k) {
      if (box_.contains(k)) addFree(k);
    });
  } else if (const auto inside = clipRegularRay(ray, box_)) {
    walkStretch(ray, *inside, [this](const Key& k) { addFree(k); });
  }
}

void ScanMarks::finish() {
  if (marker_) {
    marker_->finish();
    for (const Vector3f& end : marker_->special()) addExactly(end);
  }
  scratch_.free.unflagEmptyPages();
}

void ScanMarks::unite(const ScanMarks& other) {
  scratch_.free.unite(other.scratch_.free);
  scratch_.occupied.unite(other.scratch_.occupied);
}

std::vector<BlockMarks> ScanMarks::blocks() const {
  std::vector<BlockMarks> blocks;
  const auto count = static_cast<Code>(frame_.blocks());
  for (Code b = 0; b < count; ++b) {
    const std::uint64_t free = scratch_.free.blockPages(b);
    const std::uint64_t occupied = scratch_.occupied.blockPages(b);
    if ((free | occupied) == 0) continue;
    blocks.push_back(
        {frame_.treeCode(b), scratch_.free.block(b), scratch_.occupied.block(b), free, occupied});
  }
  std::sort(blocks.begin(), blocks.end(),
            [](const BlockMarks& a, const BlockMarks& b) { return a.tree_code < b.tree_code; });
  return blocks;
}

}  // namespace hoctomap::engine
