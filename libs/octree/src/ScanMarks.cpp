// SPDX-License-Identifier: BSD-3-Clause
#include "ScanMarks.h"

#include <algorithm>

#include "BeamOrder.h"

namespace hoctomap::engine {

using Eigen::Vector3f;

ScanMarks::ScanMarks(const ScanBeams& scan, const KeyBox& box, bool bounded, bool best_instructions,
                     Scratch& scratch)
    : scan_(scan),
      box_(box),
      bounded_(bounded),
      frame_(box),
      scratch_(scratch),
      caster_(scan.grid(), scan.origin()),
      prepare_(choosePrepareRays(best_instructions)),
      marker_(scratch.free, best_instructions) {
  scratch_.free.open(frame_);
  scratch_.occupied.open(frame_);
  if (caster_.originValid()) fan_.emplace(scan.grid(), scan.origin(), box_, frame_, bounded_);
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
  Key key;
  for (const Vector3f& p : points) {
    if (scan_.isTooLong(p) || !scan_.grid().checkedKey(p, key)) continue;
    if (box_.contains(key)) scratch_.occupied.mark(frame_.localCode(key));
  }
}

void ScanMarks::addPassing(std::span<const Vector3f> points) {
  addBeams(points);
}

void ScanMarks::addBeams(std::span<const Vector3f> points) {
  if (!fan_) return;
  if (!box_.contains(caster_.originKey()) || !isDense(scan_, points)) {
    addSpread(points.size(),
              [&](std::size_t i, Ends& ends) { ends.points[ends.count++] = scan_.end(points[i]); });
    return;
  }
  const std::vector<AimedBeam> beams = orderByDirection(scan_, points);
  if (!reach_) reach_.emplace(scan_.grid(), scan_.origin(), frame_, scratch_.free);
  const auto addOneIn = [&](std::size_t stride, std::size_t first) {
    if (beams.size() <= first) return;
    reach_->refresh();
    addSpread((beams.size() - first + stride - 1) / stride, [&](std::size_t i, Ends& ends) {
      const AimedBeam& beam = beams[first + i * stride];
      const int steps = reach_->stepsMarked(beam.direction);
      ends.points[ends.count] = beam.end;
      ends.skip_steps[ends.count] = steps;
      ends.skip_axis[ends.count] = MarkedReach::axisOf(beam.direction);
      ends.skips |= steps > 0;
      ++ends.count;
    });
  };
  // Few beams in all directions first, then those between them.
  constexpr std::size_t kCoarsest = 32;
  addOneIn(kCoarsest, 0);
  for (std::size_t stride = kCoarsest; stride > 1; stride /= 2) addOneIn(stride, stride / 2);
}

/// Adds beams four at a time from the four quarters of a list: rays marked at the same time should not be
/// neighbours, or they wait for each other's writes to the same word.
template <class BeamAt>
void ScanMarks::addSpread(std::size_t count, BeamAt&& beamAt) {
  const std::size_t part = (count + kLanes - 1) / kLanes;
  for (std::size_t i = 0; i < part; ++i) {
    Ends ends;
    for (std::size_t j = i; j < count; j += part) beamAt(j, ends);
    addRays(ends);
  }
}

void ScanMarks::addRays(const Ends& ends) {
  RayBatch batch;
  prepare_(*fan_, ends, batch);
  for (std::size_t lane = 0; lane < ends.count; ++lane) {
    switch (batch.state[lane]) {
      case RayBatch::State::none:
        break;
      case RayBatch::State::ready:
        marker_.add(batch.start, lane, batch.cells[lane]);
        break;
      case RayBatch::State::special:
        addSpecial(ends.points[lane]);
        break;
    }
  }
}

void ScanMarks::addSpecial(const Vector3f& end) {
  Key key;
  if (!scan_.grid().checkedKey(end, key)) return;
  const Ray ray = caster_.prepare(end, key);
  if (!isRegular(ray)) {
    walkAsOctomap(ray, [this](const Key& k) {
      if (box_.contains(k)) addFree(k);
    });
  } else if (const auto inside = clipRegularRay(ray, box_)) {
    Traversals start;
    placeRay(*fan_, ray, *inside, start);
    marker_.add(start, 0, inside->cells);
  }
}

void ScanMarks::finish() {
  marker_.finish();
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
