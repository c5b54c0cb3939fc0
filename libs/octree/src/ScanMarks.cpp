// SPDX-License-Identifier: BSD-3-Clause
#include "ScanMarks.h"

#include <algorithm>
#include <limits>

namespace hoctomap::engine {

using Eigen::Vector3f;

namespace {

// A cell beyond an endpoint may come from rounding, never a second one.
constexpr int kMargin = 2;

/// The smallest box of coordinates around the origin and the ends of the beams.
struct Extent {
  explicit Extent(const Vector3f& origin) : low(origin), high(origin) {}
  void add(const Vector3f& p) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }

  Vector3f low;
  Vector3f high;
};

/// Keys that the beams of a scan can reach, wrapping aside.
KeyBox reachOf(const ScanBeams& scan) {
  const VoxelGrid& grid = scan.grid();
  Extent extent(scan.origin());
  const auto points = {scan.beams().hits, scan.beams().passing};
  for (const auto list : points) {
    for (const Vector3f& p : list) extent.add(p);
  }
  Key key;
  if (!grid.checkedKey(extent.low, key) || !grid.checkedKey(extent.high, key)) {
    // Leave out what no key can address: such ends are dropped, and without the origin there are no beams.
    extent.low.setConstant(std::numeric_limits<float>::max());
    extent.high = -extent.low;
    if (grid.checkedKey(scan.origin(), key)) extent.add(scan.origin());
    for (const auto list : points) {
      for (const Vector3f& p : list) {
        const Vector3f end = scan.isTooLong(p) ? scan.cut(p) : p;
        if (grid.checkedKey(end, key)) extent.add(end);
      }
    }
  }
  KeyBox box;
  if ((extent.low.array() > extent.high.array()).any()) {  // nothing at all
    box.max = {-1, -1, -1};
    return box;
  }
  for (std::size_t i = 0; i < 3; ++i) {
    const auto axis = static_cast<Eigen::Index>(i);
    box.min[i] = std::max(grid.clampedKey(extent.low[axis]) - kMargin, 0);
    box.max[i] = std::min(grid.clampedKey(extent.high[axis]) + kMargin, kMaxKey);
  }
  return box;
}

/// True if a cell next to the box would be beyond the key range.
bool touchesEnd(const KeyBox& box) {
  bool touches = false;
  for (std::size_t i = 0; i < 3; ++i) touches |= box.min[i] == 0 || box.max[i] == kMaxKey;
  return touches;
}

}  // namespace

ScanBeams::ScanBeams(const VoxelGrid& grid, const Beams& beams) : grid_(grid), beams_(beams) {
  const KeyBox reach = reachOf(*this);
  const KeyBox bounds = grid.keyBox(beams.bounds);
  box_ = reach.intersection(bounds);
  if (touchesEnd(reach) || !allAddressable()) findOddities(reach, bounds);
}

bool ScanBeams::allAddressable() const {
  Key key;
  return std::all_of(beams_.hits.begin(), beams_.hits.end(),
                     [&](const Vector3f& p) { return grid_.checkedKey(p, key); });
}

void ScanBeams::findOddities(const KeyBox& reach, const KeyBox& bounds) {
  const RayCaster caster(grid_, beams_.origin);
  const auto findStrays = [&](const Vector3f& end, const Key& key) {
    if (!caster.originValid() || key == caster.originKey()) return;
    const Ray ray = caster.prepare(end, key);
    if (isRegular(ray)) return;
    walkAsOctomap(ray, [&](const Key& k) {
      if (bounds.contains(k) && !reach.contains(k)) strays_.push_back(k);
    });
  };
  Key key;
  for (const Vector3f& p : beams_.hits) {
    const bool too_long = isTooLong(p);
    const Vector3f end = too_long ? cut(p) : p;
    if (grid_.checkedKey(end, key)) {
      findStrays(end, key);
    } else if (!too_long) {
      ++beyond_key_range_;
    }
  }
  for (const Vector3f& p : beams_.passing) {
    const Vector3f end = isTooLong(p) ? cut(p) : p;
    if (grid_.checkedKey(end, key)) findStrays(end, key);
  }
  std::sort(strays_.begin(), strays_.end());
  strays_.erase(std::unique(strays_.begin(), strays_.end()), strays_.end());
}

Vector3f ScanBeams::cut(const Vector3f& end) const {
  Vector3f direction = end - beams_.origin;
  const double length = norm(direction);
  if (length > 0.0) direction /= static_cast<float>(length);
  return beams_.origin + direction * static_cast<float>(beams_.max_range);
}

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

/// Adds points four at a time from the four quarters of the list: rays marked at the same time should not be
/// neighbours, or they wait for each other's writes to the same word. `before(p)` may change the point, or
/// return false to leave it out.
template <class Before>
void ScanMarks::addSpread(std::span<const Vector3f> points, Before&& before) {
  const std::size_t part = (points.size() + kLanes - 1) / kLanes;
  for (std::size_t i = 0; i < part; ++i) {
    std::array<Vector3f, kLanes> ends;
    std::size_t count = 0;
    for (std::size_t j = i; j < points.size(); j += part) {
      ends[count] = points[j];
      if (before(ends[count])) ++count;
    }
    if (count > 0) addRays(ends, count);
  }
}

void ScanMarks::addHits(std::span<const Vector3f> points) {
  addSpread(points, [this](Vector3f& p) {
    if (scan_.isTooLong(p)) {
      p = scan_.cut(p);
      return true;
    }
    Key key;
    if (!scan_.grid().checkedKey(p, key)) return false;
    if (box_.contains(key)) scratch_.occupied.mark(frame_.localCode(key));
    return true;
  });
}

void ScanMarks::addPassing(std::span<const Vector3f> points) {
  addSpread(points, [this](Vector3f& p) {
    if (scan_.isTooLong(p)) p = scan_.cut(p);
    return true;
  });
}

void ScanMarks::addRays(const std::array<Vector3f, kLanes>& ends, std::size_t count) {
  if (!fan_) return;
  RayBatch batch;
  prepare_(*fan_, ends, count, batch);
  for (std::size_t lane = 0; lane < count; ++lane) {
    switch (batch.state[lane]) {
      case RayBatch::State::none:
        break;
      case RayBatch::State::ready:
        marker_.add(batch.start, lane, batch.cells[lane]);
        break;
      case RayBatch::State::special:
        addSpecial(ends[lane]);
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
